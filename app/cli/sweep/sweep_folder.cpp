#include "app/cli/sweep/sweep_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <ostream>
#include <vector>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "scenarios/files/strict_toml.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRowsEnding = ".jsonl";
constexpr const char* kRulesets = "rulesets";

[[noreturn]] void refuse_file(const fs::path& file, const char* what) {
  throw EnvironmentError(file.string() + ": " + what + ": " + std::strerror(errno));
}

std::string bytes_of_rows(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse_file(file, "cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Length up to and with the last end of line.
std::size_t whole_length(const std::string& bytes) {
  const auto end = bytes.rfind('\n');
  return end == std::string::npos ? 0 : end + 1;
}

std::vector<fs::path> files_of_rows(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == kRowsEnding) files.push_back(entry.path());
  }
  if (error) throw InputError(folder.string() + ": cannot be read as the folder of a sweep: " + error.message());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw EnvironmentError(folder.string() + ": cannot be made a folder: " + error.message());
}

void SweepRows::take_edition(const std::string& what, const std::string& of, const std::string& edition,
                             const std::string& where) {
  const auto [found, fresh] = editions_.try_emplace(what + " of " + of, edition, where);
  if (fresh || found->second.first == edition) return;
  throw InputError(where + ": " + what + " of " + of + " is " + edition + ", but " + found->second.first + " in " +
                   found->second.second + "; a sweep has one");
}

void SweepRows::take_editions(const SweepRow& row, const std::string& where) {
  take_edition("ruleset", row.key.exercise, row.rubric_sha256, where);
  take_edition("script", "hand " + row.key.hand, row.hand_sha256, where);
  take_edition("version", "the program", row.program, where);
}

void SweepRows::take(SweepRow row, const std::string& line, const std::string& where) {
  take_editions(row, where);
  const auto [found, fresh] = rows_.try_emplace(row.key);
  if (fresh)
    found->second = {std::move(row), line, where};
  else if (found->second.line != line)
    throw InputError(where + ": another outcome than in " + found->second.where + " of " + key_words(row.key));
}

bool SweepRows::has(const SweepRow& planned, const std::string& where) {
  take_editions(planned, where);
  return rows_.count(planned.key) != 0;
}

void SweepRows::read(const fs::path& folder, std::ostream& err) {
  for (const fs::path& file : files_of_rows(folder)) {
    const std::string bytes = bytes_of_rows(file);
    const std::size_t whole = whole_length(bytes);
    int number = 0;
    for (std::size_t at = 0; at < whole;) {
      const std::size_t end = bytes.find('\n', at);
      const std::string line = bytes.substr(at, end - at), where = file.string() + ":" + std::to_string(++number);
      take(parse_row(line, where), line, where);
      at = end + 1;
    }
    if (whole < bytes.size())
      err << "trocar: " << file.string() << ":" << number + 1 << ": the last line was cut off and does not count\n";
  }
}

PathLock::PathLock(const fs::path& path, Kind kind, const std::string& held_words)
    : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) refuse_file(path, "cannot be opened");
  if (::flock(descriptor_, (kind == Kind::kAlone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) return;
  const bool held = errno == EWOULDBLOCK;
  if (!held) return;
  ::close(descriptor_);
  throw InputError(path.string() + ": " + held_words);
}

PathLock::~PathLock() { ::close(descriptor_); }

RowWriter::RowWriter(const fs::path& folder, const std::string& name, std::ostream& err) : file_(folder / name) {
  make_folder(folder);
  folder_lock_ = std::make_unique<PathLock>(folder, PathLock::Kind::kShared, "is being merged");
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) refuse_file(file_, "cannot be written");
  try {
    file_lock_ = std::make_unique<PathLock>(file_, PathLock::Kind::kAlone, "is being written by another process");
    const std::string bytes = bytes_of_rows(file_);
    const std::size_t whole = whole_length(bytes);
    if (whole == bytes.size()) return;
    err << "trocar: " << file_.string() << ": the last line was cut off; it is dropped and its attempt made again\n";
    if (::ftruncate(descriptor_, static_cast<off_t>(whole)) != 0) refuse_file(file_, "cannot be cut to whole lines");
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

RowWriter::~RowWriter() { ::close(descriptor_); }

void RowWriter::add(const std::string& line) {
  const std::string bytes = line + "\n";
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t written = ::write(descriptor_, bytes.data() + at, bytes.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) refuse_file(file_, "cannot be written");
    at += static_cast<std::size_t>(written);
  }
  if (::fdatasync(descriptor_) != 0) refuse_file(file_, "cannot be kept");
}

std::string rows_file(int part, int parts) {
  return parts == 0 ? std::string("attempts") + kRowsEnding
                    : "attempts." + std::to_string(part) + "-of-" + std::to_string(parts) + kRowsEnding;
}

void keep_ruleset(const fs::path& folder, const std::string& sha256, const std::string& text) {
  const fs::path file = folder / kRulesets / (sha256 + ".toml");
  if (digest::of_readable_file(file) == sha256) return;
  make_folder(file.parent_path());
  write_file(file, text);
}

std::string kept_ruleset(const fs::path& folder, const std::string& sha256) {
  const fs::path file = folder / kRulesets / (sha256 + ".toml");
  const std::string text = read_text_file(file.string());
  if (digest::of_bytes(text) != sha256) throw InputError(file.string() + ": its bytes are not those of its name");
  return text;
}

}  // namespace trocar
