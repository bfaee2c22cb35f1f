// What stops a run, and what a user reads then; the choice of a model by name; the smallest model.
#include <functional>
#include <numeric>

#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using testing::plate_case;

struct Stopped {
  ExitCode code = ExitCode::done;
  std::string text;
  bool says(const std::string& word) const { return text.find(word) != std::string::npos; }
};

Stopped stopped(const std::function<void()>& action) {
  try {
    action();
  } catch (const Stop& stop) {
    return {stop.code(), stop.what()};
  }
  return {};
}

TEST(PlateGuard_Inversion, UnderAnAbsurdForce_NamesElementTimePlaceAndRemedy) {
  PlateHex64 model(plate_case(4, true), 1);
  std::vector<Vec3> force(model.surface().position.size());
  force[0].z = -1e8;
  model.set_surface_force(force);
  const Stopped s = stopped([&] {
    for (int i = 0; i < 100; ++i) model.step(model.stable_step());
  });
  EXPECT_EQ(s.code, ExitCode::guard);
  for (const char* word : {"element 0", "t = ", "mm", "plate.elements"})
    EXPECT_TRUE(s.says(word)) << word << " in: " << s.text;
}

// What is shown after an inversion is the shape before it: every cell still has a positive thickness, finite values.
TEST(PlateGuard_Inversion, FrameAfterwards_IsTheLastSoundShape) {
  PlateHex64 model(plate_case(4, true), 1);
  std::vector<Vec3> force(model.surface().position.size());
  force[0].z = -1e8;
  model.set_surface_force(force);
  double before = 0.0, dt = 0.0;
  const Stopped s = stopped([&] {
    for (int i = 0; i < 100; ++i) before = model.time(), dt = model.stable_step(), model.step(dt);
  });
  ASSERT_EQ(s.code, ExitCode::guard);
  EXPECT_NEAR(model.time(), before, 1e-9 * dt) << "s";
  std::vector<double> u(static_cast<std::size_t>(model.relaxation()->dofs())), v(u), f(u);
  model.relaxation()->get_state(u, v);
  EXPECT_TRUE(model.relaxation()->internal_force(u, 0.0, f)) << "no element of the shape shown is inside out";
  for (const auto& [name, values] : model.frame().cell_data)
    for (const double value : values) EXPECT_TRUE(std::isfinite(value)) << name;
}

TEST(PlateGuard_NotANumber, InTheLoad_IsStoppedAtOnce) {
  PlateHex64 model(plate_case(4, true), 1);
  std::vector<Vec3> force(model.surface().position.size());
  force[40].x = std::nan("");
  model.set_surface_force(force);
  const Stopped s = stopped([&] {
    for (int i = 0; i < 3; ++i) model.step(model.stable_step());
  });
  EXPECT_EQ(s.code, ExitCode::guard) << s.text;
}

// Relaxation asks where an element would invert: that is an answer, not an end.
TEST(PlateGuard_TrialState, TurnedInsideOut_IsRefusedWithoutStopping) {
  PlateHex64 model(plate_case(2, true), 1);
  RelaxationProblem& p = *model.relaxation();
  std::vector<double> u(static_cast<std::size_t>(p.dofs()), 0.0), f(u);
  u[u.size() / 2] = 0.5;
  EXPECT_FALSE(p.internal_force(u, 0.0, f));
  u.assign(u.size(), 0.0);
  EXPECT_TRUE(p.internal_force(u, 0.0, f));
}

TEST(PlateGuard_WrongLoadSize, FromThePeer_NamesBothSizes) {
  PlateHex64 model(plate_case(2, true), 1);
  const Stopped s = stopped([&] { model.set_surface_force(std::vector<Vec3>(3)); });
  EXPECT_TRUE(s.says("3 forces") && s.says("16 nodes")) << s.text;
}

TEST(StructuralModels_Names, UnknownName_ListsTheKnownOnes) {
  CaseSpec spec = plate_case(2, true);
  spec.plate.model = "plate_hex46";
  const Stopped s = stopped([&] { make_structural_model(spec, 1); });
  EXPECT_EQ(s.code, ExitCode::bad_case);
  EXPECT_TRUE(s.says("plate_hex64") && s.says("rigid_plate")) << s.text;
}

TEST(StructuralModels_RigidPlate, UnderLoad_PassesTheImpulseToItsSupports) {
  CaseSpec spec = plate_case(4, true);
  spec.plate.model = "rigid_plate";
  const auto rigid = make_structural_model(spec, 1);
  const auto shape = make_structural_model(plate_case(4, true), 1);
  EXPECT_EQ(rigid->surface().position, shape->surface().position);
  EXPECT_EQ(rigid->surface().quads, shape->surface().quads);
  std::vector<Vec3> force(rigid->surface().position.size());
  force[5] = {1.0, 2.0, -3.0};
  rigid->set_surface_force(force);
  for (int i = 0; i < 4; ++i) rigid->step(0.25);
  EXPECT_LT(norm(rigid->ledger().impulse_received - Vec3{1.0, 2.0, -3.0}), 1e-15);
  EXPECT_EQ(rigid->ledger().impulse_received, -rigid->ledger().impulse_of_supports);
  EXPECT_EQ(rigid->relaxation(), nullptr);
}

// Frame: evenly spaced points of true cubic cells; at rest thickness is the plate's and nothing is stressed.
TEST(PlateFrame_AtRest, CubicCells_HaveEvenPointsAndThePlateThickness) {
  const auto model = make_structural_model(plate_case(4, true), 1);
  const StructureFrame frame = model->frame();
  EXPECT_EQ(frame.vtk_cell_type, 72);
  ASSERT_EQ(frame.cells.size(), 4u);
  const auto& cell = frame.cells[0];
  ASSERT_EQ(cell.size(), 64u);
  const Vec3 a = frame.position[static_cast<std::size_t>(cell[0])],
             b = frame.position[static_cast<std::size_t>(cell[1])];
  const Vec3 third = frame.position[static_cast<std::size_t>(cell[8])];
  EXPECT_NEAR(third.x, a.x + (b.x - a.x) / 3.0, 1e-15) << "m: a point of the first edge sits at one third";
  for (const auto& [name, values] : frame.cell_data)
    for (const double v : values) {
      const double expected = name == "thickness_m" ? 0.0034 : name == "temperature_K" ? 296.0 : 0.0;
      EXPECT_NEAR(v, expected, 1e-12 * expected) << name;
    }
}

}  // namespace
}  // namespace standoff::structure
