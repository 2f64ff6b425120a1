// Slices of one DICOM file as numbers: native bytes read by ourselves, compressed ones decoded in a child process.
//
// Thread: one owner, as dicom_reader.h. Memory: native, one frame at a time; compressed, some 32 MiB of frames at a
// time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tissue/imaging/dicom/dicom_instance.h"
#include "tissue/progress.h"

namespace trocar {

/// Stored values become numbers: the bits that count, with their sign.
std::vector<float> unpacked(const std::string& bytes, const PixelFormat& format);

/// Frames of several files in the order asked for.
class DicomPixels {
 public:
  struct Wish {
    const DicomInstance* instance = nullptr;  ///< with an image
    std::size_t frame = 0;
  };

  /// Calls `take` with every wish's stored values, row by row, in the order of the wishes; rescale is not applied.
  /// @throws InputError naming the file: damaged, changed meanwhile, cut off
  using Take = std::function<void(std::size_t wish, const std::vector<float>& values)>;
  static void read(const std::vector<Wish>& wishes, const Progress& progress, const Take& take);
};

}  // namespace trocar
