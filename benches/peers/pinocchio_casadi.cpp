// Pinocchio's articulated-body algorithm over CasADi's symbols: `pinocchio_casadi FILE` saves the functions for CasADi's code generator.
#include <casadi/casadi.hpp>
#include <pinocchio/autodiff/casadi.hpp>

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include "pinocchio_models.hpp"

using Symbol = casadi::SX;
using Symbols = Eigen::Matrix<Symbol, Eigen::Dynamic, 1>;

enum class State { Body, Joints, Backward, Absolute };

static casadi::Function function(const std::string &name, void (*build)(pinocchio::Model &), State kind) {
  pinocchio::Model numbers;
  build(numbers);
  const pinocchio::ModelTpl<Symbol> model = numbers.cast<Symbol>();
  pinocchio::DataTpl<Symbol> data(model);
  const bool body = kind == State::Body;
  const Symbol state = Symbol::sym("x", body ? 13 : numbers.nq + numbers.nv);
  auto at = [&](int i) { return Symbol(state(i)); };
  Symbols q(numbers.nq), v(numbers.nv), tau = Symbols::Zero(numbers.nv);
  for (int i = 0; i < numbers.nq; i++) q[i] = body ? at(i < 3 ? 4 + i : i - 3) : at(i);
  for (int i = 0; i < numbers.nv; i++) v[i] = at((body ? 7 : numbers.nq) + i);
  if (kind == State::Absolute) q[1] -= q[0], v[1] -= v[0];
  if (kind == State::Backward || kind == State::Absolute) q = -q, v = -v;
  pinocchio::aba(model, data, q, v, tau);
  Symbols result = data.ddq;
  if (kind == State::Backward || kind == State::Absolute) result = -result;
  if (kind == State::Absolute) result[1] += result[0];
  const std::vector<Symbol> parts(result.data(), result.data() + result.size());
  const std::vector<Symbol> inputs{state}, outputs{Symbol::vertcat(parts)};
  return casadi::Function("scene_" + name, inputs, outputs, {{"cse", true}});
}

// Of a robot: configuration, speeds, and forces or accelerations, in Pinocchio's order.
static casadi::Function robot(const std::string &name, void (*build)(pinocchio::Model &), bool forward) {
  pinocchio::Model numbers;
  build(numbers);
  const pinocchio::ModelTpl<Symbol> model = numbers.cast<Symbol>();
  pinocchio::DataTpl<Symbol> data(model);
  const Symbol state = Symbol::sym("x", numbers.nq + 2 * numbers.nv);
  Symbols q(numbers.nq), v(numbers.nv), third(numbers.nv);
  for (int i = 0; i < numbers.nq; i++) q[i] = Symbol(state(i));
  for (int i = 0; i < numbers.nv; i++) v[i] = Symbol(state(numbers.nq + i)), third[i] = Symbol(state(numbers.nq + numbers.nv + i));
  const Symbols result = forward ? Symbols(pinocchio::aba(model, data, q, v, third)) : Symbols(pinocchio::rnea(model, data, q, v, third));
  const std::vector<Symbol> parts(result.data(), result.data() + result.size());
  const std::vector<Symbol> inputs{state}, outputs{Symbol::vertcat(parts)};
  return casadi::Function("scene_" + name + (forward ? "_forward" : "_inverse"), inputs, outputs, {{"cse", true}});
}

int main(int, char **arguments) {
  const casadi::Function all[] = {
      function("s1", scenes::build_s1, State::Body),
      function("s2", scenes::build_s2, State::Body),
      function("s4", scenes::build_s4, State::Joints),
      function("s5", scenes::build_s5_jointed, State::Absolute),
      function("s5_jointed", scenes::build_s5_jointed, State::Backward),
      function("s6", scenes::build_s6, State::Joints),
      function("s7", scenes::build_s7, State::Joints),
      robot("s7_fingers", scenes::build_s7_fingers, true),
      robot("s7_fingers", scenes::build_s7_fingers, false),
      robot("s8", scenes::build_s8, true),
      robot("s8", scenes::build_s8, false),
      robot("s9", scenes::build_s9, true),
      robot("s9", scenes::build_s9, false),
  };
  for (const auto &one : all) one.save(std::string(arguments[1]) + "/" + one.name() + ".casadi");
}
