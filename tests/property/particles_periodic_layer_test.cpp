// Law: a box of sand as wide as a scene that repeats is a layer without sides: as dense at the faces as anywhere, and
// no grain reaches into another or into its image, 1e-4 of a diameter being what the packing leaves (sand_body.hpp). In
// slabs that hold the part p of the width, N p grains are expected; a random packing scatters less than points thrown
// at random, for which three standard deviations are 3 sqrt(N p (1 - p)).
// A layer that flies against a wall without rebound gives it its momentum, and nothing sideways: grains push each other
// to both sides alike, so the momentum across x and y stays zero to rounding, N eps = 1e-12 of the whole.
#include <gtest/gtest.h>

#include "coupling/case/soil_body.hpp"
#include "particle_solver/packing/sand_body.hpp"
#include "particle_solver/step/sand_integrate.hpp"
#include "particle_solver/step/surface_contact.hpp"
#include "particle_solver/step/wrap.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

constexpr double width = 0.1, height = 0.03;
const PeriodicSides sides = periodic_sides(true, {-0.5 * width, -0.5 * width, 0}, {0.5 * width, 0.5 * width, 1});

SandBody layer() {
  SoilSpec soil;
  soil.kind = SoilKind::dry, soil.shape = SoilShape::box, soil.size = {width, width, height};
  soil.centre = {0.0, 0.0, 0.5 * height + 0.002}, soil.particles = 3000;
  soil.packing = 0.60, soil.bulk_density = 1620.0, soil.stiffness = 0.4e9, soil.friction = 0.3;
  BodyOptions options;
  options.centre = soil.centre, options.sides = sides;
  return fill_body(soil, options);
}

TEST(PeriodicLayer, FilledFromFaceToFace_HasNoSides) {
  const SandBody body = layer();
  const SandState& sand = body.grains;
  ASSERT_EQ(sand.size(), 3000u);
  double worst = 0.0;
  long at_the_faces = 0;
  for (std::size_t i = 0; i < sand.size(); ++i) {
    const Vec3& x = sand.position[i];
    EXPECT_TRUE(std::abs(x.x) <= 0.5 * width && std::abs(x.y) <= 0.5 * width);
    at_the_faces += std::abs(x.x) > 0.45 * width;
    for (std::size_t j = 0; j < i; ++j)
      worst = std::max(worst, 2.0 * sand.radius - norm(nearest_image(x - sand.position[j], sides.period)));
  }
  EXPECT_LE(worst, 1.0001e-4 * 2.0 * sand.radius) << "overlap";
  EXPECT_NEAR(static_cast<double>(at_the_faces), 300.0, 3.0 * std::sqrt(3000 * 0.1 * 0.9)) << "a tenth of the width";
}

TEST(PeriodicLayer, ThrownAtAWall_GivesItItsMomentumAndNothingSideways) {
  SandBody body = layer();
  SandState& sand = body.grains;
  SurfaceSheet sheet(test::flat_mesh(4, 0.5 * width, 1.0), {.recedes = false});
  SandPairs pairs({body.law, {}, sides.period.length, 0.0, 1});
  SurfaceContact contact({false, {0.0, 0.0}, {}, 1});
  for (Vec3& v : sand.velocity) v = {0.0, 0.0, -20.0};
  const Vec3 before = momentum(sand);
  const double dt = recommended_step(body.law, sand.mass);
  pairs.forces(sand, 0.0);
  for (int step = 0; step < 1500; ++step) {
    half_kick(sand, dt, 1);
    contact.run(sand, sheet, dt);
    drift(sand, dt, 1);
    wrap(sides, nullptr, &sand);
    pairs.forces(sand, dt);
    half_kick(sand, dt, 1);
  }
  const double scale = norm(before);
  const Vec3 now = momentum(sand), wall = sheet.total_impulse();
  EXPECT_LT(std::hypot(now.x, now.y), 1e-12 * scale);
  EXPECT_LT(norm(now + wall - before), 1e-12 * scale);
  EXPECT_LT(wall.z, -0.2 * scale) << "the layer must have met the wall";
  EXPECT_GT(pairs.books().friction_loss, 0.0);
  for (const Vec3& x : sand.position) EXPECT_GT(x.z, 0.0) << "a grain has passed the rim of the wall";
}

}  // namespace
}  // namespace standoff::particles
