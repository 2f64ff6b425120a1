// What a compressed frame says of itself, read before a decoder sees it: size, bits, and whether its end is there. RLE
// is decoded here.
//
// Source: JPEG ITU-T T.81 B.2, JPEG-LS T.87 C.2, JPEG 2000 T.800 A.5, RLE DICOM PS3.5 annex G. Thread: any.
#pragma once

#include <string>
#include <string_view>

#include "tissue/imaging/dicom/dicom_instance.h"

namespace trocar {

/// @param name of the file and frame in messages
/// @throws InputError when the frame (not RLE) is cut off, or is not of the size that the file's header says
void check_compressed_frame(std::string_view bytes, const DicomImage& image, const std::string& name);

/// Values of an RLE frame in little endian order. @throws InputError when it is cut off or damaged
std::string decode_rle_frame(std::string_view bytes, const DicomImage& image, const std::string& name);

}  // namespace trocar
