// A DICOM input whose files were looked at once: listed, and read from, without going through them again.
//
// A folder of a thousand slices takes seconds to look through, and an import wants its list, its labels and its images.
// A zip stays unpacked as long as the study lives. Thread: as dicom_reader.h.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "tissue/imaging/dicom/dicom_reader.h"

namespace trocar {

class DicomInput;
struct DicomCatalogue;

class DicomStudy {
 public:
  /// @throws InputError as list_dicom
  explicit DicomStudy(const std::filesystem::path& input, const Progress& progress = {});
  ~DicomStudy();
  DicomStudy(const DicomStudy&) = delete;
  DicomStudy& operator=(const DicomStudy&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const DicomInput& files() const { return *files_; }
  const DicomCatalogue& catalogue() const { return *catalogue_; }
  std::vector<DicomSeries> series() const;

 private:
  std::filesystem::path path_;
  std::unique_ptr<DicomInput> files_;
  std::unique_ptr<DicomCatalogue> catalogue_;
};

}  // namespace trocar
