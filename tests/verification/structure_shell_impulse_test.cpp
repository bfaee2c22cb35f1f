// The impulsively loaded shell plate: 130 N s with the shape cos^2(theta)/d^2.
//   symmetry   a quarter with mirror planes is the whole plate, to rounding grown over the steps; flow is contractive
//   threads    the same bits: every element writes its own forces, every node is summed in element order
//   unstable   10 % beyond the limit the energy balance opens, however plausible the deflection looks
//   stretch    metal that flows keeps its volume: where no stress is left, the thickness has lost what the plane gained
#include <gtest/gtest.h>

#include "tests/verification/structure_shell_case.hpp"

namespace standoff::structure {
namespace {

using testing::give_impulse;
using testing::shell_case;

void fly(PlateShell& model, double until, double step) {
  give_impulse(model, 130.0);
  while (model.time() < until) model.step(step);
}

TEST(ImpulsiveShell_Symmetry, QuarterAndWhole_AgreeInEveryFigure) {
  PlateShell quarter(shell_case(8, true), 1), whole(shell_case(8, false), 1);
  for (PlateShell* model : {&quarter, &whole}) fly(*model, 0.2e-3, 0.6e-6);
  const StructureLedger q = quarter.ledger(), w = whole.ledger();
  ASSERT_GT(q.plastic, 0.1 * q.kinetic) << "J";
  EXPECT_NEAR(quarter.centre_deflection() / whole.centre_deflection(), 1.0, 1e-9);
  EXPECT_NEAR(4.0 * q.plastic / w.plastic, 1.0, 1e-9);
  EXPECT_NEAR(4.0 * q.elastic / w.elastic, 1.0, 1e-9);
  EXPECT_NEAR(4.0 * q.kinetic / w.kinetic, 1.0, 1e-9);
  const auto pq = quarter.profile(), pw = whole.profile();
  ASSERT_EQ(pq.size(), pw.size());
  for (std::size_t i = 0; i < pq.size(); ++i) {
    EXPECT_NEAR(pq[i].x, pw[i].x, 1e-12) << "m";
    EXPECT_NEAR(pq[i].deflection, pw[i].deflection, 1e-9 * whole.centre_deflection()) << "m";
  }
}

TEST(ImpulsiveShell_Threads, OneAndTwo_GiveTheSameBits) {
  std::uint64_t hash[2];
  for (const int threads : {1, 2}) {
    PlateShell model(shell_case(24, true), threads);
    fly(model, 20e-6, model.stable_step());
    StateHash state;
    model.add_to(state);
    hash[threads - 1] = state.value();
  }
  EXPECT_EQ(hash[0], hash[1]);
}

TEST(ImpulsiveShell_UnstableStep, BeyondTheLimit_ShowsInTheEnergyBalance) {
  PlateShell model(shell_case(8, true), 1);
  const double limit = model.stable_step() / step_safety;
  give_impulse(model, 130.0);
  const double energy = model.ledger().kinetic, start = model.ledger().balance();
  double worst = 0.0;
  try {
    for (int i = 0; i < 1000; ++i) {
      model.step(1.1 * limit);
      worst = std::max(worst, std::fabs(model.ledger().balance() - start) / energy);
    }
  } catch (const std::runtime_error&) {
    worst = 1.0;  // torn apart: noticed as well
  }
  EXPECT_GT(worst, 0.01) << "of the initial energy";
}

// Elastic strains are below 2e-3; the plate has lost more than that of its thickness.
TEST(ImpulsiveShell_Thickness, StretchedMetal_KeepsItsVolume) {
  PlateShell model(shell_case(8, true), 1);
  fly(model, 0.4e-3, 0.6e-6);
  const StructureFrame frame = model.frame();
  double volume = 0.0, thinnest = 1.0;
  for (std::size_t e = 0; e < frame.cells.size(); ++e) {
    const auto at = [&](std::size_t a) { return frame.position[static_cast<std::size_t>(frame.cells[e][a])]; };
    const double thickness = frame.cell_data[3].second[e];
    volume += 0.5 * norm(cross(at(2) - at(0), at(3) - at(1))) * thickness;
    thinnest = std::min(thinnest, thickness);
  }
  ASSERT_EQ(frame.cell_data[3].first, "thickness_m");
  EXPECT_LT(thinnest, 0.99 * 0.0034) << "m";
  EXPECT_NEAR(volume / (0.203 * 0.203 * 0.0034), 1.0, 2e-3);
}

}  // namespace
}  // namespace standoff::structure
