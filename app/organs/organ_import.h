// `trocar organ import`: an image with labels, a label map or a surface of another program becomes an organ file, or a
// scene of organs.
//
// Report on `out`, remarks on `err`. Nothing is written unless everything was made. Errors leave as InputError (exit
// code 2), EnvironmentError (3).
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "app/organs/import_options.h"
#include "tissue/imaging/labels/label_map.h"
#include "tissue/imaging/labels/label_values.h"
#include "tissue/imaging/volumes/image_volume.h"
#include "tissue/organ/organ_manifest.h"
#include "tissue/organ/organ_set.h"

namespace trocar {

/// Compiles and writes the organ or the scene. @return exit code 0
int organ_import(const OrganImportOptions& options, std::ostream& out, std::ostream& err);

/// What an import wrote, for reports and for commands that go on with it.
struct WrittenOrgans {
  std::vector<CompiledMember> organs;  ///< one, or those of the scene
  std::optional<OrganSet> set;         ///< of a scene
  std::filesystem::path stem;          ///< path of all files without their suffixes
  std::vector<SideFile> files;         ///< lattices, tetrahedra, centrelines, the page
  std::filesystem::path manifest;      ///< of the organ, or the scene file, once written
  std::optional<ImageVolume> image;    ///< that the labels were drawn on
  std::optional<LabelMap> labels;      ///< that they were made from
  std::vector<LabelValues> values;     ///< of the image in each organ; empty without an image or a page
  std::vector<std::string> notes;      ///< of the scene as a whole
  std::vector<std::string> removed;    ///< files of an older organ of this name that this one does not have
};

/// The work of organ_import without its report.
WrittenOrgans import_organs(const OrganImportOptions& options, std::ostream& err);

}  // namespace trocar
