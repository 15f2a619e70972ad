/* The functions of FMI 3.0.2, model exchange and co-simulation, over variables.c and steps.c.
 *
 * Types and signatures are those of the standard: Functional Mock-up Interface Specification 3.0.2, headers
 * fmi3PlatformTypes.h, fmi3FunctionTypes.h and fmi3Functions.h.
 */
#include <stdbool.h>
#include <stdint.h>

typedef void *fmi3Instance, *fmi3InstanceEnvironment, *fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef double fmi3Float64;
typedef bool fmi3Boolean, fmi3Clock;
typedef const char *fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte *fmi3Binary;
typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum { fmi3Independent, fmi3Constant, fmi3Fixed, fmi3Tunable, fmi3Discrete, fmi3Dependent } fmi3DependencyKind;
typedef enum { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged } fmi3IntervalQualifier;
typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String, fmi3String);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment);
typedef void (*fmi3LockPreemptionCallback)(void);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment, fmi3Float64, fmi3Boolean, fmi3Boolean,
                                               fmi3Boolean, fmi3Boolean, fmi3Boolean *, fmi3Float64 *);

/* Source code may be linked into a program under names with a prefix. */
#ifdef FMI3_FUNCTION_PREFIX
#define GAUSS_JOIN_NAMES(a, b) a##b
#define GAUSS_JOIN(a, b) GAUSS_JOIN_NAMES(a, b)
#define NAMED(function) GAUSS_JOIN(FMI3_FUNCTION_PREFIX, function)
#else
#define NAMED(function) function
#endif
#define API EXPORTED fmi3Status NAMED

static void tell(instance *i, const char *message)
{
    if (i->log) ((fmi3LogMessageCallback)i->log)(i->environment, fmi3Error, "logStatusError", message);
}

static fmi3Status status(int done)
{
    return done ? fmi3OK : fmi3Error;
}

/* Whether a function may be called in the phase of the instance: a set of bits. */
static int is_in(instance *i, unsigned phases, const char *function)
{
    if (!i) return 0;
    if (phases >> i->now.phase & 1u) return 1;
    say(i, "%s cannot be called now", function);
    return 0;
}

#define ANY (~0u)
#define IN(phase) (1u << (phase))
#define RUNNING (IN(EVENTS) | IN(CONTINUOUS) | IN(STEPPING))

EXPORTED const char *NAMED(fmi3GetVersion)(void)
{
    return "3.0";
}

API(fmi3SetDebugLogging)(fmi3Instance c, fmi3Boolean logs, size_t count, const fmi3String categories[])
{
    (void)logs;
    (void)count;
    (void)categories;
    return status(c != NULL);
}

static fmi3Instance instantiate(fmi3String name, fmi3String token, int is_stepped, fmi3InstanceEnvironment environment,
                                fmi3LogMessageCallback log)
{
    instance *i;
    if (!token || strcmp(token, MODEL_TOKEN) != 0) {
        if (log) log(environment, fmi3Error, "logStatusError", "the instantiation token is not that of this binary");
        return NULL;
    }
    if (MODEL_CONTACTS > 0 && is_stepped) return NULL;
    i = calloc(1, sizeof *i);
    if (i) prepare(i, name, is_stepped, environment, (function)log);
    return i;
}

EXPORTED fmi3Instance NAMED(fmi3InstantiateModelExchange)(fmi3String name, fmi3String token, fmi3String resources,
                                                          fmi3Boolean visible, fmi3Boolean logs,
                                                          fmi3InstanceEnvironment environment,
                                                          fmi3LogMessageCallback log)
{
    (void)resources;
    (void)visible;
    (void)logs;
    return instantiate(name, token, 0, environment, log);
}

EXPORTED fmi3Instance NAMED(fmi3InstantiateCoSimulation)(fmi3String name, fmi3String token, fmi3String resources,
                                                         fmi3Boolean visible, fmi3Boolean logs, fmi3Boolean has_events,
                                                         fmi3Boolean returns_early,
                                                         const fmi3ValueReference intermediate[], size_t count,
                                                         fmi3InstanceEnvironment environment,
                                                         fmi3LogMessageCallback log,
                                                         fmi3IntermediateUpdateCallback update)
{
    (void)resources;
    (void)visible;
    (void)logs;
    (void)returns_early;
    (void)intermediate;
    (void)update;
    if (has_events || count > 0) {
        if (log) log(environment, fmi3Error, "logStatusError", "there is neither event mode nor intermediate update");
        return NULL;
    }
    return instantiate(name, token, 1, environment, log);
}

EXPORTED fmi3Instance NAMED(fmi3InstantiateScheduledExecution)(fmi3String name, fmi3String token, fmi3String resources,
                                                               fmi3Boolean visible, fmi3Boolean logs,
                                                               fmi3InstanceEnvironment environment,
                                                               fmi3LogMessageCallback log,
                                                               fmi3ClockUpdateCallback update,
                                                               fmi3LockPreemptionCallback lock,
                                                               fmi3LockPreemptionCallback unlock)
{
    (void)name;
    (void)token;
    (void)resources;
    (void)visible;
    (void)logs;
    (void)update;
    (void)lock;
    (void)unlock;
    if (log) log(environment, fmi3Error, "logStatusError", "there is no scheduled execution");
    return NULL;
}

EXPORTED void NAMED(fmi3FreeInstance)(fmi3Instance c)
{
    free(c);
}

API(fmi3EnterInitializationMode)(fmi3Instance c, fmi3Boolean has_tolerance, fmi3Float64 tolerance, fmi3Float64 begin,
                                 fmi3Boolean has_end, fmi3Float64 end)
{
    instance *i = c;
    (void)has_end;
    (void)end;
    if (!is_in(i, IN(INSTANTIATED), "fmi3EnterInitializationMode")) return fmi3Error;
    if (!set_experiment(i, has_tolerance, tolerance, begin)) return fmi3Error;
    i->now.phase = INITIALIZING;
    return fmi3OK;
}

API(fmi3ExitInitializationMode)(fmi3Instance c)
{
    instance *i = c;
    if (!is_in(i, IN(INITIALIZING), "fmi3ExitInitializationMode") || !start(i)) return fmi3Error;
    i->now.phase = i->is_stepped ? STEPPING : EVENTS;
    return fmi3OK;
}

API(fmi3Terminate)(fmi3Instance c)
{
    instance *i = c;
    if (!is_in(i, RUNNING, "fmi3Terminate")) return fmi3Error;
    i->now.phase = TERMINATED;
    return fmi3OK;
}

API(fmi3Reset)(fmi3Instance c)
{
    if (!c) return fmi3Error;
    reset(c);
    return fmi3OK;
}

API(fmi3GetFloat64)(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Float64 values[], size_t numbers)
{
    if (!is_in(c, ANY, "fmi3GetFloat64") || numbers != count) return fmi3Error;
    for (size_t k = 0; k < count; k++) {
        if (!get_value(c, vr[k], &values[k])) return fmi3Error;
    }
    return fmi3OK;
}

API(fmi3SetFloat64)(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Float64 values[],
                    size_t numbers)
{
    if (!is_in(c, IN(INSTANTIATED) | IN(INITIALIZING) | RUNNING, "fmi3SetFloat64") || numbers != count) {
        return fmi3Error;
    }
    for (size_t k = 0; k < count; k++) {
        if (!set_value(c, vr[k], values[k])) return fmi3Error;
    }
    return fmi3OK;
}

/* There are no variables of other types: a list of none is right. */
static fmi3Status none(instance *i, size_t count)
{
    if (i && count > 0) say(i, "all variables are of the type Float64");
    return status(i && count == 0);
}

#define OTHER(function, type)                                                                                          \
    API(function)(fmi3Instance c, const fmi3ValueReference vr[], size_t count, type values[], size_t numbers)          \
    {                                                                                                                  \
        (void)vr;                                                                                                      \
        (void)values;                                                                                                  \
        (void)numbers;                                                                                                 \
        return none(c, count);                                                                                         \
    }
OTHER(fmi3GetFloat32, float)
OTHER(fmi3GetInt8, int8_t)
OTHER(fmi3GetUInt8, uint8_t)
OTHER(fmi3GetInt16, int16_t)
OTHER(fmi3GetUInt16, uint16_t)
OTHER(fmi3GetInt32, int32_t)
OTHER(fmi3GetUInt32, uint32_t)
OTHER(fmi3GetInt64, int64_t)
OTHER(fmi3GetUInt64, uint64_t)
OTHER(fmi3GetBoolean, fmi3Boolean)
OTHER(fmi3GetString, fmi3String)
OTHER(fmi3SetFloat32, const float)
OTHER(fmi3SetInt8, const int8_t)
OTHER(fmi3SetUInt8, const uint8_t)
OTHER(fmi3SetInt16, const int16_t)
OTHER(fmi3SetUInt16, const uint16_t)
OTHER(fmi3SetInt32, const int32_t)
OTHER(fmi3SetUInt32, const uint32_t)
OTHER(fmi3SetInt64, const int64_t)
OTHER(fmi3SetUInt64, const uint64_t)
OTHER(fmi3SetBoolean, const fmi3Boolean)
OTHER(fmi3SetString, const fmi3String)

/* The same of what has more or fewer arguments. */
#define OTHER_OF_TWO(function, first, second)                                                                          \
    API(function)(fmi3Instance c, const fmi3ValueReference vr[], size_t count, first one[], second two[])              \
    {                                                                                                                  \
        (void)vr;                                                                                                      \
        (void)one;                                                                                                     \
        (void)two;                                                                                                     \
        return none(c, count);                                                                                         \
    }
#define OTHER_OF_ONE(function, type)                                                                                   \
    API(function)(fmi3Instance c, const fmi3ValueReference vr[], size_t count, type values[])                          \
    {                                                                                                                  \
        (void)vr;                                                                                                      \
        (void)values;                                                                                                  \
        return none(c, count);                                                                                         \
    }
OTHER_OF_ONE(fmi3GetClock, fmi3Clock)
OTHER_OF_ONE(fmi3SetClock, const fmi3Clock)
OTHER_OF_ONE(fmi3GetShiftDecimal, fmi3Float64)
OTHER_OF_ONE(fmi3SetIntervalDecimal, const fmi3Float64)
OTHER_OF_ONE(fmi3SetShiftDecimal, const fmi3Float64)
OTHER_OF_TWO(fmi3GetIntervalDecimal, fmi3Float64, fmi3IntervalQualifier)
OTHER_OF_TWO(fmi3GetShiftFraction, uint64_t, uint64_t)
OTHER_OF_TWO(fmi3SetIntervalFraction, const uint64_t, const uint64_t)
OTHER_OF_TWO(fmi3SetShiftFraction, const uint64_t, const uint64_t)

API(fmi3GetIntervalFraction)(fmi3Instance c, const fmi3ValueReference vr[], size_t count, uint64_t counters[],
                             uint64_t resolutions[], fmi3IntervalQualifier qualifiers[])
{
    (void)vr;
    (void)counters;
    (void)resolutions;
    (void)qualifiers;
    return none(c, count);
}

API(fmi3GetBinary)(fmi3Instance c, const fmi3ValueReference vr[], size_t count, size_t sizes[], fmi3Binary values[],
                   size_t numbers)
{
    (void)vr;
    (void)sizes;
    (void)values;
    (void)numbers;
    return none(c, count);
}

API(fmi3SetBinary)(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const size_t sizes[],
                   const fmi3Binary values[], size_t numbers)
{
    (void)vr;
    (void)sizes;
    (void)values;
    (void)numbers;
    return none(c, count);
}

/* Functions that are not offered, as modelDescription.xml says. */
static fmi3Status not_offered(instance *i, const char *what)
{
    if (i) say(i, "%s are not offered", what);
    return fmi3Error;
}

API(fmi3GetNumberOfVariableDependencies)(fmi3Instance c, fmi3ValueReference vr, size_t *count)
{
    (void)vr;
    (void)count;
    return not_offered(c, "dependencies for each element");
}

API(fmi3GetVariableDependencies)(fmi3Instance c, fmi3ValueReference dependent, size_t elements[],
                                 fmi3ValueReference independents[], size_t others[], fmi3DependencyKind kinds[],
                                 size_t count)
{
    (void)dependent;
    (void)elements;
    (void)independents;
    (void)others;
    (void)kinds;
    (void)count;
    return not_offered(c, "dependencies for each element");
}

API(fmi3GetAdjointDerivative)(fmi3Instance c, const fmi3ValueReference unknowns[], size_t unknown_count,
                              const fmi3ValueReference knowns[], size_t known_count, const fmi3Float64 seed[],
                              size_t seeds, fmi3Float64 sensitivity[], size_t sensitivities)
{
    (void)unknowns;
    (void)unknown_count;
    (void)knowns;
    (void)known_count;
    (void)seed;
    (void)seeds;
    (void)sensitivity;
    (void)sensitivities;
    return not_offered(c, "adjoint derivatives");
}

API(fmi3GetOutputDerivatives)(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const int32_t orders[],
                              fmi3Float64 values[], size_t numbers)
{
    (void)vr;
    (void)orders;
    (void)values;
    (void)numbers;
    return count == 0 && c ? fmi3OK : not_offered(c, "derivatives of outputs by time");
}

API(fmi3ActivateModelPartition)(fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time)
{
    (void)clock;
    (void)time;
    return not_offered(c, "model partitions");
}

API(fmi3EnterConfigurationMode)(fmi3Instance c)
{
    return not_offered(c, "structural parameters");
}

API(fmi3ExitConfigurationMode)(fmi3Instance c)
{
    return not_offered(c, "structural parameters");
}

API(fmi3EnterStepMode)(fmi3Instance c)
{
    return not_offered(c, "events of co-simulation");
}

API(fmi3GetFMUState)(fmi3Instance c, fmi3FMUState *state)
{
    instance *i = c;
    if (!i || !state) return fmi3Error;
    if (!*state) *state = calloc(1, sizeof(memory));
    if (!*state) {
        say(i, "no memory for a state");
        return fmi3Error;
    }
    memcpy(*state, &i->now, sizeof(memory));
    return fmi3OK;
}

API(fmi3SetFMUState)(fmi3Instance c, fmi3FMUState state)
{
    instance *i = c;
    if (!i || !state) return fmi3Error;
    memcpy(&i->now, state, sizeof(memory));
    return fmi3OK;
}

API(fmi3FreeFMUState)(fmi3Instance c, fmi3FMUState *state)
{
    if (!c || !state) return fmi3Error;
    free(*state);
    *state = NULL;
    return fmi3OK;
}

API(fmi3SerializedFMUStateSize)(fmi3Instance c, fmi3FMUState state, size_t *size)
{
    if (!c || !state) return fmi3Error;
    *size = SERIALIZED;
    return fmi3OK;
}

API(fmi3SerializeFMUState)(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size)
{
    return status(c && state && serialize(c, state, (char *)bytes, size));
}

API(fmi3DeserializeFMUState)(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state)
{
    memory read;
    if (!c || !state || !deserialize(c, (const char *)bytes, size, &read)) return fmi3Error;
    if (!*state) *state = calloc(1, sizeof(memory));
    if (!*state) return fmi3Error;
    memcpy(*state, &read, sizeof read);
    return fmi3OK;
}

API(fmi3GetDirectionalDerivative)(fmi3Instance c, const fmi3ValueReference unknowns[], size_t unknown_count,
                                  const fmi3ValueReference knowns[], size_t known_count, const fmi3Float64 seed[],
                                  size_t seeds, fmi3Float64 sensitivity[], size_t sensitivities)
{
    if (!is_in(c, IN(INITIALIZING) | RUNNING, "fmi3GetDirectionalDerivative")) return fmi3Error;
    if (seeds != known_count || sensitivities != unknown_count) return fmi3Error;
    return status(directional(c, unknowns, unknown_count, knowns, known_count, seed, sensitivity));
}

/* Model exchange. */

API(fmi3EnterEventMode)(fmi3Instance c)
{
    instance *i = c;
    if (!is_in(i, IN(CONTINUOUS) | IN(EVENTS), "fmi3EnterEventMode")) return fmi3Error;
    i->now.phase = EVENTS;
    return fmi3OK;
}

API(fmi3EvaluateDiscreteStates)(fmi3Instance c)
{
    return is_in(c, IN(INITIALIZING) | IN(EVENTS), "fmi3EvaluateDiscreteStates") ? fmi3OK : fmi3Error;
}

API(fmi3UpdateDiscreteStates)(fmi3Instance c, fmi3Boolean *needs, fmi3Boolean *terminates, fmi3Boolean *nominals,
                              fmi3Boolean *values, fmi3Boolean *has_next, fmi3Float64 *next)
{
    instance *i = c;
    int changed = 0;
    (void)next;
    if (!is_in(i, IN(EVENTS), "fmi3UpdateDiscreteStates") || !make_constants(i) || !settle(i, &changed)) {
        return fmi3Error;
    }
    *needs = *terminates = *nominals = *has_next = false;
    *values = changed;
    return fmi3OK;
}

API(fmi3EnterContinuousTimeMode)(fmi3Instance c)
{
    instance *i = c;
    if (!is_in(i, IN(EVENTS), "fmi3EnterContinuousTimeMode")) return fmi3Error;
    i->now.phase = CONTINUOUS;
    return fmi3OK;
}

API(fmi3CompletedIntegratorStep)(fmi3Instance c, fmi3Boolean keeps, fmi3Boolean *event, fmi3Boolean *terminate)
{
    instance *i = c;
    (void)keeps;
    if (!is_in(i, IN(CONTINUOUS), "fmi3CompletedIntegratorStep") || !make_constants(i)) return fmi3Error;
    *event = has_missed(&i->now);
    *terminate = false;
    return fmi3OK;
}

API(fmi3SetTime)(fmi3Instance c, fmi3Float64 time)
{
    if (!is_in(c, IN(EVENTS) | IN(CONTINUOUS), "fmi3SetTime")) return fmi3Error;
    return status(set_time(c, time));
}

API(fmi3SetContinuousStates)(fmi3Instance c, const fmi3Float64 states[], size_t count)
{
    if (!is_in(c, IN(CONTINUOUS), "fmi3SetContinuousStates")) return fmi3Error;
    return status(set_states(c, states, count));
}

API(fmi3GetContinuousStateDerivatives)(fmi3Instance c, fmi3Float64 rates[], size_t count)
{
    instance *i = c;
    if (!is_in(i, IN(INITIALIZING) | IN(EVENTS) | IN(CONTINUOUS), "fmi3GetContinuousStateDerivatives") ||
        count != STATES || !make_constants(i)) {
        return fmi3Error;
    }
    /* A state that a solver tries: it takes a shorter step. */
    if (!make_rates(i)) return fmi3Discard;
    memcpy(rates, i->now.rates, count * sizeof *rates);
    return fmi3OK;
}

API(fmi3GetEventIndicators)(fmi3Instance c, fmi3Float64 indicators[], size_t count)
{
    if (!is_in(c, IN(INITIALIZING) | IN(EVENTS) | IN(CONTINUOUS), "fmi3GetEventIndicators")) return fmi3Error;
    return status(count == MODEL_INDICATORS && make_indicators(c, indicators));
}

API(fmi3GetContinuousStates)(fmi3Instance c, fmi3Float64 states[], size_t count)
{
    instance *i = c;
    if (!i || count != STATES) return fmi3Error;
    memcpy(states, i->now.states, count * sizeof *states);
    return fmi3OK;
}

API(fmi3GetNominalsOfContinuousStates)(fmi3Instance c, fmi3Float64 nominals[], size_t count)
{
    if (!c || count != STATES) return fmi3Error;
    for (size_t k = 0; k < count; k++) nominals[k] = 1.0;
    return fmi3OK;
}

API(fmi3GetNumberOfEventIndicators)(fmi3Instance c, size_t *count)
{
    if (!c) return fmi3Error;
    *count = MODEL_INDICATORS;
    return fmi3OK;
}

API(fmi3GetNumberOfContinuousStates)(fmi3Instance c, size_t *count)
{
    if (!c) return fmi3Error;
    *count = STATES;
    return fmi3OK;
}

/* Co-simulation. */

API(fmi3DoStep)(fmi3Instance c, fmi3Float64 time, fmi3Float64 step, fmi3Boolean keeps, fmi3Boolean *event,
                fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *last)
{
    instance *i = c;
    int done;
    (void)keeps;
    if (!is_in(i, IN(STEPPING), "fmi3DoStep")) return fmi3Error;
    done = step_to(i, time, step);
    *event = *terminate = *early = false;
    *last = i->now.time;
    return status(done);
}
