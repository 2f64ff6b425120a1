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

struct Witness {
  std::int64_t position = 0;
  std::string row_hash, utc, key, signature;
};

Witness read_witness(const fs::path& file) {
  std::ifstream in(file);
  try {
    const Json json = Json::parse(in);
    if (json.at("format") != kFormat) throw InputError(file.string() + ": is no head of an audit trail");
    Witness out{json.at("position"), json.at("row_hash"), json.at("utc"), json.at("key"), json.at("signature")};
    if (!out.key.empty() && !signature_holds(out.key, head_text(out.row_hash), out.signature))
      throw InputError(file.string() + ": was changed: its signature does not hold");
    return out;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file.string() + ": is no head of an audit trail: " + error.what());
  }
}

}  // namespace

std::string exported_head(const Database& database) {
  sql::Statement row(database.connection(),
                     "SELECT position, row_hash, utc, signature FROM audit ORDER BY position DESC LIMIT 1");
  row.step();
  const auto keys = station_keys(database);
  const bool with_key = !keys.empty() && !row.text(3).empty();
  return Json{{"format", kFormat},
              {"position", row.integer(0)},
              {"row_hash", row.text(1)},
              {"utc", row.text(2)},
              {"key", with_key ? keys.back().public_key : ""},
              {"signature", row.text(3)}}
             .dump(2) +
         "\n";
}

std::vector<std::string> check_witness(const Database& database, const fs::path& file) {
  const Witness witness = read_witness(file);
  const std::string known = audit_hash(database.connection(), witness.position);
  const std::string entry = "entry " + std::to_string(witness.position) + " of " + witness.utc;
  if (known == witness.row_hash) return {};
  if (known.empty())
    return {"witness " + file.string() + ": the newest entries are missing, " + entry +
            " was there: an older copy was put back, or the end was cut off"};
  return {"witness " + file.string() + ": " + entry + " is another: the record was rewritten, or is another's"};
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
