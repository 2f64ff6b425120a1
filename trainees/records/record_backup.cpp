#include "trainees/records/record_backup.h"

#include <sqlite3.h>

#include <memory>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"
#include "trainees/files/size_text.h"
#include "trainees/integrity/anchor_file.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/replica_facts.h"
#include "trainees/store/disk_full.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

struct Named {
  std::string uuid, sha256;
  fs::path file;
};

/// Files that the attempts of a connection name, as they lie beside `database`.
std::vector<Named> named_recordings(sqlite3* connection, const fs::path& database) {
  std::vector<Named> out;
  sql::Statement rows(
      connection, "SELECT recording_path, uuid, recording_sha256 FROM attempt WHERE recording_path <> '' ORDER BY id");
  while (rows.step()) out.push_back({rows.text(1), rows.text(2), recording_here(database, rows.text(0), rows.text(1))});
  return out;
}

/// Of the copy: an attempt that began after it would be none of its own.
std::vector<Named> recordings_of_copy(const fs::path& copy, const fs::path& database) {
  sqlite3* raw = nullptr;
  const int code = sqlite3_open_v2(copy.c_str(), &raw, SQLITE_OPEN_READONLY, nullptr);
  const std::unique_ptr<sqlite3, int (*)(sqlite3*)> connection(raw, sqlite3_close_v2);
  if (code != SQLITE_OK) throw EnvironmentError(copy.string() + ": cannot be opened: " + sqlite3_errstr(code));
  return named_recordings(raw, database);
}

std::uintmax_t size_of(const std::vector<Named>& all) {
  std::uintmax_t out = 0;
  for (const Named& one : all) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(one.file, error);
    if (!error) out += size;
  }
  return out;
}

void require_room(const fs::path& to, std::uintmax_t bytes) {
  std::error_code error;
  const fs::space_info room = fs::space(to.parent_path(), error);
  if (error || room.available >= bytes) return;
  throw DiskFull(to.string() + ": the recordings need " + size_text(bytes) + " and " + size_text(room.available) +
                 " are free there; give a place on a larger disk, or leave the recordings out");
}

/// Under the attempt's name: those that somebody chose may be the same in two folders.
void copy_recordings(const std::vector<Named>& all, const fs::path& database, BackupReport& report) {
  for (const Named& one : all) {
    std::error_code error;
    // A row may have been changed to name any file of whoever makes the backup.
    const bool own = one.file == fetched_recording(database, one.uuid);
    if (!is_name_of_attempt(one.uuid) || !fs::is_regular_file(one.file, error) ||
        (!own && digest::of_readable_file(one.file) != one.sha256)) {
      report.missing.push_back(one.file);
      continue;
    }
    const fs::path target = report.recordings / (one.uuid + ".trec");
    const bool copied = fs::copy_file(one.file, target, error);
    if (!copied && is_disk_full(error.value())) throw DiskFull(no_room_for_backup(target));
    if (!copied) throw EnvironmentError(target.string() + ": the backup cannot be written: " + error.message());
    close_to_others(target);
    ++report.files;
    report.bytes += fs::file_size(target, error);
  }
}

/// What was begun, unless it became whole.
class Begun {
 public:
  Begun(fs::path copy, fs::path recordings) : copy_(std::move(copy)), recordings_(std::move(recordings)) {}
  ~Begun() {
    if (whole) return;
    std::error_code ignored;
    fs::remove_all(recordings_, ignored);
    fs::remove(anchor_path(copy_), ignored);
    fs::remove(key_path(copy_), ignored);
    fs::remove(copy_, ignored);
  }
  Begun(const Begun&) = delete;
  Begun& operator=(const Begun&) = delete;
  bool whole = false;

 private:
  fs::path copy_, recordings_;
};

}  // namespace

std::uintmax_t recordings_size(const Database& database) {
  return size_of(named_recordings(database.connection(), database.file()));
}

BackupReport back_up(const Database& database, const fs::path& to, BackedUp what) {
  const fs::path copy = fs::absolute(to).lexically_normal(), folder = recordings_folder(copy);
  BackupReport report;
  if (what == BackedUp::kWithRecordings && fs::exists(folder))
    throw InputError(folder.string() + ": exists already; a backup never overwrites");
  database.backup(copy);
  if (what == BackedUp::kWithoutRecordings) return report;
  Begun begun(copy, folder);
  const std::vector<Named> all = recordings_of_copy(copy, database.file());
  if (!all.empty()) {
    require_room(folder, size_of(all));
    report.recordings = folder;
    if (!make_owner_folders(folder)) throw EnvironmentError(folder.string() + ": cannot be made");
    copy_recordings(all, database.file(), report);
  }
  begun.whole = true;
  return report;
}

}  // namespace trocar
