// How long organs of adults are, for hints of unit and warnings; never a reason to refuse.
//
// Longest side of the bounding box, generous. Thread: any.
#pragma once

#include <optional>
#include <string>

namespace trocar {

struct OrganSize {
  const char* name;
  double least_mm, most_mm;
};

/// The organ whose name is in the text, in any case and spelling of blanks ("VH_M_Gallbladder.glb").
std::optional<OrganSize> organ_size(const std::string& text);

}  // namespace trocar
