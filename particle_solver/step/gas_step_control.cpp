// The next sub-step of the gas.
//
// Dense gas: c = v_rms h / d = 0.1. The order of hits that depend on each other within one sub-step is lost, which
// lowers the pressure: measured at fill 0.35 by 0.1 % at c = 0.1 and 3.5 % at 0.4; at fill 0.45 by 1 % at 0.1 and
// nothing at 0.05.
//
// What matters is the length of such chains, and that is what the rounds count: each round follows the chains by one
// link. Measured, the pressure is right within 0.2 % while 98 % of the hits are done in 4 rounds, at any fill, and 1 %
// low at 7. So thin gas, where the rounds are few, takes larger steps, and very dense gas smaller ones, down to half
// the rule. The share of hits is used, not the last round, because the longest chain of many particles is longer than
// that of few. The step changes by a few percent a call: one quiet step means little. While some particles still wait
// for the detonation the many that cannot collide yet say nothing about the rest: no growth.
//
// In very thin gas the price of looking far sets the step: beyond some 60 candidates a search, a longer step costs more
// than it saves.
//
// Too large: pressure too low, and the neighbours within v h become many; too small: time. All of it is deterministic.
#include <algorithm>
#include <cmath>

#include "particle_solver/step/gas_collide.hpp"

namespace standoff::particles {
namespace {

constexpr double dense_courant = 0.1;  // v_rms h / d
constexpr int few_rounds = 3, many_rounds = 5;
constexpr long many_candidates = 60;  // a search
constexpr double growth = 1.03, shrinkage = 0.95, smallest_share = 0.5;

}  // namespace

double GasCollide::suggest_step(const GasState& gas, const GasCollideCounts& last, double last_step, double cap) const {
  double square_sum = 0.0;
  for (const Vec3& v : gas.velocity) square_sum += squared_norm(v);
  if (gas.size() == 0 || square_sum == 0.0) return cap;
  const double dense = dense_courant * 2.0 * gas.radius / std::sqrt(square_sum / static_cast<double>(gas.size()));
  if (last_step <= 0.0) return std::min(dense, cap);
  double next = last_step;
  const bool far = last.candidates > many_candidates * last.searches;
  if (last.usual_rounds <= few_rounds && !far) next *= growth;
  if (last.usual_rounds > many_rounds || (far && next > dense)) next *= shrinkage;
  if (!gas.all_released()) next = std::min(next, dense);
  return std::min(std::max(next, smallest_share * dense), cap);
}

}  // namespace standoff::particles
