// The plate as relaxation sees it: trial forces leave the committed history alone, a committed state is in equilibrium
// with itself, the stiffness is the slope of the force at frozen flow, effects that are off take no memory.
#include <gtest/gtest.h>

#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using testing::plate_case;

std::uint64_t hash_of(const StructuralModel& model) {
  StateHash hash;
  model.add_to(hash);
  return hash.value();
}

/// A plate in mid-flight with plastic strain in it.
void bend(PlateHex64& model) {
  testing::give_impulse(model, 130.0);
  for (int i = 0; i < 600; ++i) model.step(model.stable_step());
  ASSERT_GT(model.extremes().max_plastic_strain, 1e-3);
}

struct State {
  explicit State(const RelaxationProblem& p) : u(static_cast<std::size_t>(p.dofs())), v(u), f(u) { p.get_state(u, v); }
  std::vector<double> u, v, f;
};

double largest(const std::vector<double>& values) {
  double m = 0.0;
  for (const double v : values) m = std::max(m, std::fabs(v));
  return m;
}

TEST(PlateRelaxation_TrialForces, AtManyStates_LeaveTheCommittedHistory) {
  PlateHex64 model(plate_case(4, true), 1);
  bend(model);
  RelaxationProblem& p = *model.relaxation();
  State s(p);
  const std::uint64_t before = hash_of(model);
  const StructureLedger books = model.ledger();
  for (const double scale : {0.9, 1.0, 1.1}) {
    std::vector<double> u = s.u;
    for (double& x : u) x *= scale;
    ASSERT_TRUE(p.internal_force(u, 0.0, s.f));
    ASSERT_TRUE(p.internal_force(u, 1e-6, s.f));
    p.elastic_energy(u);
  }
  p.stiffness(s.u);
  EXPECT_EQ(hash_of(model), before);
  EXPECT_EQ(model.ledger().balance(), books.balance());
}

// Static flow of a committed static state is nothing at all: the same tolerance decides yield and convergence.
TEST(PlateRelaxation_StaticCommit, EvaluatedAgain_DoesNotFlow) {
  PlateHex64 model(plate_case(4, true), 1);
  bend(model);
  RelaxationProblem& p = *model.relaxation();
  State s(p);
  p.commit(s.u, 0.0);
  const std::uint64_t before = hash_of(model);
  const double work = p.plastic_work();
  std::vector<double> again(s.f.size());
  ASSERT_TRUE(p.internal_force(s.u, 0.0, s.f));
  p.commit(s.u, 0.0);
  ASSERT_TRUE(p.internal_force(s.u, 0.0, again));
  EXPECT_EQ(p.plastic_work(), work) << "J";
  EXPECT_EQ(hash_of(model), before);
  EXPECT_EQ(again, s.f);
}

// K d = (f(u + t d) - f(u - t d)) / 2t where nothing yields. K comes from differences of steps of 1e-5 strain: 1e-6.
TEST(PlateRelaxation_Stiffness, AtADeformedState_IsTheSlopeOfTheForce) {
  PlateHex64 model(plate_case(4, true, 1e12), 1);
  testing::give_impulse(model, 130.0);
  for (int i = 0; i < 300; ++i) model.step(model.stable_step());
  RelaxationProblem& p = *model.relaxation();
  State s(p);
  Eigen::VectorXd d(p.dofs());
  for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = std::sin(0.37 * static_cast<double>(i));
  const double t = 1e-9;
  std::vector<double> plus = s.u, minus = s.u, fp(s.f), fm(s.f);
  for (std::size_t i = 0; i < plus.size(); ++i) {
    plus[i] += t * d[static_cast<Eigen::Index>(i)];
    minus[i] -= t * d[static_cast<Eigen::Index>(i)];
  }
  ASSERT_TRUE(p.internal_force(plus, 0.0, fp));
  ASSERT_TRUE(p.internal_force(minus, 0.0, fm));
  const Eigen::VectorXd expected = p.stiffness(s.u) * d;
  std::vector<double> error;
  for (std::size_t i = 0; i < fp.size(); ++i)
    error.push_back((fp[i] - fm[i]) / (2.0 * t) - expected[static_cast<Eigen::Index>(i)]);
  EXPECT_LT(largest(error), 1e-6 * expected.cwiseAbs().maxCoeff()) << "N/m";
}

TEST(PlateEffects_Off, EachAlone_TakesItsFieldFromTheHistory) {
  const auto bytes = [](const char* off) {
    CaseSpec spec = plate_case(2, true);
    for (EffectDecision& e : spec.effects) e.on = e.name != off;
    return PlateHex64(spec, 1).plate().forces().history_bytes() / (64 * 4 * sizeof(double));
  };
  EXPECT_EQ(bytes("none"), 10u);
  EXPECT_EQ(bytes("strain_rate"), 9u);
  EXPECT_EQ(bytes("heating"), 9u);
  EXPECT_EQ(bytes("hardening"), 10u) << "the flow stress still changes with temperature";
  EXPECT_EQ(bytes("expansion"), 10u);
}

}  // namespace
}  // namespace standoff::structure
