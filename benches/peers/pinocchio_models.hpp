// The scenes as models of Pinocchio; `models.hpp` is written by `rigid_bodies.py`.
#pragma once

#include <array>
#include <pinocchio/multibody.hpp>

namespace scenes {

enum class Kind { Free, TurnX, TurnY, TurnZ, SlideX };

inline pinocchio::JointModel joint(Kind kind) {
  switch (kind) {
  case Kind::Free: return pinocchio::JointModelFreeFlyer();
  case Kind::TurnX: return pinocchio::JointModelRX();
  case Kind::TurnY: return pinocchio::JointModelRY();
  case Kind::TurnZ: return pinocchio::JointModelRZ();
  default: return pinocchio::JointModelPX();
  }
}

// Appends a body to the last one: placed by a position and quarter turns about x, then the joint.
inline void add(pinocchio::Model &model, Kind kind, std::array<double, 3> position, int quarter_turns, double mass, std::array<double, 3> center,
                std::array<double, 9> inertia) {
  // Exact, so that no product with a residue of the quarter turn is left.
  Eigen::Matrix3d turn;
  double n = quarter_turns, rest = n == 0 ? 1 : 0;
  turn << 1, 0, 0, 0, rest, -n, 0, n, rest;
  const pinocchio::SE3 place(turn, Eigen::Vector3d(position[0], position[1], position[2]));
  const auto parent = pinocchio::JointIndex(model.njoints - 1);
  const auto index = model.addJoint(parent, joint(kind), place, "joint" + std::to_string(model.njoints));
  if (mass > 0) {
    const Eigen::Vector3d c(center[0], center[1], center[2]);
    const Eigen::Matrix3d tensor = Eigen::Map<Eigen::Matrix3d>(inertia.data());
    model.appendBodyToJoint(index, pinocchio::Inertia(mass, c, tensor), pinocchio::SE3::Identity());
  }
}

#include "models.hpp"

} // namespace scenes
