// A raw deflate stream (RFC 1951) out of a file, as DICOM's deflated transfer syntax has it, up to a limit.
//
// Thread: any.
#pragma once

#include <string>

#include "tissue/imaging/dicom/dicom_elements.h"

namespace trocar {

/// @param budget what may still be inflated; lowered by what was
/// @throws InputError when the stream is damaged, cut off or beyond the budget
std::string inflate_raw(ByteSource& source, std::uint64_t from, InflateBudget& budget);

}  // namespace trocar
