#include "trainees/records/trainee_store.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/printed_text.h"
#include "trainees/records/replica_facts.h"
#include "trainees/records/signing.h"
#include "trainees/records/verdicts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

constexpr std::size_t kMaxCode = 32, kLongestAddress = 254;

std::string trainees_query() {
  return std::string("SELECT t.id, t.uuid, t.code, t.created_utc, count(a.id), coalesce(sum(") + sql::kPassed +
         "), 0), coalesce(max(a.started_utc), ''), coalesce(p.name, ''), coalesce(p.email, '') FROM known_trainee t"
         " LEFT JOIN person p ON p.trainee_id = t.id"
         " LEFT JOIN attempt a ON a.trainee_id = t.id AND a.status <> 'running'"
         " LEFT JOIN score s ON s.attempt_id = a.id AND s.revision = 0" +
         sql::decision();
}

Trainee trainee_of(const sql::Statement& row) {
  Trainee trainee;
  trainee.id = row.integer(0);
  trainee.uuid = row.text(1);
  trainee.code = row.text(2);
  trainee.created_utc = row.text(3);
  trainee.attempts = static_cast<int>(row.integer(4));
  trainee.passes = static_cast<int>(row.integer(5));
  trainee.last_utc = row.text(6);
  trainee.name = row.text(7);
  trainee.email = row.text(8);
  return trainee;
}

}  // namespace

void check_trainee_code(const std::string& code) {
  const auto letter_or_digit = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  const auto allowed = [&](char c) { return letter_or_digit(c) || c == '.' || c == '-' || c == '_'; };
  if (code.empty() || code.size() > kMaxCode || !letter_or_digit(code[0]) ||
      !std::all_of(code.begin(), code.end(), allowed)) {
    throw InputError("trainee code \"" + code +
                     "\": give 1 to 32 letters, digits, '.', '-' or '_', beginning with a "
                     "letter or digit");
  }
  std::string lower = code;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (lower.starts_with("erased-")) {
    throw InputError("trainee code \"" + code + "\": \"erased-...\" stands for somebody whose identity was erased");
  }
}

void check_address(const std::string& email) {
  check_printed("e-mail address", email, kLongestAddress);
  const std::size_t at = email.find('@');
  if (at != std::string::npos && at > 0 && at + 1 < email.size() &&
      email.find_first_of(" @", at + 1) == std::string::npos && email.find(' ') == std::string::npos)
    return;
  throw InputError("e-mail address \"" + email + "\": is none, such as name@example.org");
}

Trainee TraineeStore::ensure_trainee(const std::string& code) {
  AnchoredTransaction transaction(*database_);
  ensure_id(code);
  transaction.commit();
  return find(code).value();
}

std::int64_t TraineeStore::ensure_id(const std::string& code) {
  check_trainee_code(code);
  sql::Statement known(connection_, "SELECT trainee_id FROM person WHERE code = ?");
  if (known.bind(code).step()) {
    require_person(connection_, known.integer(0), code);
    return known.integer(0);
  }
  require_no_replica(connection_);
  const std::string uuid = make_uuid();
  sql::Statement trainee(connection_, "INSERT INTO trainee (uuid, created_utc) VALUES (?, ?)");
  trainee.bind(uuid).bind(utc_now()).run();
  sql::Statement person(connection_, "INSERT INTO person (trainee_id, code) SELECT id, ? FROM trainee WHERE uuid = ?");
  person.bind(code).bind(uuid).run();
  keep_trainee(connection_, uuid);
  sql::Statement added(connection_, "SELECT trainee_id FROM person WHERE code = ?");
  added.bind(code).step();
  return added.integer(0);
}

std::optional<Trainee> TraineeStore::find(const std::string& name) const {
  sql::Statement row(connection_,
                     trainees_query() + " WHERE t.code = ?1 COLLATE NOCASE OR t.uuid = lower(?1) GROUP BY t.id");
  if (!row.bind(name).step()) return std::nullopt;
  return trainee_of(row);
}

Trainee TraineeStore::edit(const std::string& code, const std::optional<std::string>& name,
                           const std::optional<std::string>& email, const std::string& author,
                           const std::function<void(const Trainee&)>& check) {
  if (!name && !email)
    throw InputError("trainee \"" + code + "\": say what is to change, the name or the e-mail address");
  if (name && !name->empty()) check_printed("name", *name);
  if (email && !email->empty()) check_address(*email);
  AnchoredTransaction transaction(*database_);
  require_key(*database_);
  const auto known = find(code);
  if (!known) throw InputError("trainee \"" + code + "\": there is none");
  if (check) check(*known);
  if (!person_holds(connection_, known->uuid))
    throw InputError("trainee \"" + code + "\": was changed by another way; see trocar db check");
  sql::Statement change(connection_, "UPDATE person SET name = ?1, email = ?2 WHERE trainee_id = ?3 RETURNING 1");
  if (!change.bind(name.value_or(known->name)).bind(email.value_or(known->email)).bind(known->id).step())
    throw InputError("trainee \"" + known->code + "\": the identity was erased");
  change.run();
  if (name.value_or(known->name) == known->name && email.value_or(known->email) == known->email)
    return *known;  // as it was
  keep_person(connection_, known->uuid, author);
  transaction.commit();
  return find(known->uuid).value();
}

std::vector<Trainee> TraineeStore::list() const {
  std::vector<Trainee> trainees;
  sql::Statement rows(connection_, trainees_query() + " GROUP BY t.id ORDER BY t.code");
  while (rows.step()) trainees.push_back(trainee_of(rows));
  return trainees;
}

}  // namespace trocar
