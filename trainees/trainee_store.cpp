#include "trainees/trainee_store.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "trainees/attempt_identity.h"
#include "trainees/sqlite_handle.h"

namespace trocar {
namespace {

constexpr std::size_t kMaxCode = 32;

constexpr const char* kSelect =
    "SELECT t.id, t.uuid, t.code, t.created_utc, count(a.id), coalesce(sum(a.passed), 0), coalesce(max(a.started_utc), "
    "'')"
    " FROM trainee t LEFT JOIN attempt a ON a.trainee_id = t.id AND a.status <> 'running'";

void check_code(const std::string& code) {
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
  return trainee;
}

}  // namespace

Trainee TraineeStore::ensure_trainee(const std::string& code) {
  ensure_id(code);
  return find(code).value();
}

std::int64_t TraineeStore::ensure_id(const std::string& code) {
  check_code(code);
  sql::Statement known(connection_, "SELECT id FROM trainee WHERE code = ?");
  if (known.bind(code).step()) return known.integer(0);
  sql::Statement insert(connection_,
                        "INSERT INTO trainee (uuid, code, created_utc) VALUES (?, ?, ?) ON CONFLICT (code) DO NOTHING");
  insert.bind(make_uuid()).bind(code).bind(utc_now()).run();
  sql::Statement added(connection_, "SELECT id FROM trainee WHERE code = ?");
  added.bind(code).step();
  return added.integer(0);
}

std::optional<Trainee> TraineeStore::find(const std::string& code) const {
  sql::Statement row(connection_, std::string(kSelect) + " WHERE t.code = ? GROUP BY t.id");
  if (!row.bind(code).step()) return std::nullopt;
  return trainee_of(row);
}

std::vector<Trainee> TraineeStore::list() const {
  std::vector<Trainee> trainees;
  sql::Statement rows(connection_, std::string(kSelect) + " GROUP BY t.id ORDER BY t.code");
  while (rows.step()) trainees.push_back(trainee_of(rows));
  return trainees;
}

}  // namespace trocar
