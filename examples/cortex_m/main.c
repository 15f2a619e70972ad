/*
 * The torpedo of the README on a processor that has floats and nothing larger: its speeds after two seconds, by the
 * classical method of Runge and Kutta at 100 Hz. Printed are whole micrometres a second and microradians a second, since
 * printing floats would bring more code than the body has.
 */
#include "board.h"
#include "torpedo.h"

enum { Z = TORPEDO_Z_COUNT };

static float k[TORPEDO_K_COUNT];

static void step(float z[Z], const float q[TORPEDO_Q_COUNT], float h)
{
    static const float node[4] = {0.0f, 0.5f, 0.5f, 1.0f}, weight[4] = {1.0f, 2.0f, 2.0f, 1.0f};
    float rate[Z] = {0.0f}, sum[Z] = {0.0f}, at[Z];
    for (int stage = 0; stage < 4; stage++) {
        for (int i = 0; i < Z; i++) {
            at[i] = z[i] + (h * node[stage]) * rate[i];
        }
        torpedo_acceleration(k, 0.0f, q, at, rate);
        for (int i = 0; i < Z; i++) {
            sum[i] += weight[stage] * rate[i];
        }
    }
    for (int i = 0; i < Z; i++) {
        z[i] += (h / 6.0f) * sum[i];
    }
}

static void print_millionths(float value)
{
    char text[14];
    char *at = text + sizeof text;
    long rest = (long)(value * 1e6f);
    unsigned long digits = (unsigned long)(rest < 0 ? -rest : rest);
    *--at = '\0';
    *--at = '\n';
    do {
        *--at = (char)('0' + (int)(digits % 10u));
        digits /= 10u;
    } while (digits > 0u);
    if (rest < 0) {
        *--at = '-';
    }
    board_print(at);
}

int main(void)
{
    float parameters[TORPEDO_PARAMETERS_COUNT] = {0.0f};
    parameters[TORPEDO_PARAMETERS_MASS] = 30.0f;
    parameters[TORPEDO_PARAMETERS_CENTER_2] = -0.02f;
    parameters[TORPEDO_PARAMETERS_INERTIA_0] = 0.2f;
    parameters[TORPEDO_PARAMETERS_INERTIA_1] = 3.5f;
    parameters[TORPEDO_PARAMETERS_INERTIA_2] = 3.5f;
    parameters[TORPEDO_PARAMETERS_ADDED_0] = 0.9f;
    parameters[TORPEDO_PARAMETERS_ADDED_1] = 35.0f;
    parameters[TORPEDO_PARAMETERS_ADDED_2] = 35.0f;
    parameters[TORPEDO_PARAMETERS_ADDED_3] = 0.07f;
    parameters[TORPEDO_PARAMETERS_ADDED_4] = 4.9f;
    parameters[TORPEDO_PARAMETERS_ADDED_5] = 4.9f;
    parameters[TORPEDO_PARAMETERS_LIFT] = 60.0f;
    torpedo_kernel(parameters, k);
    /* As heavy as the water that it displaces: where it is does not matter to how it turns. */
    float q[TORPEDO_Q_COUNT] = {0.0f};
    q[TORPEDO_Q_W] = 1.0f;
    float z[Z] = {1.5f, 0.0f, 0.0f, 0.5f, 1.0f, 1.5f};
    for (int n = 0; n < 200; n++) {
        step(z, q, 0.01f);
    }
    for (int i = 0; i < Z; i++) {
        print_millionths(z[i]);
    }
    return 0;
}
