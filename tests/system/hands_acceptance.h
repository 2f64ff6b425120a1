// What every organ must grant: skill shows in the score.
#pragma once

#include <map>
#include <memory>

#include "tests/system/system_fixture.h"

namespace trocar::test {

class HandsTest : public SystemTest {
 protected:
  /// Expert, novice, clumsy and idle at once on one organ, the shipped exercise, seed 1.
  void expect_skill_to_show(const std::string& organ) const {
    std::map<std::string, std::unique_ptr<RunningProgram>> programs;
    for (const char* hand : {"expert", "novice", "clumsy", "idle"}) {
      programs[hand] = std::make_unique<RunningProgram>(
          launch({"run", "surface-touch", "--hand", hand, "--organ", organ, "--db", ":memory:", "--json"}));
    }
    std::map<std::string, double> score;
    for (auto& [hand, program] : programs) {
      const Outcome outcome = program->wait();
      EXPECT_EQ(outcome.exit_code, hand == "expert" ? 0 : 1) << hand << ": " << outcome.err;
      const Json json = Json::parse(outcome.out);
      score[hand] = json["score"].get<double>();
      EXPECT_EQ(json["passed"], hand == "expert") << hand << ' ' << score[hand];
      EXPECT_EQ(json["device"]["overruns"], 0) << hand;
      EXPECT_TRUE(json["device"]["fault"].is_null()) << hand;
    }
    EXPECT_GT(score["expert"], score["novice"]);
    EXPECT_GT(score["novice"], score["clumsy"]);
    EXPECT_EQ(score["idle"], 0);
    RecordProperty("scores", Json(score).dump());
  }
};

}  // namespace trocar::test
