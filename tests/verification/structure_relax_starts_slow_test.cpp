// Where a relaxation starts and how strongly it damps must not decide where it ends, once the metal has stopped
// flowing. A plate that was thrown with 130 Ns and brought to rest is made to swing (0.05 J in a quarter, about 0.1 mm)
// and relaxed again: at once at rest, in mid-swing, at its peak, with ten times and a tenth of the damping. Where
// plastic work gained is below 1e-6 of all, it must come back to the same deflection within 0.02 mm: ten times the
// drift per period that counts as rest. An elastic plate must return to zero, with the damping chosen for it: flat
// again it swings at 176 Hz, and ten times or a tenth of critical damping do not bring that to rest within the 30 ms
// there are.
#include <cstdio>
#include <span>

#include <gtest/gtest.h>

#include "structure_solver/relaxation/relaxation.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

struct Start {
  const char* name;
  double swing;  // share of a period of the softest mode between the push and the relaxation; negative: no push
  double damping_factor;
};
constexpr Start starts[] = {{"at rest", -1.0, 1.0},
                            {"pushed", 0.0, 1.0},
                            {"at its peak", 0.25, 1.0},
                            {"in mid-swing back", 0.5, 1.0},
                            {"pushed, damping x10", 0.0, 10.0},
                            {"pushed, damping x0.1", 0.0, 0.1}};

double relax(PlateHex64& model, double factor, double peak_kinetic, RelaxationResult* result = nullptr) {
  RelaxationOptions options;
  options.peak_kinetic_energy = peak_kinetic;
  options.damping_factor = factor;
  const RelaxationResult r = relax_to_rest(*model.relaxation(), options);
  if (result) *result = r;
  return model.centre_deflection();
}

/// Velocity in the shape of `shape`, with the kinetic energy `joule`.
void push(PlateHex64& model, const std::vector<double>& shape, double joule) {
  RelaxationProblem& problem = *model.relaxation();
  std::vector<double> u(shape.size()), v(shape.size());
  problem.get_state(u, v);
  double twice = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) twice += problem.mass()[i] * shape[i] * shape[i];
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = shape[i] * std::sqrt(2.0 * joule / twice);
  problem.set_state(u, v);
}

struct Ready {
  explicit Ready(const CaseSpec& spec, double impulse) : model(spec, 1) {
    testing::give_impulse(model, impulse);
    peak_kinetic = model.ledger().kinetic;
    while (model.time() < 0.6e-3) model.step(model.stable_step());
    RelaxationResult r;
    deflection = relax(model, 1.0, peak_kinetic, &r);
    EXPECT_TRUE(r.at_rest) << r.message;
    period = 1.0 / r.first_frequency;
  }
  PlateHex64 model;
  double peak_kinetic = 0.0, deflection = 0.0, period = 0.0;
};

/// The dome itself as the shape of a push: near the softest mode.
std::vector<double> dome(int elements) {
  PlateHex64 model(testing::plate_case(elements, true), 1);
  testing::give_impulse(model, 1.0);
  std::vector<double> u(static_cast<std::size_t>(model.relaxation()->dofs())), v(u);
  model.relaxation()->get_state(u, v);
  return v;
}

void expect_same_rest(const CaseSpec& spec, std::span<const Start> from, double impulse, double tolerance) {
  const std::vector<double> shape = dome(spec.plate.elements[0]);
  int asserted = 0;
  for (const Start& start : from) {
    Ready ready(spec, impulse);
    const double plastic = ready.model.ledger().plastic;
    if (start.swing >= 0.0) push(ready.model, shape, 0.05);
    const double until = ready.model.time() + std::max(0.0, start.swing) * ready.period;
    while (ready.model.time() < until) ready.model.step(ready.model.stable_step());
    RelaxationResult r;
    const double deflection = relax(ready.model, start.damping_factor, ready.peak_kinetic, &r);
    const double gained = plastic > 0.0 ? ready.model.ledger().plastic / plastic - 1.0 : 0.0;
    std::printf("  %-22s %.5f mm, plastic work gained %.1e of all, %s\n", start.name, 1e3 * deflection, gained,
                r.at_rest ? "at rest" : r.message.c_str());
    if (gained >= 1e-6) continue;
    ++asserted;
    EXPECT_NEAR(deflection, ready.deflection, tolerance) << "m, " << start.name;
  }
  EXPECT_GE(asserted, 4) << "most of these were meant not to flow";
}

TEST(RelaxationStarts_ThrownPlate, AnyStartAndDamping_EndsAtTheSameDeflection) {
  expect_same_rest(testing::plate_case(6, true), starts, 130.0, 2e-5);
}

TEST(RelaxationStarts_ElasticPlate, AnyStartAndDamping_ReturnsToZero) {
  CaseSpec spec = testing::plate_case(6, true);
  spec.plate.material.law = MaterialLaw::elastic;
  expect_same_rest(spec, std::span(starts).first(4), 20.0, 1e-8);
}

}  // namespace
}  // namespace standoff::structure
