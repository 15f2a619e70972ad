/* Types of the tables that model.c fills for one scene, and the memory of one instance.
 *
 * fmu.c includes all other files: everything but the functions of FMI is static, so that several FMUs can be linked
 * into one program. C99, <math.h> and a few functions of <string.h> and <stdio.h>.
 */
#ifndef GAUSS_H
#define GAUSS_H

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* C has no arrays without entries. */
#define ROOM(count) ((count) > 0 ? (count) : 1)
#define STATES (MODEL_Q + MODEL_Z)
/* Value references: time, parameters, inputs, states (q, then z), their rates, outputs. */
#define FIRST_PARAMETER 1
#define FIRST_INPUT (FIRST_PARAMETER + MODEL_PARAMETERS)
#define FIRST_STATE (FIRST_INPUT + MODEL_U)
#define FIRST_RATE (FIRST_STATE + STATES)
#define FIRST_OUTPUT (FIRST_RATE + STATES)
/* The force and the event indicator of a contact are outputs that no program of the scene gives. */
#define OUTPUTS (MODEL_OUTPUTS + 2 * MODEL_CONTACTS)
#define VARIABLES (FIRST_OUTPUT + OUTPUTS)

/* Smaller relative tolerances than this are below what rounding leaves. */
#define LEAST_TOLERANCE 1e-13

/* A part of the configuration whose first components have the norm 1: the quaternion x, y, z, w of a rotation; that of
 * a pose, then its position; cosine and sine of a pose in the plane, then its position. All else is plain numbers. */
enum group_kind { ROTATION, POSE, PLANE };

typedef struct {
    int kind;
    int component; /* the first one among q */
    int increment; /* the first one among those of a velocity: of a pose linear before angular, in body axes */
} group;

/* Rules of parameters, those of `kernel()` in Rust. */
enum rule {
    FINITE, MASS, MASS_IN_SUM, NON_NEGATIVE, SYMMETRIC, INERTIA, CENTRAL_INERTIA, INERTIA_ABOUT_AXIS, INERTIA_IN_SUM,
    KINETIC_MATRIX, STIFFNESS, WIDTH, LIMITS, ARMATURE, LENGTH, RESTITUTION, DIRECTION, STIFFNESS_MATRIX,
    DAMPING_MATRIX, MODES
};

/* A rule and the numbers that it is about: entries of `given` from `first` on. */
typedef struct {
    const char *label;
    int rule;
    int axis;
    int formal; /* principal moments need not obey the triangle inequality */
    int count;
    int first;
} check;

/* Phases of the life of an instance, of both kinds and versions. */
enum phase { INSTANTIATED, INITIALIZING, EVENTS, CONTINUOUS, STEPPING, TERMINATED };

/* All that changes while an instance runs: a copy of it is a state that can be gone back to. */
typedef struct {
    double time;
    double parameters[ROOM(MODEL_PARAMETERS)];
    double inputs[ROOM(MODEL_U)];
    double states[ROOM(STATES)]; /* the quaternions of the states of model exchange may have any norm but zero */
    double step;                 /* what co-simulation tries next, in s; 0: nothing is known */
    double tolerance;
    int phase;
    int has_constants, has_rates, has_outputs; /* whether what follows is up to date */
    double constants[ROOM(MODEL_CONSTANTS)];
    double rates[ROOM(STATES)];
    double forces[ROOM(MODEL_CONTACTS)]; /* of closed contacts, as of the rates; 0 of open ones */
    int closed[ROOM(MODEL_CONTACTS)];
    double outputs[ROOM(OUTPUTS)];
} memory;

/* Numbers that are kept between calls of one instance for nothing but room. */
typedef struct {
    double stages[7][ROOM(STATES)];
    double trial[ROOM(STATES)];
    double seeds[ROOM(VARIABLES)];
    double results[ROOM(VARIABLES)];
} room;

/* A function whose type the version of FMI knows. */
typedef void (*function)(void);

typedef struct {
    memory now;
    room room;
    char name[128];
    char message[512];
    int is_stepped; /* co-simulation */
    void *environment; /* the caller's: of FMI 2.0 its functions */
    function log;
} instance;

#endif
