// One trainee: curves with the cohort beside them, and what was decided and said.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "haptics/input_error.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/queries/desk_rows.h"
#include "trainees/progress/calendar.h"
#include "trainees/records/cohort.h"
#include "trainees/records/trainee_store.h"
#include "trainees/records/verdicts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

/// Safety of every attempt of a trainee, by curve.
std::map<CurveKey, std::vector<SafetyRecord>> safety_of(sqlite3* connection, std::int64_t trainee, double late_share) {
  std::map<CurveKey, std::vector<SafetyRecord>> out;
  sql::Statement rows(
      connection,
      "SELECT a.uuid, a.exercise_id, a.level, a.hand, a.ruleset_sha256, a.status, a.started_utc, a.device_ticks,"
      " a.device_overruns, a.saturated_contact_share,"
      " (SELECT count(*) FROM event e WHERE e.attempt_id = a.id AND e.severity = 'critical'),"
      " (SELECT count(*) FROM score s JOIN score_cap c ON c.score_id = s.id WHERE s.attempt_id = a.id AND s.revision = "
      "0"
      "  AND c.kind = 'gate'), " +
          std::string(sql::kEndedByDevice) +
          " FROM attempt a WHERE a.trainee_id = ? AND a.status <> 'running' ORDER BY a.id");
  rows.bind(trainee);
  while (rows.step()) {
    SafetyRecord record;
    record.uuid = rows.text(0);
    record.critical_events = static_cast<int>(rows.integer(10));
    record.failed_gates = static_cast<int>(rows.integer(11));
    record.broken = rows.integer(12) != 0;
    record.doubtful = rows.text(5) == status_name(AttemptStatus::kVoid) ||
                      desk::doubtful(rows.real(7), rows.real(8), rows.real(9), late_share);
    record.started_utc = rows.text(6);
    out[{rows.text(1), rows.text(2), rows.text(3), rows.text(4)}].push_back(record);
  }
  return out;
}

/// Weeks from the first to the last, none left out.
std::vector<WeekMinutes> weeks_of(const std::vector<PastAttempt>& attempts) {
  std::map<std::string, WeekMinutes> weeks;
  std::int64_t first = 0, last = 0;
  for (const PastAttempt& attempt : attempts) {
    const auto started = seconds_of_utc(attempt.summary.started_utc);
    if (!started) continue;
    first = weeks.empty() ? *started : std::min(first, *started);
    last = weeks.empty() ? *started : std::max(last, *started);
    WeekMinutes& week = weeks[monday_of(*started)];
    ++week.attempts;
    if (const auto time = attempt.metrics.find(kTimeMetric); time != attempt.metrics.end())
      week.minutes += time->second / 60;
  }
  std::vector<WeekMinutes> out;
  if (weeks.empty()) return out;
  const std::int64_t most = 7 * kSecondsADay * 520;  // a wrong clock must not fill the memory
  for (std::int64_t day = std::max(first, last - most); monday_of(day) <= monday_of(last); day += 7 * kSecondsADay) {
    WeekMinutes week = weeks[monday_of(day)];
    week.monday = monday_of(day);
    out.push_back(week);
  }
  return out;
}

std::string two_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

std::vector<double> newest_scores(const std::vector<double>& scores, int window) {
  return {scores.end() - std::min<std::ptrdiff_t>(window, static_cast<std::ptrdiff_t>(scores.size())), scores.end()};
}

std::vector<CurveAttempt> as_facts(const LearningCurve& curve) {
  std::vector<CurveAttempt> out;
  for (const PastAttempt& past : curve.attempts) {
    CurveAttempt attempt;
    attempt.started_s = seconds_of_utc(past.summary.started_utc).value_or(0);
    attempt.score = past.summary.score;
    attempt.passed = past.summary.passed;
    attempt.decided = !past.summary.decided_by.empty();
    out.push_back(attempt);
  }
  return out;
}

class TraineeQuery {
 public:
  TraineeQuery(Database& database, const Trainee& trainee, const ProgressRules& rules, const std::string& now_utc)
      : database_(database),
        connection_(database.connection()),
        trainee_(trainee),
        rules_(rules),
        now_utc_(now_utc),
        safety_(safety_of(connection_, trainee.id, rules.late_share)),
        certificates_(desk::certificates_held(database)) {}

  CurveDetail curve_detail(LearningCurve curve) {
    CurveDetail out;
    out.curve = std::move(curve);
    out.cusum = cusum(out.curve.passes(), rules_.cusum);
    out.competence = competence_of(out.cusum);
    const CurveKey& key = out.curve.key;
    std::vector<std::vector<double>> scores;
    std::vector<double> own;
    for (const auto& [trainee, of] : desk::cohort_scores(connection_, key)) {
      scores.push_back(of);
      if (trainee == trainee_.id) own = of;
    }
    out.cohort = cohort_curve(scores);
    if (own.size() >= 3)
      out.reliability = reliability(newest_scores(own, rules_.reliability_window),
                                    between_variance(scores, rules_.reliability_window).value_or(0));
    const auto held = certificates_.find({trainee_.id, key.exercise_id, key.level});
    const auto [certified, in_question] = held == certificates_.end() ? desk::HeldCertificate{} : held->second;
    out.judgements = judge(out.curve, safety_[key], rules_, out.reliability, certified, now_utc_, in_question);
    out.retention = retention_dates(certified, as_facts(out.curve), rules_, now_utc_);
    out.benchmarks = CurriculumStore(database_).benchmarks(key.exercise_id, key.level);
    return out;
  }

 private:
  Database& database_;
  sqlite3* connection_;
  const Trainee& trainee_;
  const ProgressRules& rules_;
  const std::string& now_utc_;
  std::map<CurveKey, std::vector<SafetyRecord>> safety_;
  std::map<desk::CertifiedSkill, desk::HeldCertificate> certificates_;
};

void add_ability(Database& database, const Trainee& trainee, const ProgressRules& rules, TraineeDetail& detail) {
  const RaschReport rasch = rasch_report(database, rules);
  detail.rasch_attempts = rasch.attempts;
  detail.ability_missing = rasch.missing;
  if (!rasch.missing.empty()) return;
  const auto found = rasch.abilities.find(std::to_string(trainee.id));
  if (found == rasch.abilities.end()) {
    detail.ability_missing =
        trainee.attempts == 0
            ? "No attempt yet."
            : "There are only passes or only failures so far, or no exercise shared with others: no ability "
              "can be told.";
    return;
  }
  const RaschEstimate& own = found->second;
  detail.ability_n = own.n;
  if (own.standard_error < rules.rasch_largest_se) {
    detail.ability_logit = own.logit;
    detail.ability_se = own.standard_error;
  } else {
    detail.ability_missing = "Its standard error after " + std::to_string(own.n) +
                             (own.n == 1 ? " attempt" : " attempts") + " is " + two_digits(own.standard_error) +
                             " logit; it is shown below " + two_digits(rules.rasch_largest_se) + ".";
  }
}

/// Finished, and in no curve. Oldest first.
std::vector<PastAttempt> ended_by_device(const std::vector<PastAttempt>& newest_first) {
  std::vector<PastAttempt> out;
  std::copy_if(newest_first.rbegin(), newest_first.rend(), std::back_inserter(out),
               [](const PastAttempt& attempt) { return attempt.summary.ended_by_device; });
  return out;
}

}  // namespace

ProgressRules rules_in_force(Database& database) {
  ProgressRules rules;
  std::string unread;
  CurriculumStore(database).newest(kRulesName, [&](const Curriculum& one) {
    try {
      rules = read_progress_rules(one.toml, "curriculum " + one.name + ", version " + std::to_string(one.version));
      return true;
    } catch (const InputError& error) {  // fetched from a newer program, say: those before it rule on
      if (unread.empty()) unread = error.what();
      return false;
    }
  });
  rules.unread = unread;
  return rules;
}

TraineeDetail trainee_detail(Database& database, const std::string& code, const ProgressRules& rules,
                             const std::string& now_utc) {
  const auto trainee = TraineeStore(database).find(code);
  if (!trainee) throw InputError("there is no trainee \"" + code + "\" in this record");
  TraineeDetail out;
  out.code = trainee->code;
  out.created_utc = trainee->created_utc;
  out.rule_version = rules.version;
  const desk::Person person = desk::people(database.connection())[trainee->id];
  out.name = person.name;
  out.groups = person.groups;
  out.training_erased = desk::training_erased(database.connection()).contains(trainee->id);
  const auto attempts = out.training_erased ? std::vector<PastAttempt>{} : past_attempts(database, trainee->code);
  TraineeQuery query(database, *trainee, rules, now_utc);
  for (LearningCurve& curve : learning_curves(attempts)) out.curves.push_back(query.curve_detail(std::move(curve)));
  out.weeks = weeks_of(attempts);
  const AssessmentStore assessments(database);
  out.certificates = assessments.certificates_of(trainee->code);
  out.notes = assessments.notes_of(trainee->code);
  out.ended_by_device = ended_by_device(attempts);
  if (!out.training_erased) add_ability(database, *trainee, rules, out);
  return out;
}

}  // namespace trocar
