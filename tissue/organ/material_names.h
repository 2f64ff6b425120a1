// Finding a material by the name of an organ: by its own name, by an alias, by the beginning of a name. "Liver" and
// "liver" are one. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "tissue/imaging/labels/segment.h"

namespace trocar {

/// What stands in for every organ that a table does not name.
inline constexpr const char* kFallbackMaterial = "soft_tissue";

/// @param alias a trailing * stands for any ending
inline bool alias_fits(const std::string& alias, const std::string& name) {
  if (alias.ends_with('*')) return name.starts_with(alias.substr(0, alias.size() - 1));
  return alias == name;
}

/// @param materials each with `name` and `aliases`; an own name goes before every alias. Null when none fits.
template <typename Material>
const Material* material_named(const std::vector<Material>& materials, const std::string& given) {
  const std::string name = folded_name(given);
  for (const Material& material : materials)
    if (material.name == name) return &material;
  for (const Material& material : materials)
    for (const std::string& alias : material.aliases)
      if (alias_fits(alias, name)) return &material;
  return nullptr;
}

}  // namespace trocar
