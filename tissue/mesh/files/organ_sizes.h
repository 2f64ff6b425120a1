// How long organs of adults are, for hints of unit and warnings; never a reason to refuse.
//
// Longest side of the bounding box, generous. Thread: any.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace trocar {

struct OrganSize {
  std::string_view name;
  double least_mm, most_mm;
  std::string_view found_by = {};  ///< what names of it have in common, where that is not `name`

  /// "a liver", "an artery"
  std::string with_article() const;
};

/// The organ whose name is in the text, in any case and spelling of blanks ("VH_M_Gallbladder.glb").
std::optional<OrganSize> organ_size(const std::string& text);

}  // namespace trocar
