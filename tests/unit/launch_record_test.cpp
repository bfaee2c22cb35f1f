// run.json merged from two reports. Laws: a cross-process error is what is missing between two books that each close
// (coupling/launcher/run_record.hpp); numbers below are small integers, so sums are exact and tolerances are a few ulp.
#include <gtest/gtest.h>

#include "coupling/launcher/run_record.hpp"

namespace standoff::launch {
namespace {

using nlohmann::json;

CaseSpec quarter_case() {
  CaseSpec spec;
  spec.name = "scene", spec.level = "coarse", spec.run.seed = 7;
  spec.effects = {
      {"friction", true, "mu = 0.3", false}, {"damping", false, "xi = 0", false}, {"relaxation", true, "", false}};
  return spec;
}

std::map<std::string, json> two_reports() {
  return {
      {"particles",
       {{"results", {{"impulse_Ns", 250.0}}},
        {"conservation",
         {{"energy_error_particles", 0.002}, {"momentum_residual_Ns", {0.0, 0.0, 0.5}}, {"impulse_scale_Ns", 60.0}}},
        {"timing", {{"particle", {{"compute_s", 3.0}}}}},
        {"provenance", {{"state_hash", "aaaa"}}}}},
      {"structure",
       {{"results", {{"permanent_centre_deflection_m", 0.03}}},
        {"conservation", {{"momentum_residual_Ns", {0.0, 4.0, 0.0}}, {"impulse_scale_Ns", 40.0}}},
        {"provenance", {{"state_hash", "bbbb"}}}}}};
}

RunFacts finished(double given, double received) {
  RunFacts facts;
  facts.status = "done", facts.exit_code = 0, facts.wall_s = 12.0;
  facts.clock = ClockEvent{1e-6, 2000, "parallel"};
  facts.interface_ledger = InterfaceEvent{1e6, {0.0, 0.0, given}, {0.0, 0.0, received}, 50.0, 40.0};
  return facts;
}

TEST(RunRecord, TwoReports_AreOneRecord) {
  const OrderedJson record = run_record(quarter_case(), finished(-60.0, -60.0), two_reports());
  EXPECT_EQ(record["status"], "done");
  EXPECT_EQ(record["exit_code"], 0);
  EXPECT_EQ(record["seed"], 7);
  EXPECT_EQ(number_at(record, "results.impulse_Ns"), 250.0);
  EXPECT_EQ(number_at(record, "results.permanent_centre_deflection_m"), 0.03);
  EXPECT_EQ(number_at(record, "timing.particle.compute_s"), 3.0);
  EXPECT_EQ(number_at(record, "counts.windows"), 2000.0);
  EXPECT_EQ(number_at(record, "coupling.bytes"), 1e6);
}

TEST(RunRecord, ImpulseLostBetweenTheBooks_IsTheMomentumError) {
  const OrderedJson record = run_record(quarter_case(), finished(-60.0, -62.5), two_reports());
  // r_p + r_s + received - given = (0, 4, 0.5 - 2.5) = (0, 4, -2); scale 100.
  EXPECT_NEAR(*number_at(record, "conservation.momentum_error"), std::sqrt(20.0) / 100.0, 1e-15);
}

TEST(RunRecord, BooksThatCancel_LeaveNoError) {
  auto reports = two_reports();
  reports["structure"]["conservation"]["momentum_residual_Ns"] = {0.0, 0.0, -0.5};
  const OrderedJson record = run_record(quarter_case(), finished(-60.0, -60.0), reports);
  EXPECT_NEAR(*number_at(record, "conservation.momentum_error"), 0.0, 1e-15);
}

TEST(RunRecord, OneBookMissing_HasNoMomentumError) {
  auto reports = two_reports();
  reports.erase("structure");
  const OrderedJson record = run_record(quarter_case(), finished(-60.0, -60.0), reports);
  EXPECT_FALSE(number_at(record, "conservation.momentum_error").has_value());
}

TEST(RunRecord, WorkError_IsTheLargestOfRowsAndEnd) {
  RunFacts facts = finished(-60.0, -60.0);  // the end: 4 copies x (50 - 40) J of 4 x 40 J
  facts.largest_work_error = 8.0, facts.largest_external_work = 200.0;
  EXPECT_DOUBLE_EQ(*number_at(run_record(quarter_case(), facts, {}), "conservation.interface_work_error"),
                   40.0 / 200.0);
  facts.largest_work_error = 80.0;
  EXPECT_DOUBLE_EQ(*number_at(run_record(quarter_case(), facts, {}), "conservation.interface_work_error"),
                   80.0 / 200.0);
}

TEST(RunRecord, StateHash_ChangesWithEitherSideAndNeedsBoth) {
  auto reports = two_reports();
  const auto hash = [&] {
    return run_record(quarter_case(), finished(0, 0), reports)["provenance"].value("state_hash", "");
  };
  const std::string before = hash();
  EXPECT_EQ(before.size(), 16u);
  reports["structure"]["provenance"]["state_hash"] = "cccc";
  EXPECT_NE(hash(), before);
  reports["structure"]["provenance"].erase("state_hash");
  EXPECT_EQ(hash(), "");
}

TEST(RunRecord, KeysNobodyReported_AreListedAsAbsent) {
  const OrderedJson record = run_record(quarter_case(), finished(-60.0, -60.0), two_reports());
  const auto absent = record["absent"].get<std::vector<std::string>>();
  const auto listed = [&](const char* key) { return std::find(absent.begin(), absent.end(), key) != absent.end(); };
  EXPECT_TRUE(listed("results.impulse_air_Ns"));
  EXPECT_FALSE(listed("results.impulse_Ns"));
}

TEST(RunRecord, EffectThatIsOff_CostsNothing) {
  RunFacts facts = finished(-60.0, -60.0);
  facts.effect_bytes = {{"friction", 1000.0}, {"damping", 1000.0}};
  auto reports = two_reports();
  reports["particles"]["effects"]["friction"] = {{"bytes", 1234}, {"seconds", 2.5}};
  reports["structure"]["timing"]["structure"]["stages"] = {{"relax", 7.0}, {"polish", 0.5}, {"integrate", 3.0}};
  const OrderedJson effects = run_record(quarter_case(), facts, reports)["effects"];
  EXPECT_EQ(effects[0]["bytes"], 1234);
  EXPECT_EQ(effects[0]["seconds"], 2.5);
  EXPECT_TRUE(effects[2]["seconds"].is_number());
  EXPECT_EQ(effects[2]["seconds"], 7.5);  // its own stages, added
  EXPECT_EQ(effects[1]["bytes"], 0.0);
  EXPECT_EQ(effects[1]["seconds"], 0.0);
}

}  // namespace
}  // namespace standoff::launch
