// The DICOM files, or others that are wanted, of a zip archive, unpacked into a private temporary folder that is gone
// when this object is.
//
// Names in the archive never become paths: files are numbered. Number, size, sum and ratio of what is unpacked are
// limited as it comes out, whatever the archive claims. Unpacking runs in a child process. Thread: one owner.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tissue/progress.h"

namespace trocar {

struct ZipLimits {
  std::uint64_t entries = 50000;
  std::uint64_t file_bytes = std::uint64_t{1} << 30;
  std::uint64_t all_bytes = std::uint64_t{4} << 30;
  std::uint64_t free_bytes = std::uint64_t{64} << 20;  ///< that may come out whatever the ratio
  std::uint64_t ratio = 200;                           ///< of all bytes to the size of the archive beyond that
};

class UnpackedZip {
 public:
  struct File {
    std::filesystem::path path;
    std::string name;  ///< in the archive, printable, without its folders
  };

  /// Which files of an archive are wanted, by their names in it.
  using Wanted = std::function<bool(const std::string& name)>;

  /// @param wanted instead of the files that may be DICOM
  /// @throws InputError naming the archive: damaged, encrypted, beyond the limits
  UnpackedZip(const std::filesystem::path& archive, const ZipLimits& limits, const Progress& progress,
              const Wanted& wanted = {});
  ~UnpackedZip();
  UnpackedZip(const UnpackedZip&) = delete;
  UnpackedZip& operator=(const UnpackedZip&) = delete;

  /// Files that may be DICOM, or that were wanted, in the order of their names in the archive.
  const std::vector<File>& files() const { return files_; }
  const std::filesystem::path& folder() const { return folder_.path; }

 private:
  struct Folder {
    std::filesystem::path path;
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
  };

  Folder folder_;
  std::vector<File> files_;
};

/// Names of all files in an archive, printable, with their folders. @throws InputError as UnpackedZip
std::vector<std::string> names_in_zip(const std::filesystem::path& archive, const Progress& progress);

/// Whether a file starts as a zip archive does.
bool is_zip(const std::filesystem::path& file);

}  // namespace trocar
