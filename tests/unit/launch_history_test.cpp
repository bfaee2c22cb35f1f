// histories.csv from two halves that arrive in any order. Exact text comparisons: the numbers are short decimals.
#include <gtest/gtest.h>

#include "coupling/launcher/history_table.hpp"

namespace standoff::launch {
namespace {

SampleEvent particles(double time, double impulse, double work) {
  return {"particles", time, {{"time_s", time}, {"impulse_Ns", impulse}, {"work_to_structure_J", work}}};
}
SampleEvent structure(double time, double deflection, double work) {
  return {"structure", time, {{"centre_deflection_m", deflection}, {"external_work_J", work}}};
}

TEST(HistoryTable, HalvesOfOneTime_AreOneRowInContractOrder) {
  HistoryTable table(5e-6, 2);
  EXPECT_EQ(table.add(structure(0.0, 0.25, 8.0)), "");
  EXPECT_EQ(table.add(particles(0.0, 2.0, 10.0)),
            "time_s,impulse_Ns,centre_deflection_m,external_work_J,interface_work_error_J,work_to_structure_J\n"
            "0,2,0.25,8,2,10\n");
  EXPECT_DOUBLE_EQ(table.largest_work_error(), 2.0);
  EXPECT_DOUBLE_EQ(table.largest_external_work(), 8.0);
}

TEST(HistoryTable, AbsentMedium_HasNoColumn) {
  HistoryTable table(5e-6, 2);
  table.add(structure(0.0, 0.0, 0.0));
  EXPECT_EQ(table.add(particles(0.0, 0.0, 0.0)).find("sand"), std::string::npos);
}

TEST(HistoryTable, TimesARoundingErrorApart_MeetInOneRow) {
  HistoryTable table(5e-6, 2);
  table.add(particles(5e-6 * (1.0 + 1e-12), 1.0, 0.0));
  EXPECT_FALSE(table.add(structure(5e-6, 0.0, 0.0)).empty());
  EXPECT_EQ(table.rows(), 1);
}

TEST(HistoryTable, OneSideAhead_RowsStayInOrderOfTime) {
  HistoryTable table(1.0, 2);
  for (const double t : {0.0, 1.0, 2.0}) EXPECT_EQ(table.add(particles(t, t, 0.0)), "");
  std::string text;
  for (const double t : {0.0, 1.0, 2.0}) text += table.add(structure(t, t, 0.0));
  EXPECT_LT(text.find("\n0,"), text.find("\n1,"));
  EXPECT_LT(text.find("\n1,"), text.find("\n2,"));
}

TEST(HistoryTable, BrokenOffRun_KeepsTheHalfRowWithEmptyFields) {
  HistoryTable table(1.0, 2);
  table.add(structure(0.0, 0.0, 0.0));
  table.add(particles(0.0, 0.0, 0.0));
  table.add(particles(1.0, 3.0, 4.0));
  EXPECT_EQ(table.finish(), "1,3,,,,4\n");
}

TEST(HistoryTable, ValueThatIsNotANumber_IsAnEmptyField) {
  HistoryTable table(1.0, 1);
  EXPECT_EQ(table.add({"particles", 0.0, {{"impulse_Ns", std::nan("")}}}), "time_s,impulse_Ns\n0,\n");
}

}  // namespace
}  // namespace standoff::launch
