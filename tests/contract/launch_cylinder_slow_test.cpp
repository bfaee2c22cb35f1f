// The cylinder test as a user runs it, small and for 20 us of its 50: the front has passed the station 50 mm from the
// lit end (at 6 us) and not the one at 250 mm (at 31 us, and the wall's own waves are slower, 4.6 km/s). So the far
// wall is at rest, bit for bit, and the near one moves outwards, slower than if it and the gas had all the energy,
// shared as Gurney does: sqrt(2 E0 / rho0 / (M/C + 1/2)) = 1.90 km/s. The books close as in any run.
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

class LauncherCylinder : public LauncherStage {
 protected:
  LauncherCylinder() { real_programs_ = true; }
};

TEST_F(LauncherCylinder, SmallRun_DrivesTheWallWhereTheFrontHasPassed) {
  start({"run", STANDOFF_SOURCE_DIR "/cases/borvik_2011/cylinder_test", "--level", "small", "--set", "run.until=20 us",
         "--out", "run", "--quiet"});
  ASSERT_EQ(finish(300.0), 0) << errors();
  std::istringstream table(read_file(root_ / "run" / "wall_velocity.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(table, line));
  EXPECT_EQ(line, "time_s,place_m,displacement_m,velocity_m_per_s");
  double near = 0.0, far = 0.0, last = 0.0;
  while (std::getline(table, line)) {
    std::istringstream cells(line);
    std::array<double, 4> row{};
    for (double& value : row) {
      std::string cell;
      std::getline(cells, cell, ',');
      value = std::stod(cell);
    }
    last = row[0];
    if (std::abs(row[1] - 0.25) < 1e-9) near = row[3];
    if (std::abs(row[1] - 0.05) < 1e-9) far = std::max(far, std::abs(row[3]));
  }
  EXPECT_GT(last, 19e-6) << "s";
  EXPECT_GT(near, 500.0) << "m/s";
  EXPECT_LT(near, 1900.0) << "m/s";
  EXPECT_LT(far, 20.0) << "m/s";
  const auto books = record()["conservation"];
  EXPECT_LT(books["energy_error_particles"].get<double>(), 1e-3);
  EXPECT_LT(books["energy_error_structure"].get<double>(), 0.02);
  EXPECT_LT(books["momentum_error"].get<double>(), 1e-9);
  EXPECT_LT(books["interface_work_error"].get<double>(), 0.25) << "where a run would be stopped at its end";
}

}  // namespace
}  // namespace standoff::launch
