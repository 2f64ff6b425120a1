// The cohort in one pass over an index, beside columns that are read whole: 10^5 attempts are few enough for memory, and far cheaper so
// than one by one out of the wide tables.
#include <algorithm>
#include <cmath>
#include <limits>

#include "trainees/progress/calendar.h"
#include "trainees/review/desk_queries.h"
#include "trainees/review/desk_rows.h"
#include "trainees/sqlite_handle.h"

namespace trocar {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Values by row number, which counts from 1 without large gaps.
template <class Value>
class ByRow {
 public:
  explicit ByRow(Value none) : none_(none) {}
  Value& at(std::int64_t row) {
    const auto k = static_cast<std::size_t>(row);
    if (k >= values_.size()) values_.resize(std::max(k + 1, 2 * values_.size()), none_);
    return values_[k];
  }
  const Value& get(std::int64_t row) const {
    const auto k = static_cast<std::size_t>(row);
    return k < values_.size() ? values_[k] : none_;
  }

 private:
  Value none_;
  std::vector<Value> values_;
};

struct FirstScore {
  double value = kNone;
  std::int64_t row = 0;
  bool passed = false;
};

/// What stands beside the attempts.
struct Columns {
  ByRow<FirstScore> scores{FirstScore{}};
  ByRow<double> peaks{kNone};              ///< by score
  ByRow<int> gates{0};                     ///< by score
  ByRow<int> critical{0}, over_force{0};
};

Columns read_columns(sqlite3* connection) {
  Columns out;
  sql::Statement scores(connection, "SELECT attempt_id, value, passed, id FROM score INDEXED BY score_first WHERE revision = 0");
  while (scores.step()) out.scores.at(scores.integer(0)) = {scores.real(1), scores.integer(3), scores.integer(2) != 0};
  sql::Statement peaks(connection, "SELECT score_id, value FROM metric INDEXED BY metric_peak_force WHERE name = 'force_max_n'");
  while (peaks.step()) out.peaks.at(peaks.integer(0)) = peaks.real(1);
  sql::Statement gates(connection, "SELECT score_id FROM score_cap INDEXED BY cap_of_safety WHERE substr(reason, 1, 8) = 'safety: '");
  while (gates.step()) ++out.gates.at(gates.integer(0));
  sql::Statement critical(connection, "SELECT attempt_id FROM event INDEXED BY event_critical WHERE severity = 'critical'");
  while (critical.step()) ++out.critical.at(critical.integer(0));
  sql::Statement over(connection, "SELECT attempt_id FROM event INDEXED BY event_over_force"
                                  " WHERE type IN ('EXCESS_FORCE', 'CRITICAL_FORCE', 'GRIP_EXCESS', 'CRUSH')");
  while (over.step()) ++out.over_force.at(over.integer(0));
  return out;
}

/// One trainee on one curve while it is read.
struct Draft {
  std::int64_t trainee = 0, last_row = 0;
  CohortLine line = {};
  std::vector<CurveAttempt> attempts = {};
  std::vector<double> scores = {};
  double peak_sum = 0;
  int peaks = 0;
};

class CohortPass {
 public:
  CohortPass(Database& database, const ProgressRules& rules, const CohortFilter& filter, const std::string& now_utc)
      : connection_(database.connection()), rules_(rules), filter_(filter), now_utc_(now_utc), people_(desk::people(connection_)),
        certificates_(desk::certificates_that_hold(connection_)), columns_(read_columns(connection_)),
        newest_(connection_, "SELECT uuid, exercise_version, started_utc FROM attempt WHERE id = ?") {}

  std::vector<CohortLine> lines() {
    sql::Statement rows(connection_, "SELECT id, trainee_id, status, started_utc, device_ticks, device_overruns, saturated_contact_share,"
                                     " exercise_id, level, hand, ruleset_sha256 FROM attempt INDEXED BY attempt_by_curve"
                                     " WHERE status <> 'running' AND (?1 = '' OR exercise_id = ?1) AND (?2 = '' OR level = ?2)"
                                     " ORDER BY exercise_id, level, hand, ruleset_sha256, trainee_id, id");
    rows.bind(filter_.exercise).bind(filter_.level);
    CurveKey key;
    while (rows.step()) {
      const CurveKey here{rows.text(7), rows.text(8), rows.text(9), rows.text(10)};
      if (here != key) finish_curve();
      key = here;
      if (curve_.empty() || curve_.back().trainee != rows.integer(1)) begin(rows.integer(1), key);
      add(curve_.back(), rows);
    }
    finish_curve();
    std::stable_sort(out_.begin(), out_.end(), [](const CohortLine& a, const CohortLine& b) { return a.trainee < b.trainee; });
    return std::move(out_);
  }

 private:
  bool wanted(const desk::Person& person) const {
    const auto same_code = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b)); };
    const std::string& code = filter_.trainee;
    if (!code.empty() && !std::equal(code.begin(), code.end(), person.code.begin(), person.code.end(), same_code)) return false;
    return filter_.group.empty() || std::find(person.groups.begin(), person.groups.end(), filter_.group) != person.groups.end();
  }

  void begin(std::int64_t trainee, const CurveKey& key) {
    curve_.emplace_back();
    curve_.back().trainee = trainee;
    curve_.back().line.key = key;
  }

  void add(Draft& draft, const sql::Statement& row) const {
    const std::int64_t id = row.integer(0);
    const FirstScore& score = columns_.scores.get(id);
    CurveAttempt attempt;
    attempt.started_s = seconds_of_utc(row.text(3)).value_or(0);
    attempt.passed = score.passed;
    attempt.critical_events = columns_.critical.get(id);
    attempt.failed_gates = columns_.gates.get(score.row);
    attempt.broken = desk::broken(row.text(2));
    attempt.doubtful = desk::doubtful(row.real(4), row.real(5), row.real(6), rules_.late_share);
    if (!attempt.broken && !std::isnan(score.value)) attempt.score = score.value;
    draft.last_row = id;
    draft.line.over_force += columns_.over_force.get(id);
    draft.attempts.push_back(attempt);
    if (attempt.broken) return;
    ++draft.line.tries;
    draft.line.passes += attempt.passed ? 1 : 0;
    draft.line.in_a_row = attempt.passed ? draft.line.in_a_row + 1 : 0;
    if (!attempt.score) return;
    ++draft.line.graded;
    draft.scores.push_back(*attempt.score);
    draft.line.last = attempt.score;
    draft.line.best = std::max(draft.line.best.value_or(*attempt.score), *attempt.score);
    if (const double peak = columns_.peaks.get(score.row); !std::isnan(peak)) {
      draft.peak_sum += peak;
      ++draft.peaks;
    }
  }

  /// What needs the whole cohort of the curve, then the lines that are asked for.
  void finish_curve() {
    std::vector<std::vector<double>> scores;
    for (const Draft& draft : curve_) scores.push_back(draft.scores);
    const double between = between_variance(scores, rules_.reliability_window).value_or(0);
    for (Draft& draft : curve_) {
      const auto person = people_.find(draft.trainee);
      if (person == people_.end() || !wanted(person->second)) continue;
      finish(draft, person->second, between);
      const auto& judgements = draft.line.judgements;
      const bool shown = !filter_.flag || std::any_of(judgements.begin(), judgements.end(),
                                                       [this](const Judgement& j) { return j.flag == *filter_.flag; });
      if (shown) out_.push_back(std::move(draft.line));
    }
    curve_.clear();
  }

  void finish(Draft& draft, const desk::Person& person, double between) {
    CohortLine& line = draft.line;
    line.trainee = person.code;
    line.name = person.name;
    line.groups = person.groups;
    if (draft.peaks > 0) line.mean_peak_n = draft.peak_sum / draft.peaks;
    const auto newest = [&](int n) {
      return std::vector<double>(draft.scores.end() - std::min<std::ptrdiff_t>(n, static_cast<std::ptrdiff_t>(draft.scores.size())),
                                 draft.scores.end());
    };
    line.newest_scores = newest(kSparkScores);
    if (draft.scores.size() >= 3) line.reliability = reliability(newest(rules_.reliability_window), between);
    if (const auto at = certificates_.find({draft.trainee, line.key.exercise_id, line.key.level}); at != certificates_.end())
      line.certified_utc = at->second;
    line.judgements = judge(draft.attempts, rules_, line.reliability, line.certified_utc, now_utc_);
    newest_.bind(draft.last_row).step();
    line.last_uuid = newest_.text(0);
    line.exercise_version = newest_.text(1);
    line.last_utc = newest_.text(2);
    newest_.run();
  }

  sqlite3* connection_;
  const ProgressRules& rules_;
  const CohortFilter& filter_;
  const std::string& now_utc_;
  std::map<std::int64_t, desk::Person> people_;
  std::map<desk::CertifiedSkill, std::string> certificates_;
  Columns columns_;
  sql::Statement newest_;
  std::vector<Draft> curve_;
  std::vector<CohortLine> out_;
};

}  // namespace

std::vector<CohortLine> cohort_lines(Database& database, const ProgressRules& rules, const CohortFilter& filter, const std::string& now_utc) {
  return CohortPass(database, rules, filter, now_utc).lines();
}

void sort_by_gravity(std::vector<CohortLine>& lines) {
  std::stable_sort(lines.begin(), lines.end(),
                   [](const CohortLine& a, const CohortLine& b) { return a.judgements.front().flag < b.judgements.front().flag; });
}

}  // namespace trocar
