// Who may write: a file, or all files of one name, by one program at a time.
//
// Advisory locks of the kernel (flock), so a program that dies holds none. Thread: one owner. Errors: EnvironmentError
// naming the file and the system's reason, or that another program is just writing it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trocar {

/// Opens a file for writing and locks it; it and its folder are made when missing, its bytes stay.
/// @param target what is named in errors
/// @param made gets the folders that were made, the innermost first
/// @returns the descriptor, to be closed by the caller; the path names that very file as long as nobody else removes it
int open_locked(const std::filesystem::path& file, const std::filesystem::path& target,
                std::vector<std::filesystem::path>* made = nullptr);

/// Whether a file is the lock of some name, and so no input though it lies among inputs.
inline bool is_name_lock(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with('.') && name.ends_with(".lock");
}

/// Keeps other programs from writing files of one name, "out" of "out.ply", "out.organ.toml" and so on.
///
/// The lock is on the hidden file ".out.lock" beside them, which goes with it. Its holder unlinks it before the lock
/// ends, so nobody can hold a lock on a file that still has the name but not be the only one: who opened it before it
/// went, and got the lock after, sees that the name is another file's, or none's, and begins again (open_locked). A
/// program that was killed leaves the file, which locks nobody out and goes with the next lock.
class NameLock {
 public:
  /// @throws EnvironmentError also when another program holds the lock
  explicit NameLock(const std::filesystem::path& stem);
  /// Takes away the lock's file, and the folders that were made for it where nothing was put into them.
  ~NameLock();
  NameLock(const NameLock&) = delete;
  NameLock& operator=(const NameLock&) = delete;

 private:
  std::filesystem::path file_;
  std::vector<std::filesystem::path> made_;
  int descriptor_ = -1;
};

}  // namespace trocar
