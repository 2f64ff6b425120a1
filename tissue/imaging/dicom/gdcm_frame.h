// One compressed frame through GDCM, seen without any of its types.
//
// GDCM gets the bytes of the frame and our own checked description, never a file. Call it in a child process: its
// decoders may crash on damaged bytes. Thread: any.
#pragma once

#include <string>

#include "tissue/imaging/dicom/dicom_instance.h"

namespace trocar {

/// Stored values of one frame, row by row, little endian, `allocated` bits each.
/// @throws InputError when GDCM refuses it
std::string decode_frame_gdcm(const std::string& bytes, const DicomImage& image, const std::string& name);

}  // namespace trocar
