#include "tests/trainees/records/cohort_samples.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "haptics/digest/digest.h"
#include "trainees/integrity/attempt_chain.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/progress/calendar.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/attempt_rows.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::test {
namespace {

constexpr const char* kExercises[] = {"reach-and-orient", "surface-touch", "limited-grasp"};
constexpr const char* kLevels[] = {"L1", "L2", "L3"};
constexpr const char* kEventTypes[] = {"TARGET_LIT", "TARGET_TOUCHED", "TARGET_HELD"};
constexpr int kCommit = 4000;
constexpr std::int64_t kBegin = 1767225600;  // 2026-01-01

std::string ruleset_text(const std::string& exercise) {
  return "id = \"" + exercise + "\"\n" + std::string(6000, '#') + "\n";
}

class Filler {
 public:
  Filler(Database& database, const CohortPlan& plan)
      : connection_(database.connection()), plan_(plan), random_(plan.seed) {
    for (int k = 0; k < plan.metrics - 4; ++k)
      names_.push_back("metric_no_" + std::string(k < 10 ? "0" : "") + std::to_string(k));
  }

  void fill(Database& database) {
    sql::Transaction first(connection_);
    add_rules();
    for (int t = 0; t < plan_.trainees; ++t) add_trainee(database, t);
    first.commit();
    for (int done = 0; done < plan_.attempts;) {
      sql::Transaction transaction(connection_);
      for (int k = 0; k < kCommit && done < plan_.attempts; ++k) add_attempt(done++);
      transaction.commit();
    }
  }

 private:
  double uniform() { return random_() / 4294967296.0; }

  void add_rules() {
    for (const char* exercise : kExercises) {
      const std::string text = ruleset_text(exercise);
      shas_.push_back(digest::of_bytes(text));
      sql::Statement(connection_, "INSERT INTO exercise VALUES (?, '', '')").bind(exercise).run();
      keep_exercise(connection_, exercise);
      sql::Statement(connection_, "INSERT INTO ruleset VALUES (?, ?, '1.0', ?)")
          .bind(shas_.back())
          .bind(exercise)
          .bind(text)
          .run();
    }
  }

  void add_trainee(Database& database, int t) {
    const std::string digits = std::to_string(t + 1);
    ids_.push_back(
        TraineeStore(database).ensure_id("P" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits));
    talent_.push_back(0.3 + 1.4 * uniform());
    tries_.emplace_back(static_cast<std::size_t>(plan_.curves_each), 0);
    const std::string group = t % 2 == 0 ? "2026 A" : "2026 B";
    sql::Statement member(
        connection_, "INSERT INTO membership VALUES (?, ?) RETURNING (SELECT uuid FROM trainee WHERE id = trainee_id)");
    member.bind(ids_.back()).bind(group).step();
    const std::string uuid = member.text(0);
    member.run();
    append_audit(connection_, "group joined", uuid, group);
  }

  /// Trainees take turns, so that the rows of one lie far apart as they do in life.
  void add_attempt(int n) {
    const auto t = static_cast<std::size_t>(n % plan_.trainees);
    const auto c = static_cast<std::size_t>(n / plan_.trainees % plan_.curves_each);
    const int curve = static_cast<int>(t + c) % 9, tried = tries_[t][c]++;
    const std::string exercise = kExercises[curve % 3], level = kLevels[curve / 3];
    const bool expert = curve == 0 && n % 40 == 0;
    sql::Statement insert(
        connection_,
        "INSERT INTO attempt (uuid, trainee_id, exercise_id, exercise_version, ruleset_sha256, level, seed, board, "
        "hand,"
        " organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, started_utc, owner_pid, owner_boot,"
        " owner_start, recording_path, program, hash_version, status)"
        " VALUES (?, ?, ?, '1.0', ?, ?, ?, ?, ?, 'liver', 'phantom-liver.organ.toml', ?, 1, 'Synthetic phantom, "
        "CC0-1.0',"
        " ?, 4242, '8d3a2f1e-0000-4000-8000-000000000000', 17, ?, '0.1.0', ?, 'running') RETURNING id");
    const std::string uuid = make_uuid();
    insert.bind(uuid)
        .bind(ids_[t])
        .bind(exercise)
        .bind(shas_[static_cast<std::size_t>(curve % 3)])
        .bind(level)
        .bind(n)
        .bind(n % 12);
    insert.bind(expert ? "expert" : t % 4 == 3 ? "device" : "mouse").bind(std::string(64, 'a'));
    insert.bind(started(n)).bind("trocar.recordings/" + uuid + ".trec").bind(kHashVersion).step();
    const std::int64_t row = insert.integer(0);
    insert.run();
    write_result(connection_, row, result(talent_[t], tried, expert), "trocar.recordings/" + uuid + ".trec");
  }

  std::string started(int n) const {
    const std::int64_t whole = 180 * kSecondsADay;
    std::string utc = utc_of_seconds(kBegin + whole * n / std::max(plan_.attempts, 1));
    return utc.insert(utc.size() - 1, ".123");
  }

  AttemptResult result(double talent, int tried, bool expert) {
    AttemptResult out;
    const double left = expert ? 0 : std::exp(-tried * talent / 20), chance = uniform();
    out.grade.status = chance < 0.01   ? AttemptStatus::kVoid
                       : chance < 0.03 ? AttemptStatus::kAborted
                       : chance < 0.05 ? AttemptStatus::kTimeout
                                       : AttemptStatus::kCompleted;
    out.grade.grade = "not graded";
    out.recording_sha256 = digest::of_bytes("recording " + std::to_string(++recorded_));
    out.state_hash = "0123456789abcdef";
    out.device.backend = "simulated";
    out.device.rate_hz = 1000;
    out.device.ticks = 60000;
    out.device.overruns = uniform() < 0.02 ? 900 : 0;
    out.device.saturated_contact_share = 0.06 * uniform() * uniform();
    out.device.passivity_active_share = 0.05;
    out.device.transitions = {{0, "homing", "armed"}, {0.5, "armed", "running"}, {60, "running", "ended"}};
    add_events(out, left);
    if (out.grade.status == AttemptStatus::kVoid || out.grade.status == AttemptStatus::kAborted) return out;
    add_grade(out, left);
    return out;
  }

  void add_events(AttemptResult& out, double left) {
    for (int k = 0; k < plan_.events; ++k)
      out.events.push_back({1.0 + k * 1.7 + uniform(), kEventTypes[k % 3], Severity::kInfo, k / 3,
                            k % 3 == 0 ? 0 : uniform(), k % 3 == 0 ? "" : "s",
                            Vec3(0.1 * uniform(), 0.1 * uniform(), 0.1 * uniform())});
    while (uniform() < 0.5 * left)
      out.events.push_back({50, "EXCESS_FORCE", Severity::kMajor, 1, 3 + uniform(), "N", Vec3::Zero()});
    if (uniform() < 0.1 * left)
      out.events.push_back({55, "CRITICAL_FORCE", Severity::kCritical, 1, 5, "N", Vec3::Zero()});
  }

  void add_grade(AttemptResult& out, double left) {
    Grade& grade = out.grade;
    const auto count = [&](Severity severity) {
      return static_cast<double>(
          std::count_if(out.events.begin(), out.events.end(), [&](const Event& e) { return e.severity == severity; }));
    };
    grade.metrics = {{"time_s", 30 + 60 * left + 10 * uniform(), "s"},
                     {"force_max_n", 1.5 + 3 * left * uniform(), "N"},
                     {"excess_events", count(Severity::kMajor), "1"},
                     {"critical_events", count(Severity::kCritical), "1"}};
    for (std::size_t k = 0; k < names_.size(); ++k) {  // as in real ones some are undefined, some are counts
      const double value = k % 4 == 1 ? std::floor(20 * uniform()) : uniform();
      grade.metrics.push_back({names_[k], k % 8 == 0 ? std::nullopt : std::optional(value), k % 3 == 0 ? "m/s" : "1"});
    }
    for (const char* name : {"force", "in band", "wrong places", "time", "path ratio"})
      grade.subscores.push_back({name, uniform(), 0.2, uniform(), "N", 0, 6, name[0] == 'f'});
    double score = std::clamp(95 - 45 * left + 6 * (uniform() - 0.5), 0.0, 100.0);
    if (uniform() < 0.4 * left) {
      grade.caps.push_back({.kind = CapKind::kGate, .subject = "force", .below = 0.5, .at_most = 59});
      score = std::min(score, 59.0);
    }
    if (count(Severity::kCritical) > 0) {
      grade.caps.push_back({.kind = CapKind::kCritical, .at_most = 49});
      score = std::min(score, 49.0);
    }
    grade.score = score;
    grade.passed = score >= 75 && grade.status == AttemptStatus::kCompleted;
    grade.grade = grade.passed ? "pass" : "below pass";
  }

  sqlite3* connection_;
  CohortPlan plan_;
  std::mt19937 random_;
  int recorded_ = 0;
  std::vector<std::string> names_, shas_;
  std::vector<std::int64_t> ids_;
  std::vector<double> talent_;
  std::vector<std::vector<int>> tries_;
};

}  // namespace

void fill_cohort(Database& database, const CohortPlan& plan) { Filler(database, plan).fill(database); }

}  // namespace trocar::test
