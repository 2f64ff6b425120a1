// What somebody gives as "the scan": a folder, a zip, a DICOMDIR or one file, as a list of files.
//
// Folders are walked without following links to folders; a DICOMDIR may name files below its own folder only. Thread:
// one owner.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tissue/imaging/dicom/unpacked_zip.h"
#include "tissue/progress.h"

namespace trocar {

class DicomInput {
 public:
  struct File {
    std::filesystem::path path;
    std::string name;  ///< in messages
  };

  /// @throws InputError when it does not exist, is damaged or beyond the limits
  DicomInput(const std::filesystem::path& input, const Progress& progress);

  const std::string& name() const { return name_; }
  const std::vector<File>& files() const { return files_; }
  bool single() const { return single_; }  ///< one file, which must be DICOM itself
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void walk(const std::filesystem::path& folder);
  void unpack(const std::filesystem::path& archive, const Progress& progress);
  bool follow_directory(const std::filesystem::path& file);

  std::string name_;
  std::vector<File> files_;
  std::vector<std::string> notes_;
  std::unique_ptr<UnpackedZip> zip_;  ///< keeps the unpacked files
  bool single_ = false;
};

}  // namespace trocar
