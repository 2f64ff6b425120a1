// What the result says of stiffness, from rows made by hand; and as JSON.
#include "app/session/grading/stiffness_report.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/cli/attempts/attempt_json.h"
#include "app/cli/attempts/run_command.h"
#include "tests/support/sample_attempt.h"

namespace trocar::stiffness_report_test {
namespace {

RecordedTick row(double asked, double k_max) {
  TraceSample sample;
  sample.stiffness_n_per_m = asked;
  sample.k_max_n_per_m = k_max;
  return quantise(1, {}, sample, LoopState::kActive, 0);
}

TEST(StiffnessReport, CountsTheTicksThatFeltASpring) {
  const std::vector<RecordedTick> rows{row(0, 0), row(100, 50), row(100, 200), row(200, 50), row(0, 0), row(100, 100)};
  const StiffnessReport r = stiffness_report(rows, true);
  EXPECT_TRUE(r.recorded);
  EXPECT_TRUE(r.clamped);
  EXPECT_EQ(r.contact_ticks, 4u);
  EXPECT_DOUBLE_EQ(r.k_max_min_n_per_m, 50);
  EXPECT_DOUBLE_EQ(r.k_max_max_n_per_m, 200);
  EXPECT_DOUBLE_EQ(r.asked_max_n_per_m, 200);
  EXPECT_DOUBLE_EQ(r.share_min, 0.25);
  EXPECT_DOUBLE_EQ(r.above_share, 0.5) << "what asks for exactly K_max does not ask for more";
}

TEST(StiffnessReport, OlderRowsSayNothing) {
  const std::vector<RecordedTick> rows(10);
  EXPECT_FALSE(stiffness_report(rows, false).recorded);
  EXPECT_FALSE(stiffness_report({}, false).recorded);
}

TEST(StiffnessReport, FreeAirIsRecordedAndEmpty) {
  const std::vector<RecordedTick> rows{row(0, 0), row(0, 0)};
  const StiffnessReport r = stiffness_report(rows, false);
  EXPECT_TRUE(r.recorded);
  EXPECT_EQ(r.contact_ticks, 0u);
  EXPECT_DOUBLE_EQ(r.share_min, 1);
}

TEST(StiffnessReport, StandsInTheResult) {
  AttemptResult result = testing_support::sample_attempt();
  auto device = nlohmann::json::parse(attempt_json(result)).at("device");
  EXPECT_TRUE(device.at("stiffness_clamp").is_null()) << "not known";
  EXPECT_TRUE(device.at("k_max_min_n_per_m").is_null());

  result.device.stiffness = stiffness_report(std::vector<RecordedTick>{row(100, 50), row(20, 80)}, true);
  device = nlohmann::json::parse(attempt_json(result)).at("device");
  EXPECT_EQ(device.at("stiffness_clamp"), true);
  EXPECT_EQ(device.at("stiffness_contact_ticks"), 2);
  EXPECT_EQ(device.at("k_max_min_n_per_m"), 50.0);
  EXPECT_EQ(device.at("k_max_max_n_per_m"), 80.0);
  EXPECT_EQ(device.at("stiffness_asked_max_n_per_m"), 100.0);
  EXPECT_EQ(device.at("stiffness_share_min"), 0.5);
  EXPECT_EQ(device.at("above_k_max_share"), 0.5);

  result.device.stiffness = stiffness_report(std::vector<RecordedTick>{row(0, 0)}, false);
  device = nlohmann::json::parse(attempt_json(result)).at("device");
  EXPECT_EQ(device.at("stiffness_clamp"), false);
  EXPECT_TRUE(device.at("stiffness_share_min").is_null()) << "nothing was touched: no number";
}

TEST(StiffnessReport, IsALineForPeople) {
  AttemptResult result = testing_support::sample_attempt();
  std::ostringstream older, touched, free_air;
  print_result(result, older);
  EXPECT_EQ(older.str().find("K_max"), std::string::npos) << "an older recording says nothing";
  result.device.stiffness = stiffness_report(std::vector<RecordedTick>{row(100, 50), row(20, 80)}, true);
  print_result(result, touched);
  EXPECT_NE(
      touched.str().find(
          "up to 100 N/m asked of the device, K_max 50 to 80 N/m, above it for 50 % of the contact time, clamp on"),
      std::string::npos)
      << touched.str();
  result.device.stiffness = stiffness_report(std::vector<RecordedTick>{row(0, 0)}, true);
  print_result(result, free_air);
  EXPECT_EQ(free_air.str().find("K_max"), std::string::npos);
}

}  // namespace
}  // namespace trocar::stiffness_report_test
