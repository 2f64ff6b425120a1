// How long work tells how far it is, and how it is stopped.
//
// The one who asks for the work passes a function; the work calls it now and then. The function may throw to stop the
// work: whoever does the work holds nothing that a destructor does not give back, so nothing half-made stays.
#pragma once

#include <functional>
#include <string_view>

namespace trocar {

/// @param stage what is being done, "decoding slices"
/// @param share done of this stage, 0..1; negative when it cannot be told
using Progress = std::function<void(std::string_view stage, double share)>;

inline void report(const Progress& progress, std::string_view stage, double share) {
  if (progress) progress(stage, share);
}

}  // namespace trocar
