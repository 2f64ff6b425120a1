// Writes the phantom's CT as a DICOM series, so that the way from a hospital's folder can be tried without a patient.
//
// CT Image Storage, explicit VR little endian, one file a slice, 12 bits stored with an intercept of -1024. Patient
// name and ID read PHANTOM; dates are those of no study; UIDs (2.25, made from the image) are the same for the same
// image. DICOM PS3.5 section 7 (elements), PS3.3 A.3 (CT IOD). Axial slices, patient frame LPS. Thread: any.
#pragma once

#include <filesystem>
#include <string>

#include "tissue/imaging/phantom/phantom.h"

namespace trocar {

/// The bytes of one slice. @param k index of the slice, 0 the lowest
std::string phantom_dicom_slice(const CtPhantom& phantom, int k);

/// Writes slice-0001.dcm and so on, from the feet up; all of them or none.
/// @throws EnvironmentError when the folder cannot be written
void write_phantom_dicom(const std::filesystem::path& folder, const CtPhantom& phantom);

}  // namespace trocar
