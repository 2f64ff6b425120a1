#include "trainees/integrity/witness.h"

#include <fstream>

#include <nlohmann/json.hpp>

#include "haptics/input_error.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/audit.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "trocar-head-1";
constexpr std::size_t kShown = 16;

SignedHead read_witness(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file.string() + ": the witness cannot be read: is it there?");
  try {
    const Json json = Json::parse(in);
    if (json.at("format") != kFormat) throw InputError(file.string() + ": is no head of an audit trail");
    SignedHead out{json.at("position"), json.at("row_hash"), json.at("utc"), json.at("key"), json.at("signature")};
    if (!head_holds(out)) throw InputError(file.string() + ": was changed: its signature does not hold");
    return out;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file.string() + ": is no head of an audit trail: " + error.what());
  }
}

}  // namespace

SignedHead head_at(const Database& database, std::int64_t position) {
  sql::Statement row(database.connection(), "SELECT position, row_hash, utc, signature FROM audit WHERE position = ?");
  row.bind(position).step();
  SignedHead head{row.integer(0), row.text(1), row.text(2), "", row.text(3)};
  for (const AnnouncedKey& key : station_keys(database))
    if (!head.signature.empty() && key.position <= position) head.key = key.public_key;
  return head;
}

bool head_holds(const SignedHead& head) {
  return head.key.empty() || signature_holds(head.key, head_text(head.row_hash), head.signature);
}

std::string check_head(const Database& database, const SignedHead& head, const std::string& from) {
  const std::string known = audit_hash(database.connection(), head.position);
  const std::string entry = "entry " + std::to_string(head.position) + " of " + head.utc;
  if (!known.empty() && known == head.row_hash) return "";
  if (known.empty())
    return "witness " + from + ": the newest entries are missing, " + entry +
           " was there: an older copy was put back, or the end was cut off";
  return "witness " + from + ": " + entry + " is another: the record was rewritten, or is another's";
}

std::string exported_head(const Database& database) {
  if (!trail_whole(database.connection(), 0))
    throw InputError(database.file().string() +
                     ": the audit trail is not whole, so its head is no witness; see trocar db check");
  const SignedHead head = head_at(database, audit_head(database.connection()).position);
  return Json{{"format", kFormat}, {"position", head.position}, {"row_hash", head.row_hash},
              {"utc", head.utc},   {"key", head.key},           {"signature", head.signature}}
             .dump(2) +
         "\n";
}

std::vector<std::string> check_witness(const Database& database, const fs::path& file) {
  const SignedHead head = read_witness(file);
  if (head.key.empty() && !station_keys(database).empty())
    throw InputError(file.string() + ": is not signed, as every head of this record is");
  const std::string problem = check_head(database, head, file.string());
  return problem.empty() ? std::vector<std::string>{} : std::vector<std::string>{problem};
}

std::vector<AnnouncedKey> station_keys(const Database& database) { return announced_keys(database.connection()); }

void renew_station_key(Database& database) {
  const fs::path file = key_path(database.file());
  const auto keys = station_keys(database);
  AnchoredTransaction transaction(database);
  if (std::error_code error; fs::exists(file, error)) {
    const fs::path old = file.string() + "." + (keys.empty() ? "old" : key_words(keys.back().public_key));
    fs::rename(file, old, error);
    if (error) throw EnvironmentError(file.string() + ": cannot be moved to " + old.string() + ": " + error.message());
  }
  append_audit(database.connection(), kActionKey, kActionKey, make_station_key(database.file()).public_key());
  transaction.commit();
}

std::string key_words(const std::string& digits) { return digits.substr(0, kShown); }

}  // namespace trocar
