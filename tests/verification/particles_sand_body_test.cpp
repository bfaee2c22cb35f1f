// A shell of sand about a charge: count and mass as asked for, no grain in another or in its own mirror image, the same
// density everywhere. Count and mass are exact by construction (rounding of a sum of N numbers: N eps = 3e-12).
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "coupling/case/soil_body.hpp"
#include "particle_solver/packing/sand_body.hpp"
#include "particle_solver/step/sand_integrate.hpp"

namespace standoff::particles {
namespace {

constexpr double volume = 4.18879020478639 * (0.0762 * 0.0762 * 0.0762 - 0.03 * 0.03 * 0.03);
constexpr Vec3 centre{0, 0, 0.15};

SoilSpec soil(SoilKind kind, long particles) {
  SoilSpec s;
  const bool wet = kind == SoilKind::wet;
  s.kind = kind, s.inner_radius = 0.03, s.outer_radius = 0.0762, s.particles = particles;
  s.packing = wet ? 0.64 : 0.60, s.bulk_density = wet ? 2020.0 : 1620.0, s.stiffness = wet ? 4e9 : 0.4e9;
  s.friction = wet ? 0.0 : 0.3, s.damping = wet ? 0.01 : 0.0, s.radius_spread = wet ? 0.025 : 0.0;
  return s;
}

double mass(const SandState& sand) {
  double sum = 0.0;
  for (std::size_t i = 0; i < sand.size(); ++i) sum += sand.mass_of(i);
  return sum;
}

class Shell : public testing::TestWithParam<std::tuple<SoilKind, bool>> {};

TEST_P(Shell, FilledWithAFewThousandGrains_HasTheMassTheCountAndNoOverlap) {
  const auto [kind, quarter] = GetParam();
  const SoilSpec s = soil(kind, 8000);
  const SandBody body = fill_body(s, {centre, quarter, 1});
  const SandState& sand = body.grains;
  const double full = quarter ? 4.0 : 1.0;
  EXPECT_EQ(sand.size(), quarter ? 2000u : 8000u);
  EXPECT_NEAR(full * mass(sand) / (s.bulk_density * volume), 1.0, 1e-11);
  EXPECT_NEAR(body.law.stiffness, s.stiffness * body.cell_size, 1e-6);
  EXPECT_NEAR(body.cell_size, std::cbrt(volume * 1000 / 8000), 1e-9);
  EXPECT_LE(body.residual_overlap, 1e-4);
  EXPECT_EQ(momentum(sand), Vec3{});

  double worst = 0.0, nearest_plane = 1.0;
  for (std::size_t i = 0; i < sand.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      worst = std::max(worst, sand.radius_of(i) + sand.radius_of(j) - norm(sand.position[i] - sand.position[j]));
    const Vec3& p = sand.position[i];
    nearest_plane =
        std::min({nearest_plane, (p.x - sand.radius_of(i)) / sand.radius, (p.y - sand.radius_of(i)) / sand.radius});
    const double r = norm(p - centre);
    EXPECT_GT(r, s.inner_radius - 0.36 * sand.radius);
    EXPECT_LT(r, s.outer_radius + 0.36 * sand.radius);
  }
  EXPECT_LE(worst / (2.0 * sand.radius), 1.0001e-4) << "overlap in diameters";
  if (quarter) {
    EXPECT_GE(nearest_plane, -2e-4) << "a grain reaches into its own image, in radii";
  }
}

INSTANTIATE_TEST_SUITE_P(DryAndWet, Shell,
                         testing::Combine(testing::Values(SoilKind::dry, SoilKind::wet), testing::Bool()));

TEST(SandShell, InThreeLayersAndTwoHalves_IsEvenlyDense) {
  // N = 40000 grains, a third of the volume each: a cut through a packing has errors on its surface only: a layer with
  // about 2 A/(d^2) = 2e4 surface grains is uncertain by sqrt(2e4) = 140 of 13333, 1.1 %; four of these.
  const SoilSpec s = soil(SoilKind::dry, 40000);
  const SandBody body = fill_body(s, {centre, false, 4});
  int layers[3] = {0, 0, 0}, above = 0;
  for (const Vec3& p : body.grains.position) {
    const double r = norm(p - centre);
    const double share = (r * r * r - std::pow(0.03, 3)) / (std::pow(0.0762, 3) - std::pow(0.03, 3));
    ++layers[std::clamp(static_cast<int>(3.0 * share), 0, 2)];
    above += p.z > centre.z;
  }
  for (const int layer : layers) EXPECT_NEAR(layer / 40000.0, 1.0 / 3.0, 4 * 0.011 / 3.0);
  EXPECT_NEAR(above / 40000.0, 0.5, 4 * 0.011 / 3.0);
}

TEST(SandShell, OtherSeed_GivesAnotherBody) {
  const SoilSpec s = soil(SoilKind::dry, 2000);
  const SandBody one = fill_body(s, {centre, false, 1}), two = fill_body(s, {centre, false, 2});
  const SandBody again = fill_body(s, {centre, false, 1});
  EXPECT_NE(one.grains.position, two.grains.position);
  EXPECT_EQ(one.grains.position, again.grains.position);
}

TEST(SandShell, AtRest_StaysAtRest) {
  // What overlap is left (1e-4 d) may push a grain to v = overlap sqrt(k/m); ten contacts in line at most.
  SandBody body = fill_body(soil(SoilKind::dry, 4000), {centre, true, 1});
  SandPairs pairs({body.law, {true}, {}, 0.0, 1});
  pairs.forces(body.grains, 0.0);
  for (int n = 0; n < 100; ++n) sand_step(body.grains, pairs, pairs.stable_step());
  const double speed = 1e-4 * 2.0 * body.grains.radius * std::sqrt(body.law.stiffness / body.grains.mass);
  for (const Vec3& v : body.grains.velocity) EXPECT_LT(norm(v), 10.0 * speed);
}

TEST(SandBody, SphereCylinderAndBoxWithACavity_HaveTheMassTheCountAndLieWhereStated) {
  for (const SoilShape shape : {SoilShape::sphere, SoilShape::cylinder, SoilShape::box})
    for (const bool quarter : {true, false}) {
      SoilSpec s = soil(SoilKind::dry, 8000);
      s.shape = shape, s.outer_radius = 0.08, s.height = 0.09, s.size = {0.2, 0.1, 0.09}, s.centre = {0, 0, 0.16};
      const SoilBody where(s, centre);
      const SandBody body = fill_body(s, {centre, quarter, 1});
      EXPECT_EQ(body.grains.size(), quarter ? 2000u : 8000u);
      EXPECT_NEAR((quarter ? 4.0 : 1.0) * mass(body.grains) / (s.bulk_density * where.volume()), 1.0, 1e-11);
      EXPECT_LE(body.residual_overlap, 1e-4) << "shape " << int(shape);
      int shifted = 0;
      for (const Vec3& p : body.grains.position) {
        EXPECT_LE(where.beyond(p), 0.36 * body.grains.radius);
        shifted += p.z > 0.16;
      }
      // Halves above and below the centre differ by the cavity, 6 % of the volume at most, and by the cut: see above.
      EXPECT_NEAR(shifted / double(body.grains.size()), 0.5, 0.06);
    }
}

TEST(SandShell, NotOnTheMirrorPlanes_IsRefusedWithTheRemedy) {
  try {
    fill_body(soil(SoilKind::dry, 4000), {{0.01, 0, 0.15}, true, 1});
    FAIL() << "accepted";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), ExitCode::bad_case);
    EXPECT_NE(std::string(stop.what()).find("run.symmetry"), std::string::npos);
  }
}

}  // namespace
}  // namespace standoff::particles
