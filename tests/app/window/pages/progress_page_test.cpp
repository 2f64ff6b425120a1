// T6: curves of one's own, never mixed over inputs, chosen by pointer and keys.
#include "app/window/pages/progress_page.h"

#include "tests/app/window/pages/page_bench.h"

namespace trocar::progress_page_test {
namespace {

using testing_support::graded;
using testing_support::press;
using testing_support::shipped_exercise;

class ProgressPageTest : public testing_support::PageBench {
 protected:
  ProgressEntry entry(const std::string& hand, int count, int learned_after) {
    AttemptResult like = graded(touch_, "L1", {{"time_s", 60}});
    like.hand = hand;
    std::vector<PastAttempt> newest_first;
    for (int n = 0; n < count; ++n) {
      PastAttempt a = testing_support::past_run(like, n % 20, std::min(93.0, 48 + 2.1 * n + (n % 3) * 4),
                                                n >= learned_after && n % 11 != 7);
      a.summary.uuid = hand + std::to_string(n);
      if (n == 4) a.summary.score.reset();
      newest_first.insert(newest_first.begin(), a);
    }
    ProgressEntry out;
    out.curve = learning_curves(newest_first).front();
    out.name = "E02 Surface touch L1";
    out.input = hand;
    out.cusum = cusum(out.curve.passes());
    out.in_a_row = 2;
    return out;
  }
  void show(const std::vector<InputEvent>& events = {}) {
    frame([&](Ui& ui) { choice_ = page_.draw(ui, entries_, who_); }, events);
  }
  const Exercise touch_ = shipped_exercise("surface-touch");
  std::vector<ProgressEntry> entries_;
  ProgressPage page_;
  std::string who_ = "T-1";
  ProgressChoice choice_;
};

TEST_F(ProgressPageTest, ShowsCurvePassLineBandAndCusum) {
  entries_ = {entry("mouse", 40, 12), entry("device", 6, 3)};
  for (int i = 0; i < 3; ++i) show();
  picture("progress");
  for (const char* said : {"My progress", "E02 Surface touch L1, by mouse", "pass 75", "shown at 2.5"})
    EXPECT_TRUE(text(said)) << said;
  EXPECT_TRUE(says("your median"));
  EXPECT_TRUE(says("Last 10: median 93.0, middle half 93.0 to 93.0."));
  EXPECT_TRUE(scrolling_.empty());
  expect_clear("progress");
}

TEST_F(ProgressPageTest, ADecisionHasItsOwnMarkInTheLegendAndIsNamed) {
  entries_ = {entry("mouse", 12, 5)};
  PastAttempt& decided = entries_[0].curve.attempts[10];
  decided.summary.passed = false;
  decided.summary.passed_by_score = true;
  decided.summary.decided_by = "Dr Ines Okafor";
  show();
  EXPECT_TRUE(says("diamond: decided by a person"));
  for (int i = 0; i < 10 && page_.chosen_attempt() < 0; ++i) {
    show(press(kKeyTab));
    show(press(kKeyLeft));
  }
  ASSERT_EQ(page_.chosen_attempt(), 10);
  show();
  picture("progress-decided");
  EXPECT_TRUE(says("(not passed: Dr Ines Okafor decided)"));
  expect_clear("progress, decided");
}

TEST_F(ProgressPageTest, InputsAreCurvesOfTheirOwn) {
  entries_ = {entry("mouse", 12, 5), entry("device", 6, 3)};
  show();
  show();
  EXPECT_TRUE(text("mouse  12"));
  EXPECT_TRUE(text("device  6"));
  show(press(kKeyTab));
  show(press(kKeyTab));
  show(press(kKeyEnter));
  show();
  EXPECT_EQ(page_.chosen(), 1);
  EXPECT_TRUE(text("E02 Surface touch L1, by device"));
}

TEST_F(ProgressPageTest, AnAttemptIsChosenByKeysAndOpened) {
  entries_ = {entry("mouse", 12, 5)};
  show();
  show(press('O'));
  EXPECT_EQ(choice_.kind, ProgressChoice::Kind::kNone) << "none is chosen yet";
  for (int i = 0; i < 10 && page_.chosen_attempt() < 0; ++i) {
    show(press(kKeyTab));
    show(press(kKeyLeft));
  }
  ASSERT_EQ(page_.chosen_attempt(), 10) << "the last but one";
  show(press('O'));
  EXPECT_EQ(choice_.kind, ProgressChoice::Kind::kOpen);
  EXPECT_EQ(choice_.uuid, "mouse10");
}

TEST_F(ProgressPageTest, KeysExportAndLeave) {
  entries_ = {entry("mouse", 3, 5)};
  show();
  show(press('X'));
  EXPECT_EQ(choice_.kind, ProgressChoice::Kind::kExport);
  show(press(kKeyEnter));
  EXPECT_EQ(choice_.kind, ProgressChoice::Kind::kBack);
}

TEST_F(ProgressPageTest, NothingYetSaysSo) {
  show();
  show(press('X'));
  EXPECT_EQ(choice_.kind, ProgressChoice::Kind::kNone) << "nothing to export";
  EXPECT_TRUE(says("No attempt yet."));
  expect_clear("empty");
}

TEST_F(ProgressPageTest, NothingIsCutAndNothingCollidesAtAnyScale) {
  ProgressEntry older = entry("spacemouse", 1, 5);
  older.older_rubric = true;
  for (const double scale : {1.0, 1.5, 2.0}) {
    scale_ = scale;
    for (ProgressEntry shown : {entry("mouse", 40, 12), entry("device", 2, 0), older}) {
      entries_ = {shown, entry("device", 6, 3)};
      page_ = {};
      for (int i = 0; i < 3; ++i) show();
      expect_clear("progress at " + std::to_string(scale));
      picture("progress-" + std::to_string(static_cast<int>(100 * scale)) + "-" + shown.input);
    }
  }
}

TEST_F(ProgressPageTest, NothingIsCutInAnyLanguage) {
  who_ = "Krankenschwester-Muster-2026-014";  // as long as a code may be
  for (const char* language : {"fr", "de"}) {
    words_ = Translator(std::filesystem::path(TROCAR_SOURCE_DIR) / "assets" / "languages", language);
    for (const double scale : {1.0, 1.5, 2.0}) {
      scale_ = scale;
      height_ = scale > 1 ? 3000 : 720;  // so that nothing is below the edge, where it would not be looked at
      entries_ = {entry("mouse", 40, 12), entry("device", 6, 3)};
      page_ = {};
      for (int i = 0; i < 3; ++i) show();
      expect_clear(std::string(language) + " at " + std::to_string(scale));
      picture("progress-" + std::string(language) + "-" + std::to_string(static_cast<int>(100 * scale)));
    }
  }
}

TEST(CompetenceWords, SayWhatThePointsComeTo) {
  const Translator w;
  std::vector<bool> runs(13, true);
  EXPECT_EQ(competence_words(w, cusum(runs)),
            "Competence not shown yet: 2.4 of 2.5. The shortest way is 14 passes in a row.");
  runs.push_back(true);
  EXPECT_EQ(competence_words(w, cusum(runs)), "Competence was shown after 14 attempts; relapse alarm at 0.0 of 2.0.");
  runs.insert(runs.end(), {false, false, false});
  EXPECT_EQ(competence_words(w, cusum(runs)), "A relapse: competence is to be shown again, now 0.0 of 2.5.");
  runs.insert(runs.end(), 14, true);
  EXPECT_EQ(competence_words(w, cusum(runs)),
            "Competence was lost once and is shown again; relapse alarm at 0.0 of 2.0.");
}

}  // namespace
}  // namespace trocar::progress_page_test
