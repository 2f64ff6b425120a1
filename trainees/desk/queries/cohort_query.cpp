// The cohort in one pass over an index, beside columns that are read whole: 10^5 attempts are few enough for memory,
// and far cheaper so than one by one out of the wide tables.
#include <algorithm>
#include <cmath>
#include <limits>

#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/queries/desk_rows.h"
#include "trainees/progress/calendar.h"
#include "trainees/records/standings.h"
#include "trainees/records/verdicts.h"
#include "trainees/store/sqlite_handle.h"

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

/// What stands beside an attempt, in one place: the attempts of one curve lie far apart.
struct Facts {
  double score = kNone, peak = kNone;
  std::int32_t critical = 0, over_force = 0, gates = 0;
  bool passed = false;  ///< by the score
  bool decided = false, decided_passed = false;
};

ByRow<Facts> read_facts(const Database& database) {
  sqlite3* connection = database.connection();
  ByRow<Facts> out{Facts{}};
  ByRow<std::int64_t> attempt_of{0};  // by score
  sql::Statement scores(connection,
                        "SELECT attempt_id, value, passed, id FROM score INDEXED BY score_first WHERE revision = 0");
  while (scores.step()) {
    Facts& facts = out.at(scores.integer(0));
    facts.score = scores.real(1);
    facts.passed = scores.integer(2) != 0;
    attempt_of.at(scores.integer(3)) = scores.integer(0);
  }
  for (const auto& [attempt, passed] : newest_decisions(database)) {
    out.at(attempt).decided = true;
    out.at(attempt).decided_passed = passed;
  }
  sql::Statement peaks(connection,
                       "SELECT id >> 10, value FROM metric_row INDEXED BY metric_peak_force WHERE id & 1023 = 1");
  while (peaks.step()) out.at(attempt_of.get(peaks.integer(0))).peak = peaks.real(1);
  sql::Statement others(
      connection,
      "SELECT id FROM metric_kind WHERE name = 'force_max_n' AND id <> 1");  // of an unusual unit: without an index
  sql::Statement of_kind(connection, "SELECT id >> 10, value FROM metric_row WHERE id & 1023 = ?");
  while (others.step()) {
    of_kind.bind(others.integer(0));
    while (of_kind.step()) out.at(attempt_of.get(of_kind.integer(0))).peak = of_kind.real(1);
    of_kind.run();
  }
  sql::Statement gates(connection, "SELECT score_id FROM score_cap INDEXED BY cap_of_gate WHERE kind = 'gate'");
  while (gates.step()) ++out.at(attempt_of.get(gates.integer(0))).gates;
  sql::Statement grave(
      connection, "SELECT id >> 20, kind_id & 1, kind_id & 2 FROM event_row INDEXED BY event_grave WHERE kind_id & 3");
  while (grave.step()) {
    Facts& facts = out.at(grave.integer(0));
    facts.critical += grave.integer(1) != 0 ? 1 : 0;
    facts.over_force += grave.integer(2) != 0 ? 1 : 0;
  }
  return out;
}

/// Curves that anybody has tried: from one to the next along the index, without reading what lies between.
std::vector<CurveKey> curves_of(sqlite3* connection, const CohortFilter& filter) {
  std::vector<CurveKey> out;
  sql::Statement rubric(
      connection,
      "SELECT ruleset_sha256 FROM attempt INDEXED BY attempt_by_curve WHERE exercise_id = ? AND level = ? AND hand = ?"
      " AND substr(ruleset_sha256, 1, 16) > ? ORDER BY substr(ruleset_sha256, 1, 16) LIMIT 1");
  for (const auto& [exercise, level, hand] : desk::combinations(connection)) {
    CurveKey key{exercise, level, hand, ""};
    if ((!filter.exercise.empty() && key.exercise_id != filter.exercise) ||
        (!filter.level.empty() && key.level != filter.level))
      continue;
    while (rubric.bind(key.exercise_id)
               .bind(key.level)
               .bind(key.hand)
               .bind(desk::rubric_start(key.rubric_sha256))
               .step()) {
      key.rubric_sha256 = rubric.text(0);
      rubric.run();
      out.push_back(key);
    }
    rubric.run();
  }
  return out;
}

std::string curve_rows() {
  return "SELECT a.id, a.trainee_id, " + std::string(sql::kEndedByDevice) +
         ", a.status = 'void' OR a.device_overruns > ?5 * a.device_ticks OR coalesce(a.saturated_contact_share, 0) > "
         "?6,"
         " a.started_utc FROM attempt a INDEXED BY attempt_by_curve WHERE a.exercise_id = ?1 AND a.level = ?2 AND "
         "a.hand = ?3 AND substr(a.ruleset_sha256, 1, 16) = ?4 AND a.status <> 'running' ORDER BY a.trainee_id, a.id";
}

/// One trainee on one curve while it is read.
struct Draft {
  std::int64_t trainee = 0, last_row = 0;
  CohortLine line = {};
  std::string in_question = {};  ///< of the certificate that is held
  std::vector<CurveAttempt> attempts = {};
  std::vector<std::int64_t> rows = {};  ///< of the attempts
  std::vector<double> scores = {};
  double peak_sum = 0;
  int peaks = 0;
};

class CohortPass {
 public:
  CohortPass(Database& database, const ProgressRules& rules, const CohortFilter& filter, const std::string& now_utc)
      : connection_(database.connection()),
        rules_(rules),
        filter_(filter),
        now_utc_(now_utc),
        people_(desk::people(connection_)),
        certificates_(desk::certificates_held(database)),
        erased_(desk::training_erased(connection_)),
        deactivated_(deactivated(connection_)),
        facts_(read_facts(database)),
        newest_(connection_, "SELECT uuid, exercise_version, started_utc FROM attempt WHERE id = ?") {}

  std::vector<CohortLine> lines() {
    for (const CurveKey& key : curves_of(connection_, filter_)) {
      sql::Statement rows(connection_, curve_rows());
      rows.bind(key.exercise_id)
          .bind(key.level)
          .bind(key.hand)
          .bind(desk::rubric_start(key.rubric_sha256))
          .bind(rules_.late_share)
          .bind(desk::kNotRendered);
      while (rows.step()) {
        if (erased_.contains(rows.integer(1))) continue;
        if (curve_.empty() || curve_.back().trainee != rows.integer(1)) begin(rows.integer(1), key);
        add(curve_.back(), rows);
      }
      finish_curve();
    }
    std::stable_sort(out_.begin(), out_.end(),
                     [](const CohortLine& a, const CohortLine& b) { return a.trainee < b.trainee; });
    return std::move(out_);
  }

 private:
  bool wanted(const desk::Person& person) const {
    const auto same_code = [](char a, char b) {
      return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    };
    const std::string& code = filter_.trainee;
    if (!code.empty() && !std::equal(code.begin(), code.end(), person.code.begin(), person.code.end(), same_code))
      return false;
    if (code.empty() && !filter_.deactivated && deactivated_.contains(person.id)) return false;
    return filter_.group.empty() ||
           std::find(person.groups.begin(), person.groups.end(), filter_.group) != person.groups.end();
  }

  void begin(std::int64_t trainee, const CurveKey& key) {
    curve_.emplace_back();
    curve_.back().trainee = trainee;
    curve_.back().line.key = key;
    if (const auto at = certificates_.find({trainee, key.exercise_id, key.level}); at != certificates_.end()) {
      curve_.back().line.certified_utc = at->second.utc;
      curve_.back().in_question = at->second.in_question;
    }
  }

  void add(Draft& draft, const sql::Statement& row) const {
    const std::int64_t id = row.integer(0);
    const Facts& facts = facts_.get(id);
    CurveAttempt attempt;
    if (!draft.line.certified_utc.empty())
      attempt.started_s = seconds_of_utc(row.view(4)).value_or(0);  // for dates after it alone
    attempt.critical_events = facts.critical;
    attempt.failed_gates = facts.gates;
    attempt.broken = row.integer(2) != 0;
    attempt.passed =
        judged_passed(attempt.broken, facts.passed, facts.decided ? std::optional(facts.decided_passed) : std::nullopt);
    attempt.decided = facts.decided;
    attempt.doubtful = row.integer(3) != 0;
    if (!attempt.broken && !std::isnan(facts.score)) attempt.score = facts.score;
    draft.last_row = id;
    draft.line.over_force += facts.over_force;
    draft.attempts.push_back(attempt);
    draft.rows.push_back(id);
    if (attempt.broken) return;
    ++draft.line.tries;
    draft.line.passes += attempt.passed ? 1 : 0;
    draft.line.in_a_row = attempt.passed ? draft.line.in_a_row + 1 : 0;
    if (!attempt.score) return;
    ++draft.line.graded;
    draft.scores.push_back(*attempt.score);
    draft.line.last = attempt.score;
    draft.line.best = std::max(draft.line.best.value_or(*attempt.score), *attempt.score);
    if (!std::isnan(facts.peak)) {
      draft.peak_sum += facts.peak;
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
      return std::vector<double>(
          draft.scores.end() - std::min<std::ptrdiff_t>(n, static_cast<std::ptrdiff_t>(draft.scores.size())),
          draft.scores.end());
    };
    line.newest_scores = newest(kSparkScores);
    for (std::size_t i = draft.rows.size(); i-- > 0 && line.newest_rows.size() < kRowsForLosses;)
      if (!draft.attempts[i].broken) line.newest_rows.push_back(draft.rows[i]);
    if (draft.scores.size() >= 3) line.reliability = reliability(newest(rules_.reliability_window), between);
    line.judgements = judge(draft.attempts, rules_, line.reliability, line.certified_utc, now_utc_, draft.in_question);
    if (line.judgements.front().flag == Flag::kUnsafe) line.harm = harm_of(draft);
    newest_.bind(draft.last_row).step();
    line.last_uuid = newest_.text(0);
    line.exercise_version = newest_.text(1);
    line.last_utc = newest_.text(2);
    newest_.run();
  }

  Harm harm_of(const Draft& draft) const {
    Harm out;
    std::vector<std::int64_t> window;
    for (std::size_t i = draft.attempts.size(); i-- > 0 && out.attempts_before < rules_.unsafe_window;) {
      const CurveAttempt& attempt = draft.attempts[i];
      if (!looked_at_for_safety(attempt)) continue;
      const bool before = out.attempts >= rules_.unsafe_window;
      ++(before ? out.attempts_before : out.attempts);
      (before ? out.unsafe_before : out.unsafe) += was_unsafe(attempt) ? 1 : 0;
      if (before) continue;
      window.push_back(draft.rows[i]);
      const double peak = facts_.get(draft.rows[i]).peak;
      if (!std::isnan(peak)) out.peak_n = std::max(out.peak_n.value_or(peak), peak);
    }
    read_harm(connection_, window, out);
    return out;
  }

  sqlite3* connection_;
  const ProgressRules& rules_;
  const CohortFilter& filter_;
  const std::string& now_utc_;
  std::map<std::int64_t, desk::Person> people_;
  std::map<desk::CertifiedSkill, desk::HeldCertificate> certificates_;
  std::set<std::int64_t> erased_, deactivated_;
  ByRow<Facts> facts_;  ///< by attempt; 0 takes those of scores again, which nobody asks for
  sql::Statement newest_;
  std::vector<Draft> curve_;
  std::vector<CohortLine> out_;
};

}  // namespace

std::vector<CohortLine> cohort_lines(Database& database, const ProgressRules& rules, const CohortFilter& filter,
                                     const std::string& now_utc) {
  // The indices that are read here fit; SQLite's own 2 MB would read them from the file at every call.
  sql::execute(database.connection(), "PRAGMA cache_size = -65536");
  const sql::ReadSnapshot snapshot(database.connection());
  return CohortPass(database, rules, filter, now_utc).lines();
}

void sort_by_gravity(std::vector<CohortLine>& lines) {
  std::stable_sort(lines.begin(), lines.end(), [](const CohortLine& a, const CohortLine& b) {
    const Flag left = a.judgements.front().flag, right = b.judgements.front().flag;
    return left != right ? left < right : a.harm && b.harm && worse(*a.harm, *b.harm);
  });
}

}  // namespace trocar
