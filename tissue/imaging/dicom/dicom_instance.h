// One DICOM file as the readers use it: which series it belongs to, and, where it holds an image, its checked
// description.
//
// Frame of positions and directions: LPS, mm, as DICOM has it. Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tissue/imaging/dicom/dicom_elements.h"
#include "tissue/imaging/dicom/dicom_reader.h"

namespace trocar {

/// Where one slice lies (PS3.3 C.7.6.2) and how its stored values become values (C.11.1.1).
struct SlicePlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< centre of the first pixel
  Eigen::Vector3d along_row = Eigen::Vector3d::UnitX(), along_column = Eigen::Vector3d::UnitY();
  double row_step = 1, column_step = 1;  ///< between pixels along a row, along a column
  std::optional<double> slope, intercept;
};

struct PixelFormat {
  int allocated = 16, stored = 16, high_bit = 15;
  bool is_signed = false;
};

/// An image whose header holds: sizes within limits, places finite and at right angles, pixel data as long as they must
/// be.
struct DicomImage {
  int rows = 0, columns = 0, frames = 0;
  PixelFormat format;
  bool inverted = false;  ///< MONOCHROME1: meant to be shown with dark and bright exchanged
  bool lossy = false;
  bool padded = false;  ///< more bytes than the image needs
  const TransferSyntax* syntax = nullptr;
  PixelSpan pixels;
  std::vector<SlicePlace> places;  ///< one a frame
};

/// What an image of several in one place may differ in, in the order in which it is looked at.
inline constexpr std::array<const char*, 7> kPassNames{
    "echo", "echo time", "phase", "trigger time", "diffusion weighting", "kind of image", "acquisition"};

struct DicomInstance {
  std::filesystem::path path;
  std::string name;  ///< of the file in messages
  DicomKind kind = DicomKind::kOther;
  std::string modality = "unknown";               ///< one of a fixed list, or "unknown"
  std::string study, series, frame_of_reference;  ///< for grouping: never shown
  long series_number = 0;
  std::vector<std::string>
      pass;  ///< what tells echoes, phases, directions of one series apart, as kPassNames; never shown
  int rows = 0, columns = 0, frames = 0;
  std::string problem;  ///< why `image` is missing although there are pixels, or what is damaged
  std::optional<DicomImage> image;
};

/// Stands for the series of images that name none.
inline constexpr std::string_view kNoSeries = "none";

/// What the elements say, with the first thing that is wrong in `problem`; does not throw for bad content.
DicomInstance instance_of(const DicomFile& file, const std::filesystem::path& path, const std::string& name,
                          std::uint64_t source_size);

/// @throws InputError naming file and what is wrong
DicomImage checked_image(const DicomFile& file, const std::string& name, std::uint64_t source_size);

/// By its transfer syntax, which must be known, or by what it says of its past (JPEG 2000 may be either).
bool compressed_with_loss(const DicomFile& file);

/// The functional group macro of one frame: its own, else the shared one; nullptr when neither has it. Of an image
/// without such groups (PS3.3 C.7.6.16) the data set itself.
const DicomItem* frame_group(const DicomItem& data, std::size_t frame, DicomTag group);

/// Places of the frames of a multi-frame image from its functional groups, or of a plain image from its own elements.
/// @throws InputError naming file, frame and element
std::vector<SlicePlace> slice_places(const DicomItem& data, int frames, const std::string& name);

}  // namespace trocar
