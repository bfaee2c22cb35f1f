// Slow uniaxial compression of the unit cell [Borvik 2011, sec. 3.3, figs. 11 and 13]; means of five cells, stress
// against engineering strain, residual stress subtracted.
//
// Bounds. The moduli aimed at are 1.7 GPa dry and 10.7 GPa wet [Borvik 2011, sec. 3.3], "reasonably" met: a factor 1.3
// dry over the range where the packing has locked (6 to 13 %), which is 1.0 (its beginning) to 2.2; wet 9 to 15.
// All contacts moving with the mean strain (affine, Walton, J. Mech. Phys. Solids 35, 213 (1987)) give
// K = phi Z k/(6 pi R), an upper estimate for the present contacts Z: 2 % above it for stress over the present volume
// and the scatter of 15000 contacts. Real packings are softer, by up to a third where friction holds the grains
// in place; without friction they yield by rearranging, and half of the affine figure is asked for.
// Without friction an assembly bears hardly more shear than its jamming margin: lateral/axial near 1, below it as axial
// strain is what drives. With mu = 0.3 it lies between the elastic cone nu/(1 - nu) = 0.2 (nu = 1/6) and Jaky's
// 1 - sin(atan 0.3 * 2) = 0.49; five cells leave 0.25 to 0.45.
#include <gtest/gtest.h>

#include "particle_solver/packing/cell_study.hpp"

namespace standoff::particles {
namespace {

SoilSpec soil(SoilKind kind) {
  SoilSpec s;
  const bool wet = kind == SoilKind::wet;
  s.kind = kind, s.packing = wet ? 0.64 : 0.60, s.stiffness = wet ? 4e9 : 0.4e9;
  s.friction = wet ? 0.0 : 0.3, s.damping = wet ? 0.01 : 0.0, s.radius_spread = wet ? 0.025 : 0.0;
  return s;
}

/// The mean of five cells, as `standoff cell` gives it.
CellStudy five_cells(const SoilSpec& s, double strain, long points) {
  CellSpec cell;
  cell.strain = strain, cell.points = points;
  return study_cells(s, cell, 1, 1);
}

double modulus(const CompressionPoint& p) {
  return p.pressure() / p.strain;
}

TEST(CellCompression, DrySand_HasTheStiffnessAndTheLateralPressureOfTheCell) {
  const SoilSpec s = soil(SoilKind::dry);
  const CellStudy study = five_cells(s, 0.13, 13);
  for (std::size_t n = 1; n < study.mean.size(); ++n) {
    const CompressionPoint& p = study.mean[n];
    if (p.strain > 0.0599) {
      EXPECT_GT(modulus(p), 1.0e9) << "Pa at strain " << p.strain;
      EXPECT_LT(modulus(p), 2.2e9) << "Pa at strain " << p.strain;
      EXPECT_GT(p.lateral / p.axial, 0.25) << "at strain " << p.strain;
      EXPECT_LT(p.lateral / p.axial, 0.45) << "at strain " << p.strain;
    }
    EXPECT_LT(modulus(p), 1.02 * affine_bulk_modulus(study, s.stiffness, p.coordination)) << "Pa at " << p.strain;
    EXPECT_GT(modulus(p), 0.67 * affine_bulk_modulus(study, s.stiffness, p.coordination)) << "Pa at " << p.strain;
    if (n > 1) {
      EXPECT_GT(modulus(p), modulus(study.mean[n - 1])) << "stiffens as contacts form";
    }
  }
  for (const CellSample& sample : study.samples) EXPECT_LT(sample.residual_axial, 1e6) << "Pa, a loose cell";
}

TEST(CellCompression, WetSand_HasTheStiffnessOfTheCellAndLittleShear) {
  const SoilSpec s = soil(SoilKind::wet);
  const CellStudy study = five_cells(s, 0.09, 6);
  for (std::size_t n = 1; n < study.mean.size(); ++n) {
    const CompressionPoint& p = study.mean[n];
    EXPECT_GT(modulus(p), 9e9) << "Pa at strain " << p.strain;
    EXPECT_LT(modulus(p), 15e9) << "Pa at strain " << p.strain;
    EXPECT_GT(p.lateral / p.axial, 0.80) << "at strain " << p.strain;
    EXPECT_LE(p.lateral / p.axial, 1.0) << "at strain " << p.strain;
    EXPECT_LT(modulus(p), 1.02 * affine_bulk_modulus(study, s.stiffness, p.coordination)) << "Pa at " << p.strain;
    EXPECT_GT(modulus(p), 0.5 * affine_bulk_modulus(study, s.stiffness, p.coordination)) << "Pa at " << p.strain;
  }
}

TEST(CellCompression, HalfTheSpeed_GivesTheSameCurve) {
  // Quasi-static: pressure may not depend on the rate beyond what rearrangements scatter, 2 % of 3000 contact forces,
  // twice.
  const PackedCell& cell = pack_cell({1000, 0.60, 0.0, 1});
  const auto slow = compress_cell(cell, {0.4e9, 0.3, 0.0}, {0.06, 3, 20000, 0.1, 1});
  const auto fast = compress_cell(cell, {0.4e9, 0.3, 0.0}, {0.06, 3, 10000, 0.1, 1});
  for (std::size_t n = 1; n < slow.size(); ++n) EXPECT_NEAR(fast[n].axial / slow[n].axial, 1.0, 0.04);
}

}  // namespace
}  // namespace standoff::particles
