// What a teacher must know of a trainee at an exercise and level in 30 seconds: stuck, unsafe, relapsed, ready, due;
// each with its evidence.
//
// A judgement is a rule over the attempts and says which numbers it rests on. It certifies nobody: a person signs.
// Pure. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trainees/progress/learning_curve.h"
#include "trainees/progress/rules.h"

namespace trocar {

enum class Flag : std::uint8_t {
  kUnsafe,        ///< critical events or failed safety gates among the newest attempts
  kRelapsed,      ///< the CUSUM of failures alarmed after competence had been shown
  kInQuestion,    ///< a certificate's attempts no longer count as they did when it was given
  kStuck,         ///< so many attempts without a pass
  kPlateau,       ///< scores no longer rise and the pass mark is not reached
  kIntegrity,     ///< void attempts, late device loop: what was counted may not be a measurement
  kRetentionDue,  ///< a certificate's attempt for keeping is due
  kReady,         ///< LC-CUSUM shown, reliable enough, no flag of safety: ready for a person's decision
  kCertified,     ///< a certificate is held, and none of these
  kLearning,      ///< none of these, and no certificate
  kNotStarted,    ///< registered, and no attempt yet; of a person, not of a curve: judge() does not give it
};
const char* flag_name(Flag flag);  ///< "unsafe", "relapsed", ...
std::optional<Flag> flag_named(const std::string& name);

struct Judgement {
  Flag flag = Flag::kLearning;
  std::string evidence;  ///< one sentence in English with the numbers: "2 of the last 5 attempts went past 4.7 N"
  int n = 0;             ///< attempts that it rests on
  std::string rule_version;
  std::optional<double> reliability = {};  ///< of the mean of the newest scores; empty where it cannot be told
  int decided = 0;                         ///< of the n, by a person's decision and not by the score
};

/// What the attempts of one curve are known to have besides their numbers. Those that the device ended are in no curve,
/// yet here.
struct SafetyRecord {
  std::string uuid;
  int critical_events = 0, failed_gates = 0;
  bool broken = false;           ///< void, or ended by the device
  bool doubtful = false;         ///< late device loop, or force that was not rendered
  std::string started_utc = {};  ///< of broken ones, for their place
};

/// One attempt as the rules see it.
struct CurveAttempt {
  std::int64_t started_s = 0;        ///< since 1970
  std::optional<double> score = {};  ///< empty when not graded
  bool passed = false;               ///< as it counts (trainees/records/verdicts.h)
  int critical_events = 0, failed_gates = 0;
  bool broken = false, doubtful = false;  ///< as above; a broken one counts for integrity alone
  bool decided = false;                   ///< passed or not by a person's decision
};

/// Whether the rule of safety looks at it: an attempt left after a critical event counts like a graded one, so that
/// leaving hides nothing.
bool looked_at_for_safety(const CurveAttempt& attempt);
/// A critical event or a failed safety gate.
bool was_unsafe(const CurveAttempt& attempt);

/// Reliability of the mean of the newest scores: 1 - (variance of the mean) / (variance between trainees); see
/// docs/progress_rules.md. Empty where either variance cannot be told. @param between_variance of true scores over the
/// cohort.
std::optional<double> reliability(const std::vector<double>& scores, double between_variance);
/// "0.84"; "over 0.99" where two decimals would say that nothing can be doubted.
std::string reliability_words(double reliability);

/// All that hold, gravest first; kCertified or kLearning alone when none does. @param safety by attempt; attempts
/// without one count as safe.
/// @param certified_utc of a certificate that is held, "" without. @param in_question why it may not stand, "" while it
/// does (trainees/records/certificate_standing.h); without one that is held, of one that lies there unsigned.
std::vector<Judgement> judge(const LearningCurve& curve, const std::vector<SafetyRecord>& safety,
                             const ProgressRules& rules, std::optional<double> reliability,
                             const std::string& certified_utc, const std::string& now_utc,
                             const std::string& in_question = "");

/// The same over attempts oldest first.
std::vector<Judgement> judge(const std::vector<CurveAttempt>& attempts, const ProgressRules& rules,
                             std::optional<double> reliability, const std::string& certified_utc,
                             const std::string& now_utc, const std::string& in_question = "");

}  // namespace trocar
