#include "trainees/live/live_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace trocar {
namespace {

constexpr const char* kLooked = "looked";
constexpr mode_t kOwnerFile = 0600, kOwnerFolder = 0700, kOthers = 0077;

bool own(const struct stat& of) { return of.st_uid == ::geteuid() && (of.st_mode & kOthers) == 0; }

/// A file of this user's own, opened without following a link and without waiting for a pipe; -1 otherwise.
int open_own(int folder, const std::string& name) {
  const int file = ::openat(folder, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  struct stat found = {};
  if (file >= 0 && ::fstat(file, &found) == 0 && S_ISREG(found.st_mode) && own(found)) return file;
  if (file >= 0) ::close(file);
  return -1;
}

bool write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

std::string LiveFolder::picture_of(const std::string& moment_name) {
  return moment_name.substr(0, moment_name.rfind('.')) + kPicture;
}

std::filesystem::path LiveFolder::beside(const std::filesystem::path& database) {
  return database.parent_path() / (database.stem().string() + ".live");
}

LiveFolder::LiveFolder(const std::filesystem::path& database, Open how) {
  if (database.empty() || database == ":memory:") return;
  path_ = beside(database);
  if (how == Open::kMake) ::mkdir(path_.c_str(), kOwnerFolder);  // there already, or in vain: the next line tells
  folder_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder_ < 0) {
    if (errno != ENOENT) refusal_ = path_.string() + " is no folder that can be read";
    return;
  }
  struct stat found = {};
  if (::fstat(folder_, &found) == 0 && own(found)) return;
  ::close(folder_);
  folder_ = -1;
  refusal_ = path_.string() + " belongs to another user or is open to others";
}

LiveFolder::~LiveFolder() {
  if (folder_ >= 0) ::close(folder_);
}

bool LiveFolder::write(const std::string& name, const std::string& text) {
  if (!open()) return false;
  const std::string part = name + ".part";
  ::unlinkat(folder_, part.c_str(), 0);  // left by a program that died, or a link that somebody put there
  const int file = ::openat(folder_, part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kOwnerFile);
  if (file < 0) return false;
  const bool whole = write_all(file, text);
  if (::close(file) == 0 && whole && ::renameat(folder_, part.c_str(), folder_, name.c_str()) == 0) return true;
  ::unlinkat(folder_, part.c_str(), 0);
  return false;
}

std::optional<std::string> LiveFolder::read(const std::string& name) const {
  const int file = open() ? open_own(folder_, name) : -1;
  if (file < 0) return {};
  std::string out(kLargest + 1, '\0');
  std::size_t have = 0;
  while (have < out.size()) {
    const ssize_t n = ::read(file, out.data() + have, out.size() - have);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    have += static_cast<std::size_t>(n);
  }
  ::close(file);
  if (have > kLargest) return {};
  out.resize(have);
  return out;
}

void LiveFolder::remove(const std::string& name) {
  if (open()) ::unlinkat(folder_, name.c_str(), 0);
}

std::vector<std::string> LiveFolder::names() const {
  std::vector<std::string> out;
  if (!open()) return out;
  const int again = ::openat(folder_, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);  // a place of its own in the folder
  DIR* entries = again < 0 ? nullptr : ::fdopendir(again);
  if (entries == nullptr) {
    if (again >= 0) ::close(again);
    return out;
  }
  while (const dirent* entry = ::readdir(entries)) {
    const std::string name = entry->d_name;
    if (name.ends_with(kMoment)) out.push_back(name);
  }
  ::closedir(entries);
  std::sort(out.begin(), out.end());
  return out;
}

std::optional<double> LiveFolder::age_s(const std::string& name) const {
  struct stat found = {};
  if (!open() || ::fstatat(folder_, name.c_str(), &found, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(found.st_mode))
    return {};
  timespec now = {};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return static_cast<double>(now.tv_sec - found.st_mtim.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec - found.st_mtim.tv_nsec);
}

void LiveFolder::look() {
  if (!open()) return;
  const int file = ::openat(folder_, kLooked, O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, kOwnerFile);
  if (file < 0) return;
  ::futimens(file, nullptr);
  ::close(file);
}

std::optional<double> LiveFolder::last_look_s() const { return age_s(kLooked); }

}  // namespace trocar
