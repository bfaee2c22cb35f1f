// A plate that is held still resolves the load alone (model rigid_plate): a run with the real programs ends well, tells
// the impulse and nothing of deflection or strain, where a zero would read as a result. The window is short, 0.1 ms:
// the first gas is at the plate after about 20 us (150 mm at some 8 km/s), so the impulse is positive.
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

class LauncherRigid : public LauncherStage {
 protected:
  LauncherRigid() { real_programs_ = true; }
};

TEST_F(LauncherRigid, RunOfARigidPlate_ReportsTheImpulseOnly) {
  start({"run", STANDOFF_SOURCE_DIR "/cases/borvik_2011/bare_150mm", "--level", "coarse", "--structure", "rigid_plate",
         "--set", "run.until=0.1 ms", "--set", "charge.particles=2000", "--out", "run", "--quiet"});
  ASSERT_EQ(finish(60.0), 0) << errors();
  const auto results = record()["results"];
  EXPECT_GT(results["impulse_Ns"].get<double>(), 1.0) << "N s";
  for (const auto& [key, value] : results.items())
    EXPECT_TRUE(key.find("impulse") != std::string::npos || key.find("momentum") != std::string::npos) << key;
}

}  // namespace
}  // namespace standoff::launch
