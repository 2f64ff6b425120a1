#include "trainees/store/record_files.h"

#include <string>

#include "trainees/files/owner_file.h"
#include "trainees/integrity/station_key.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolders[] = {".recordings", ".films", ".live"};

/// "trocar.db", "trocar.db-wal", "trocar.db.anchor", "trocar.db.schema3.backup", but not "trocar.db2"; nor the key,
/// which is refused where it stood open, not closed: who has read it can sign.
bool of_database(const std::string& name, const std::string& database) {
  if (!name.starts_with(database) || name == key_path(database).string()) return false;
  return name.size() == database.size() || name[database.size()] == '-' || name[database.size()] == '.';
}

void add_open_files(const fs::path& folder, const std::string& database, std::vector<fs::path>& to) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (!database.empty() && !of_database(it->path().filename().string(), database)) continue;
    if (it->is_regular_file(error) && !it->is_symlink(error) && open_to_others(it->path())) to.push_back(it->path());
  }
}

}  // namespace

std::vector<fs::path> record_files_open_to_others(const fs::path& database) {
  std::vector<fs::path> out;
  if (database.empty()) return out;
  const fs::path whole = fs::absolute(database);
  add_open_files(whole.parent_path(), whole.filename().string(), out);
  if (fs::is_symlink(whole) && open_to_others(whole)) out.push_back(whole);
  for (const char* ending : kFolders) {
    const fs::path folder = whole.parent_path() / (whole.stem().string() + ending);
    if (!open_to_others(folder)) continue;
    add_open_files(folder, "", out);
    out.push_back(folder);
  }
  return out;
}

}  // namespace trocar
