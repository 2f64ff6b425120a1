// What is known about an organ or a scene as text for people or as JSON for programs (keys: docs/commands.md).
//
// Pure; nothing in it names a patient. Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "tissue/organ/lost_form.h"
#include "tissue/organ/organ_set.h"

namespace trocar {

std::string organ_json(const OrganManifest& manifest, const Eigen::AlignedBox3d& bounds);
/// What matters of an import, in at most ten lines; `organ info` and the page have the rest.
/// @param manifest_file name of the file to ask `organ info` about
std::string organ_summary(const OrganManifest& manifest, const Eigen::AlignedBox3d& bounds,
                          const std::string& manifest_file);
std::string scene_summary(const OrganSet& set, const std::vector<CompiledMember>& organs,
                          const std::string& manifest_file);

std::string organ_text(const OrganManifest& manifest, const Eigen::AlignedBox3d& bounds);

/// "800 triangles are too few for a body 3.1 mm thick: ..., --triangles 5400".
std::string lost_form_words(const LostForm& form);

std::string scene_report_json(const OrganSet& set, const std::vector<CompiledMember>& organs);
std::string scene_report_text(const OrganSet& set, const std::vector<CompiledMember>& organs);

}  // namespace trocar
