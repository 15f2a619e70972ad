/* Contacts and ranges without friction, one that acts at a time: events of model exchange.
 *
 * An open contact has its gap as event indicator. Where that closes the speeds change by the impulse of restitution,
 * A^-1 W^T P with P = -(1 + e) g' / D. A bounce that would last less than SHORTEST, or rise no higher than how deep the
 * solver found the gap, is the last one: the contact is closed at a gap of zero, with the force that keeps its rate
 * zero, which is then its event indicator; it opens where the force would pull.
 */

/* In s. */
#define SHORTEST 1e-6
/* The depth below zero at which gaps may start, in their unit: rounding of start values. */
#define DEEPEST 1e-9

#if MODEL_CONTACTS == 0

static int closed_contact(const memory *now)
{
    (void)now;
    return -1;
}

static int add_contact_force(memory *now, double t, const double *q, const double *z, double *acceleration)
{
    (void)now, (void)t, (void)q, (void)z, (void)acceleration;
    return 1;
}

static int make_indicators(instance *i, double *indicators)
{
    (void)indicators;
    return make_constants(i);
}

static int settle(instance *i, int *changed)
{
    (void)i;
    *changed = 0;
    return 1;
}

static int start_contacts(instance *i)
{
    (void)i;
    return 1;
}

static int has_missed(const memory *now)
{
    (void)now;
    return 0;
}

#else

typedef struct {
    double acceleration[ROOM(MODEL_Z)];
    double bias[MODEL_CONTACTS];
    double columns[ROOM(MODEL_Z) * MODEL_CONTACTS];
    double delassus[MODEL_CONTACTS * MODEL_CONTACTS];
} response;

static int closed_contact(const memory *now)
{
    for (int c = 0; c < MODEL_CONTACTS; c++) {
        if (now->closed[c]) return c;
    }
    return -1;
}

static double mobility(const response *of, int contact)
{
    return of->delassus[MODEL_CONTACTS * contact + contact];
}

/* Adds the force of the closed contact, if there is one; the accelerations are those without it. */
static int add_contact_force(memory *now, double t, const double *q, const double *z, double *acceleration)
{
    const int contact = closed_contact(now);
    response of;
    memset(now->forces, 0, sizeof now->forces);
    if (contact < 0) return 1;
    model_impulse_dynamics(now->constants, t, q, z, now->inputs, of.acceleration, of.bias, of.columns, of.delassus);
    const double force = -of.bias[contact] / mobility(&of, contact);
    for (int k = 0; k < MODEL_Z; k++) acceleration[k] += of.columns[MODEL_CONTACTS * k + contact] * force;
    now->forces[contact] = force;
    return isfinite(force);
}

/* Gaps at the state of now. */
static void gaps_at(const memory *now, double *q, double *gaps)
{
    memcpy(q, now->states, MODEL_Q * sizeof *q);
    normalise(q);
    model_gaps(now->constants, now->time, q, gaps);
}

static int make_rates(instance *i);
static void component_rates(const double *raw, const double *q, const double *velocity, double *rates);

static int make_indicators(instance *i, double *indicators)
{
    double q[ROOM(MODEL_Q)];
    if (!make_rates(i)) return 0;
    gaps_at(&i->now, q, indicators);
    for (int c = 0; c < MODEL_CONTACTS; c++) {
        if (i->now.closed[c]) indicators[c] = i->now.forces[c];
        if (!isfinite(indicators[c])) {
            say(i, "the gap of `%s` is not finite at t = %.17g s", contact_names[c], i->now.time);
            return 0;
        }
    }
    return 1;
}

/* No gap is closed beyond rounding where a run starts. */
static int start_contacts(instance *i)
{
    double q[ROOM(MODEL_Q)], gaps[MODEL_CONTACTS];
    gaps_at(&i->now, q, gaps);
    for (int c = 0; c < MODEL_CONTACTS; c++) {
        if (!(gaps[c] >= -DEEPEST)) {
            say(i, "the gap of `%s` is %g at the start: it must be zero or greater", contact_names[c], gaps[c]);
            return 0;
        }
    }
    return 1;
}

/* Whether a step ended with a gap that is closed and closing: a solver sees no event where two are in one step. */
static int has_missed(const memory *now)
{
    double q[ROOM(MODEL_Q)], gaps[MODEL_CONTACTS], rates[MODEL_CONTACTS];
    gaps_at(now, q, gaps);
    model_contact_rates(now->constants, now->time, q, now->states + MODEL_Q, rates);
    for (int c = 0; c < MODEL_CONTACTS; c++) {
        if (!now->closed[c] && gaps[c] < 0.0 && rates[c] < 0.0) return 1;
    }
    return 0;
}

/* Impulse of the contact on the speeds, after which its rate is what it is meant to be. */
static void strike(memory *now, const response *of, int contact, double change)
{
    for (int k = 0; k < MODEL_Z; k++) {
        now->states[MODEL_Q + k] += of->columns[MODEL_CONTACTS * k + contact] * change / mobility(of, contact);
    }
}

/* Moves the configuration along A^-1 W^T of the contact until its gap is zero: Newton's method, whose error is squared
 * with each of a few turns. */
static void lift(memory *now, const response *of, int contact)
{
    double q[ROOM(MODEL_Q)], gaps[MODEL_CONTACTS], z[ROOM(MODEL_Z)];
    double still[ROOM(MODEL_V)], moving[ROOM(MODEL_V)], change[ROOM(MODEL_Q)];
    for (int turn = 0; turn < 4; turn++) {
        gaps_at(now, q, gaps);
        for (int k = 0; k < MODEL_Z; k++) {
            z[k] = -of->columns[MODEL_CONTACTS * k + contact] * gaps[contact] / mobility(of, contact);
        }
        model_kinematics(now->constants, now->time, q, z, moving);
        memset(z, 0, sizeof z);
        model_kinematics(now->constants, now->time, q, z, still);
        for (int k = 0; k < MODEL_V; k++) moving[k] -= still[k];
        component_rates(q, q, moving, change);
        for (int k = 0; k < MODEL_Q; k++) now->states[k] = q[k] + change[k];
        normalise(now->states);
    }
}

/* Bounces or rests a contact whose gap is closed and closing: the gap is brought to zero, so that the next event is seen
 * as a change of its sign, and the rate changes by restitution. */
static void bounce(memory *now, const response *found, int contact, double gap)
{
    double q[ROOM(MODEL_Q)], gaps[MODEL_CONTACTS], rates[MODEL_CONTACTS], restitution[MODEL_CONTACTS];
    const double *z = now->states + MODEL_Q;
    response of;
    lift(now, found, contact);
    gaps_at(now, q, gaps);
    model_restitution(now->constants, now->time, q, restitution);
    model_contact_rates(now->constants, now->time, q, z, rates);
    model_impulse_dynamics(now->constants, now->time, q, z, now->inputs, of.acceleration, of.bias, of.columns,
                           of.delassus);
    const double after = -restitution[contact] * rates[contact], pull = -of.bias[contact];
    const double depth = fmax(-gap, 0.0);
    /* The length and the height of a flight under the acceleration -pull. */
    const int is_last = pull > 0.0 && (2.0 * after <= SHORTEST * pull || after * after <= 20.0 * pull * depth);
    strike(now, &of, contact, (is_last ? 0.0 : after) - rates[contact]);
    now->closed[contact] = is_last;
}

/* Discrete changes at an event: opens a contact that would pull, and lets a closing gap bounce. */
static int settle(instance *i, int *changed)
{
    memory *now = &i->now;
    double q[ROOM(MODEL_Q)], gaps[MODEL_CONTACTS], rates[MODEL_CONTACTS];
    response of;
    int closing = -1, closed = closed_contact(now);
    *changed = 0;
    if (!make_rates(i)) return 0;
    if (closed >= 0 && now->forces[closed] <= 0.0) {
        now->closed[closed] = 0;
        closed = -1;
    }
    forget(now);
    gaps_at(now, q, gaps);
    model_contact_rates(now->constants, now->time, q, now->states + MODEL_Q, rates);
    model_impulse_dynamics(now->constants, now->time, q, now->states + MODEL_Q, now->inputs, of.acceleration, of.bias,
                           of.columns, of.delassus);
    for (int c = 0; c < MODEL_CONTACTS; c++) {
        const int acts = rates[c] < 0.0 || (rates[c] == 0.0 && of.bias[c] < 0.0);
        if (now->closed[c] || gaps[c] > 0.0 || !acts) continue;
        if (closing >= 0 || closed >= 0) {
            say(i, "`%s` and `%s` act at once at t = %.17g s: an FMU has one contact at a time",
                contact_names[closing >= 0 ? closing : closed], contact_names[c], now->time);
            return 0;
        }
        closing = c;
    }
    if (closing >= 0) {
        bounce(now, &of, closing, gaps[closing]);
        *changed = 1;
    }
    forget(now);
    return 1;
}

#endif
