/* One translation unit: compile this file alone.
 *
 *   cc -std=c99 -O2 -ffp-contract=off -shared -fPIC -fvisibility=hidden fmu.c -lm
 */
#if defined _WIN32
#define EXPORTED __declspec(dllexport)
#elif defined __GNUC__
#define EXPORTED __attribute__((visibility("default")))
#else
#define EXPORTED
#endif

#include "model.h"
#include "gauss.h"
#include "model.c"

/* Declarations that files share. Every version of FMI has its own way to hand a message over. */
static void tell(instance *i, const char *message);
static double say(instance *i, const char *format, ...);
static void normalise(double *q);
static void forget(memory *now);

#include "checks.c"
#include "contacts.c"
#include "motion.c"
#include "variables.c"
#include "steps.c"
#if MODEL_FMI == 2
#include "fmi2.c"
#else
#include "fmi3.c"
#endif
