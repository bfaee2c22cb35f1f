// Law: averaged over where a hit lands, the masses of the surface nodes answer an impulse as the plate's own lumped
// masses do: mean of sum_a w_a^2 / m_a = mean of w.A w, A = N M^-1 N^T with M through the whole thickness
// (surface_inertia.hpp). Two Gauss points a direction integrate the products of bilinear weights exactly, so the
// tolerance is rounding.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "structure_solver/mesh/surface_inertia.hpp"
#include "structure_solver/mesh/surface_map.hpp"

namespace standoff::structure {
namespace {

constexpr double wave_speed = 5707.0;  // m/s
constexpr double long_time = 1.0;      // s

PlateMesh free_plate() {
  return make_plate_mesh({{0.406, 0.406, 0.0034}, {6, 4, 1}, false, "free", 8060.0});
}

std::vector<double> column_mass(const PlateMesh& mesh) {
  std::vector<double> column(mesh.node_count(), 0.0);
  for (int k = 0; k < mesh.nodes[2]; ++k)
    for (int j = 0; j < mesh.nodes[1]; ++j)
      for (int i = 0; i < mesh.nodes[0]; ++i)
        column[static_cast<std::size_t>(mesh.node(i, j, mesh.nodes[2] - 1))] +=
            mesh.mass[static_cast<std::size_t>(mesh.node(i, j, k))];
  return column;
}

/// w.A w for bilinear weights w on the corners of a quad: the squared nodal impulses over the column masses.
double true_inverse_mass(const PlateMesh& mesh, const SurfaceMap& map, const std::vector<double>& column,
                         const std::array<std::int32_t, 4>& quad, const std::array<double, 4>& w) {
  std::vector<Vec3> impulse(map.surface().position.size()), nodal(mesh.node_count());
  for (std::size_t a = 0; a < 4; ++a) impulse[static_cast<std::size_t>(quad[a])].z = w[a];
  map.to_nodes(impulse, nodal);
  double sum = 0.0;
  for (std::size_t i = 0; i < nodal.size(); ++i)
    if (nodal[i].z != 0.0) sum += nodal[i].z * nodal[i].z / column[i];
  return sum;
}

TEST(SurfaceInertia, FreePlateHitEverywhere_AnswersOnAverageAsItsOwnMasses) {
  const PlateMesh mesh = free_plate();
  const SurfaceMap map(mesh);
  const std::vector<double> mass = surface_inertia(mesh, wave_speed, long_time), column = column_mass(mesh);
  const double g = 1.0 / std::sqrt(3.0);
  double shown = 0.0, own = 0.0;
  for (const auto& quad : map.surface().quads)
    for (const double xi : {-g, g})
      for (const double eta : {-g, g}) {
        const std::array<double, 4> w = {0.25 * (1 - xi) * (1 - eta), 0.25 * (1 + xi) * (1 - eta),
                                         0.25 * (1 + xi) * (1 + eta), 0.25 * (1 - xi) * (1 + eta)};
        for (std::size_t a = 0; a < 4; ++a) shown += w[a] * w[a] / mass[static_cast<std::size_t>(quad[a])];
        own += true_inverse_mass(mesh, map, column, quad, w);
      }
  EXPECT_NEAR(shown / own, 1.0, 1e-12) << "shown " << shown << " 1/kg, own " << own << " 1/kg";
}

TEST(SurfaceInertia, AnswerShorterThanTheThicknessWave_IsLighterByTheirRatio) {
  const PlateMesh mesh = free_plate();
  const double there_and_back = 2.0 * 0.0034 / wave_speed;
  const std::vector<double> whole = surface_inertia(mesh, wave_speed, there_and_back);
  const std::vector<double> half = surface_inertia(mesh, wave_speed, 0.5 * there_and_back);
  for (std::size_t a = 0; a < whole.size(); ++a) EXPECT_NEAR(half[a] / whole[a], 0.5, 1e-12) << "node " << a;
}

TEST(SurfaceInertia, AnswerAtOnce_IsThatOfTheNodesOfTheLoadedFace) {
  for (const int layers : {1, 3}) {
    const PlateMesh mesh = make_plate_mesh({{0.406, 0.406, 0.0034}, {6, 4, layers}, false, "free", 8060.0});
    double face = 0.0, all = 0.0;
    for (std::size_t i = 0; i < mesh.node_count(); ++i) all += mesh.mass[i];
    for (int j = 0; j < mesh.nodes[1]; ++j)
      for (int i = 0; i < mesh.nodes[0]; ++i)
        face += mesh.mass[static_cast<std::size_t>(mesh.node(i, j, mesh.nodes[2] - 1))];
    const std::vector<double> whole = surface_inertia(mesh, wave_speed, long_time);
    const std::vector<double> at_once = surface_inertia(mesh, wave_speed, 1e-12);
    for (std::size_t a = 0; a < whole.size(); ++a)
      EXPECT_NEAR(at_once[a] / whole[a], face / all, 1e-12) << "node " << a;
  }
}

TEST(SurfaceInertia, ClampedEdge_HardlyMoves) {
  const PlateMesh mesh = make_plate_mesh({{0.406, 0.406, 0.0034}, {4, 4, 1}, true, "clamped", 8060.0});
  const std::vector<double> mass = surface_inertia(mesh, wave_speed, long_time);
  const double free_corner = mass.front(), clamped_corner = mass.back();  // centre of the plate, corner of the clamp
  EXPECT_GT(clamped_corner, 1e6 * free_corner);
}

}  // namespace
}  // namespace standoff::structure
