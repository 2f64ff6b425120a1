#include "trainees/progress/judgement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "trainees/progress/calendar.h"
#include "trainees/progress/cohort_bands.h"
#include "trainees/progress/plateau.h"
#include "trainees/progress/retention.h"

namespace trocar {
namespace {

using Attempts = std::vector<CurveAttempt>;
using Found = std::optional<Judgement>;

std::string fixed(double value, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string number(int value) { return std::to_string(value); }

/// "1 attempt", "3 attempts"
std::string counted(int n, const char* one, const char* many) { return number(n) + " " + (n == 1 ? one : many); }

/// Newest `window` of those that pass the filter, newest first.
template <class Filter>
std::vector<const CurveAttempt*> newest(const Attempts& attempts, int window, Filter counts) {
  std::vector<const CurveAttempt*> out;
  for (auto at = attempts.rbegin(); at != attempts.rend() && static_cast<int>(out.size()) < window; ++at)
    if (counts(*at)) out.push_back(&*at);
  return out;
}

Found unsafe(const Attempts& attempts, const ProgressRules& rules) {
  const auto looked_at = newest(attempts, rules.unsafe_window, looked_at_for_safety);
  int unsafe = 0, critical = 0, gates = 0;
  for (const CurveAttempt* a : looked_at) {
    unsafe += was_unsafe(*a) ? 1 : 0;
    critical += a->critical_events > 0 ? 1 : 0;
    gates += a->failed_gates > 0 ? 1 : 0;
  }
  if (unsafe < rules.unsafe_attempts) return std::nullopt;
  const int n = static_cast<int>(looked_at.size());
  return Judgement{Flag::kUnsafe,
                   number(unsafe) + " of the last " + counted(n, "attempt was", "attempts were") +
                       " unsafe: " + (critical > 0 ? number(critical) + " with a critical event" : "") +
                       (critical > 0 && gates > 0 ? ", " : "") +
                       (gates > 0 ? number(gates) + " with a failed safety gate" : ""),
                   n, rules.version};
}

Found relapsed(const std::vector<CusumPoint>& points, const ProgressRules& rules) {
  const Competence competence = competence_of(points);
  if (competence.relapses == 0 || competence.shown) return std::nullopt;
  std::size_t alarm = points.size();
  while (alarm > 0 && !(points[alarm - 1].decided && points[alarm - 1].test == CusumPoint::Test::kKeeping)) --alarm;
  return Judgement{Flag::kRelapsed,
                   "competence was shown at attempt " + number(*competence.first_shown) + "; failures reached " +
                       fixed(points[alarm - 1].value, 1) + " (alarm at " + fixed(rules.cusum.relapse_at, 1) +
                       ") at attempt " + number(static_cast<int>(alarm)),
                   static_cast<int>(points.size()), rules.version};
}

Found stuck(const Attempts& tried, const ProgressRules& rules) {
  int since = 0;
  for (auto at = tried.rbegin(); at != tried.rend() && !at->passed; ++at) ++since;
  if (since < rules.stuck_after) return std::nullopt;
  const bool ever = since < static_cast<int>(tried.size());
  return Judgement{Flag::kStuck,
                   counted(since, "attempt", "attempts") + (ever ? " since the last pass" : ", none passed yet"), since,
                   rules.version};
}

Found flat(const Attempts& tried, const ProgressRules& rules) {
  std::vector<double> scores;
  std::vector<bool> passed;
  for (const CurveAttempt& a : tried) {
    if (!a.score) continue;
    scores.push_back(*a.score);
    passed.push_back(a.passed);
  }
  const auto seen = plateau(scores, rules.plateau_window, rules.plateau_rise);
  if (!seen || !seen->flat) return std::nullopt;
  const auto passes = static_cast<int>(std::count(passed.end() - seen->n, passed.end(), true));
  if (2 * passes >= seen->n) return std::nullopt;
  return Judgement{Flag::kPlateau,
                   std::string("scores ") + (seen->rise < 0 ? "fell by " : "rose by ") +
                       fixed(std::abs(seen->rise), 1) + " points over the last " + number(seen->n) + " (flat below " +
                       fixed(rules.plateau_rise, 1) + "), " + number(passes) + " of them passed",
                   seen->n, rules.version};
}

Found integrity(const Attempts& attempts, const ProgressRules& rules) {
  const auto looked_at = newest(attempts, rules.integrity_window, [](const CurveAttempt&) { return true; });
  int broken = 0, doubtful = 0;
  for (const CurveAttempt* a : looked_at) {
    broken += a->broken ? 1 : 0;
    doubtful += !a->broken && a->doubtful ? 1 : 0;
  }
  if (broken + doubtful < rules.integrity_attempts) return std::nullopt;
  const int n = static_cast<int>(looked_at.size());
  return Judgement{Flag::kIntegrity,
                   "of the last " + counted(n, "attempt", "attempts") + " " + number(broken) +
                       " void or ended by the device, " + number(doubtful) +
                       " switched off in the run, with a late loop or force that was not rendered",
                   n, rules.version};
}

Found retention_due(const Attempts& attempts, const ProgressRules& rules, const std::string& certified_utc,
                    const std::string& now_utc) {
  const auto dates = retention_dates(certified_utc, attempts, rules, now_utc);
  for (auto date = dates.rbegin(); date != dates.rend(); ++date)
    if (date->state == RetentionDate::State::kDue)
      return Judgement{Flag::kRetentionDue,
                       "certified " + certified_utc.substr(0, 10) + "; the attempt after " + number(date->days) +
                           " days was due " + date->due_utc.substr(0, 10),
                       static_cast<int>(attempts.size()), rules.version};
  return std::nullopt;
}

/// @param safe no flag of safety or integrity holds.
Found ready(const std::vector<CusumPoint>& points, const ProgressRules& rules, std::optional<double> reliable,
            bool safe, const std::string& certified_utc) {
  const Competence competence = competence_of(points);
  if (!competence.shown || !safe || !certified_utc.empty() || reliable.value_or(1) < rules.least_reliability)
    return std::nullopt;
  std::size_t shown = points.size();
  while (!(points[shown - 1].decided && points[shown - 1].test == CusumPoint::Test::kLearning)) --shown;
  return Judgement{Flag::kReady,
                   "competence shown at attempt " + number(static_cast<int>(shown)) + " of " +
                       number(static_cast<int>(points.size())) +
                       (reliable ? ", reliability " + reliability_words(*reliable)
                                 : std::string(", reliability cannot be told yet")) +
                       "; a person decides",
                   static_cast<int>(points.size()), rules.version};
}

/// By decision among the newest n.
int decided_of(const Attempts& attempts, int n) {
  const auto newest = attempts.end() - std::min<std::ptrdiff_t>(n, static_cast<std::ptrdiff_t>(attempts.size()));
  return static_cast<int>(std::count_if(newest, attempts.end(), [](const CurveAttempt& a) { return a.decided; }));
}

Judgement certified(const Attempts& tried, const ProgressRules& rules, const std::string& utc) {
  const auto passes = std::count_if(tried.begin(), tried.end(), [](const CurveAttempt& a) { return a.passed; });
  const int n = static_cast<int>(tried.size());
  return {Flag::kCertified,
          "certified " + utc.substr(0, 10) + "; " + number(static_cast<int>(passes)) + " of " +
              counted(n, "attempt", "attempts") + " passed",
          n, rules.version};
}

std::string learning_text(const Attempts& tried, const std::vector<CusumPoint>& points, const ProgressRules& rules) {
  const auto passes = std::count_if(tried.begin(), tried.end(), [](const CurveAttempt& a) { return a.passed; });
  const Competence competence = competence_of(points);
  const std::string of = competence.shown
                             ? "; competence shown"
                             : "; evidence " + fixed(competence.value, 1) + " of " + fixed(rules.cusum.shown_at, 1);
  return number(static_cast<int>(passes)) + " of " + counted(static_cast<int>(tried.size()), "attempt", "attempts") +
         " passed" + of;
}

}  // namespace

const char* flag_name(Flag flag) {
  switch (flag) {
    case Flag::kUnsafe:
      return "unsafe";
    case Flag::kRelapsed:
      return "relapsed";
    case Flag::kInQuestion:
      return "in question";
    case Flag::kStuck:
      return "stuck";
    case Flag::kPlateau:
      return "plateau";
    case Flag::kIntegrity:
      return "integrity";
    case Flag::kRetentionDue:
      return "retention due";
    case Flag::kReady:
      return "ready";
    case Flag::kCertified:
      return "certified";
    case Flag::kLearning:
      return "learning";
    case Flag::kNotStarted:
      return "not started";
  }
  return "unknown";
}

std::optional<Flag> flag_named(const std::string& name) {
  for (const Flag flag :
       {Flag::kUnsafe, Flag::kRelapsed, Flag::kInQuestion, Flag::kStuck, Flag::kPlateau, Flag::kIntegrity,
        Flag::kRetentionDue, Flag::kReady, Flag::kCertified, Flag::kLearning, Flag::kNotStarted})
    if (name == flag_name(flag)) return flag;
  return std::nullopt;
}

bool looked_at_for_safety(const CurveAttempt& attempt) {
  return !attempt.broken && (attempt.score || attempt.critical_events > 0);
}

bool was_unsafe(const CurveAttempt& attempt) { return attempt.critical_events > 0 || attempt.failed_gates > 0; }

std::string reliability_words(double reliability) { return reliability > 0.99 ? "over 0.99" : fixed(reliability, 2); }

std::optional<double> reliability(const std::vector<double>& scores, double between_variance) {
  const auto spread = spread_of(scores);
  if (!spread || !(between_variance > 0)) return std::nullopt;
  const double of_mean = spread->sd * spread->sd / spread->n;
  return 1 - of_mean / (between_variance + of_mean);
}

std::vector<Judgement> judge(const Attempts& attempts, const ProgressRules& rules, std::optional<double> reliable,
                             const std::string& certified_utc, const std::string& now_utc,
                             const std::string& in_question) {
  Attempts tried;
  std::vector<bool> passed;
  for (const CurveAttempt& attempt : attempts) {
    if (attempt.broken) continue;
    tried.push_back(attempt);
    passed.push_back(attempt.passed);
  }
  const auto points = cusum(passed, rules.cusum);
  std::vector<Judgement> out;
  const auto add = [&out](Found found) {
    if (found) out.push_back(std::move(*found));
    return found.has_value();
  };
  const bool harmful = add(unsafe(tried, rules));
  add(relapsed(points, rules));
  if (!in_question.empty())
    out.push_back(
        {Flag::kInQuestion,
         (certified_utc.empty() ? "a certificate is there" : "certificate of " + certified_utc.substr(0, 10)) + ": " +
             in_question,
         static_cast<int>(tried.size()), rules.version});
  add(stuck(tried, rules));
  add(flat(tried, rules));
  const bool unsound = add(integrity(attempts, rules));
  add(retention_due(tried, rules, certified_utc, now_utc));
  add(ready(points, rules, reliable, !harmful && !unsound, certified_utc));
  if (out.empty() && !certified_utc.empty()) out.push_back(certified(tried, rules, certified_utc));
  if (out.empty())
    out.push_back(
        {Flag::kLearning, learning_text(tried, points, rules), static_cast<int>(tried.size()), rules.version});
  for (Judgement& judgement : out) {
    judgement.reliability = reliable;
    judgement.decided = decided_of(judgement.flag == Flag::kIntegrity ? attempts : tried, judgement.n);
  }
  return out;
}

std::vector<Judgement> judge(const LearningCurve& curve, const std::vector<SafetyRecord>& safety,
                             const ProgressRules& rules, std::optional<double> reliable,
                             const std::string& certified_utc, const std::string& now_utc,
                             const std::string& in_question) {
  std::map<std::string, const SafetyRecord*> records;
  for (const SafetyRecord& record : safety) records[record.uuid] = &record;
  const auto started = [](const std::string& utc) { return seconds_of_utc(utc).value_or(0); };
  Attempts attempts;
  for (const PastAttempt& past : curve.attempts) {
    CurveAttempt attempt{started(past.summary.started_utc), past.summary.score, past.summary.passed, 0, 0, false, false,
                         !past.summary.decided_by.empty()};
    if (const auto at = records.find(past.summary.uuid); at != records.end()) {
      attempt.critical_events = at->second->critical_events;
      attempt.failed_gates = at->second->failed_gates;
      attempt.doubtful = at->second->doubtful;
      records.erase(at);
    }
    attempts.push_back(attempt);
  }
  for (const auto& [uuid, record] : records)
    if (record->broken)
      attempts.push_back(
          {started(record->started_utc), {}, false, record->critical_events, record->failed_gates, true, false, false});
  std::stable_sort(attempts.begin(), attempts.end(),
                   [](const CurveAttempt& a, const CurveAttempt& b) { return a.started_s < b.started_s; });
  return judge(attempts, rules, reliable, certified_utc, now_utc, in_question);
}

}  // namespace trocar
