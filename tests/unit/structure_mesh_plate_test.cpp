// The mesh of the plate: exact mass, fixed components, the loaded face and its adjoint pair.
// Tolerances are rounding: sums of N positive terms, N eps / 2 at worst and sqrt(N) eps in practice: 1e-13 for N < 1e5.
#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "coupling/base/counter_random.hpp"
#include "coupling/base/stop.hpp"
#include "structure_solver/mesh/surface_map.hpp"
#include "structure_solver/mesh/vtk_hexahedron.hpp"

namespace standoff::structure {
namespace {

PlateMesh mesh_of(std::array<int, 3> elements, bool quarter, const std::string& edges = "clamped") {
  return make_plate_mesh({{0.406, 0.3, 0.0034}, elements, quarter, edges, 8060.0});
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(PlateMesh_LumpedMass, AnyMesh_IsPositiveAndSumsToDensityTimesVolume) {
  for (const bool quarter : {false, true})
    for (const std::array<int, 3> elements : {std::array{2, 2, 1}, std::array{10, 6, 1}, std::array{8, 4, 3}}) {
      const PlateMesh mesh = mesh_of(elements, quarter);
      const double expected = 8060.0 * 0.406 * 0.3 * 0.0034 / (quarter ? 4.0 : 1.0);
      EXPECT_NEAR(sum(mesh.mass) / expected, 1.0, 1e-13) << "nodes " << mesh.node_count();
      EXPECT_GT(*std::min_element(mesh.mass.begin(), mesh.mass.end()), 0.0) << "kg";
    }
}

TEST(PlateMesh_Edges, QuarterClamped_HoldsRimAndMirrorPlanes) {
  const PlateMesh mesh = mesh_of({4, 4, 1}, true);
  for (std::size_t i = 0; i < mesh.node_count(); ++i) {
    const Vec3& x = mesh.position[i];
    const bool rim = x.x > 0.203 - 1e-9 || x.y > 0.15 - 1e-9;
    const int expected = rim ? fixed_all : (x.x == 0.0 ? fixed_x : 0) | (x.y == 0.0 ? fixed_y : 0);
    EXPECT_EQ(mesh.fixed[i], expected) << "at " << x.x << ", " << x.y << " m";
  }
  EXPECT_EQ(mesh.position.back().z, 0.0) << "the loaded face is z = 0";
}

TEST(PlateMesh_WrongOptions, AnyMistake_IsNamedWithARemedy) {
  const auto message = [](const PlateMeshOptions& o) -> std::string {
    try {
      make_plate_mesh(o);
    } catch (const Stop& stop) {
      EXPECT_EQ(stop.code(), ExitCode::bad_case);
      return stop.what();
    }
    return "nothing thrown";
  };
  const Vec3 size{0.4, 0.4, 0.003};
  EXPECT_NE(message({size, {5, 4, 1}, true, "clamped", 8000}).find("even number"), std::string::npos);
  EXPECT_NE(message({size, {4, 4, 1}, true, "glued", 8000}).find("clamped, pinned, free"), std::string::npos);
  EXPECT_NE(message({size, {4, 0, 1}, false, "clamped", 8000}).find("at least 1"), std::string::npos);
  EXPECT_NE(message({{0.4, 0.4, 0.0}, {4, 4, 1}, false, "clamped", 8000}).find("longer than zero"), std::string::npos);
}

TEST(PlateSurface_Quads, AtRest_FaceTheChargeAndCarryTheWholeMass) {
  const PlateMesh mesh = mesh_of({10, 6, 2}, true);
  const SurfaceMesh surface = plate_surface(mesh);
  EXPECT_EQ(surface.quads.size(), 9u * 5u * 3u);
  double area = 0.0;
  for (const auto& q : surface.quads) {
    const auto at = [&](int a) { return surface.position[static_cast<std::size_t>(q[static_cast<std::size_t>(a)])]; };
    const Vec3 normal = 0.5 * cross(at(2) - at(0), at(3) - at(1));
    EXPECT_GT(normal.z, 0.0);
    area += normal.z;
  }
  EXPECT_NEAR(area, 0.203 * 0.15, 1e-13 * area);
  EXPECT_NEAR(sum(surface.node_mass) / sum(mesh.mass), 1.0, 1e-13);
}

// x_s = N x and f = N^T f_s: same work, same force, and any field that is linear in x, y is reproduced (the shape is
// cubic).
TEST(SurfaceMap_AdjointPair, RandomForceAndMotion_WorkAndForceAgree) {
  const PlateMesh mesh = mesh_of({6, 4, 1}, false);
  const SurfaceMap map(mesh);
  const std::size_t ns = map.surface().position.size();
  CounterRandom random(7, RandomUse::test, 0);
  std::vector<Vec3> u(mesh.node_count()), fs(ns), xs(ns), f(mesh.node_count());
  for (Vec3& v : u) v = {random.normal(), random.normal(), random.normal()};
  for (Vec3& v : fs) v = {random.normal(), random.normal(), random.normal()};
  map.to_surface(u, xs);
  map.to_nodes(fs, f);
  double work_s = 0.0, work = 0.0, scale = 0.0;
  Vec3 total_s, total;
  for (std::size_t i = 0; i < ns; ++i)
    work_s += dot(fs[i], xs[i]), scale += std::fabs(dot(fs[i], xs[i])), total_s += fs[i];
  for (std::size_t i = 0; i < f.size(); ++i) work += dot(f[i], u[i]), total += f[i];
  EXPECT_NEAR(work, work_s, 1e-14 * scale) << "J";
  EXPECT_LT(norm(total - total_s), 1e-14 * static_cast<double>(ns)) << "N";
  map.to_surface(mesh.position, xs);
  for (std::size_t i = 0; i < ns; ++i) EXPECT_LT(norm(xs[i] - map.surface().position[i]), 1e-15) << "m, node " << i;
}

// A uniform pressure keeps its resultant and makes no moment about the centre.
TEST(SurfaceMap_UniformPressure, OverOneElement_KeepsResultantAndMoments) {
  const PlateMesh mesh = mesh_of({1, 1, 1}, false, "free");
  const SurfaceMap map(mesh);
  std::vector<Vec3> fs, f(mesh.node_count());
  for (const double m : map.surface().node_mass) fs.push_back({0.0, 0.0, m});
  map.to_nodes(fs, f);
  Vec3 force, moment;
  for (std::size_t i = 0; i < f.size(); ++i) force += f[i], moment += cross(mesh.position[i], f[i]);
  EXPECT_NEAR(force.z / sum(mesh.mass), 1.0, 1e-13);
  EXPECT_LT(norm(moment), 1e-13 * force.z) << "N m";
}

TEST(VtkHexahedron_Order, SixtyFourPoints_IsAPermutationWithVtkCornersFirst) {
  std::array<int, 64> sorted = vtk_order<4>;
  std::sort(sorted.begin(), sorted.end());
  for (int i = 0; i < 64; ++i) EXPECT_EQ(sorted[static_cast<std::size_t>(i)], i);
  // Corners of VTK_HEXAHEDRON, then the first upright edge between corners 0 and 4, 1 and 5, 2 and 6, 3 and 7
  // (file 2.2).
  const std::array<int, 8> corners = {0, 3, 15, 12, 48, 51, 63, 60};
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(vtk_order<4>[i], corners[i]);
  const std::array<int, 8> upright = {16, 32, 19, 35, 31, 47, 28, 44};
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(vtk_order<4>[24 + i], upright[i]);
}

}  // namespace
}  // namespace standoff::structure
