/* Co-simulation: the pair of orders 5 and 4 of J. R. Dormand and P. J. Prince, A family of embedded Runge-Kutta
 * formulae, J. Comput. Appl. Math. 6 (1980) 19-26, RK5(4)7M, on components; quaternions are brought to norm 1 after
 * every step. This is not an integrator of gauss-runtime.
 */

#define STAGES 7

static const double nodes[STAGES] = {0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0};

static const double weights[STAGES][STAGES - 1] = {
    {0.0},
    {1.0 / 5.0},
    {3.0 / 40.0, 9.0 / 40.0},
    {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
    {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
    {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
    {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0},
};

/* Weights of order 5 less those of order 4. */
static const double errors[STAGES] = {
    71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0,
};

/* Attempts within one call: a stiff scene at a small tolerance takes more, and would never end. */
#define MOST_ATTEMPTS 10000000L

/* Largest component of a vector, each over what the tolerance allows it: tolerance (1 + |x|). */
static double in_tolerances(const memory *now, const double *vector, const double *from, const double *to)
{
    double largest = 0.0;
    for (int k = 0; k < STATES; k++) {
        const double size = fabs(vector[k]) / (now->tolerance * (1.0 + fmax(fabs(from[k]), fabs(to[k]))));
        if (!(size <= largest)) largest = size; /* NaN stays */
    }
    return largest;
}

/* One attempt: the state behind a step into room.trial; its error in tolerances, infinite where a stage has no value.
 */
static double attempt(instance *i, double t, double h)
{
    memory *now = &i->now;
    double (*k)[ROOM(STATES)] = i->room.stages, *trial = i->room.trial;
    double error[ROOM(STATES)];
    for (int stage = 1; stage < STAGES; stage++) {
        for (int n = 0; n < STATES; n++) {
            double sum = 0.0;
            for (int before = 0; before < stage; before++) sum += weights[stage][before] * k[before][n];
            trial[n] = now->states[n] + h * sum;
        }
        if (!rates_at(now, t + nodes[stage] * h, trial, k[stage])) return INFINITY;
    }
    for (int n = 0; n < STATES; n++) {
        error[n] = 0.0;
        for (int stage = 0; stage < STAGES; stage++) error[n] += h * errors[stage] * k[stage][n];
    }
    return in_tolerances(now, error, now->states, trial);
}

/* The sign of what coordinates of a chart lose at its singularity: a step must not pass over one. */
static double side(const memory *now, double t, const double *states)
{
    double q[ROOM(MODEL_Q)];
    if (!MODEL_HAS_REGULARITY) return 1.0;
    memcpy(q, states, MODEL_Q * sizeof *q);
    normalise(q);
    return model_regularity(now->constants, t, q);
}

/* Runs from now to `end` exactly; 0 and a message where that is not possible, at the state reached. */
static int advance(instance *i, double end)
{
    memory *now = &i->now;
    const double begin = now->time;
    double *first = i->room.stages[0], *trial = i->room.trial;
    if (!make_rates(i)) return 0;
    memcpy(first, now->rates, sizeof now->rates);
    if (!(now->step > 0.0)) {
        /* A step over which rates change the state by a part of what the tolerance makes of its size. */
        const double pace = in_tolerances(now, first, now->states, now->states) * now->tolerance;
        now->step = pow(now->tolerance, 0.2) / (pace + 1.0);
    }
    for (long attempts = 0; now->time < end; attempts++) {
        const double left = end - now->time;
        const int is_last = now->step >= left * (1.0 - 1e-9);
        const double h = is_last ? left : now->step;
        const double error = attempt(i, now->time, h);
        const double factor = error > 0.0 ? 0.9 * pow(error, -0.2) : 5.0;
        if (error <= 1.0 && side(now, now->time, now->states) * side(now, now->time + h, trial) > 0.0) {
            now->time = is_last ? end : now->time + h;
            memcpy(now->states, trial, sizeof now->states);
            normalise(now->states);
            forget(now);
            if (!make_rates(i)) return 0;
            memcpy(first, now->rates, sizeof now->rates);
            if (!is_last || factor < 1.0) now->step = h * fmin(5.0, fmax(0.2, factor));
            continue;
        }
        now->step = h * fmin(0.5, fmax(0.1, factor));
        if (now->step < 16.0 * DBL_EPSILON * fmax(fabs(now->time), end - begin)) {
            no_rates(i, now->time + h, trial, i->room.stages[STAGES - 1]);
            say(i, "no step from t = %.17g s keeps the tolerance %g: rates have no value or are not smooth there",
                now->time, now->tolerance);
            return 0;
        }
        if (attempts >= MOST_ATTEMPTS) {
            say(i, "%ld steps did not reach t = %.17g s: the scene is stiff for this tolerance, %g", attempts, end,
                now->tolerance);
            return 0;
        }
    }
    forget(now);
    return 1;
}

/* A communication step from `time`, which is where the last one ended up to rounding. */
static int step_to(instance *i, double time, double step)
{
    const double slack = 1e-9 * fmax(fabs(step), fmax(fabs(time), fabs(i->now.time)));
    if (!isfinite(time) || !(step > 0.0) || !isfinite(step)) {
        say(i, "a step from `currentCommunicationPoint` %g over `communicationStepSize` %g is none", time, step);
        return 0;
    }
    if (fabs(time - i->now.time) > slack) {
        say(i, "`currentCommunicationPoint` is %.17g, and the last step ended at %.17g", time, i->now.time);
        return 0;
    }
    return advance(i, time + step);
}
