// The solid plates beside plate_hex64. First frequency of the clamped plate against Kirchhoff's 175.84 Hz
// (structure_plate_frequency_test.cpp), at 10 x 10 and 20 x 20 elements of the case:
//   plate_hex27   +2.5 %, +0.71 %: from above, three times the error of cubic elements
//   plate_hex8    -0.01 % (30 x 30 bricks), 60 x 60 in the same tenth of a per cent: bending is cured, so that what is
//                 left is the coarse shape of the mode, of either sign
// Same bits for one and two threads: by construction. An element that turns inside out ends the run.
#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "tests/verification/structure_frequency.hpp"
#include "tests/verification/structure_solid_case.hpp"

namespace standoff::structure {
namespace {

using testing::first_frequency;
using testing::solid_plate;

struct Solid {
  const char* name;
  double at_ten, at_twenty;  // largest error of the first frequency
  int cell_type, cell_nodes;
};

class SolidPlate : public ::testing::TestWithParam<Solid> {};

TEST_P(SolidPlate, ClampedFirstFrequency_ConvergesToKirchhoff) {
  const double coarse = first_frequency(*solid_plate(GetParam().name, 10, true)) / 175.84 - 1.0;
  const double fine = first_frequency(*solid_plate(GetParam().name, 20, true)) / 175.84 - 1.0;
  EXPECT_LT(std::fabs(coarse), GetParam().at_ten) << coarse;
  EXPECT_LT(std::fabs(fine), GetParam().at_twenty) << fine;
}

TEST_P(SolidPlate, OneAndTwoThreads_GiveTheSameBits) {
  std::uint64_t hash[2];
  for (const int threads : {1, 2}) {
    const auto model = solid_plate(GetParam().name, 12, false, threads);
    testing::give_impulse(*model, 130.0);
    while (model->time() < 60e-6) model->step(model->stable_step());
    EXPECT_EQ(model->plate().threads(), threads);
    EXPECT_GT(model->extremes().max_plastic_strain, 0.0) << "the load was meant to make it flow";
    StateHash state;
    model->add_to(state);
    hash[threads - 1] = state.value();
  }
  EXPECT_EQ(hash[0], hash[1]);
}

TEST_P(SolidPlate, InvertedElement_EndsTheRunAndTheFrameIsSound) {
  const auto model = solid_plate(GetParam().name, 4, true);
  std::vector<Vec3> force(model->surface().position.size());
  force[0].z = -1e8;
  model->set_surface_force(force);
  try {
    for (int i = 0; i < 200; ++i) model->step(model->stable_step());
    FAIL() << "an absurd force was carried";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), ExitCode::guard);
    EXPECT_NE(std::string(stop.what()).find("element 0"), std::string::npos) << stop.what();
  }
  const StructureFrame frame = model->frame();
  EXPECT_EQ(frame.vtk_cell_type, GetParam().cell_type);
  EXPECT_EQ(frame.cells.front().size(), static_cast<std::size_t>(GetParam().cell_nodes));
  for (const auto& [name, values] : frame.cell_data)
    for (const double value : values) EXPECT_TRUE(std::isfinite(value)) << name;
}

INSTANTIATE_TEST_SUITE_P(Models, SolidPlate,
                         ::testing::Values(Solid{"plate_hex27", 0.03, 0.01, 72, 27},
                                           Solid{"plate_hex8", 0.003, 0.003, 12, 8}),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace standoff::structure
