// Parallel planes as slices of an even grid in which some may be empty.
//
// Heights h_n along the normal are multiples of one step: the middle one of the distances near the smallest. Thread:
// any.
#pragma once

#include <string>
#include <vector>

namespace trocar {

struct EvenPlanes {
  double first = 0, step = 0;  ///< mm; step 0 when there is one plane only
  int count = 0;
  std::vector<int> slice;  ///< of each height given
};

/// @param heights mm, in any order, with repeats
/// @param what "frames" or "contours", @param name of the file: for messages
/// @throws InputError when the heights are no multiples of one step, or span more slices than an import may hold
EvenPlanes even_planes(const std::vector<double>& heights, const std::string& what, const std::string& name);

}  // namespace trocar
