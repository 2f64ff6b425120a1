#include "trainees/markup/score_words.h"

#include <gtest/gtest.h>

namespace trocar::score_words_test {
namespace {

Subscore part(const std::string& name, std::optional<double> raw, const std::string& unit, double full, double zero) {
  Subscore out;
  out.name = name;
  out.raw = raw;
  out.unit = unit;
  out.full_at = full;
  out.zero_at = zero;
  return out;
}

TEST(ScoreWords, AGateSaysItsValueWithAUnitAndWhatItAsks) {
  EXPECT_EQ(gate_text(part("force in band", 0.48, "1", 1, 0), 0.5), "force in band 48 %, the gate asks 50 % or more");
  EXPECT_EQ(gate_text(part("force_in_band", 0.2547, "1", 1, 0.3), 0.5),
            "force in band 25.5 %, the gate asks 65 % or more");
  EXPECT_EQ(gate_text(part("excess force", 16, "1", 0, 6), 0.5), "excess force 16, the gate asks 3 or less");
  EXPECT_EQ(gate_text(part("place", 0.0075, "m", 0.002, 0.01), 0.5), "place 7.5 mm, the gate asks 6 mm or less");
  EXPECT_EQ(gate_text(part("grip", {}, "N", 1, 0), 0.5), "grip: nothing was done that it measures");
}

TEST(ScoreWords, ACountIsNoShare) {
  EXPECT_EQ(part_value_text(part("crushed", 1, "1", 0, 1), 1), "1") << "0 and 1 are counts where nothing is broken";
  EXPECT_EQ(part_value_text(part("done", 0.5, "1", 1, 0), 0.5), "50 %");
  EXPECT_EQ(part_value_text(part("ratio", 1.5, "1", 1, 2.2), 1.5), "1.5");
  EXPECT_EQ(anchors_text(part("time", 40, "s", 26.25, 112.5)), "full at 26.25 s, none at 112.5 s");
}

TEST(ScoreWords, OtherCapsAreSaidAsTheyAre) {
  Grade grade;
  grade.subscores = {part("in band", 0.48, "1", 1, 0)};
  EXPECT_EQ(cap_text(grade, {.kind = CapKind::kGate, .subject = "in band", .below = 0.5, .at_most = 59}),
            "safety gate: in band 48 %, the gate asks 50 % or more: at most 59");
  EXPECT_EQ(cap_text(grade, {.kind = CapKind::kGate, .subject = "gone", .below = 0.5, .at_most = 59}),
            "safety: gone below 0.5: at most 59");
  EXPECT_EQ(cap_text(grade, {.kind = CapKind::kCritical, .at_most = 49}), "critical event: at most 49");
}

}  // namespace
}  // namespace trocar::score_words_test
