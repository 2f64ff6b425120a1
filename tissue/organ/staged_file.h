// A file that appears whole or not at all: written beside its place under a temporary name, renamed when complete.
//
// Thread: one owner. Errors: EnvironmentError naming the file and the system's reason.
#pragma once

#include <filesystem>
#include <string_view>

namespace trocar {

class StagedFile {
 public:
  /// Writes and flushes the bytes under the temporary name, which is locked until the end; the folder is made when
  /// missing.
  /// @throws EnvironmentError also when another process is just writing this file
  StagedFile(std::filesystem::path target, std::string_view bytes);
  /// Removes the temporary file unless it was renamed.
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /// Renames to the final name, replacing what was there.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  int descriptor_ = -1;  ///< holds the lock
};

}  // namespace trocar
