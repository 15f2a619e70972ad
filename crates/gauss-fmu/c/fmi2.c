/* The functions of FMI 2.0.4, model exchange and co-simulation, over variables.c and steps.c.
 *
 * Types and signatures are those of the standard: Functional Mock-up Interface for Model Exchange and Co-Simulation
 * 2.0.4, headers fmi2TypesPlatform.h, fmi2FunctionTypes.h and fmi2Functions.h.
 */

typedef void *fmi2Component, *fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer, fmi2Boolean;
typedef const char *fmi2String;
typedef char fmi2Byte;
typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef struct {
    void (*logger)(void *, fmi2String, fmi2Status, fmi2String, fmi2String, ...);
    void *(*allocateMemory)(size_t, size_t);
    void (*freeMemory)(void *);
    void (*stepFinished)(void *, fmi2Status);
    void *componentEnvironment;
} fmi2CallbackFunctions;

typedef struct {
    fmi2Boolean newDiscreteStatesNeeded, terminateSimulation, nominalsOfContinuousStatesChanged;
    fmi2Boolean valuesOfContinuousStatesChanged, nextEventTimeDefined;
    fmi2Real nextEventTime;
} fmi2EventInfo;

/* Source code may be linked into a program under names with a prefix. */
#ifdef FMI2_FUNCTION_PREFIX
#define GAUSS_JOIN_NAMES(a, b) a##b
#define GAUSS_JOIN(a, b) GAUSS_JOIN_NAMES(a, b)
#define NAMED(function) GAUSS_JOIN(FMI2_FUNCTION_PREFIX, function)
#else
#define NAMED(function) function
#endif
#define API EXPORTED fmi2Status NAMED

/* Hands a message to the logger; `%` and `#` have a meaning there. */
static void tell(instance *i, const char *message)
{
    char plain[2 * sizeof i->message];
    size_t length = 0;
    const fmi2CallbackFunctions *callbacks = i->environment;
    if (!callbacks->logger) return;
    for (; *message; message++) {
        if (*message == '%' || *message == '#') plain[length++] = *message;
        plain[length++] = *message;
    }
    plain[length] = '\0';
    callbacks->logger(callbacks->componentEnvironment, i->name, fmi2Error, "logStatusError", plain);
}

static fmi2Status status(int done)
{
    return done ? fmi2OK : fmi2Error;
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

EXPORTED const char *NAMED(fmi2GetTypesPlatform)(void)
{
    return "default";
}

EXPORTED const char *NAMED(fmi2GetVersion)(void)
{
    return "2.0";
}

/* The functions of the caller's that the instance was made with. */
static const fmi2CallbackFunctions *callbacks_of(const instance *i)
{
    return i->environment;
}

API(fmi2SetDebugLogging)(fmi2Component c, fmi2Boolean logs, size_t count, const fmi2String categories[])
{
    (void)logs;
    (void)count;
    (void)categories;
    return status(c != NULL);
}

EXPORTED fmi2Component NAMED(fmi2Instantiate)(fmi2String name, fmi2Type type, fmi2String token, fmi2String resources,
                                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible,
                                              fmi2Boolean logs)
{
    instance *i;
    (void)resources;
    (void)visible;
    (void)logs;
    if (!callbacks || !callbacks->allocateMemory || !callbacks->freeMemory) return NULL;
    if (!token || strcmp(token, MODEL_TOKEN) != 0) {
        if (callbacks->logger) {
            callbacks->logger(callbacks->componentEnvironment, name ? name : "?", fmi2Error, "logStatusError",
                              "the GUID is not that of this binary");
        }
        return NULL;
    }
    if (MODEL_CONTACTS > 0 && type == fmi2CoSimulation) return NULL;
    i = callbacks->allocateMemory(1, sizeof *i);
    if (!i) return NULL;
    memset(i, 0, sizeof *i);
    prepare(i, name, type == fmi2CoSimulation, (void *)callbacks, NULL);
    return i;
}

EXPORTED void NAMED(fmi2FreeInstance)(fmi2Component c)
{
    if (c) callbacks_of(c)->freeMemory(c);
}

API(fmi2SetupExperiment)(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real begin,
                         fmi2Boolean has_end, fmi2Real end)
{
    (void)has_end;
    (void)end;
    if (!is_in(c, IN(INSTANTIATED), "fmi2SetupExperiment")) return fmi2Error;
    return status(set_experiment(c, has_tolerance, tolerance, begin));
}

API(fmi2EnterInitializationMode)(fmi2Component c)
{
    instance *i = c;
    if (!is_in(i, IN(INSTANTIATED), "fmi2EnterInitializationMode")) return fmi2Error;
    i->now.phase = INITIALIZING;
    return fmi2OK;
}

API(fmi2ExitInitializationMode)(fmi2Component c)
{
    instance *i = c;
    if (!is_in(i, IN(INITIALIZING), "fmi2ExitInitializationMode")) return fmi2Error;
    if (!start(i)) return fmi2Error;
    i->now.phase = i->is_stepped ? STEPPING : EVENTS;
    return fmi2OK;
}

API(fmi2Terminate)(fmi2Component c)
{
    instance *i = c;
    if (!is_in(i, RUNNING, "fmi2Terminate")) return fmi2Error;
    i->now.phase = TERMINATED;
    return fmi2OK;
}

API(fmi2Reset)(fmi2Component c)
{
    instance *i = c;
    if (!i) return fmi2Error;
    reset(i);
    return fmi2OK;
}

API(fmi2GetReal)(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Real value[])
{
    instance *i = c;
    if (!is_in(i, ANY, "fmi2GetReal")) return fmi2Error;
    for (size_t k = 0; k < count; k++) {
        if (!get_value(i, vr[k], &value[k])) return fmi2Error;
    }
    return fmi2OK;
}

API(fmi2SetReal)(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Real value[])
{
    instance *i = c;
    if (!is_in(i, IN(INSTANTIATED) | IN(INITIALIZING) | RUNNING, "fmi2SetReal")) return fmi2Error;
    for (size_t k = 0; k < count; k++) {
        if (!set_value(i, vr[k], value[k])) return fmi2Error;
    }
    return fmi2OK;
}

/* There are no variables of other types. */
#define NONE(function, type)                                                                                           \
    API(function)(fmi2Component c, const fmi2ValueReference vr[], size_t count, type value[])                          \
    {                                                                                                                  \
        (void)vr;                                                                                                      \
        (void)value;                                                                                                   \
        if (c && count > 0) say(c, "all variables are real");                                                          \
        return status(c && count == 0);                                                                                \
    }
NONE(fmi2GetInteger, fmi2Integer)
NONE(fmi2GetBoolean, fmi2Boolean)
NONE(fmi2GetString, fmi2String)
NONE(fmi2SetInteger, const fmi2Integer)
NONE(fmi2SetBoolean, const fmi2Boolean)
NONE(fmi2SetString, const fmi2String)

API(fmi2GetFMUstate)(fmi2Component c, fmi2FMUstate *state)
{
    instance *i = c;
    if (!i || !state) return fmi2Error;
    if (!*state) *state = callbacks_of(i)->allocateMemory(1, sizeof(memory));
    if (!*state) {
        say(i, "no memory for a state");
        return fmi2Error;
    }
    memcpy(*state, &i->now, sizeof(memory));
    return fmi2OK;
}

API(fmi2SetFMUstate)(fmi2Component c, fmi2FMUstate state)
{
    instance *i = c;
    if (!i || !state) return fmi2Error;
    memcpy(&i->now, state, sizeof(memory));
    return fmi2OK;
}

API(fmi2FreeFMUstate)(fmi2Component c, fmi2FMUstate *state)
{
    if (!c || !state) return fmi2Error;
    if (*state) callbacks_of(c)->freeMemory(*state);
    *state = NULL;
    return fmi2OK;
}

API(fmi2SerializedFMUstateSize)(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    if (!c || !state) return fmi2Error;
    *size = SERIALIZED;
    return fmi2OK;
}

API(fmi2SerializeFMUstate)(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    return status(c && state && serialize(c, state, bytes, size));
}

API(fmi2DeSerializeFMUstate)(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    memory read;
    if (!c || !state || !deserialize(c, bytes, size, &read)) return fmi2Error;
    if (!*state) *state = callbacks_of(c)->allocateMemory(1, sizeof(memory));
    if (!*state) return fmi2Error;
    memcpy(*state, &read, sizeof read);
    return fmi2OK;
}

API(fmi2GetDirectionalDerivative)(fmi2Component c, const fmi2ValueReference unknowns[], size_t unknown_count,
                                  const fmi2ValueReference knowns[], size_t known_count, const fmi2Real seed[],
                                  fmi2Real sensitivity[])
{
    instance *i = c;
    if (!is_in(i, IN(INITIALIZING) | RUNNING, "fmi2GetDirectionalDerivative")) return fmi2Error;
    return status(directional(i, unknowns, unknown_count, knowns, known_count, seed, sensitivity));
}

/* Model exchange. */

API(fmi2EnterEventMode)(fmi2Component c)
{
    instance *i = c;
    if (!is_in(i, IN(CONTINUOUS) | IN(EVENTS), "fmi2EnterEventMode")) return fmi2Error;
    i->now.phase = EVENTS;
    return fmi2OK;
}

API(fmi2NewDiscreteStates)(fmi2Component c, fmi2EventInfo *info)
{
    instance *i = c;
    int changed = 0;
    if (!is_in(i, IN(EVENTS), "fmi2NewDiscreteStates")) return fmi2Error;
    if (!make_constants(i) || !settle(i, &changed)) return fmi2Error;
    memset(info, 0, sizeof *info);
    info->valuesOfContinuousStatesChanged = changed;
    return fmi2OK;
}

API(fmi2EnterContinuousTimeMode)(fmi2Component c)
{
    instance *i = c;
    if (!is_in(i, IN(EVENTS), "fmi2EnterContinuousTimeMode")) return fmi2Error;
    i->now.phase = CONTINUOUS;
    return fmi2OK;
}

API(fmi2CompletedIntegratorStep)(fmi2Component c, fmi2Boolean keeps, fmi2Boolean *event, fmi2Boolean *terminate)
{
    instance *i = c;
    (void)keeps;
    if (!is_in(i, IN(CONTINUOUS), "fmi2CompletedIntegratorStep") || !make_constants(i)) return fmi2Error;
    *event = has_missed(&i->now);
    *terminate = 0;
    return fmi2OK;
}

API(fmi2SetTime)(fmi2Component c, fmi2Real time)
{
    instance *i = c;
    if (!is_in(i, IN(EVENTS) | IN(CONTINUOUS), "fmi2SetTime")) return fmi2Error;
    return status(set_time(i, time));
}

API(fmi2SetContinuousStates)(fmi2Component c, const fmi2Real states[], size_t count)
{
    instance *i = c;
    if (!is_in(i, IN(CONTINUOUS), "fmi2SetContinuousStates")) return fmi2Error;
    return status(set_states(i, states, count));
}

API(fmi2GetDerivatives)(fmi2Component c, fmi2Real rates[], size_t count)
{
    instance *i = c;
    if (!is_in(i, IN(INITIALIZING) | IN(EVENTS) | IN(CONTINUOUS), "fmi2GetDerivatives")) return fmi2Error;
    if (count != STATES) return fmi2Error;
    if (!make_constants(i)) return fmi2Error;
    /* A state that a solver tries: it takes a shorter step. */
    if (!make_rates(i)) return fmi2Discard;
    memcpy(rates, i->now.rates, count * sizeof *rates);
    return fmi2OK;
}

API(fmi2GetEventIndicators)(fmi2Component c, fmi2Real indicators[], size_t count)
{
    instance *i = c;
    if (!is_in(i, IN(INITIALIZING) | IN(EVENTS) | IN(CONTINUOUS), "fmi2GetEventIndicators")) return fmi2Error;
    if (count != MODEL_INDICATORS) return fmi2Error;
    return status(make_indicators(i, indicators));
}

API(fmi2GetContinuousStates)(fmi2Component c, fmi2Real states[], size_t count)
{
    instance *i = c;
    if (!is_in(i, ANY, "fmi2GetContinuousStates") || count != STATES) return fmi2Error;
    memcpy(states, i->now.states, count * sizeof *states);
    return fmi2OK;
}

API(fmi2GetNominalsOfContinuousStates)(fmi2Component c, fmi2Real nominals[], size_t count)
{
    if (!c || count != STATES) return fmi2Error;
    for (size_t k = 0; k < count; k++) nominals[k] = 1.0;
    return fmi2OK;
}

/* Co-simulation. */

API(fmi2DoStep)(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean keeps)
{
    instance *i = c;
    (void)keeps;
    if (!is_in(i, IN(STEPPING), "fmi2DoStep")) return fmi2Error;
    return status(step_to(i, time, step));
}

API(fmi2CancelStep)(fmi2Component c)
{
    if (c) say(c, "no step runs beside the caller");
    return fmi2Error;
}

API(fmi2SetRealInputDerivatives)(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                 const fmi2Integer order[], const fmi2Real value[])
{
    (void)vr;
    (void)order;
    (void)value;
    if (c && count > 0) say(c, "inputs are held within a step: canInterpolateInputs is false");
    return status(c && count == 0);
}

API(fmi2GetRealOutputDerivatives)(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                  const fmi2Integer order[], fmi2Real value[])
{
    (void)vr;
    (void)order;
    (void)value;
    if (c && count > 0) say(c, "there are no derivatives of outputs: maxOutputDerivativeOrder is 0");
    return status(c && count == 0);
}

#define NO_STATUS(function, type)                                                                                      \
    API(function)(fmi2Component c, const fmi2StatusKind kind, type *value)                                             \
    {                                                                                                                  \
        (void)kind;                                                                                                    \
        (void)value;                                                                                                   \
        return c ? fmi2Discard : fmi2Error;                                                                            \
    }
NO_STATUS(fmi2GetStatus, fmi2Status)
NO_STATUS(fmi2GetIntegerStatus, fmi2Integer)
NO_STATUS(fmi2GetStringStatus, fmi2String)

API(fmi2GetRealStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    const instance *i = c;
    if (!i) return fmi2Error;
    if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
    *value = i->now.time;
    return fmi2OK;
}

API(fmi2GetBooleanStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    if (!c) return fmi2Error;
    if (kind != fmi2Terminated) return fmi2Discard;
    *value = 0;
    return fmi2OK;
}
