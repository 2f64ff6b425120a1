#include "trainees/exchange/export/pending_export.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"

namespace trocar {

namespace fs = std::filesystem;

namespace {

/// "folder/" is the folder.
fs::path without_slash(fs::path path) {
  while (!path.has_filename() && path.has_relative_path()) path = path.parent_path();
  return path;
}

[[noreturn]] void cannot(const fs::path& path, const std::string& doing, int error) {
  throw EnvironmentError(path.string() + ": cannot " + doing + ": " + std::strerror(error));
}

[[noreturn]] void already_there(const fs::path& out) {
  throw InputError(out.string() + ": exists already and is not overwritten; choose another name or move it away");
}

void check_place(const fs::path& typed, const fs::path& out, bool replaces) {
  if (out.empty() || !out.has_filename() || out.filename() == "." || out.filename() == "..") {
    throw InputError("\"" + typed.string() + "\": is no name of a file or folder to be written");
  }
  std::error_code error;
  const fs::path folder = out.parent_path();
  if (!folder.empty() && fs::status(folder, error).type() == fs::file_type::not_found) {
    throw InputError(typed.string() + ": there is no folder " + folder.string() + "; make it first");
  }
  const fs::file_type there = fs::symlink_status(out, error).type();
  if (there == fs::file_type::not_found || error || (replaces && there == fs::file_type::regular)) return;
  if (replaces) throw InputError(out.string() + ": is no file, and is not replaced");
  already_there(out);
}

}  // namespace

PendingExport::PendingExport(const fs::path& out, Shape shape, Existing existing)
    : out_(without_slash(out)), shape_(shape), existing_(shape == Shape::kFile ? existing : Existing::kKept) {
  check_place(out, out_, existing_ == Existing::kReplaced);
  pending_ = out_.parent_path() / ("." + out_.filename().string() + ".part-" + std::to_string(getpid()));
  if (shape_ != Shape::kFolder) return;
  if (std::error_code error; fs::exists(pending_, error)) cannot(out_, "make the folder", EEXIST);
  if (!make_owner_folders(pending_)) cannot(out_, "make the folder", errno);
}

PendingExport::~PendingExport() {
  if (committed_) return;
  stream_.close();
  std::error_code ignored;
  fs::remove_all(pending_, ignored);
}

std::ostream& PendingExport::file(const std::string& name) {
  end_file();
  current_ = shape_ == Shape::kFolder ? pending_ / name : pending_;
  if (shape_ == Shape::kFolder) make_owner_folders(current_.parent_path());
  errno = 0;
  stream_ = open_owner_file(current_);
  if (!stream_) cannot(out_, "write " + (name.empty() ? std::string("it") : name), errno);
  return stream_;
}

void PendingExport::end_file() {
  if (!stream_.is_open()) return;
  errno = 0;
  stream_.close();
  if (stream_.fail()) cannot(out_, "write it", errno ? errno : EIO);
  stream_.clear();
}

void PendingExport::commit() {
  end_file();
  if (existing_ == Existing::kReplaced) {
    if (std::rename(pending_.c_str(), out_.c_str()) != 0) cannot(out_, "move it to its place", errno);
    committed_ = true;
    return;
  }
  // Where a file system does not know RENAME_NOREPLACE the name is looked at once more instead.
  int result = renameat2(AT_FDCWD, pending_.c_str(), AT_FDCWD, out_.c_str(), RENAME_NOREPLACE);
  if (result != 0 && errno == EINVAL) {
    check_place(out_, out_, false);
    result = std::rename(pending_.c_str(), out_.c_str());
  }
  if (result != 0 && errno == EEXIST) already_there(out_);
  if (result != 0) cannot(out_, "move it to its place", errno);
  committed_ = true;
}

}  // namespace trocar
