// Deforming tissue by name: assets/tissues.toml, read strictly.
//
// Every number is a table {value, range, unit, source, checked}: one without its unit, in another unit, outside its own
// range or beyond what the solver can bear is refused with line and column. Requirement T14 of tissue.md. SI units.
// Thread: loading only.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tissue/solid/tissue_material.h"

namespace trocar {

class TissueTable {
 public:
  /// @throws InputError with line and column: unknown or missing keys, units, ranges, shares that add up to 1 or more,
  /// friction that grows with sliding, two tissues of one name, no "soft_tissue"
  static TissueTable load(const std::filesystem::path& file);
  static TissueTable parse(const std::string& text, const std::string& file);

  /// By the tissue's own name, by an alias, else "soft_tissue".
  const TissueSolid& find(const std::string& name) const;
  bool knows(const std::string& name) const;
  const std::vector<TissueSolid>& all() const { return tissues_; }

 private:
  std::vector<TissueSolid> tissues_;
};

/// What an instructor picks: that the organ stands still, or how it gives way.
inline constexpr const char *kStillTissue = "still", *kNormalTissue = "normal";
inline constexpr std::array<const char*, 4> kTissueWords{kStillTissue, "soft", kNormalTissue, "stiff"};

/// "soft" and "stiff" are the ends of the range of young_pa, "normal" is its value.
/// @param tissue from a table. @throws std::invalid_argument for any other word
TissueSolid stiffness_choice(const TissueSolid& tissue, std::string_view choice);

}  // namespace trocar
