#include "trainees/integrity/station_key.h"

#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"
#include "trainees/integrity/audit.h"
#include "trainees/store/disk_full.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTitle = "Trocar, key of a station: keep it secret";

/// The key that was read last: each entry of the trail asks for it, and deriving it costs as much as signing. Good for
/// as long as the file is the same one, unchanged.
struct KeptKey {
  std::string file;
  dev_t device = 0;
  ino_t inode = 0;
  timespec changed = {};
  std::optional<SigningKey> key = {};

  bool holds(const fs::path& path, const struct stat& about) const {
    return key && file == path && device == about.st_dev && inode == about.st_ino &&
           changed.tv_sec == about.st_ctim.tv_sec && changed.tv_nsec == about.st_ctim.tv_nsec;
  }
};
thread_local KeptKey kept_key;

/// Who owns a file writes and reads it, whatever its rights: the key must be of whoever runs this, of root, or of who
/// owns the record itself.
void require_own(const fs::path& file, const struct stat& about, const fs::path& database) {
  struct stat record {};
  if (about.st_uid == ::geteuid() || about.st_uid == 0) return;
  if (::stat(database.c_str(), &record) == 0 && record.st_uid == about.st_uid) return;
  throw EnvironmentError(file.string() +
                         ": the station's key belongs to another user than the record, who can read it; chown it, and "
                         "make a new one: trocar db key --renew");
}

void require_secret(const fs::path& file, const struct stat& about) {
  if ((about.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    throw EnvironmentError(file.string() +
                           ": the station's key can be read by others; chmod 600 it, and if others may "
                           "have read it, make a new one: trocar db key --renew");
}

}  // namespace

fs::path key_path(const fs::path& database) { return database.string() + ".key"; }

std::optional<SigningKey> station_key(const fs::path& database) {
  const fs::path file = key_path(database);
  struct stat about {};
  if (database.empty() || ::stat(file.c_str(), &about) != 0) return std::nullopt;
  if (kept_key.holds(file, about)) return kept_key.key;
  require_secret(file, about);
  require_own(file, about, database);
  std::ifstream in(file);
  if (!in) throw EnvironmentError(file.string() + ": the station's key cannot be read: " + std::strerror(errno));
  std::string title, seed;
  std::getline(in, title);
  std::getline(in, seed);
  const auto key = title == kTitle ? SigningKey::of_seed(seed) : std::nullopt;
  if (!key) throw InputError(file.string() + ": is not the key of a station");
  kept_key = {file.string(), about.st_dev, about.st_ino, about.st_ctim, key};
  return key;
}

std::optional<SigningKey> station_key(sqlite3* connection) {
  const char* file = sqlite3_db_filename(connection, "main");
  return file == nullptr ? std::nullopt : station_key(fs::path(file));
}

SigningKey make_station_key(const fs::path& database) {
  if (const auto there = station_key(database)) return *there;
  const SigningKey key = SigningKey::make();
  write_station_key(database, key);
  return key;
}

void write_station_key(const fs::path& database, const SigningKey& key) {
  const fs::path file = key_path(database);
  std::ofstream out = open_owner_file(file);
  out << kTitle << '\n' << key.seed() << '\n' << std::flush;
  if (!out) {
    const int reason = errno;
    std::error_code ignored;
    fs::remove(file, ignored);
    const std::string message = file.string() + ": the station's key cannot be written: " + std::strerror(reason);
    if (is_disk_full(reason)) throw DiskFull(message);
    throw EnvironmentError(message);
  }
}

bool is_named(const SigningKey& key, const std::vector<AnnouncedKey>& named) {
  return std::ranges::find(named, key.public_key(), &AnnouncedKey::public_key) != named.end();
}

std::string lost_key(sqlite3* connection) {
  const char* file = sqlite3_db_filename(connection, "main");
  if (file == nullptr || *file == '\0') return "";
  const std::vector<AnnouncedKey> named = announced_keys(connection);
  if (named.empty()) return "";
  const std::string name = key_path(file).filename().string();
  if (!fs::exists(key_path(file)))
    return "its key " + name +
           " is missing: what is written now is not signed, which db check tells for ever. "
           "Put it back, or make a new one with trocar db key --renew";
  const auto key = station_key(connection);
  if (key && !is_named(*key, named))
    return "its key " + name +
           " is not the one that signs this record: what is written now does not count. "
           "Put the right one back, or make a new one with trocar db key --renew";
  return "";
}

std::vector<AnnouncedKey> announced_keys(sqlite3* connection) {
  std::vector<AnnouncedKey> out;
  sql::Statement rows(connection,
                      "SELECT 1, detail FROM audit WHERE position = 1 AND action = ?1 AND detail <> ''"
                      " UNION ALL SELECT position, detail FROM audit WHERE subject = ?2 AND action = ?2 AND"
                      " position > 0 ORDER BY 1");
  rows.bind(kActionMade).bind(kActionKey);
  while (rows.step()) out.push_back({rows.integer(0), rows.text(1)});
  return out;
}

}  // namespace trocar
