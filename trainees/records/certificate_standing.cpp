#include "trainees/records/certificate_standing.h"

#include <algorithm>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <unordered_set>

#include <nlohmann/json.hpp>

#include "trainees/integrity/audit.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/verdicts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

using nlohmann::json;

std::string text_of(const json& of, const char* key) {
  return of.is_object() && of.contains(key) && of[key].is_string() ? of[key].get<std::string>() : std::string();
}

struct KnownDecision {
  std::string uuid, by;
  bool passed = false;
};

/// What the certificate says itself. Those of older programs name neither attempts nor decisions.
struct Evidence {
  std::string attempt, row_hash;
  std::optional<std::set<std::string>> attempts;
  std::optional<std::map<std::string, KnownDecision>> decisions;  ///< by attempt
};

Evidence evidence_of(const Certificate& certificate) {
  const json whole = json::parse(certificate.evidence, nullptr, false);
  Evidence out{text_of(whole, "attempt"), text_of(whole, "row_hash"), {}, {}};
  if (!whole.is_object()) return out;
  if (whole.contains("attempts") && whole["attempts"].is_array()) {
    out.attempts.emplace();
    for (const json& one : whole["attempts"])
      if (one.is_string()) out.attempts->insert(one.get<std::string>());
  }
  if (whole.contains("overrides") && whole["overrides"].is_array()) {
    out.decisions.emplace();
    for (const json& one : whole["overrides"])
      (*out.decisions)[text_of(one, "attempt")] = {text_of(one, "decision"), text_of(one, "by"),
                                                   one.is_object() && one.contains("passed") && one["passed"] == true};
  }
  return out;
}

struct Entry {
  std::int64_t position = 0;
  bool elsewhere = false;  ///< written in another database: what came first there only times tell
};

Entry entry_of(sqlite3* connection, const std::string& certificate) {
  sql::Statement row(connection,
                     "SELECT position, actor FROM audit WHERE subject = ? AND action = 'certificate added'");
  if (!row.bind(certificate).step()) return {};
  return {row.integer(0), row.text(1) == kFromCentre};
}

/// The newest decision that stood in the trail before the certificate.
std::optional<KnownDecision> decision_before(sqlite3* connection, std::int64_t attempt, std::int64_t position) {
  sql::Statement row(connection,
                     "SELECT v.uuid, v.printed, v.passed FROM verdict_override v JOIN audit u ON u.subject = v.uuid AND"
                     " u.action = 'verdict_override added' WHERE v.attempt_id = ? AND u.position < ?"
                     " ORDER BY u.position DESC LIMIT 1");
  if (!row.bind(attempt).bind(position).step()) return {};
  return KnownDecision{row.text(0), row.text(1), row.integer(2) != 0};
}

/// Attempts that count in curves: those of a trainee at an exercise and level, on the curve of ?1 where that is known.
constexpr const char* kOfCurve =
    " LEFT JOIN attempt e ON e.uuid = ?1 WHERE a.status IN ('completed', 'timeout', 'aborted')"
    " AND (e.id IS NULL OR (a.hand = e.hand AND a.ruleset_sha256 = e.ruleset_sha256))";

/// Since then, of an attempt that had counted as passed.
struct Doubt {
  std::string attempt, printed, utc, reason;
};

std::string words_of(const std::vector<Doubt>& doubts, const std::string& cited, std::size_t all) {
  if (doubts.empty()) return "";
  const auto first = std::find_if(doubts.begin(), doubts.end(), [&](const Doubt& d) { return d.attempt == cited; });
  const Doubt& told = first == doubts.end() ? doubts.back() : *first;
  const std::string what = first != doubts.end()
                               ? "the attempt that it cites was"
                               : std::to_string(doubts.size()) + " of the " + std::to_string(all) +
                                     " attempts that it stands on " + (doubts.size() == 1 ? "was" : "were");
  const std::string reason = told.reason.substr(0, told.reason.find_last_not_of('.') + 1);  // goes into sentences
  return what + " decided not passed by " + told.printed + " on " + told.utc.substr(0, 10) + ": " + reason;
}

/// Attempts of one person at one skill on which nobody has decided, asked of many certificates.
class SoundAttempts {
 public:
  explicit SoundAttempts(sqlite3* connection)
      : own_(connection,
             "SELECT id, uuid FROM attempt INDEXED BY attempt_by_trainee WHERE trainee_id = ? AND exercise_id = ? AND"
             " level = ? ORDER BY uuid"),  // out of the index alone
        named_(connection, "SELECT 1 FROM attempt WHERE uuid = ?") {
    sql::Statement decisions(connection, "SELECT attempt_id FROM verdict_override");
    while (decisions.step()) decided_.insert(decisions.integer(0));
  }

  void look_up(std::int64_t trainee, std::string_view exercise, std::string_view level) {
    uuids_.clear();
    own_.bind(trainee).bind(exercise).bind(level);
    while (own_.step())
      if (own_.view(1).size() == kLength && !decided_.contains(own_.integer(0))) uuids_ += own_.view(1);
    own_.run();
  }

  /// Whether every attempt that the evidence could name is one of them. What it names is a JSON string, hence every
  /// such string is looked at, as it stands: false where it could be written in another way.
  bool hold_all_of(std::string_view evidence) {
    if (evidence.find('\\') != std::string_view::npos) return false;
    std::size_t next = 0;  // evidence names them in their order
    for (std::size_t begin = 0; (begin = evidence.find('"', begin)) != std::string_view::npos;) {
      const std::size_t end = evidence.find('"', ++begin);
      if (end == std::string_view::npos) return false;
      const std::string_view text = evidence.substr(begin, end - begin);
      begin = end + 1;
      if (begin < evidence.size() && evidence[begin] == ':') continue;  // a key
      if (next == size() || uuid(next) != text) next = place_of(text);
      if (next < size() && uuid(next) == text)
        ++next;
      else if (is_attempt(text))
        return false;
    }
    return true;
  }

 private:
  static constexpr std::size_t kLength = 36;

  std::size_t size() const { return uuids_.size() / kLength; }
  std::string_view uuid(std::size_t at) const { return std::string_view(uuids_).substr(kLength * at, kLength); }
  /// Of the first that is not less.
  std::size_t place_of(std::string_view text) const {
    const auto all = std::views::iota(std::size_t{0}, size());
    const auto found = std::ranges::lower_bound(all, text, {}, [this](std::size_t at) { return uuid(at); });
    return static_cast<std::size_t>(found - all.begin());
  }
  bool is_attempt(std::string_view text) {
    const bool found = named_.bind(text).step();
    named_.run();
    return found;
  }

  sql::Statement own_, named_;
  std::unordered_set<std::int64_t> decided_;
  std::string uuids_;  ///< kLength for each, in their order
};

}  // namespace

CertificateStanding standing_of(const Database& database, const Certificate& certificate) {
  sqlite3* connection = database.connection();
  const Evidence evidence = evidence_of(certificate);
  const Entry given = entry_of(connection, certificate.uuid);
  CertificateStanding out;
  out.cited = evidence.attempt;
  std::vector<Doubt> doubts;
  sql::Statement rows(
      connection,
      "SELECT a.id, a.uuid, coalesce(s.passed, 0), coalesce(a.row_hash, ''), o.uuid, o.passed, o.printed, o.utc,"
      " o.reason, (SELECT max(position) FROM audit u WHERE u.subject = a.uuid AND u.action IN ('" +
          std::string(kActionFinished) + "', '" + kActionReplicated +
          "')) < ?3 AND (?4 = 0 OR a.finished_utc <= c.utc) FROM certificate c JOIN attempt a ON a.trainee_id = "
          "c.trainee_id AND"
          " a.exercise_id = c.exercise_id AND a.level = c.level"
          " LEFT JOIN score s INDEXED BY score_first ON s.attempt_id = a.id AND s.revision = 0" +
          sql::decision() + kOfCurve + " AND c.uuid = ?2 ORDER BY a.id");
  rows.bind(evidence.attempt).bind(certificate.uuid).bind(given.position).bind(given.elsewhere);
  while (rows.step()) {
    CertifiedBy one{rows.integer(0), rows.text(1)};
    if (evidence.attempts ? !evidence.attempts->contains(one.uuid) : rows.integer(9) == 0) continue;
    one.passed_then = one.passed_now = rows.integer(2) != 0;
    if (!rows.is_null(4)) {
      std::optional<KnownDecision> known;
      if (!evidence.decisions)
        known = decision_before(connection, one.row, given.position);
      else if (const auto at = evidence.decisions->find(one.uuid); at != evidence.decisions->end())
        known = at->second;
      if (known) one.passed_then = known->passed;
      if (known) one.decided_then = known->by;
      one.passed_now = rows.integer(5) != 0;
      if (!known || known->uuid != rows.text(4)) one.decided_now = rows.text(6);
      if (one.passed_then && !one.passed_now) doubts.push_back({one.uuid, rows.text(6), rows.text(7), rows.text(8)});
    }
    if (one.uuid == evidence.attempt && !evidence.row_hash.empty() && evidence.row_hash != rows.text(3))
      out.in_question = "the attempt that it cites is no longer the one that was certified";
    out.attempts.push_back(std::move(one));
  }
  std::set<std::string> others = evidence.attempts.value_or(std::set<std::string>{});
  for (const CertifiedBy& own : out.attempts) others.erase(own.uuid);
  for (const std::string& named : others) {
    sql::Statement other(connection,
                         "SELECT 1 FROM attempt a JOIN certificate c ON c.uuid = ? WHERE a.uuid = ? AND"
                         " a.trainee_id <> c.trainee_id");
    if (other.bind(certificate.uuid).bind(named).step())
      out.in_question = "attempt " + named + ", on which it stands, is another person's";
  }
  sql::Statement own(connection, "SELECT row_holds('certificate', id) FROM certificate WHERE uuid = ?");
  if (!own.bind(certificate.uuid).step() || own.integer(0) == 0)
    out.in_question = "it is not signed with the station's key, or was changed since";
  if (out.in_question.empty()) out.in_question = words_of(doubts, out.cited, out.attempts.size());
  return out;
}

std::set<std::string> certificates_beyond_doubt(const Database& database) {
  sqlite3* connection = database.connection();
  const sql::ReadSnapshot snapshot(connection);
  SoundAttempts sound(connection);
  RowEntries entries(connection, "certificate");
  sql::Statement rows(
      connection,
      "SELECT c.uuid, c.id, c.trainee_id, c.exercise_id, c.level, c.evidence FROM certificate c WHERE"
      " json_valid(c.evidence) AND json_type(c.evidence, '$.attempts') = 'array'"
      " AND NOT EXISTS (SELECT 1 FROM attempt a WHERE a.uuid = json_extract(c.evidence, '$.attempt') AND"
      " a.row_hash <> json_extract(c.evidence, '$.row_hash'))");
  std::set<std::string> out;
  while (rows.step()) {
    sound.look_up(rows.integer(2), rows.view(3), rows.view(4));
    if (sound.hold_all_of(rows.view(5)) && entries.of(rows.integer(1)) > 0) out.insert(rows.text(0));
  }
  return out;
}

std::vector<std::string> attempts_of_curve(const Database& database, const std::string& attempt_uuid) {
  std::vector<std::string> out;
  sql::Statement rows(database.connection(),
                      std::string("SELECT a.uuid FROM attempt a") + kOfCurve +
                          " AND a.trainee_id = e.trainee_id AND a.exercise_id = e.exercise_id AND a.level = e.level"
                          " ORDER BY a.id");
  rows.bind(attempt_uuid);
  while (rows.step()) out.push_back(rows.text(0));
  return out;
}

}  // namespace trocar
