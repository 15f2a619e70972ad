/* The equations of motion over components: rates, outputs, and derivatives of both along a direction.
 *
 * States are the components of the configuration, then the speeds: a vector space. Quaternions among them may have any
 * norm but zero: the equations are evaluated at norm 1, and the rates are those of the quaternion as it is, whose norm
 * they keep. So a norm that a solver lets drift turns nothing, and no events are needed to mend it.
 */

/* Nearer to a singularity of a chart velocities are ten thousand times as large as those of the bodies. */
#define NEAR_SINGULARITY 1e-4

/* Keeps a message for whoever called, and sends it where messages go; NaN. */
static double say(instance *i, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(i->message, sizeof i->message, format, list);
    va_end(list);
    tell(i, i->message);
    return NAN;
}

static int unit_components(int kind)
{
    return kind == PLANE ? 2 : 4;
}

static double norm_of(const double *q, int count)
{
    double largest = 0.0, sum = 0.0;
    for (int k = 0; k < count; k++) largest = fmax(largest, fabs(q[k]));
    if (!(largest > 0.0)) return largest;
    for (int k = 0; k < count; k++) sum += q[k] / largest * (q[k] / largest);
    return largest * sqrt(sum);
}

/* Brings all quaternions, and pairs of cosine and sine, to norm 1. */
static void normalise(double *q)
{
    for (int g = 0; g < MODEL_GROUPS; g++) {
        const int count = unit_components(groups[g].kind);
        double *own = q + groups[g].component;
        const double norm = norm_of(own, count);
        for (int k = 0; k < count; k++) own[k] /= norm;
    }
}

static void cross(const double *a, const double *b, double *out)
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Half of the product of a quaternion x, y, z, w and a vector: the rates of its components. */
static void quaternion_rates(const double *q, const double *omega, double *out)
{
    cross(q, omega, out);
    for (int k = 0; k < 3; k++) out[k] = 0.5 * (out[k] + q[3] * omega[k]);
    out[3] = -0.5 * (q[0] * omega[0] + q[1] * omega[1] + q[2] * omega[2]);
}

/* R u of a unit quaternion, u + 2 w (v x u) + 2 v x (v x u). */
static void turned(const double *q, const double *u, double *out)
{
    double once[3], twice[3];
    cross(q, u, once);
    cross(q, once, twice);
    for (int k = 0; k < 3; k++) out[k] = u[k] + 2.0 * (q[3] * once[k] + twice[k]);
}

/* The change of R u by a change of the quaternion. */
static void turned_by_change(const double *q, const double *dq, const double *u, double *out)
{
    double once[3], change[3], first[3], second[3];
    cross(q, u, once);
    cross(dq, u, change);
    cross(dq, once, first);
    cross(q, change, second);
    for (int k = 0; k < 3; k++) {
        out[k] = 2.0 * (dq[3] * once[k] + q[3] * change[k] + first[k] + second[k]);
    }
}

/* Rates of components at a velocity whose increments are in body axes: `raw` as the components are, `q` at norm 1. */
static void component_rates(const double *raw, const double *q, const double *velocity, double *rates)
{
    int component = 0, increment = 0;
    for (int g = 0; g < MODEL_GROUPS; g++) {
        const int c = groups[g].component;
        const double *v = velocity + groups[g].increment;
        if (groups[g].kind == PLANE) {
            rates[c] = -v[2] * raw[c + 1];
            rates[c + 1] = v[2] * raw[c];
            rates[c + 2] = q[c] * v[0] - q[c + 1] * v[1];
            rates[c + 3] = q[c + 1] * v[0] + q[c] * v[1];
        } else {
            quaternion_rates(raw + c, groups[g].kind == POSE ? v + 3 : v, rates + c);
            if (groups[g].kind == POSE) turned(q + c, v, rates + c + 4);
        }
        component = c + (groups[g].kind == POSE ? 7 : 4);
        increment = groups[g].increment + (groups[g].kind == POSE ? 6 : 3);
    }
    while (component < MODEL_Q) rates[component++] = velocity[increment++];
}

/* The change of these rates by changes of the components and of the velocity. */
static void component_rates_tangent(const double *raw, const double *draw, const double *q, const double *dq,
                                    const double *v, const double *dv, double *drates)
{
    double by_place[4];
    component_rates(raw, q, dv, drates); /* linear in the velocity */
    for (int g = 0; g < MODEL_GROUPS; g++) {
        const int c = groups[g].component;
        const double *own = v + groups[g].increment;
        if (groups[g].kind == PLANE) {
            drates[c] += -own[2] * draw[c + 1];
            drates[c + 1] += own[2] * draw[c];
            drates[c + 2] += dq[c] * own[0] - dq[c + 1] * own[1];
            drates[c + 3] += dq[c + 1] * own[0] + dq[c] * own[1];
            continue;
        }
        quaternion_rates(draw + c, groups[g].kind == POSE ? own + 3 : own, by_place);
        for (int k = 0; k < 4; k++) drates[c + k] += by_place[k];
        if (groups[g].kind == POSE) {
            turned_by_change(q + c, dq + c, own, by_place);
            for (int k = 0; k < 3; k++) drates[c + 4 + k] += by_place[k];
        }
    }
}

/* Rates of all states. 0 where the equations have no value; nothing is said of it. */
static int rates_at(memory *now, double t, const double *states, double *rates)
{
    double q[ROOM(MODEL_Q)], velocity[ROOM(MODEL_V)];
    memcpy(q, states, MODEL_Q * sizeof *q);
    normalise(q);
    if (MODEL_HAS_REGULARITY && !(fabs(model_regularity(now->constants, t, q)) >= NEAR_SINGULARITY)) return 0;
    model_rates(now->constants, t, q, states + MODEL_Q, now->inputs, velocity, rates + MODEL_Q);
    if (!add_contact_force(now, t, q, states + MODEL_Q, rates + MODEL_Q)) return 0;
    component_rates(states, q, velocity, rates);
    return all_finite(rates, STATES);
}

/* Says why the rates have no value. */
static int no_rates(instance *i, double t, const double *states, const double *rates)
{
    double q[ROOM(MODEL_Q)];
    for (int k = 0; k < STATES; k++) {
        if (!isfinite(states[k])) {
            say(i, "state `%s` is not finite at t = %.17g s", names[FIRST_STATE + k], t);
            return 0;
        }
    }
    memcpy(q, states, MODEL_Q * sizeof *q);
    normalise(q);
    if (MODEL_HAS_REGULARITY && !(fabs(model_regularity(i->now.constants, t, q)) >= NEAR_SINGULARITY)) {
        say(i, "the chart is singular at t = %.17g s; another chart has no singularity here", t);
        return 0;
    }
    for (int k = 0; k < STATES; k++) {
        if (!isfinite(rates[k])) {
            say(i, "`%s` is not finite at t = %.17g s", names[FIRST_RATE + k], t);
            return 0;
        }
    }
    return 0;
}

/* Brings the constants and the rates of states up to date; 0 and a message where one has no value. */
static int make_rates(instance *i)
{
    memory *now = &i->now;
    if (!make_constants(i)) return 0;
    if (!now->has_rates) {
        if (!rates_at(now, now->time, now->states, now->rates)) return no_rates(i, now->time, now->states, now->rates);
        now->has_rates = 1;
    }
    return 1;
}

/* Brings the outputs up to date; 0 and a message where one has no value. */
static int make_outputs(instance *i)
{
    memory *now = &i->now;
    double q[ROOM(MODEL_Q)];
    if (!make_rates(i)) return 0;
    if (now->has_outputs) return 1;
    memcpy(q, now->states, MODEL_Q * sizeof *q);
    normalise(q);
    model_outputs(now->constants, now->time, q, now->states + MODEL_Q, now->inputs,
                  now->rates + MODEL_Q, now->outputs);
    for (int c = 0; c < MODEL_CONTACTS; c++) now->outputs[MODEL_OUTPUTS + c] = now->forces[c];
    if (!make_indicators(i, now->outputs + MODEL_OUTPUTS + MODEL_CONTACTS)) return 0;
    for (int k = 0; k < OUTPUTS; k++) {
        if (!isfinite(now->outputs[k])) {
            say(i, "output `%s` is not finite at t = %.17g s", names[FIRST_OUTPUT + k], now->time);
            return 0;
        }
    }
    now->has_outputs = 1;
    return 1;
}

/* Derivatives of rates and outputs along the direction `seeds`, one number for each variable, into `results`: forward
 * differentiation of the programs, exact to rounding. */
static int make_tangents(instance *i, const double *seeds, double *results)
{
    const memory *now = &i->now;
    const double *states = now->states, *z = states + MODEL_Q, *dstates = seeds + FIRST_STATE;
    double q[ROOM(MODEL_Q)], dq[ROOM(MODEL_Q)], v[ROOM(MODEL_V)], dv[ROOM(MODEL_V)], rates[ROOM(MODEL_Z)];
    double read[ROOM(MODEL_READ)], dread[ROOM(MODEL_READ)], dk[ROOM(MODEL_CONSTANTS)];
    int by_parameters = 0;
    if (!make_constants(i)) return 0;
    if (closed_contact(now) >= 0) {
        say(i, "there are no derivatives while `%s` is closed", contact_names[closed_contact(now)]);
        return 0;
    }
    memcpy(q, states, MODEL_Q * sizeof *q);
    memcpy(dq, dstates, MODEL_Q * sizeof *dq);
    normalise(q);
    for (int g = 0; g < MODEL_GROUPS; g++) {
        const int count = unit_components(groups[g].kind), c = groups[g].component;
        const double norm = norm_of(states + c, count);
        double along = 0.0;
        for (int k = c; k < c + count; k++) along += q[k] * dq[k];
        for (int k = c; k < c + count; k++) dq[k] = (dq[k] - along * q[k]) / norm;
    }
    model_rates(now->constants, now->time, q, z, now->inputs, v, rates);
    model_tangent(now->constants, now->time, q, z, now->inputs, rates, seeds[0], dq, dstates + MODEL_Q,
                  seeds + FIRST_INPUT, dv, results + FIRST_RATE + MODEL_Q, results + FIRST_OUTPUT);
    for (int k = 0; k < MODEL_READ; k++) {
        read[k] = now->parameters[read_parameters[k]];
        dread[k] = seeds[FIRST_PARAMETER + read_parameters[k]];
        by_parameters |= dread[k] != 0.0;
    }
    if (by_parameters) {
        double more_v[ROOM(MODEL_V)], more_z[ROOM(MODEL_Z)], more[ROOM(MODEL_OUTPUTS)];
        model_constants_tangent(read, dread, dk);
        model_tangent_by_constants(now->constants, now->time, q, z, now->inputs, rates, dk, more_v, more_z, more);
        for (int k = 0; k < MODEL_V; k++) dv[k] += more_v[k];
        for (int k = 0; k < MODEL_Z; k++) results[FIRST_RATE + MODEL_Q + k] += more_z[k];
        for (int k = 0; k < MODEL_OUTPUTS; k++) results[FIRST_OUTPUT + k] += more[k];
    }
    component_rates_tangent(states, dstates, q, dq, v, dv, results + FIRST_RATE);
    /* Open contacts have no force, and their gaps, which the scene gives, as indicators. */
    for (int c = 0; c < MODEL_CONTACTS; c++) {
        results[FIRST_OUTPUT + MODEL_OUTPUTS + MODEL_CONTACTS + c] = results[FIRST_OUTPUT + FIRST_GAP + c];
    }
    for (int k = 0; k < STATES; k++) results[FIRST_STATE + k] = seeds[FIRST_STATE + k];
    return 1;
}
