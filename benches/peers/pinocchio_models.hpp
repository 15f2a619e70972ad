// The scenes as models of Pinocchio; `models.hpp` is written by `rigid_bodies.py`.
#pragma once

#include <array>
#include <pinocchio/multibody.hpp>

namespace scenes {

enum class Kind { Free, TurnX, TurnY, TurnZ, SlideX, Turn, Slide };

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

// About or along a coordinate axis where it is one: Pinocchio has joints of their own for these.
inline pinocchio::JointModel along(Kind kind, const Eigen::Vector3d &axis) {
  const bool turns = kind == Kind::Turn;
  if (axis == Eigen::Vector3d::UnitX()) return turns ? pinocchio::JointModel(pinocchio::JointModelRX()) : pinocchio::JointModelPX();
  if (axis == Eigen::Vector3d::UnitY()) return turns ? pinocchio::JointModel(pinocchio::JointModelRY()) : pinocchio::JointModelPY();
  if (axis == Eigen::Vector3d::UnitZ()) return turns ? pinocchio::JointModel(pinocchio::JointModelRZ()) : pinocchio::JointModelPZ();
  if (turns) return pinocchio::JointModelRevoluteUnaligned(axis);
  return pinocchio::JointModelPrismaticUnaligned(axis);
}

// Hangs a body on a joint, placed by rotation and position there.
inline void place(pinocchio::Model &model, int parent, Kind kind, std::array<double, 3> axis, std::array<double, 9> rotation,
                  std::array<double, 3> position, double mass, std::array<double, 3> center, std::array<double, 9> inertia) {
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const auto vector = [](std::array<double, 3> a) { return Eigen::Vector3d(a[0], a[1], a[2]); };
  const pinocchio::SE3 at(Eigen::Map<Rows>(rotation.data()), vector(position));
  const pinocchio::JointModel joint_model = kind == Kind::Free ? pinocchio::JointModel(pinocchio::JointModelFreeFlyer()) : along(kind, vector(axis));
  const auto index = model.addJoint(pinocchio::JointIndex(parent), joint_model, at, "joint" + std::to_string(model.njoints));
  const Eigen::Matrix3d tensor = Eigen::Map<Rows>(inertia.data());
  model.appendBodyToJoint(index, pinocchio::Inertia(mass, vector(center), tensor), pinocchio::SE3::Identity());
}

#include "models.hpp"

} // namespace scenes
