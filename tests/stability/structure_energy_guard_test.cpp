// Plasticity hides an unstable step; the energy books do not. Beyond the stability limit the highest mode of a linear
// plate grows by acosh(2 * 1.02^2 - 1) = 0.4 per step at 2 % excess, from rounding to yield in about a hundred steps;
// then every step makes energy. The guard must see it within 1000 steps, and keep quiet below the limit. The limit is 2
// / omega_max of the assembled plate by power iteration with its own stiffness (from below: 1e-3 short at most).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "structure_solver/app/structure_books.hpp"
#include "tests/unit/structure_plate_case.hpp"
#include "tests/verification/structure_frequency.hpp"

namespace standoff::structure {
namespace {

double stability_limit(PlateHex64& model) {
  return testing::fastest_mode(model).stability_limit();
}

struct Watched {
  int steps = 0;  // when the guard fired; 1000 if it did not
  std::string said;
};

/// A thousand steps under a pressure pulse of 60 us; the books are looked at every ten steps, as after a window.
Watched watch(const CaseSpec& spec, double dt_over_limit) {
  PlateHex64 model(spec, 1);
  const double dt = dt_over_limit * stability_limit(model);
  StructureBooks books(spec);
  Watched result;
  try {
    for (; result.steps < 1000; result.steps += 10) {
      const double phase = model.time() / 60e-6,
                   pressure = phase < 1.0 ? 4e6 * std::pow(std::sin(M_PI * phase), 2) : 0.0;
      model.set_surface_force(testing::pressure_force(model.plate().mesh(), pressure));
      for (int i = 0; i < 10; ++i) model.step(dt);
      books.observe(model);
    }
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), ExitCode::guard);
    result.said = stop.what();
  }
  return result;
}

TEST(EnergyGuard_UnstableStep, TwoPercentBeyondTheLimit_IsFoundWithinAThousandSteps) {
  const Watched metal = watch(testing::plate_case(6, true), 1.02);
  EXPECT_LT(metal.steps, 1000);
  EXPECT_THAT(metal.said, ::testing::HasSubstr("came from nowhere at t = "));
  EXPECT_THAT(metal.said, ::testing::HasSubstr("surface node"));
  EXPECT_THAT(metal.said, ::testing::HasSubstr("coupling.window"));
  CaseSpec elastic = testing::plate_case(6, true);
  elastic.plate.material.law = MaterialLaw::elastic;
  EXPECT_LT(watch(elastic, 1.02).steps, 1000) << "without yield it grows without bound";
}

TEST(EnergyGuard_StableStep, AtNineTenthsAndJustBelowTheLimit_KeepsQuiet) {
  for (const double share : {0.9, 0.99}) {
    const Watched w = watch(testing::plate_case(6, true), share);
    EXPECT_EQ(w.said, "") << "at " << share << " of the limit";
  }
}

// The first look: nothing has happened, and nothing is wrong.
TEST(EnergyGuard_AtRest, BeforeAnyLoad_KeepsQuiet) {
  const CaseSpec spec = testing::plate_case(2, true);
  PlateHex64 model(spec, 1);
  StructureBooks books(spec);
  EXPECT_NO_THROW(books.observe(model));
}

// What the guard prevents. Nobody looks at the books: after 400 steps 2 % beyond the limit the plate has a deflection
// that anyone would believe, within half of that of the stable run, and energy from nowhere.
TEST(EnergyGuard_Absent, TwoPercentBeyondTheLimit_DeflectionIsPlausibleAndEnergyIsNot) {
  const auto run = [](double dt_over_limit) {
    PlateHex64 model(testing::plate_case(6, true), 1);
    const double limit = stability_limit(model);
    const auto pulse = [&] {
      const double phase = model.time() / 60e-6;
      return phase < 1.0 ? 4e6 * std::pow(std::sin(M_PI * phase), 2) : 0.0;
    };
    while (model.time() < 400 * limit) {
      model.set_surface_force(testing::pressure_force(model.plate().mesh(), pulse()));
      model.step(dt_over_limit * limit);
    }
    const StructureLedger books = model.ledger();
    return std::pair{model.centre_deflection(), std::abs(books.balance()) / books.external_work};
  };
  const auto [stable, small] = run(0.9);
  const auto [unstable, large] = run(1.02);
  EXPECT_LT(small, 0.005);
  EXPECT_GT(large, 0.05) << "energy from nowhere over work";
  EXPECT_NEAR(unstable, stable, 0.5 * stable) << "m";
}

}  // namespace
}  // namespace standoff::structure
