// The ways in which DICOM stores bytes (PS3.5 annex A, PS3.6 table A-1), by name, and which of them can be decoded
// here.
//
// Thread: any.
#pragma once

#include <string_view>

namespace trocar {

enum class PixelCoding { kNative, kRle, kJpeg, kJpegLs, kJpeg2000, kCannot };

struct TransferSyntax {
  std::string_view uid;
  std::string_view name;
  PixelCoding coding = PixelCoding::kNative;
  bool explicit_vr = true;
  bool big_endian = false;
  bool deflated = false;
  bool lossy = false;  ///< may have lost detail; JPEG 2000 (91) may or may not
};

/// nullptr for one that is not in the standard's list.
const TransferSyntax* transfer_syntax(std::string_view uid);

/// What a file without a header is tried as: one of the two.
const TransferSyntax& implicit_little_endian();
const TransferSyntax& explicit_little_endian();

}  // namespace trocar
