// Edges "symmetry" are mirror planes: a plate with such edges moves like its part of the plate twice as long under the
// mirrored load, here uneven hits hard enough that the metal flows. Each element has the same arithmetic in both
// plates; on the mirror the image doubles load, force and mass. What is left is rounding, 1e-16 a step: 1e-12 of the
// way asked.
#include <gtest/gtest.h>

#include "coupling/base/counter_random.hpp"
#include "structure_solver/models/structural_model.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure::testing {
namespace {

CaseSpec mirrored_plate(const std::string& model, int lengths) {
  CaseSpec spec = plate_case(4, true);
  spec.plate.model = model, spec.plate.edges = "symmetry";
  spec.plate.size = {0.08 * lengths, 0.08, 0.0034};
  spec.plate.elements = {4 * lengths, 4, 1};
  return spec;
}

/// Nodes of the surface along x.
std::size_t row_of(const StructuralModel& model) {
  std::size_t count = 0;
  for (const Vec3& x : model.surface().position) count += x.y == 0.0;
  return count;
}

/// The load on the plate that goes on: that of `once`, and its image beyond the mirror at the last node of a row.
std::vector<Vec3> continued(const std::vector<Vec3>& once, std::size_t row) {
  std::vector<Vec3> twice;
  for (std::size_t first = 0; first < once.size(); first += row)
    for (std::size_t i = 0; i < 2 * row - 1; ++i) {
      Vec3 f = once[first + std::min(i, 2 * (row - 1) - i)];
      if (i + 1 == row) f = {0.0, 2.0 * f.y, 2.0 * f.z};
      if (i + 1 > row) f.x = -f.x;
      twice.push_back(f);
    }
  return twice;
}

class PlateEdges_Symmetry : public ::testing::TestWithParam<const char*> {};

TEST_P(PlateEdges_Symmetry, PlateAndItsContinuation_MoveAlike) {
  const auto plate = make_structural_model(mirrored_plate(GetParam(), 1), 1);
  const auto longer = make_structural_model(mirrored_plate(GetParam(), 2), 1);
  const std::size_t row = row_of(*plate);
  ASSERT_EQ(row_of(*longer), 2 * row - 1);
  CounterRandom random(7, RandomUse::test, 1);
  double next = 0.0;
  while (plate->time() < 30e-6) {
    if (plate->time() >= next) {
      next += 5e-6;
      std::vector<Vec3> force(plate->surface().position.size());
      for (Vec3& f : force) f = {2e3 * random.normal(), 2e3 * random.normal(), -2e4 * random.uniform()};
      plate->set_surface_force(force), longer->set_surface_force(continued(force, row));
    }
    const double dt = plate->stable_step();
    plate->step(dt), longer->step(dt);
  }
  SurfaceMotion a, b;
  plate->surface_motion(a), longer->surface_motion(b);
  double way = 0.0, apart = 0.0, slid = 0.0;
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    way = std::max(way, norm(a.position[i] - plate->surface().position[i]));
    apart = std::max(apart, norm(a.position[i] - b.position[i / row * (2 * row - 1) + i % row]));
    if ((i + 1) % row == 0) slid = std::max(slid, std::fabs(a.position[i].z));
  }
  EXPECT_GT(plate->extremes().max_plastic_strain, 1e-3) << "the load was meant to make the metal flow";
  EXPECT_LT(apart, 1e-12 * way) << "m";
  EXPECT_GT(slid, 0.1 * way) << "m: the edge is not held across the plate";
}

INSTANTIATE_TEST_SUITE_P(Models, PlateEdges_Symmetry,
                         ::testing::Values("plate_hex64", "plate_hex27", "plate_hex8", "plate_shell"),
                         [](const auto& model) { return std::string(model.param); });

}  // namespace
}  // namespace standoff::structure::testing
