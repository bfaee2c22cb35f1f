// What the progress line says, and the pace it promises: remaining windows over the windows of the last seconds.
#include <cmath>

#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/command_line.hpp"
#include "coupling/launcher/progress_view.hpp"
#include "coupling/launcher/text_format.hpp"

namespace standoff::launch {
namespace {

TEST(ProgressLine, LoadingPhase_NamesStepAndWhatLimitsIt) {
  RunProgress p;
  p.take(ClockEvent{2e-3 / 6000, 6000, "parallel"});
  p.take(ProgressEvent{"particles",
                       {{"time_s", 0.412e-3},
                        {"window", 1234},
                        {"step_s", 38e-9},
                        {"impulse_Ns", 201.34},
                        {"energy_error", 2e-4},
                        {"limited_by:gas_collide", 1.0}}});
  p.eta_s = 41.0;
  EXPECT_EQ(progress_line(p),
            "t 0.412/2.000 ms  21 %  window 1,234/6,000  dt 38 ns (limited by gas_collide)  impulse 201.3 N s  "
            "energy error 0.02 %  ETA 00:00:41");
}

TEST(ProgressLine, Relaxation_HasItsOwnLine) {
  RunProgress p;
  p.take(ClockEvent{1e-6, 10, "parallel"});
  p.take(ProgressEvent{"structure",
                       {{"relax_time_s", 3.2e-3}, {"kinetic_ratio", 1.2e-5}, {"centre_deflection_m", 0.03371}}});
  EXPECT_EQ(progress_line(p), "coming to rest  t +3.20 ms  kinetic energy 1.2e-05 of its peak  centre 33.71 mm");
}

TEST(ProgressLine, BeforeTheFirstWindow_SaysSo) {
  EXPECT_EQ(progress_line(RunProgress{}), "starting");
  EXPECT_EQ(when_text(RunProgress{}), "before the first window");
}

TEST(PaceMeter, PaceThatChanged_ForgetsTheSlowStart) {
  PaceMeter pace;
  EXPECT_TRUE(std::isnan(pace.remaining(100)));
  for (int i = 0; i <= 20; ++i) pace.add(i, i);                   // 1 window a second
  for (int i = 1; i <= 20; ++i) pace.add(20.0 + i, 20 + 10 * i);  // then 10 a second
  EXPECT_NEAR(pace.remaining(420), 20.0, 1e-9);                   // 200 windows at 10 a second
}

TEST(TextFormat, Numbers_AreReadable) {
  EXPECT_EQ(with_separators(1234567), "1,234,567");
  EXPECT_EQ(with_separators(-999), "-999");
  EXPECT_EQ(duration_text(38e-9), "38 ns");
  EXPECT_EQ(duration_text(0.412e-3), "412 us");
  EXPECT_EQ(clock_text(3661.0), "01:01:01");
  EXPECT_EQ(clock_text(std::nan("")), "--:--:--");
  EXPECT_EQ(value_text("permanent_centre_deflection_m", 0.0337), "33.70 mm");
  EXPECT_EQ(value_text("impulse_Ns", 289.14), "289.1 N s");
  EXPECT_EQ(value_text("max_strain_rate_per_s", 1500.0), "1500.0 1/s");
  EXPECT_EQ(label_of("results.permanent_centre_deflection_m"), "permanent centre deflection");
}

TEST(WallSeconds, UnitsPeopleUse_AreRead) {
  EXPECT_EQ(wall_seconds("90"), 90.0);
  EXPECT_EQ(wall_seconds("1.5 min"), 90.0);
  EXPECT_EQ(wall_seconds("2h"), 7200.0);
  for (const char* wrong : {"", "soon", "-3", "0", "5 ms", "1 h 30"}) EXPECT_THROW(wall_seconds(wrong), Stop) << wrong;
}

}  // namespace
}  // namespace standoff::launch
