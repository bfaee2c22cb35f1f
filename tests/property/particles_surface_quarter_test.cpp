// Law: in a scene that is its own mirror image in x = 0 and y = 0, a quarter model and the full one do the same. A node
// on a mirror plane has the half mass in the quarter and gets half of the hits, and cannot leave its plane. Tolerance:
// hits in another order round differently; a few hundred roundings.
#include <gtest/gtest.h>

#include "particle_solver/state/surface_sheet.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

using namespace test;

constexpr double node_mass = 1e-3;

/// A bowl with a sharp cone at its centre.
Vec3 bowl(double x, double y) {
  return {x, y, 0.3 * std::hypot(x, y)};
}

/// Nodal masses of a quarter: what lies on x > 0, y > 0.
SurfaceMesh quarter_mesh(int n) {
  SurfaceMesh mesh = sheet_mesh(n, 0.0, 0.2, node_mass, bowl);
  for (std::size_t i = 0; i < mesh.position.size(); ++i)
    mesh.node_mass[i] *= (mesh.position[i].x == 0.0 ? 0.5 : 1.0) * (mesh.position[i].y == 0.0 ? 0.5 : 1.0);
  return mesh;
}

TEST(QuarterSheet_UnderMirroredHits, AnswersLikeTheFullOne) {
  SurfaceMesh full_mesh = sheet_mesh(16, -0.2, 0.2, node_mass, bowl);
  SurfaceSheet full(full_mesh, {false, 0.3}), quarter(quarter_mesh(8), {true, 0.3});
  CounterRandom random(7, RandomUse::test, 1);
  for (int i = 0; i < 200; ++i) {
    const double reach = 0.05;
    const Vec3 p{between(random, 0.001, 0.25), between(random, 0.001, 0.25), 0.1}, v{0, 0, -100};
    const SheetPoint where = quarter.closest(p, reach);
    std::array<SheetPoint, 4> images;
    for (int k = 0; k < 4; ++k) {
      images[static_cast<std::size_t>(k)] = full.closest({k & 1 ? -p.x : p.x, k & 2 ? -p.y : p.y, p.z}, reach);
      EXPECT_NEAR(images[static_cast<std::size_t>(k)].gap, where.gap, 1e-13);
    }
    if (where.face < 0) continue;
    // Light hits, so that the four of the full model, one after the other, are the one of the quarter.
    Vec3 velocity = v;
    const Impact one = quarter.collide(where, 1e-13, 1.0, 0.0, 0.0, velocity);
    for (const SheetPoint& image : images) {
      Vec3 mirrored = v;
      const Impact hit = full.collide(image, 1e-13, 1.0, 0.0, 0.0, mirrored);
      EXPECT_NEAR(hit.impulse.z, one.impulse.z, 1e-7 * std::abs(one.impulse.z));  // light, but not without mass
      EXPECT_NEAR(mirrored.z, velocity.z, 1e-5);
    }
  }
  for (std::size_t n = 0; n < quarter.plate_nodes(); ++n) {
    const Vec3 x = quarter.mesh().position[n], u = quarter.node_velocity()[n];
    const auto column = static_cast<std::size_t>(std::lround((x.x + 0.2) / 0.025));
    const Vec3 same = full.node_velocity()[17 * static_cast<std::size_t>(std::lround((x.y + 0.2) / 0.025)) + column];
    EXPECT_LT(norm(same - u), 1e-7 * (norm(u) + 1e-9)) << "m/s at " << x.x << ' ' << x.y;
  }
  EXPECT_NEAR(full.total_impulse().z, 4.0 * quarter.total_impulse().z, 1e-7 * std::abs(full.total_impulse().z));
  EXPECT_NEAR(full.surround_impulse().z, 4.0 * quarter.surround_impulse().z,
              1e-9 * std::abs(full.surround_impulse().z));
}

TEST(QuarterSheet_AtAMirrorEdge, CountsAsSmooth) {
  const SurfaceSheet quarter(quarter_mesh(8), {true, 0.0});
  const SheetPoint above = quarter.closest({0.0, 0.1, 0.08}, 0.1), under = quarter.closest({1e-3, 1e-3, -1e-3}, 0.1);
  EXPECT_GT(above.gap, 0.0);
  EXPECT_LT(under.gap, 0.0) << "below a mirror edge is behind the sheet, not beside it";
  EXPECT_GE(under.face, 0);
}

}  // namespace
}  // namespace standoff::particles
