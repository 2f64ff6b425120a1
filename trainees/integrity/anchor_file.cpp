#include "trainees/integrity/anchor_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/store/disk_full.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr char kTorn = '~';  // ends a line that a crash or a full disk cut off

struct AnchorLine {
  AuditHead head;
  std::string utc;
};

std::optional<AnchorLine> parse_line(const std::string& line) {
  std::istringstream words(line);
  AnchorLine anchor;
  std::string more;
  if (!(words >> anchor.head.position >> anchor.head.row_hash >> anchor.utc) || words >> more) return std::nullopt;
  return anchor;
}

/// What one line says against the trail, "" when nothing.
std::string problem_of(const AnchorLine& line, sqlite3* connection) {
  const std::string known = audit_hash(connection, line.head.position);
  const std::string entry = "entry " + std::to_string(line.head.position) + " of " + line.utc;
  if (known.empty()) return "the newest entries are missing: " + entry + " is anchored";
  return known == line.head.row_hash ? "" : entry + " is not the one that was anchored";
}

/// Open for appending or reading; a link, pipe or device in its place is none, and nobody waits for it.
/// @returns -1 where there is none.
int opened_anchor(const fs::path& database, int flags) {
  const int file = ::open(anchor_path(database).c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
  struct stat about {};
  if (file < 0 || (::fstat(file, &about) == 0 && S_ISREG(about.st_mode))) return file;
  ::close(file);
  return -1;
}

}  // namespace

fs::path anchor_path(const fs::path& database) { return database.string() + ".anchor"; }

void append_anchor(const fs::path& database, const AuditHead& head) {
  if (database.empty()) return;
  std::string line = std::to_string(head.position) + " " + head.row_hash + " " + utc_now() + "\n";
  const int file = opened_anchor(database, O_RDWR | O_CREAT | O_APPEND);
  if (file < 0) return;
  char last = '\n';
  const off_t size = ::lseek(file, 0, SEEK_END);
  if (size > 0 && ::pread(file, &last, 1, size - 1) == 1 && last != '\n') line = kTorn + ("\n" + line);
  // One write to a file opened for appending: lines of two programs do not mix.
  [[maybe_unused]] const ssize_t written = ::write(file, line.data(), line.size());
  ::close(file);
}

std::string read_anchor(const fs::path& database) {
  const int file = opened_anchor(database, O_RDONLY);
  if (file < 0) return "";
  std::string text;
  char bytes[65536];
  for (ssize_t n = 0; (n = ::read(file, bytes, sizeof bytes)) > 0;) text.append(bytes, static_cast<std::size_t>(n));
  ::close(file);
  return text;
}

void write_anchor(const fs::path& database, const std::string& text) {
  if (text.empty()) return;
  std::ofstream out = open_owner_file(anchor_path(database));
  out << text << std::flush;
  if (out) return;
  const int reason = errno;
  const std::string message = anchor_path(database).string() + ": cannot be written: " + std::strerror(reason);
  if (is_disk_full(reason)) throw DiskFull(message);
  throw EnvironmentError(message);
}

std::vector<std::string> check_anchor(const fs::path& database, sqlite3* connection) {
  if (database.empty() || audit_head(connection).position == 0) return {};
  const std::string name = anchor_path(database).filename().string();
  std::istringstream in(read_anchor(database));
  std::vector<std::string> problems;
  std::int64_t first = 0;
  for (std::string text; std::getline(in, text) && !in.eof();) {  // a last line without its end was cut off by a crash
    if (text.ends_with(kTorn)) continue;
    const auto line = parse_line(text);
    if (!line) {
      problems.push_back(name + ": a line is not readable: " + text);
      continue;
    }
    if (first == 0 || line->head.position < first) first = line->head.position;
    if (const std::string problem = problem_of(*line, connection); !problem.empty()) problems.push_back(problem);
  }
  if (first == 0) {
    problems.push_back(name +
                       " is missing: whether the newest attempts were removed cannot be told (db anchor renews it)");
  } else if (first > 1 && audit_action(connection, first) != kActionRenewed) {
    problems.push_back(name + " begins with entry " + std::to_string(first) + ": it is younger than the database");
  }
  return problems;
}

}  // namespace trocar
