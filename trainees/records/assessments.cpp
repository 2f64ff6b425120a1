#include "trainees/records/assessments.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "haptics/input_error.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/attempt_chain.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/printed_text.h"
#include "trainees/records/rating_scales.h"
#include "trainees/records/signing.h"
#include "trainees/records/verdicts.h"

namespace trocar {
namespace {

constexpr std::size_t kLongestEvidence = 200000;

struct FinishedAttempt {
  std::int64_t id = 0;
  std::string row_hash;
  bool ended_by_device = false;
};

/// @throws InputError: unknown, running, erased.
FinishedAttempt finished_attempt(sqlite3* connection, const std::string& uuid) {
  sql::Statement row(connection,
                     "SELECT id, row_hash, status, EXISTS (SELECT 1 FROM erasure e WHERE e.trainee_id = a.trainee_id"
                     " AND e.kind = 'training' AND row_holds('erasure', e.id)) FROM attempt a WHERE uuid = ?");
  if (!row.bind(uuid).step()) throw InputError("attempt " + uuid + ": not in this database");
  if (row.text(2) == "running") throw InputError("attempt " + uuid + ": is still running");
  if (row.integer(3) != 0) throw InputError("attempt " + uuid + ": its training data were erased");
  return {row.integer(0), row.text(1), row.text(2) == "fault" || row.text(2) == "void"};
}

/// Somebody who has not been erased.
std::int64_t trainee_id(sqlite3* connection, const std::string& code) {
  sql::Statement row(connection, "SELECT trainee_id FROM person WHERE code = ?");
  if (!row.bind(code).step()) throw InputError("trainee \"" + code + "\": there is none");
  require_person(connection, row.integer(0), code);
  return row.integer(0);
}

std::int64_t attempt_of(sqlite3* connection, std::int64_t trainee, const std::string& uuid) {
  sql::Statement row(connection, "SELECT id FROM attempt WHERE uuid = ? AND trainee_id = ?");
  if (!row.bind(uuid).bind(trainee).step()) throw InputError("attempt " + uuid + ": is none of this trainee's");
  return row.integer(0);
}

/// Inside a transaction. @param rating its uuid is made here.
void insert_rating(sqlite3* connection, const std::string& attempt_uuid, const Rating& rating) {
  const std::string uuid = next_row_uuid(connection, "rating");
  sql::Statement insert(connection,
                        "INSERT INTO rating (uuid, attempt_id, account_uuid, rater, scale, item, value, utc)"
                        " VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(uuid).bind(finished_attempt(connection, attempt_uuid).id).bind(rating.account_uuid).bind(rating.rater);
  insert.bind(rating.scale).bind(rating.item).bind(rating.value).bind(rating.utc).run();
  seal_row(connection, "rating", uuid, rating.account_uuid);
}

void check_rating(const RatingScale& scale, const std::string& item, double value) {
  const std::string what = "rating " + scale.name + ", " + item;
  const bool known =
      std::any_of(scale.items.begin(), scale.items.end(), [&](const RatingItem& i) { return i.name == item; });
  if (!known) throw InputError(what + ": the scale has no such item");
  if (!(value >= scale.least && value <= scale.most) || value != std::floor(value)) {
    throw InputError(what + ": a whole number from " + std::to_string(scale.least) + " to " +
                     std::to_string(scale.most) + " is needed");
  }
}

/// The attempts that it names are this trainee's, and as they were stored.
void check_named(sqlite3* connection, std::int64_t trainee, const nlohmann::json& attempts) {
  if (!attempts.is_array()) return;
  sql::Statement row(connection, "SELECT id, trainee_id FROM attempt WHERE uuid = ?");
  for (const nlohmann::json& one : attempts) {
    const std::string uuid = one.is_string() ? one.get<std::string>() : "";
    if (!row.bind(uuid).step() || row.integer(1) != trainee)
      throw InputError("certificate: attempt " + uuid + " is none of this trainee's");
    require_vouched(connection, row.integer(0), "certified");
    row.run();
  }
}

/// A certificate cites an attempt that counts as passed, whatever was decided in between.
void check_cited(sqlite3* connection, std::int64_t trainee, const std::string& evidence) {
  const nlohmann::json json = nlohmann::json::parse(evidence, nullptr, false);
  if (!json.is_object() || !json.contains("attempt") || !json["attempt"].is_string()) return;
  check_named(connection, trainee, nlohmann::json::array({json["attempt"]}));
  if (json.contains("attempts")) check_named(connection, trainee, json["attempts"]);
  const std::string uuid = json["attempt"].get<std::string>();
  sql::Statement row(connection, std::string("SELECT ") + sql::kPassed +
                                     ", coalesce(o.printed, ''), coalesce(o.utc, '') FROM attempt a"
                                     " LEFT JOIN score s ON s.attempt_id = a.id AND s.revision = 0" +
                                     sql::decision() + " WHERE a.uuid = ?");
  if (!row.bind(uuid).step() || row.integer(0) != 0) return;
  const std::string by =
      row.text(1).empty() ? "" : " by decision of " + row.text(1) + " on " + row.text(2).substr(0, 10);
  throw InputError("certificate: attempt " + uuid + " is not passed" + by + ", so it is no evidence; cite one that is");
}

constexpr const char* kNotes =
    "SELECT n.uuid, t.code, coalesce(a.uuid, ''), n.author, n.printed, n.text, n.utc, n.id, coalesce(s.utc, '')"
    " FROM note n JOIN known_trainee t ON t.id = n.trainee_id LEFT JOIN attempt a ON a.id = n.attempt_id"
    " LEFT JOIN note_seen s ON s.note_id = n.id WHERE t.code = ? COLLATE NOCASE";

/// Notes by what signed entries say of them and of their being met. Nothing is to be written while it lives.
class NoteReader {
 public:
  explicit NoteReader(sqlite3* connection)
      : entries_(connection, "note"), met_(connection), lost_(!lost_key(connection).empty()) {}

  /// @param row of kNotes.
  Note of(const sql::Statement& row) {
    return {row.text(0),
            row.text(1),
            row.text(2),
            row.text(3),
            row.text(4),
            row.text(5),
            row.text(6),
            lost_ && !row.view(8).empty() ? row.text(8) : met_.when(row.text(0)),  // what nothing here could sign
            entries_.of(row.integer(7)) > 0};
  }

  /// The first of the rows that may be shown to its trainee, who has not met it.
  std::optional<Note> first_unseen(sql::Statement& rows) {
    while (rows.step())
      if (Note note = of(rows); note.is_signed && note.seen_utc.empty()) return note;
    return std::nullopt;
  }

 private:
  RowEntries entries_;
  SeenEntries met_;
  bool lost_;
};

constexpr const char* kCertificates =
    "SELECT c.uuid, t.code, exercise_id, level, rule_version, evidence, c.author, c.printed, c.utc, coalesce(r.utc, "
    "''),"
    " coalesce(r.reason, '') FROM certificate c JOIN known_trainee t ON t.id = c.trainee_id"
    " LEFT JOIN revocation r ON r.certificate_id = c.id AND row_holds('revocation', r.id) WHERE (?1 = '' OR t.code = "
    "?1 COLLATE NOCASE) ORDER BY c.uuid "
    "DESC";

/// A form that was sent twice, or from two tabs: inside the transaction, so that only one of them can be first.
void refuse_second(sqlite3* connection, std::int64_t attempt, const std::string& meaning, const Author& author) {
  sql::Statement row(connection,
                     "SELECT signer, utc FROM signature WHERE attempt_id = ?1 AND meaning = ?2 AND account_uuid = ?3"
                     " AND (?3 <> '' OR signer = ?4) AND row_holds('signature', id)");
  if (!row.bind(attempt).bind(meaning).bind(author.account_uuid).bind(author.printed).step()) return;
  throw InputError("already signed: " + row.text(0) + " gave \"" + meaning + "\" on " + row.text(1) +
                   "; nothing was written");
}

/// Likewise of two desks at once. One that was revoked does not count, nor one that nobody signed.
void refuse_second_certificate(sqlite3* connection, std::int64_t trainee, const Certificate& wanted) {
  sql::Statement row(connection,
                     "SELECT printed, utc FROM certificate c WHERE trainee_id = ? AND exercise_id = ? AND level = ?"
                     " AND row_holds('certificate', c.id) AND NOT EXISTS (SELECT 1 FROM revocation r WHERE"
                     " r.certificate_id = c.id AND row_holds('revocation', r.id))");
  if (!row.bind(trainee).bind(wanted.exercise_id).bind(wanted.level).step()) return;
  throw InputError("trainee \"" + wanted.trainee + "\": holds a certificate for " + wanted.exercise_id + " at level " +
                   wanted.level + " already, by " + row.text(0) + " on " + row.text(1) + "; nothing was written");
}

Certificate certificate_of(const sql::Statement& row) {
  return {row.text(0), row.text(1), row.text(2), row.text(3), row.text(4), row.text(5),
          row.text(6), row.text(7), row.text(8), row.text(9), row.text(10)};
}

/// Within a transaction.
Note write_note(sqlite3* connection, const std::string& trainee, const std::string& attempt_uuid,
                const std::string& text, const Author& author) {
  check_prose("note", text);
  check_printed("author", author.printed);
  const Note note{
      next_row_uuid(connection, "note"), trainee, attempt_uuid, author.account_uuid, author.printed, text, utc_now()};
  const std::int64_t id = trainee_id(connection, trainee);
  sql::Statement insert(connection,
                        "INSERT INTO note (uuid, trainee_id, attempt_id, author, printed, text, utc)"
                        " VALUES (?, ?, ?, ?, ?, ?, ?)");
  insert.bind(note.uuid).bind(id);
  if (attempt_uuid.empty())
    insert.bind_null();
  else
    insert.bind(attempt_of(connection, id, attempt_uuid));
  insert.bind(note.author).bind(note.printed).bind(note.text).bind(note.utc).run();
  seal_row(connection, "note", note.uuid, author.account_uuid);
  return note;
}

}  // namespace

Note AssessmentStore::add_note(const std::string& trainee, const std::string& attempt_uuid, const std::string& text,
                               const Author& author) {
  AnchoredTransaction transaction(*database_);
  require_key(*database_);
  const Note note = write_note(database_->connection(), trainee, attempt_uuid, text, author);
  transaction.commit();
  return note;
}

Note AssessmentStore::add_message(const std::string& trainee, const std::string& text, const Author& author) {
  if (text.size() > kLongestMessage)
    throw InputError("a message has at most " + std::to_string(kLongestMessage) +
                     " characters: it is read in passing. Write a note for more");
  if (text.find_first_of("\r\n") != std::string::npos) throw InputError("a message is one line");
  AnchoredTransaction transaction(*database_);
  require_key(*database_);
  const Note note = write_note(database_->connection(), trainee, "", text, author);
  append_audit(database_->connection(), kActionMessage, note.uuid, "",
               author.account_uuid.empty() ? "trocar" : author.account_uuid);
  transaction.commit();
  return note;
}

std::optional<Note> AssessmentStore::unseen_message(const std::string& trainee) const {
  sql::Statement row(database_->connection(), std::string(kNotes) +
                                                  " AND EXISTS (SELECT 1 FROM audit u"
                                                  " WHERE u.subject = n.uuid AND u.action = ?) ORDER BY n.uuid");
  row.bind(trainee).bind(kActionMessage);
  return NoteReader(database_->connection()).first_unseen(row);
}

std::vector<Note> AssessmentStore::notes_of(const std::string& trainee) const {
  std::vector<Note> notes;
  sql::Statement rows(database_->connection(), std::string(kNotes) + " ORDER BY n.uuid DESC");
  rows.bind(trainee);
  NoteReader reader(database_->connection());
  while (rows.step()) notes.push_back(reader.of(rows));
  return notes;
}

std::optional<Note> AssessmentStore::newest_unseen(const std::string& trainee) const {
  sql::Statement rows(database_->connection(), std::string(kNotes) + " ORDER BY n.uuid DESC");
  rows.bind(trainee);
  return NoteReader(database_->connection()).first_unseen(rows);
}

void AssessmentStore::mark_seen(const std::string& note_uuid) {
  sqlite3* connection = database_->connection();
  AnchoredTransaction transaction(*database_);
  {
    sql::Statement known(connection, "SELECT 1 FROM note WHERE uuid = ?");
    if (!known.bind(note_uuid).step()) throw InputError("note " + note_uuid + ": not in this database");
  }
  if (keep_note_seen(connection, note_uuid, utc_now())) transaction.commit();
}

void AssessmentStore::add_rating(const std::string& attempt_uuid, const std::string& scale, const std::string& item,
                                 double value, const Author& author) {
  check_printed("scale", scale);
  check_printed("item", item);
  check_printed("author", author.printed);
  if (!std::isfinite(value)) throw InputError("rating " + scale + ", " + item + ": is not a number");
  AnchoredTransaction transaction(*database_);
  require_key(*database_);
  insert_rating(database_->connection(), attempt_uuid,
                {"", author.account_uuid, author.printed, scale, item, utc_now(), value});
  transaction.commit();
}

void AssessmentStore::rate(const std::string& attempt_uuid, const std::string& scale_name,
                           const std::map<std::string, double>& values, const Author& author) {
  const RatingScale& scale = rating_scale(scale_name);
  check_printed("author", author.printed);
  if (values.empty()) throw InputError("rating " + scale.name + ": no item was rated");
  for (const auto& [item, value] : values) check_rating(scale, item, value);
  const std::string now = utc_now();
  AnchoredTransaction transaction(*database_);
  require_key(*database_);
  for (const RatingItem& item : scale.items) {
    const auto value = values.find(item.name);
    if (value == values.end()) continue;
    insert_rating(database_->connection(), attempt_uuid,
                  {"", author.account_uuid, author.printed, scale.name, item.name, now, value->second});
  }
  transaction.commit();
}

std::vector<Rating> AssessmentStore::ratings_of(const std::string& attempt_uuid) const {
  std::vector<Rating> ratings;
  sql::Statement rows(database_->connection(),
                      "SELECT r.uuid, account_uuid, rater, scale, item, utc, value FROM rating r"
                      " JOIN attempt a ON a.id = r.attempt_id WHERE a.uuid = ? ORDER BY r.uuid");
  rows.bind(attempt_uuid);
  while (rows.step()) {
    ratings.push_back(
        {rows.text(0), rows.text(1), rows.text(2), rows.text(3), rows.text(4), rows.text(5), rows.real(6)});
  }
  return ratings;
}

Signature AssessmentStore::sign(const std::string& attempt_uuid, const std::string& meaning, const std::string& note,
                                const Author& author) {
  if (meaning != "review" && meaning != "approval" && meaning != "responsibility" && meaning != "authorship") {
    throw InputError("signature: its meaning is review, approval, responsibility or authorship, not \"" + meaning +
                     "\"");
  }
  check_printed("signer", author.printed);
  if (!note.empty()) check_prose("signature's note", note);
  sqlite3* connection = database_->connection();
  AnchoredTransaction transaction(*database_);
  require_signature(*database_, author.account_uuid);
  const FinishedAttempt attempt = finished_attempt(connection, attempt_uuid);
  require_vouched(connection, attempt.id, "signed");
  refuse_second(connection, attempt.id, meaning, author);
  const Signature signature{next_row_uuid(connection, "signature"),
                            attempt.row_hash,
                            author.account_uuid,
                            author.printed,
                            meaning,
                            note,
                            utc_now()};
  sql::Statement insert(connection,
                        "INSERT INTO signature (uuid, attempt_id, row_hash, account_uuid, signer, meaning, note, utc)"
                        " VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(signature.uuid)
      .bind(attempt.id)
      .bind(signature.row_hash)
      .bind(signature.account_uuid)
      .bind(signature.signer);
  insert.bind(meaning).bind(note).bind(signature.utc).run();
  seal_row(connection, "signature", signature.uuid, author.account_uuid);
  transaction.commit();
  return signature;
}

std::vector<Signature> AssessmentStore::signatures_of(const std::string& attempt_uuid) const {
  std::vector<Signature> signatures;
  sql::Statement rows(database_->connection(),
                      "SELECT s.uuid, s.row_hash, account_uuid, signer, meaning, note, utc FROM signature s"
                      " JOIN attempt a ON a.id = s.attempt_id WHERE a.uuid = ? ORDER BY s.uuid");
  rows.bind(attempt_uuid);
  while (rows.step()) {
    signatures.push_back(
        {rows.text(0), rows.text(1), rows.text(2), rows.text(3), rows.text(4), rows.text(5), rows.text(6)});
  }
  return signatures;
}

VerdictOverride AssessmentStore::override_verdict(const std::string& attempt_uuid, bool passed,
                                                  const std::string& reason, const Author& author) {
  check_reason(reason);
  check_printed("author", author.printed);
  sqlite3* connection = database_->connection();
  AnchoredTransaction transaction(*database_);
  const VerdictOverride verdict{
      next_row_uuid(connection, "verdict_override"), author.account_uuid, author.printed, reason, utc_now(), passed};
  require_signature(*database_, author.account_uuid);
  const FinishedAttempt attempt = finished_attempt(connection, attempt_uuid);
  if (attempt.ended_by_device) {
    throw InputError("attempt " + attempt_uuid +
                     ": was ended by the device or is void; it counts for nothing, so there is nothing to decide");
  }
  require_vouched(connection, attempt.id, "decided");
  sql::Statement insert(
      connection,
      "INSERT INTO verdict_override (uuid, attempt_id, row_hash, author, printed, passed, reason, utc)"
      " VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(verdict.uuid)
      .bind(attempt.id)
      .bind(attempt.row_hash)
      .bind(verdict.author)
      .bind(verdict.printed)
      .bind(passed);
  insert.bind(reason).bind(verdict.utc).run();
  seal_row(connection, "verdict_override", verdict.uuid, author.account_uuid);
  transaction.commit();
  return verdict;
}

std::vector<VerdictOverride> AssessmentStore::overrides_of(const std::string& attempt_uuid) const {
  std::vector<VerdictOverride> verdicts;
  sql::Statement rows(database_->connection(),
                      "SELECT o.uuid, author, printed, reason, utc, passed FROM verdict_override o JOIN attempt a ON "
                      "a.id = o.attempt_id WHERE a.uuid = ? AND row_holds('verdict_override', o.id)" +
                          newest_first("verdict_override", "o", "attempt_id"));
  rows.bind(attempt_uuid);
  while (rows.step())
    verdicts.push_back({rows.text(0), rows.text(1), rows.text(2), rows.text(3), rows.text(4), rows.integer(5) != 0});
  return verdicts;
}

Certificate AssessmentStore::certify(const std::string& trainee, const std::string& exercise_id,
                                     const std::string& level, const std::string& rule_version,
                                     const std::string& evidence, const Author& author) {
  check_printed("level", level);
  check_printed("rule", rule_version);
  check_prose("evidence", evidence, kLongestEvidence);
  check_printed("author", author.printed);
  sqlite3* connection = database_->connection();
  AnchoredTransaction transaction(*database_);
  const Certificate certificate{next_row_uuid(connection, "certificate"),
                                trainee,
                                exercise_id,
                                level,
                                rule_version,
                                evidence,
                                author.account_uuid,
                                author.printed,
                                utc_now()};
  require_signature(*database_, author.account_uuid);
  const std::int64_t id = trainee_id(connection, trainee);
  {
    sql::Statement known(connection, "SELECT 1 FROM exercise WHERE id = ?");
    if (!known.bind(exercise_id).step())
      throw InputError("exercise " + exercise_id + ": nobody has tried it in this database");
  }
  refuse_second_certificate(connection, id, certificate);
  check_cited(connection, id, evidence);
  sql::Statement insert(connection,
                        "INSERT INTO certificate (uuid, trainee_id, exercise_id, level, rule_version, evidence, author,"
                        " printed, utc) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(certificate.uuid).bind(id).bind(exercise_id).bind(level).bind(rule_version).bind(evidence);
  insert.bind(certificate.author).bind(certificate.printed).bind(certificate.utc).run();
  seal_row(connection, "certificate", certificate.uuid, author.account_uuid);
  transaction.commit();
  return certificate;
}

void AssessmentStore::revoke(const std::string& certificate_uuid, const std::string& reason, const Author& author) {
  check_reason(reason);
  check_printed("author", author.printed);
  sqlite3* connection = database_->connection();
  AnchoredTransaction transaction(*database_);
  require_signature(*database_, author.account_uuid);
  const std::string uuid = next_row_uuid(connection, "revocation");
  {
    sql::Statement known(connection,
                         "SELECT r.utc FROM certificate c LEFT JOIN revocation r ON r.certificate_id = c.id AND"
                         " row_holds('revocation', r.id) WHERE c.uuid = ?");
    if (!known.bind(certificate_uuid).step())
      throw InputError("certificate " + certificate_uuid + ": not in this database");
    if (!known.is_null(0)) throw InputError("certificate " + certificate_uuid + ": was revoked on " + known.text(0));
  }
  sql::Statement insert(connection,
                        "INSERT INTO revocation (uuid, certificate_id, author, printed, reason, utc)"
                        " SELECT ?, id, ?, ?, ?, ? FROM certificate WHERE uuid = ?");
  insert.bind(uuid)
      .bind(author.account_uuid)
      .bind(author.printed)
      .bind(reason)
      .bind(utc_now())
      .bind(certificate_uuid)
      .run();
  seal_row(connection, "revocation", uuid, author.account_uuid);
  transaction.commit();
}

std::vector<Certificate> AssessmentStore::certificates_of(const std::string& trainee) const {
  std::vector<Certificate> certificates;
  sql::Statement rows(database_->connection(), kCertificates);
  rows.bind(trainee);
  while (rows.step()) certificates.push_back(certificate_of(rows));
  return certificates;
}

}  // namespace trocar
