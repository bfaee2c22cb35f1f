// The unit cell [Borvik 2011, sec. 3.3]: the fill asked for, no overlap where the packing is loose, no preferred
// direction. Statistical tolerances are four standard errors of the quantity for independent grains; grains that
// exclude each other fluctuate less, so they are generous but fail for a lattice or a gradient.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "particle_solver/packing/packed_cell.hpp"

namespace standoff::particles {
namespace {

double nearest(double d) {
  return d - std::nearbyint(d);
}

/// Largest overlap of any pair, all with all, in mean diameters; `contacts` counts pairs nearer than 1 + `reach`.
double overlap_by_brute_force(const PackedCell& cell, double reach, double& contacts) {
  double worst = 0.0;
  contacts = 0.0;
  for (std::size_t i = 0; i < cell.position.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 d = cell.position[i] - cell.position[j];
      const double distance = norm({nearest(d.x), nearest(d.y), nearest(d.z)});
      const double touching = cell.radius.empty() ? 2.0 * cell.mean_radius : cell.radius[i] + cell.radius[j];
      worst = std::max(worst, (touching - distance) / (2.0 * cell.mean_radius));
      contacts += distance < touching * (1.0 + reach);
    }
  return worst;
}

double fill(const PackedCell& cell) {
  double volume = 0.0;
  for (std::size_t i = 0; i < cell.position.size(); ++i)
    volume += 4.0 / 3.0 * std::numbers::pi * std::pow(cell.radius.empty() ? cell.mean_radius : cell.radius[i], 3.0);
  return volume;
}

TEST(PackedCell, SixtyPercent_IsFullAndFreeOfOverlap) {
  for (const std::uint64_t seed : {1u, 2u}) {
    const PackedCell& cell = pack_cell({1000, 0.60, 0.0, seed});
    double contacts = 0.0;
    EXPECT_NEAR(fill(cell), 0.60, 1e-12);
    EXPECT_LE(overlap_by_brute_force(cell, 0.01, contacts), 1.0001e-6) << "mean diameters";
    EXPECT_LE(cell.max_overlap, 1e-6);
    // A lattice at this fill has no neighbours within 1 %, a random packing near jamming 3.5 to 6 of them.
    EXPECT_GT(2.0 * contacts / 1000, 3.0);
    EXPECT_LT(2.0 * contacts / 1000, 6.5);
  }
}

TEST(PackedCell, SixtyFourPercentWithSpread_ReportsTheOverlapThatStays) {
  // At random close packing: isostatic (6 contacts a grain) or a little more, residual overlap below 1 % of a diameter,
  // and a pressure of at most phi Z overlap/(pi d^2) * k = 0.64 * 6.5 * 0.003 / (pi 0.107) k0 = 0.037 k0 for a mean
  // overlap of 0.3 %.
  const PackedCell& cell = pack_cell({1000, 0.64, 0.025, 1});
  double contacts = 0.0;
  const double overlap = overlap_by_brute_force(cell, 0.0, contacts);
  EXPECT_NEAR(fill(cell), 0.64, 1e-12);
  EXPECT_NEAR(cell.max_overlap, overlap, 1e-9);
  EXPECT_LT(overlap, 0.01);
  EXPECT_NEAR(cell.coordination, 2.0 * contacts / 1000, 1e-12);
  EXPECT_GT(cell.coordination, 5.5);
  EXPECT_LT(cell.coordination, 7.0);
  EXPECT_GT(cell.residual_pressure, 0.0);
  EXPECT_LT(cell.residual_pressure, 0.037);
  for (const double r : cell.radius) EXPECT_NEAR(r / cell.mean_radius, 1.0, 0.026);
}

TEST(PackedCell, Centres_FillTheCellWithoutBias) {
  // Centre of mass on the periodic circle: |mean of exp(2 pi i x)| of independent points is about 1/sqrt(N) = 0.032.
  const PackedCell& cell = pack_cell({1000, 0.60, 0.0, 1});
  const auto tilt = [&](auto component) {
    double c = 0.0, s = 0.0;
    for (const Vec3& p : cell.position) {
      EXPECT_GE(component(p), 0.0);
      EXPECT_LT(component(p), 1.0);
      c += std::cos(2.0 * std::numbers::pi * component(p)), s += std::sin(2.0 * std::numbers::pi * component(p));
    }
    return std::hypot(c, s) / 1000;
  };
  EXPECT_LT(tilt([](const Vec3& p) { return p.x; }), 4 * 0.032);
  EXPECT_LT(tilt([](const Vec3& p) { return p.y; }), 4 * 0.032);
  EXPECT_LT(tilt([](const Vec3& p) { return p.z; }), 4 * 0.032);
}

TEST(PackedCell, Seeds_GiveDifferentCellsAndTheSameSeedTheSame) {
  const PackedCell& one = pack_cell({200, 0.55, 0.0, 1});
  const PackedCell& two = pack_cell({200, 0.55, 0.0, 2});
  EXPECT_NE(one.position, two.position);
  EXPECT_EQ(&one, &pack_cell({200, 0.55, 0.0, 1}));
}

}  // namespace
}  // namespace standoff::particles
