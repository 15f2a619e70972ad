/* Checks of parameters: the rules of `kernel()` in Rust, in the same order with the same bounds. */

/* The most rows of a matrix that is checked. */
#define MOST_ROWS (MODEL_Z > 32 ? MODEL_Z : 32)

/* Room of one matrix, for N rows one after another. */
typedef double square[MOST_ROWS * MOST_ROWS];

/* One rotation that annihilates entry (p, q), by the smaller angle. */
static void rotate_pair(double *a, int n, int p, int q)
{
    const double tau = (a[n * q + q] - a[n * p + p]) / (2.0 * a[n * p + q]);
    const double root = sqrt(1.0 + tau * tau);
    const double tangent = tau < 0.0 ? -1.0 / (root - tau) : 1.0 / (root + tau);
    const double cosine = 1.0 / sqrt(1.0 + tangent * tangent), sine = tangent * cosine;
    const double shift = tangent * a[n * p + q];
    a[n * p + p] -= shift;
    a[n * q + q] += shift;
    a[n * p + q] = a[n * q + p] = 0.0;
    for (int k = 0; k < n; k++) {
        if (k != p && k != q) {
            const double u = a[n * k + p], v = a[n * k + q];
            a[n * k + p] = a[n * p + k] = cosine * u - sine * v;
            a[n * k + q] = a[n * q + k] = sine * u + cosine * v;
        }
    }
}

/* Eigenvalues of a symmetric matrix by Jacobi's method; its lower triangle is ignored. */
static void eigenvalues(const double *matrix, int n, double *values)
{
    square a;
    double largest = 0.0;
    for (int k = 0; k < n * n; k++) largest = fmax(largest, fabs(matrix[k]));
    for (int r = 0; r < n; r++) {
        values[r] = 0.0;
        for (int c = 0; c < n; c++) {
            a[n * r + c] = largest > 0.0 ? (r <= c ? matrix[n * r + c] : matrix[n * c + r]) / largest : 0.0;
        }
    }
    for (int sweep = 0, rotated = 1; sweep < 20 && rotated; sweep++) {
        rotated = 0;
        for (int p = 0; p < n; p++) {
            for (int q = p + 1; q < n; q++) {
                const double entry = fabs(a[n * p + q]);
                if (!(entry <= 1e-17 * sqrt(fabs(a[n * p + p] * a[n * q + q])) || entry < 1e-300)) {
                    rotated = 1;
                    rotate_pair(a, n, p, q);
                }
            }
        }
    }
    for (int r = 0; r < n; r++) values[r] = a[n * r + r] * largest;
}

static double least(const double *values, int n)
{
    double found = INFINITY;
    for (int k = 0; k < n; k++) found = fmin(found, values[k]);
    return found;
}

static int all_finite(const double *values, int count)
{
    for (int k = 0; k < count; k++) {
        if (!isfinite(values[k])) return 0;
    }
    return 1;
}

/* Whether the symmetric part has a negative eigenvalue beyond rounding; the sign is decided at a unit diagonal. */
static int has_negative_eigenvalue(const double *matrix, int n)
{
    square symmetric = {0.0};
    double scale[MOST_ROWS], values[MOST_ROWS], norm = 0.0;
    for (int r = 0; r < n; r++) {
        for (int c = 0; c < n; c++) symmetric[n * r + c] = 0.5 * matrix[n * r + c] + 0.5 * matrix[n * c + r];
    }
    for (int r = 0; r < n; r++) {
        double size = symmetric[n * r + r];
        if (size < 0.0) return 1;
        if (size == 0.0) {
            for (int c = 0; c < n; c++) size = fmax(size, fabs(symmetric[n * r + c]));
        }
        scale[r] = size > 0.0 ? 1.0 / sqrt(size) : 0.0;
    }
    for (int k = 0; k < n * n; k++) {
        symmetric[k] = symmetric[k] * scale[k / n] * scale[k % n];
        norm += symmetric[k] * symmetric[k];
    }
    eigenvalues(symmetric, n, values);
    return least(values, n) < -16.0 * DBL_EPSILON * sqrt(norm);
}

/* The smallest and the largest eigenvalue of a matrix that is scaled to a unit diagonal; 0 where an entry of the
 * diagonal is not positive. */
static int of_unit_diagonal(const double *matrix, int n, double *smallest, double *largest)
{
    square scaled = {0.0};
    double values[MOST_ROWS];
    for (int r = 0; r < n; r++) {
        if (!(matrix[n * r + r] > 0.0)) return 0;
    }
    for (int k = 0; k < n * n; k++) {
        const int r = k / n, c = k % n;
        scaled[k] = r == c ? 1.0 : matrix[k] * (1.0 / sqrt(matrix[n * r + r])) * (1.0 / sqrt(matrix[n * c + c]));
    }
    eigenvalues(scaled, n, values);
    *smallest = least(values, n);
    *largest = 0.0;
    for (int r = 0; r < n; r++) *largest = fmax(*largest, values[r]);
    return 1;
}

/* Says which rule a parameter breaks; 0. */
static int broken(instance *i, const char *label, const char *rule, double value)
{
    say(i, "parameter `%s` %s: found %.17g", label, rule, value);
    return 0;
}

static int is_symmetric(instance *i, const char *label, const double *matrix, int n)
{
    double largest = 0.0;
    for (int k = 0; k < n * n; k++) {
        if (!isfinite(matrix[k])) return broken(i, label, "must be finite", matrix[k]);
        largest = fmax(largest, fabs(matrix[k]));
    }
    for (int k = 0; k < n * n; k++) {
        const double difference = matrix[k] - matrix[n * (k % n) + k / n];
        if (fabs(difference) > 8.0 * DBL_EPSILON * largest) {
            return broken(i, label, "must be symmetric; entries across the diagonal differ", difference);
        }
    }
    return 1;
}

/* Principal moments: none below -rounding (exclusively where it is positive), and, where that is asked for, none above
 * the sum of the others by more than slack. */
static int are_moments(instance *i, const check *law, const double *tensor, double rounding, double slack)
{
    double values[MOST_ROWS];
    if (!all_finite(tensor, 9)) return broken(i, law->label, "leaves the range of numbers", tensor[0]);
    eigenvalues(tensor, 3, values);
    const double smallest = least(values, 3);
    if (smallest <= -rounding) {
        return broken(i, law->label, "must have positive principal moments of inertia", smallest);
    }
    for (int k = 0; !law->formal && k < 3; k++) {
        const double sum = values[(k + 1) % 3] + values[(k + 2) % 3];
        if (values[k] - sum > slack) {
            return broken(i, law->label, "has a principal moment above the sum of the others", values[k]);
        }
    }
    return 1;
}

/* I_O - m (|c|^2 1 - c c^T); gives |c|^2. */
static double about_center(const double *v, double *central)
{
    const double *c = v + 1, square_length = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    for (int k = 0; k < 9; k++) {
        const int row = k / 3, column = k % 3;
        const double steiner = row == column ? square_length - c[row] * c[row] : -(c[row] * c[column]);
        central[k] = v[4 + k] - v[0] * steiner;
    }
    return square_length;
}

/* The inertia of a body alone, v = (m, c, I_O): what is left about its centre of mass. */
static int is_central(instance *i, const check *law, const double *v)
{
    double central[9];
    if (!is_symmetric(i, law->label, v + 4, 3)) return 0;
    if (!(v[0] > 0.0) || !all_finite(v, 4)) return 1; /* their own fields say so */
    const double rounding = 8.0 * DBL_EPSILON * v[0] * about_center(v, central);
    return are_moments(i, law, central, rounding, rounding + 8.0 * DBL_EPSILON * (v[4] + v[8] + v[12]));
}

static double next_up(double x)
{
    return nextafter(x, INFINITY);
}

/* The inertia of one of several bodies: a smallest moment of zero is one of a body. */
static int is_inertia_in_sum(instance *i, const check *law, const double *v, int *massless)
{
    double central[9], values[MOST_ROWS];
    if (!is_symmetric(i, law->label, v + 4, 3)) return 0;
    double slack = 8.0 * DBL_EPSILON * fabs(v[4] + v[8] + v[12]);
    if (!are_moments(i, law, v + 4, next_up(slack), slack)) return 0;
    if (!(v[0] >= 0.0) || !all_finite(v, 4)) return 1;
    slack += 8.0 * DBL_EPSILON * v[0] * about_center(v, central);
    if (!are_moments(i, law, central, next_up(slack), slack)) return 0;
    eigenvalues(central, 3, values);
    *massless |= least(values, 3) - slack <= 0.0;
    return 1;
}

/* The same of a body that turns about one axis alone: a disk across it has the same moment. */
static int is_inertia_about_axis(instance *i, const check *law, const double *v, int *massless)
{
    check formal = *law;
    double disk[13] = {0};
    if (!is_symmetric(i, law->label, v + 4, 3)) return 0;
    formal.formal = 1;
    disk[0] = v[0];
    for (int k = 0; k < 3; k++) {
        disk[1 + k] = k == law->axis ? 0.0 : v[1 + k];
        disk[4 + 4 * k] = v[4 + 4 * law->axis];
    }
    return is_inertia_in_sum(i, &formal, disk, massless);
}

static int is_kinetic_matrix(instance *i, const char *label, const double *matrix, int n)
{
    double smallest, largest;
    if (!all_finite(matrix, n * n)) return broken(i, label, "must be finite", NAN);
    if (!of_unit_diagonal(matrix, n, &smallest, &largest) || smallest <= -n * DBL_EPSILON) {
        return broken(i, label, "gives no positive kinetic energy; smallest eigenvalue or diagonal entry", matrix[0]);
    }
    if (smallest / DBL_EPSILON < largest) {
        return broken(i, label, "makes the mass matrix singular to rounding; smallest eigenvalue", smallest);
    }
    return 1;
}

static int are_modes(instance *i, const char *label, const double *matrix, int n)
{
    if (!all_finite(matrix, n * n)) return broken(i, label, "must be finite", NAN);
    for (int k = 6; k < n; k++) {
        if (!(matrix[n * k + k] > 0.0)) return broken(i, label, "must have positive modal masses", matrix[n * k + k]);
    }
    return !has_negative_eigenvalue(matrix, n) || broken(i, label, "has motions of negative energy", matrix[0]);
}

static int rows_of(int count)
{
    int n = 0;
    while (n * n < count) n++;
    return n;
}

/* Rules about one number, or a pair of limits. */
static int keeps_rule_of_numbers(instance *i, const check *law, const double *v, int *massless)
{
    const char *label = law->label;
    const double quarter = 0.25 * v[0];
    for (int k = 0; k < law->count; k++) {
        if (!isfinite(v[k])) return broken(i, label, "must be finite", v[k]);
    }
    switch (law->rule) {
    case MASS: return v[0] > 0.0 || broken(i, label, "must be a mass greater than zero", v[0]);
    case MASS_IN_SUM:
        *massless |= v[0] == 0.0;
        return v[0] >= 0.0 || broken(i, label, "must be a mass of zero or greater", v[0]);
    case ARMATURE:
        *massless |= v[0] == 0.0;
        return v[0] >= 0.0 || broken(i, label, "must be zero or greater", v[0]);
    case NON_NEGATIVE: return v[0] >= 0.0 || broken(i, label, "must be zero or greater", v[0]);
    case STIFFNESS: return v[0] >= 0.0 || broken(i, label, "must be a stiffness of zero or greater", v[0]);
    case WIDTH: return v[0] > 0.0 || broken(i, label, "must be a width greater than zero", v[0]);
    case LIMITS: return v[0] < v[1] || broken(i, label, "must be below the upper limit", v[0]);
    case LENGTH:
        return (v[0] > 0.0 && quarter * quarter > 0.0 && isfinite(quarter * quarter)) ||
               broken(i, label, "must be a length greater than zero", v[0]);
    case RESTITUTION: return (v[0] >= 0.0 && v[0] <= 1.0) || broken(i, label, "must be from 0 to 1", v[0]);
    case DIRECTION: return v[0] > 0.0 || broken(i, label, "must have a direction: its square is", v[0]);
    default: return 1;
    }
}

static int keeps_rule(instance *i, const check *law, const double *v, int *massless)
{
    const int n = rows_of(law->count);
    const double trace = law->count >= 9 ? v[0] + v[4] + v[8] : 0.0;
    switch (law->rule) {
    case SYMMETRIC:
    case DAMPING_MATRIX: return is_symmetric(i, law->label, v, n);
    case STIFFNESS_MATRIX:
        if (!is_symmetric(i, law->label, v, n)) return 0;
        return !has_negative_eigenvalue(v, n) || broken(i, law->label, "has a negative eigenvalue", v[0]);
    case INERTIA:
        return is_symmetric(i, law->label, v, 3) && are_moments(i, law, v, 0.0, 8.0 * DBL_EPSILON * trace);
    case CENTRAL_INERTIA: return is_central(i, law, v);
    case INERTIA_IN_SUM: return is_inertia_in_sum(i, law, v, massless);
    case INERTIA_ABOUT_AXIS: return is_inertia_about_axis(i, law, v, massless);
    case KINETIC_MATRIX: return (MODEL_IN_SUM && *massless) || is_kinetic_matrix(i, law->label, v, n);
    case MODES: return are_modes(i, law->label, v, n);
    default: return keeps_rule_of_numbers(i, law, v, massless);
    }
}

/* Whether bodies without mass of their own have a regular mass matrix at one of four configurations of general
 * position: then it is one nearly everywhere. */
static int is_regular(instance *i, const double *constants)
{
    static const double scales[4] = {1.0, 1e-3, 30.0, 1e3};
    unsigned long long seed = 0x9e3779b97f4a7c15ull;
    double q[ROOM(MODEL_Q)];
    square matrix;
    for (int sample = 0; sample < 4; sample++) {
        double smallest, largest;
        for (int k = 0; k < MODEL_Q; k++) {
            seed = seed * 6364136223846793005ull + 1442695040888963407ull;
            const double size = 0.25 + 0.75 * ((double)(seed >> 12) / 4503599627370496.0);
            q[k] = (seed >> 11 & 1 ? -1.0 : 1.0) * scales[sample] * size;
        }
        normalise(q);
        model_mass_matrix(constants, 0.37, q, matrix);
        if (all_finite(matrix, MODEL_Z * MODEL_Z) && of_unit_diagonal(matrix, MODEL_Z, &smallest, &largest) &&
            smallest > 256.0 * MODEL_Z * DBL_EPSILON) {
            return 1;
        }
    }
    return broken(i, MODEL_LABEL, "or others leave motions without inertia: the mass matrix is singular", 0.0);
}

/* The constants of the parameters, after all checks; 0 and a message where one fails. */
static int make_constants(instance *i)
{
    double read[ROOM(MODEL_READ)], computed[ROOM(MODEL_COMPUTED)] = {0.0}, values[MOST_GIVEN];
    int massless = 0;
    if (i->now.has_constants) return 1;
    for (int k = 0; k < MODEL_READ; k++) read[k] = i->now.parameters[read_parameters[k]];
    model_checks(read, computed);
    for (int c = 0; c < MODEL_CHECKS; c++) {
        for (int k = 0; k < checks[c].count; k++) {
            const int place = given[checks[c].first + k];
            /* Places from 0 on are parameters, below -1 computed numbers, -1 is zero. */
            values[k] = place >= 0 ? i->now.parameters[place] : place == -1 ? 0.0 : computed[-2 - place];
        }
        if (!keeps_rule(i, &checks[c], values, &massless)) return 0;
    }
    model_constants(read, i->now.constants);
    if (MODEL_IN_SUM && massless && !is_regular(i, i->now.constants)) return 0;
    if (!all_finite(i->now.constants, MODEL_CONSTANTS)) {
        return broken(i, MODEL_LABEL, "and others give constants that leave the range of numbers", NAN);
    }
    i->now.has_constants = 1;
    return 1;
}
