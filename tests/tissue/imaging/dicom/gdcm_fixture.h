// Files compressed by GDCM's encoders.
//
// Thread: any.
#pragma once

#include <string>

namespace trocar::test {

/// @param file a plain DICOM file
/// @param syntax UID of a compressed transfer syntax
std::string compressed(const std::string& file, const std::string& syntax);

}  // namespace trocar::test
