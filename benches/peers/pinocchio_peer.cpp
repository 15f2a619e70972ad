// Forward dynamics by Pinocchio's articulated-body algorithm, header only. The double pendulum has angles of the other sign, from the vertical or
// at the joint; they are carried over here.
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <string>

#include "pinocchio_models.hpp"

namespace {

template <int NQ, int NV> struct Scene {
  pinocchio::Model model;
  pinocchio::Data data;
  Eigen::VectorXd q, v, tau;

  explicit Scene(void (*build)(pinocchio::Model &)) : model(made(build)), data(model), q(NQ), v(NV), tau(Eigen::VectorXd::Zero(NV)) {}

  static pinocchio::Model made(void (*build)(pinocchio::Model &)) {
    pinocchio::Model model;
    build(model);
    return model;
  }

  void accelerations(double *out) {
    pinocchio::aba(model, data, q, v, tau);
    Eigen::Map<Eigen::Matrix<double, NV, 1>> result(out);
    result = data.ddq;
  }

  // q, then v, by joints.
  void joints(const double *state, double *out, double sign = 1) {
    for (int i = 0; i < NV; i++) {
      q[i] = sign * state[i];
      v[i] = sign * state[NQ + i];
    }
    accelerations(out);
    if (sign < 0)
      for (int i = 0; i < NV; i++) out[i] = -out[i];
  }

  // Velocities of its free joint are those of the scene.
  void body(const double *state, double *out) {
    for (int i = 0; i < 4; i++) q[3 + i] = state[i];
    for (int i = 0; i < 3; i++) q[i] = state[4 + i];
    for (int i = 0; i < 6; i++) v[i] = state[7 + i];
    accelerations(out);
  }
};

Scene<7, 6> scene_s1(scenes::build_s1), scene_s2(scenes::build_s2);
Scene<3, 3> scene_s4(scenes::build_s4);
Scene<2, 2> scene_s5_jointed(scenes::build_s5_jointed), scene_s6(scenes::build_s6);
Scene<7, 7> scene_s7(scenes::build_s7);

// Robots read configuration, speeds, and forces or accelerations, all in Pinocchio's order.
template <int NQ, int NV> struct Robot {
  using Q = Eigen::Map<const Eigen::Matrix<double, NQ, 1>>;
  using V = Eigen::Map<const Eigen::Matrix<double, NV, 1>>;
  using Out = Eigen::Map<Eigen::Matrix<double, NV, 1>>;
  pinocchio::Model model;
  pinocchio::Data data;

  explicit Robot(void (*build)(pinocchio::Model &)) : model(Scene<NQ, NV>::made(build)), data(model) {}

  void forward(const double *state, double *out) { Out{out} = pinocchio::aba(model, data, Q{state}, V{state + NQ}, V{state + NQ + NV}); }
  void inverse(const double *state, double *out) { Out{out} = pinocchio::rnea(model, data, Q{state}, V{state + NQ}, V{state + NQ + NV}); }
  // The derivatives stay where Pinocchio puts them.
  void linearize(const double *state, double *out) {
    pinocchio::computeABADerivatives(model, data, Q{state}, V{state + NQ}, V{state + NQ + NV});
    Out{out} = data.ddq;
  }
  void inverse_linearize(const double *state, double *out) {
    pinocchio::computeRNEADerivatives(model, data, Q{state}, V{state + NQ}, V{state + NQ + NV});
    Out{out} = data.tau;
  }
  // By q and by the speeds, row by row.
  using Block = Eigen::Map<Eigen::Matrix<double, NV, NV, Eigen::RowMajor>>;
  void derivatives(const double *state, double *out) {
    pinocchio::computeABADerivatives(model, data, Q{state}, V{state + NQ}, V{state + NQ + NV});
    Block{out} = data.ddq_dq;
    Block{out + NV * NV} = data.ddq_dv;
  }
  void inverse_derivatives(const double *state, double *out) {
    pinocchio::computeRNEADerivatives(model, data, Q{state}, V{state + NQ}, V{state + NQ + NV});
    Block{out} = data.dtau_dq;
    Block{out + NV * NV} = data.dtau_dv;
  }
};

Robot<9, 9> robot_s7_fingers(scenes::build_s7_fingers);
Robot<19, 18> robot_s8(scenes::build_s8);
Robot<39, 38> robot_s9(scenes::build_s9);

} // namespace

#define ROBOT(name) \
  void name##_forward(const double *state, double *out) { robot_##name.forward(state, out); } \
  void name##_inverse(const double *state, double *out) { robot_##name.inverse(state, out); } \
  void name##_linearize(const double *state, double *out) { robot_##name.linearize(state, out); } \
  void name##_derivatives(const double *state, double *out) { robot_##name.derivatives(state, out); } \
  void name##_inverse_linearize(const double *state, double *out) { robot_##name.inverse_linearize(state, out); } \
  void name##_inverse_derivatives(const double *state, double *out) { robot_##name.inverse_derivatives(state, out); }

extern "C" {
ROBOT(s7_fingers)
ROBOT(s8)
ROBOT(s9)
void s1(const double *state, double *out) { scene_s1.body(state, out); }
void s2(const double *state, double *out) { scene_s2.body(state, out); }
void s4(const double *state, double *out) { scene_s4.joints(state, out); }
void s5_jointed(const double *state, double *out) { scene_s5_jointed.joints(state, out, -1); }
void s5(const double *state, double *out) {
  const double relative[] = {state[0], state[1] - state[0], state[2], state[3] - state[2]};
  s5_jointed(relative, out);
  out[1] += out[0];
}
void s6(const double *state, double *out) { scene_s6.joints(state, out); }
void s7(const double *state, double *out) { scene_s7.joints(state, out); }
}
