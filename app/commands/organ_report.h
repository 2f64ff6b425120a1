// The report of an organ as people and programs read it: the keys of `trocar organ import --json` and a text form.
//
// Lengths in metres unless the key says otherwise. Thread: any.
#pragma once

#include <string>

#include "tissue/mesh/organ_manifest.h"

namespace trocar {

/// One JSON object, indented, with a closing newline. @param bounds of the surface, m
std::string organ_json(const OrganManifest& manifest, const Eigen::AlignedBox3d& bounds);

/// A few lines for a person.
std::string organ_text(const OrganManifest& manifest, const Eigen::AlignedBox3d& bounds);

}  // namespace trocar
