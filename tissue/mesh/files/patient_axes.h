// Names of frames ("RAS", "LPS", "LSA") and the turn that brings each to RAS.
//
// A name says what the file's x, y and z point at: R or L, A or P, S or I, each axis once. Thread: any.
#pragma once

#include <string>

#include "haptics/quantities.h"

namespace trocar {

/// Matrix from the named frame to RAS: a signed permutation, with determinant -1 for mirroring names ("LAS").
/// @throws InputError saying which names there are
Mat3 to_ras(const std::string& frame);

/// "z" is RAS, "y" is LSA, "x" is SRA. @throws InputError for anything else
std::string frame_of_up_axis(const std::string& up_axis);

}  // namespace trocar
