// Judgements table by table: for each flag what raises it, what just does not, and the numbers in its evidence.
#include "trainees/progress/judgement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "trainees/progress/calendar.h"

namespace trocar::judgement_test {
namespace {

constexpr const char* kNow = "2026-06-01T12:00:00Z";

/// P pass, f fail, a left, C failed with a critical event, G failed gate, c left after a critical event, v void, d
/// doubtful pass.
CurveAttempt attempt(char kind, std::size_t k) {
  CurveAttempt a;
  a.started_s = *seconds_of_utc("2026-01-01T00:00:00Z") + static_cast<std::int64_t>(k) * 3600;
  a.passed = kind == 'P' || kind == 'd';
  if (kind != 'a' && kind != 'c' && kind != 'v') a.score = a.passed ? 85 : 60;
  a.critical_events = kind == 'C' || kind == 'c' ? 1 : 0;
  a.failed_gates = kind == 'G' ? 2 : 0;
  a.broken = kind == 'v';
  a.doubtful = kind == 'd';
  return a;
}

std::vector<CurveAttempt> attempts(const std::string& kinds) {
  std::vector<CurveAttempt> out;
  for (const char kind : kinds) out.push_back(attempt(kind, out.size()));
  return out;
}

/// By the shipped rules but for the plateau, which has a table of its own: the scores here are all alike.
std::vector<Judgement> judged(const std::string& kinds, std::optional<double> reliable = 0.9,
                              const std::string& certified = "") {
  ProgressRules rules;
  rules.plateau_window = 1000;
  return judge(attempts(kinds), rules, reliable, certified, kNow);
}

std::string flags(const std::vector<Judgement>& judgements) {
  std::string out;
  for (const Judgement& j : judgements) out += (out.empty() ? "" : ",") + std::string(flag_name(j.flag));
  return out;
}

const std::string kShown(14, 'P');  // competence is shown

TEST(Judgements, TableByTable) {
  struct Row {
    std::string kinds, flags;
    const char* why;
  };
  for (const Row& row : {
           Row{"", "learning", "nothing yet"},
           {"f", "learning", "one attempt"},
           {"ffff", "learning", "four without a pass"},
           {"fffff", "stuck", "five without a pass"},
           {"faafa", "stuck", "left ones are attempts too"},
           {"ffvff", "learning", "void ones are none"},
           {"Pfffff", "stuck", "since the last pass"},
           {"fffffP", "learning", "a pass ends it"},
           {"fPfCPfG", "unsafe", "one critical event and one gate among five"},
           {"fPfCPfPfPfG", "learning", "too far apart"},
           {"CCPfPfPf", "learning", "too long ago"},
           {"PcPfG", "unsafe", "leaving after a critical event hides nothing"},
           {"PaPaCPaPG", "unsafe", "left ones without one are not looked at"},
           {"vPvP", "integrity", "two void"},
           {"vPdP", "integrity", "one void, one doubtful"},
           {"vPfP", "learning", "one void"},
           {"vvPPPPPfPPPP", "learning", "too long ago"},
           {kShown, "ready", "competence shown"},
           {std::string(13, 'P'), "learning", "one short"},
           {kShown + "f", "ready", "a single failure"},
           {kShown + "fff", "relapsed", "alarm"},
           {kShown + "fffff", "relapsed,stuck", "alarm and five without a pass"},
           {kShown + "fff" + kShown, "ready", "shown again"},
           {kShown + "dd", "integrity", "shown, but what was counted may be none"},
           {kShown + "CC", "unsafe", "shown, but not safe"},
           {kShown + "CCf", "unsafe,relapsed", "gravest first"},
       })
    EXPECT_EQ(flags(judged(row.kinds)), row.flags) << row.kinds << ": " << row.why;
}

TEST(Judgements, PlateauIsFlatScoresThatMostlyFail) {
  const auto scored = [](std::initializer_list<double> scores) {
    std::vector<CurveAttempt> out;
    for (const double score : scores) {
      out.push_back(attempt(score >= 75 ? 'P' : 'f', out.size()));
      out.back().score = score;
    }
    return flags(judge(out, {}, {}, "", kNow));
  };
  EXPECT_EQ(scored({66, 76, 70, 71, 69, 76, 70, 71}), "plateau");
  EXPECT_EQ(scored({66, 76, 70, 71, 72, 73, 74, 74.5}), "stuck") << "it still rises";
  EXPECT_EQ(scored({80, 80, 80, 80, 80, 80}), "learning") << "flat above the pass mark";
  EXPECT_EQ(scored({70, 80, 70, 80, 70, 80}), "learning") << "half of them pass";
  EXPECT_EQ(scored({76, 70, 70, 70, 70}), "learning") << "too few";
  EXPECT_EQ(scored({70, 70, 70, 70, 70, 70}), "stuck,plateau");
}

TEST(Judgements, EvidenceSaysTheNumbers) {
  const auto unsafe = judged("fPfCPfG");
  EXPECT_EQ(unsafe[0].evidence,
            "2 of the last 5 attempts were unsafe: 1 with a critical event, 1 with a failed safety gate");
  EXPECT_EQ(unsafe[0].n, 5);
  EXPECT_EQ(judged("Pfffff")[0].evidence, "5 attempts since the last pass");
  EXPECT_EQ(judged("fffff")[0].evidence, "5 attempts, none passed yet");
  EXPECT_EQ(judged(kShown + "fff")[0].evidence,
            "competence was shown at attempt 14; failures reached 2.7 (alarm at 2.0) at attempt 17");
  EXPECT_EQ(judged("vPdP")[0].evidence,
            "of the last 4 attempts 1 void or ended by the device, 1 switched off in the run, with a late loop or "
            "force that was not rendered");
  EXPECT_EQ(judged(kShown)[0].evidence, "competence shown at attempt 14 of 14, reliability 0.90; a person decides");
  EXPECT_EQ(judged("PPf")[0].evidence, "2 of 3 attempts passed; evidence 0.0 of 2.5");
}

TEST(Judgements, NameTheRulesTheyRestOn) {
  ProgressRules rules;
  rules.version = "ward 3";
  rules.stuck_after = 2;
  rules.unsafe_window = 3;
  rules.unsafe_attempts = 1;
  const auto found = judge(attempts("PCff"), rules, {}, "", kNow);
  EXPECT_EQ(flags(found), "unsafe,stuck");
  for (const Judgement& j : found) EXPECT_EQ(j.rule_version, "ward 3");
}

TEST(Judgements, ReadinessWantsReliability) {
  EXPECT_EQ(flags(judged(kShown, 0.69)), "learning");
  EXPECT_EQ(flags(judged(kShown, 0.70)), "ready");
  const auto unknown = judged(kShown, std::nullopt);
  EXPECT_EQ(flags(unknown), "ready");
  EXPECT_EQ(reliability_words(0.99), "0.99");
  EXPECT_EQ(reliability_words(0.991), "over 0.99");
  EXPECT_EQ(reliability_words(0.7), "0.70");
  EXPECT_NE(unknown[0].evidence.find("reliability cannot be told yet"), std::string::npos);
}

TEST(Judgements, CertifiedPeopleComeBack) {
  const std::string certified = "2026-01-05T00:00:00Z";
  const auto due = judged(kShown, 0.9, certified);
  EXPECT_EQ(flags(due), "retention due");
  EXPECT_EQ(due[0].evidence, "certified 2026-01-05; the attempt after 14 days was due 2026-01-19");
  const auto held = judged(kShown, 0.9, "2026-05-25T00:00:00Z");
  EXPECT_EQ(flags(held), "certified") << "nothing due: not to be certified again, and no learner";
  EXPECT_EQ(held[0].evidence.find("certified 2026-05-25; "), 0U) << held[0].evidence;
}

TEST(Judgements, OfACurveAreThoseOfItsAttempts) {
  LearningCurve curve;
  std::vector<SafetyRecord> safety;
  for (int k = 0; k < 6; ++k) {
    PastAttempt past;
    past.summary.uuid = "u" + std::to_string(k);
    past.summary.started_utc = "2026-01-0" + std::to_string(k + 1) + "T00:00:00.000Z";
    past.summary.score = 60;
    past.summary.passed = k == 0;
    curve.attempts.push_back(past);
  }
  EXPECT_EQ(flags(judge(curve, safety, {}, {}, "", kNow)), "stuck,plateau");
  safety = {
      {"u4", 1, 0}, {"u5", 0, 1}, {"u9", 0, 0, true, false, "2026-01-03T12:00:00.000Z"}, {"u3", 0, 0, false, true}};
  EXPECT_EQ(flags(judge(curve, safety, {}, {}, "", kNow)), "unsafe,stuck,plateau,integrity");
  safety.resize(1);
  EXPECT_EQ(flags(judge(curve, safety, {}, {}, "", kNow)), "stuck,plateau") << "one critical event alone";
}

TEST(Judgements, OldVoidOnesFindTheirPlace) {
  LearningCurve curve;
  std::vector<SafetyRecord> safety;
  for (int k = 10; k < 25; ++k) {
    PastAttempt past;
    past.summary.uuid = "u" + std::to_string(k);
    past.summary.started_utc = "2026-01-" + std::to_string(k) + "T00:00:00Z";
    past.summary.score = 80;
    past.summary.passed = k % 2 == 0;
    curve.attempts.push_back(past);
  }
  safety = {{"v1", 0, 0, true, false, "2026-01-01T00:00:00Z"}, {"v2", 0, 0, true, false, "2026-01-02T00:00:00Z"}};
  EXPECT_EQ(flags(judge(curve, safety, {}, {}, "", kNow)), "learning");
  for (SafetyRecord& record : safety) record.started_utc = "2026-01-23T12:00:00Z";
  EXPECT_EQ(flags(judge(curve, safety, {}, {}, "", kNow)), "integrity");
}

TEST(Judgements, SayThatACertificateIsInQuestionAndWhy) {
  const auto found =
      judge(attempts(kShown), {}, 0.9, "2026-05-25T00:00:00Z", kNow, "the attempt was decided not passed");
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].flag, Flag::kInQuestion);
  EXPECT_EQ(found[0].evidence, "certificate of 2026-05-25: the attempt was decided not passed");
  const auto unsigned_one = judge(attempts(kShown), {}, 0.9, "", kNow, "it is not signed");
  EXPECT_EQ(flags(unsigned_one), "in question,ready") << "it keeps no other from being given";
  EXPECT_EQ(unsigned_one[0].evidence, "a certificate is there: it is not signed");
}

TEST(Flags, HaveNamesThatReadBack) {
  for (const Flag flag : {Flag::kUnsafe, Flag::kRelapsed, Flag::kInQuestion, Flag::kStuck, Flag::kPlateau,
                          Flag::kIntegrity, Flag::kRetentionDue, Flag::kReady, Flag::kCertified, Flag::kLearning})
    EXPECT_EQ(flag_named(flag_name(flag)), flag);
  EXPECT_FALSE(flag_named("perfect"));
}

TEST(Judgements, SayReliabilityAndHowManyWereDecided) {
  std::vector<CurveAttempt> all = attempts("f" + kShown);
  all[0].decided = all[5].decided = true;
  const std::vector<Judgement> found = judge(all, {}, 0.84, "", kNow);
  ASSERT_EQ(flags(found).find("ready"), 0u) << flags(found);
  EXPECT_EQ(found[0].reliability, 0.84);
  EXPECT_EQ(found[0].decided, 2);
  ProgressRules no_plateau;
  no_plateau.plateau_window = 1000;
  const std::vector<Judgement> stuck = judge(attempts("Pffffff"), no_plateau, {}, "", kNow);
  ASSERT_EQ(flags(stuck), "stuck");
  EXPECT_FALSE(stuck[0].reliability);
  EXPECT_EQ(stuck[0].decided, 0);
  all = attempts("Pffffff");
  all[0].decided = true;
  EXPECT_EQ(judge(all, no_plateau, {}, "", kNow)[0].decided, 0) << "the first is none of the six that it rests on";
}

}  // namespace
}  // namespace trocar::judgement_test
