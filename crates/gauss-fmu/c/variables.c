/* Variables by value reference, and the life of an instance: what both versions of FMI ask in the same way. */

/* The state, an input or a parameter has changed. */
static void forget(memory *now)
{
    now->has_rates = now->has_outputs = 0;
}

/* The state at the beginning: all start values. */
static void reset(instance *i)
{
    memory *now = &i->now;
    memset(now, 0, sizeof *now);
    memcpy(now->parameters, start_parameters, MODEL_PARAMETERS * sizeof *now->parameters);
    memcpy(now->states, start_states, STATES * sizeof *now->states);
    now->tolerance = MODEL_TOLERANCE;
    now->phase = INSTANTIATED;
}

/* Memory is of the caller's; it has been set to zero. */
static void prepare(instance *i, const char *name, int is_stepped, void *environment, function log)
{
    strncpy(i->name, name ? name : MODEL_NAME, sizeof i->name - 1);
    i->is_stepped = is_stepped;
    i->environment = environment;
    i->log = log;
    reset(i);
}

static const char *name_of(size_t reference)
{
    return reference < VARIABLES ? names[reference] : "?";
}

/* The value of a variable; 0 and a message where it has none. */
static int get_value(instance *i, size_t reference, double *value)
{
    const memory *now = &i->now;
    if (reference >= VARIABLES) {
        say(i, "there is no variable with the value reference %lu", (unsigned long)reference);
        return 0;
    }
    if (reference >= FIRST_OUTPUT) {
        if (!make_outputs(i)) return 0;
        *value = now->outputs[reference - FIRST_OUTPUT];
    } else if (reference >= FIRST_RATE) {
        if (!make_rates(i)) return 0;
        *value = now->rates[reference - FIRST_RATE];
    } else if (reference >= FIRST_STATE) {
        *value = now->states[reference - FIRST_STATE];
    } else if (reference >= FIRST_INPUT) {
        *value = now->inputs[reference - FIRST_INPUT];
    } else if (reference >= FIRST_PARAMETER) {
        *value = now->parameters[reference - FIRST_PARAMETER];
    } else {
        *value = now->time;
    }
    return 1;
}

/* Whether a number can be a value of the variable; a message where it cannot. */
static int can_be(instance *i, size_t reference, double value)
{
    if (isfinite(value)) return 1;
    say(i, "`%s` is set to %g: it must be finite", name_of(reference), value);
    return 0;
}

/* Sets a parameter, an input, or before the run starts a state; 0 and a message where that cannot be. */
static int set_value(instance *i, size_t reference, double value)
{
    memory *now = &i->now;
    if (!can_be(i, reference, value)) return 0;
    if (reference < FIRST_PARAMETER || reference >= FIRST_RATE) {
        say(i, "`%s` cannot be set", name_of(reference));
        return 0;
    }
    if (reference >= FIRST_STATE) {
        if (now->phase != INSTANTIATED && now->phase != INITIALIZING) {
            say(i, "state `%s` is set before or during initialization only", name_of(reference));
            return 0;
        }
        now->states[reference - FIRST_STATE] = value;
    } else if (reference >= FIRST_INPUT) {
        now->inputs[reference - FIRST_INPUT] = value;
    } else {
        if (i->is_stepped == 0 && now->phase == CONTINUOUS) {
            say(i, "parameter `%s` is set in event mode only", name_of(reference));
            return 0;
        }
        now->parameters[reference - FIRST_PARAMETER] = value;
        now->has_constants = 0;
    }
    forget(now);
    return 1;
}

/* Quaternions, and pairs of cosine and sine, have a direction; a message where one has none. */
static int have_directions(instance *i, const double *q)
{
    for (int g = 0; g < MODEL_GROUPS; g++) {
        const int count = unit_components(groups[g].kind), c = groups[g].component;
        const double norm = norm_of(q + c, count);
        if (!(norm > 1e-100 && norm < 1e100)) {
            say(i, "`%s` and the %d states after it are no rotation: their norm is %g", names[FIRST_STATE + c],
                count - 1, norm);
            return 0;
        }
    }
    return 1;
}

/* Checks parameters and states as the run starts, and brings quaternions to norm 1. */
static int start(instance *i)
{
    if (!have_directions(i, i->now.states) || !make_constants(i)) return 0;
    normalise(i->now.states);
    forget(&i->now);
    return start_contacts(i) && make_rates(i) && make_outputs(i);
}

/* Continuous states of a solver. */
static int set_states(instance *i, const double *states, size_t count)
{
    if (count != STATES) {
        say(i, "%lu continuous states in place of %d", (unsigned long)count, STATES);
        return 0;
    }
    for (size_t k = 0; k < count; k++) {
        if (!can_be(i, FIRST_STATE + k, states[k])) return 0;
    }
    if (!have_directions(i, states)) return 0;
    memcpy(i->now.states, states, count * sizeof *states);
    forget(&i->now);
    return 1;
}

static int set_time(instance *i, double time)
{
    if (!can_be(i, 0, time)) return 0;
    i->now.time = time;
    forget(&i->now);
    return 1;
}

/* Sets up an experiment: the tolerance of co-simulation, and when it begins. */
static int set_experiment(instance *i, int has_tolerance, double tolerance, double begin)
{
    if (has_tolerance && !(tolerance > 0.0 && tolerance < 1.0)) {
        say(i, "`tolerance` is %g: it must be above 0 and below 1", tolerance);
        return 0;
    }
    if (has_tolerance) i->now.tolerance = fmax(tolerance, LEAST_TOLERANCE);
    return set_time(i, begin);
}

/* Derivatives of unknowns along a direction in the space of knowns. */
static int directional(instance *i, const unsigned *unknowns, size_t unknown_count, const unsigned *knowns,
                       size_t known_count, const double *seed, double *sensitivity)
{
    double *seeds = i->room.seeds, *results = i->room.results;
    memset(seeds, 0, sizeof i->room.seeds);
    memset(results, 0, sizeof i->room.results);
    for (size_t k = 0; k < known_count; k++) {
        if (knowns[k] >= FIRST_RATE) {
            say(i, "there are no derivatives by `%s`", name_of(knowns[k]));
            return 0;
        }
        if (!can_be(i, knowns[k], seed[k])) return 0;
        seeds[knowns[k]] += seed[k];
    }
    if (!make_tangents(i, seeds, results)) return 0;
    for (size_t k = 0; k < unknown_count; k++) {
        if (unknowns[k] < FIRST_STATE || unknowns[k] >= VARIABLES) {
            say(i, "there are no derivatives of `%s`", name_of(unknowns[k]));
            return 0;
        }
        if (!isfinite(results[unknowns[k]])) {
            say(i, "the derivative of `%s` is not finite at t = %.17g s", name_of(unknowns[k]), i->now.time);
            return 0;
        }
        sensitivity[k] = results[unknowns[k]];
    }
    return 1;
}

/* A state as bytes: a mark of the model, then the memory as it is. They are read by the same binary alone. */
#define SERIALIZED (sizeof MODEL_TOKEN + sizeof(memory))

static int serialize(instance *i, const memory *state, char *bytes, size_t size)
{
    if (size < SERIALIZED) {
        say(i, "a state has %lu bytes, and there is room for %lu", (unsigned long)SERIALIZED, (unsigned long)size);
        return 0;
    }
    memcpy(bytes, MODEL_TOKEN, sizeof MODEL_TOKEN);
    memcpy(bytes + sizeof MODEL_TOKEN, state, sizeof *state);
    return 1;
}

static int deserialize(instance *i, const char *bytes, size_t size, memory *state)
{
    if (size != SERIALIZED || memcmp(bytes, MODEL_TOKEN, sizeof MODEL_TOKEN) != 0) {
        say(i, "these bytes are no state of this model");
        return 0;
    }
    memcpy(state, bytes + sizeof MODEL_TOKEN, sizeof *state);
    return 1;
}
