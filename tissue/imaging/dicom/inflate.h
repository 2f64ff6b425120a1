// A raw deflate stream (RFC 1951) out of a file, as DICOM's deflated transfer syntax has it, up to a limit.
//
// Thread: any.
#pragma once

#include <string>

#include "tissue/imaging/dicom/dicom_elements.h"

namespace trocar {

struct Inflated {
  std::string bytes;   ///< up to the damage
  std::string damage;  ///< "" or what is wrong: damaged, cut off, beyond the budget
};

/// @param budget what may still be inflated; lowered by what was
/// @throws InputError when the file cannot be read
Inflated inflate_raw(ByteSource& source, std::uint64_t from, InflateBudget& budget);

}  // namespace trocar
