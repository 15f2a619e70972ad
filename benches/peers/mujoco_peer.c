// Forward dynamics by MuJoCo: `mj_forward`, or with MINIMAL its stages that a scene without contacts needs and no more.
//
// A free joint of MuJoCo has velocities in the axes of space, so those of the scene and their rates are carried over; the double pendulum
// has angles of the other sign, from the vertical or at the joint. That takes a few nanoseconds of several hundred.
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>

#include "models_xml.h"

typedef struct {
  mjModel *model;
  mjData *data;
} Scene;

static Scene load(const char *xml) {
  char message[1000] = "";
  mjSpec *description = mj_parseXMLString(xml, NULL, message, sizeof message);
  Scene scene = {description ? mj_compile(description, NULL) : NULL, NULL};
  if (!scene.model) {
    fprintf(stderr, "MuJoCo does not accept a scene: %s %s\n", message, description ? mjs_getError(description) : "");
    exit(1);
  }
  scene.data = mj_makeData(scene.model);
  return scene;
}

static void forward(Scene scene) {
#ifdef MINIMAL
  const mjModel *model = scene.model;
  mjData *data = scene.data;
  mj_kinematics(model, data);
  mj_comPos(model, data);
  mj_makeM(model, data);
  mj_factorM(model, data);
  mj_comVel(model, data);
  mj_rne(model, data, 0, data->qfrc_bias);
  for (int i = 0; i < model->nv; i++) data->qfrc_smooth[i] = data->qfrc_applied[i] - data->qfrc_bias[i];
  mj_solveM(model, data, data->qacc, data->qfrc_smooth, 1);
#else
  mj_forward(scene.model, scene.data);
#endif
}

// Rows of R from the unit quaternion x y z w.
static void rotation(const double *q, double r[3][3]) {
  double x = q[0], y = q[1], z = q[2], w = q[3];
  double rows[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                       {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                       {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) r[i][j] = rows[i][j];
}

static void free_base(Scene scene, const double *position, const double *turn, const double *u, const double *w, double *out) {
  mjData *data = scene.data;
  double r[3][3];
  rotation(turn, r);
  for (int i = 0; i < 3; i++) {
    data->qpos[i] = position[i];
    data->qpos[4 + i] = turn[i];
    data->qvel[i] = r[i][0] * u[0] + r[i][1] * u[1] + r[i][2] * u[2];
    data->qvel[3 + i] = w[i];
  }
  data->qpos[3] = turn[3];
  forward(scene);
  // The rate of u in body axes is the acceleration there less w x u.
  const double *a = data->qacc;
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    out[i] = r[0][i] * a[0] + r[1][i] * a[1] + r[2][i] * a[2] - (w[j] * u[k] - w[k] * u[j]);
    out[3 + i] = a[3 + i];
  }
}

static void free_body(Scene scene, const double *state, double *out) { free_base(scene, state + 4, state, state + 7, state + 10, out); }

// A robot on a base that floats, on which nothing acts but its weight: `n` joints.
static void floating(Scene scene, const double *state, double *out, int n) {
  const double *speeds = state + 7 + n, *forces = speeds + 6 + n;
  for (int i = 0; i < n; i++) {
    scene.data->qpos[7 + i] = state[7 + i];
    scene.data->qvel[6 + i] = speeds[6 + i];
    scene.data->qfrc_applied[6 + i] = forces[6 + i];
  }
  free_base(scene, state, state + 3, speeds, speeds + 3, out);
  for (int i = 0; i < n; i++) out[6 + i] = scene.data->qacc[6 + i];
}

static void joints(Scene scene, const double *state, double *out, int n) {
  for (int i = 0; i < n; i++) {
    scene.data->qpos[i] = state[i];
    scene.data->qvel[i] = state[n + i];
  }
  forward(scene);
  for (int i = 0; i < n; i++) out[i] = scene.data->qacc[i];
}

static Scene scene_s1, scene_s2, scene_s4, scene_s5_jointed, scene_s6, scene_s7, scene_s7_fingers, scene_s8, scene_s9;

static void ignore(const char *message) { (void)message; }

__attribute__((constructor)) static void load_all(void) {
  // The reference position of the top is gimbal lock, of which compiling a model warns; no state has it.
  mju_user_warning = ignore;
  scene_s1 = load(xml_s1);
  scene_s2 = load(xml_s2);
  scene_s4 = load(xml_s4);
  scene_s5_jointed = load(xml_s5_jointed);
  scene_s6 = load(xml_s6);
  scene_s7 = load(xml_s7);
  scene_s7_fingers = load(xml_s7_fingers);
  scene_s8 = load(xml_s8);
  scene_s9 = load(xml_s9);
  mju_user_warning = NULL;
}

void s1(const double *state, double *out) { free_body(scene_s1, state, out); }
void s2(const double *state, double *out) { free_body(scene_s2, state, out); }
void s4(const double *state, double *out) { joints(scene_s4, state, out, 3); }
void s6(const double *state, double *out) { joints(scene_s6, state, out, 2); }
void s7(const double *state, double *out) { joints(scene_s7, state, out, 7); }
void s8_forward(const double *state, double *out) { floating(scene_s8, state, out, 12); }
void s9_forward(const double *state, double *out) { floating(scene_s9, state, out, 32); }

void s7_fingers_forward(const double *state, double *out) {
  for (int i = 0; i < 9; i++) scene_s7_fingers.data->qfrc_applied[i] = state[18 + i];
  joints(scene_s7_fingers, state, out, 9);
}

void s5_jointed(const double *state, double *out) {
  const double turned[] = {-state[0], -state[1], -state[2], -state[3]};
  joints(scene_s5_jointed, turned, out, 2);
  out[0] = -out[0];
  out[1] = -out[1];
}

void s5(const double *state, double *out) {
  const double relative[] = {state[0], state[1] - state[0], state[2], state[3] - state[2]};
  s5_jointed(relative, out);
  out[1] += out[0];
}
