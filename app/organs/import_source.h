// What an import starts from: the image, the label map and where they came from, read by whoever understands the input.
//
// Dispatch: a surface's extension -> not here; a volume's extension -> tissue/imaging/volumes/volume_reader.h; a
// folder, a zip, a DICOMDIR or any other file -> DICOM. Frame RAS, mm. A DICOM input is never named in the provenance:
// folders are often named after patients.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/organs/import_options.h"
#include "app/organs/organ_files.h"
#include "tissue/imaging/labels/label_map.h"
#include "tissue/imaging/labels/label_values.h"
#include "tissue/imaging/volumes/image_volume.h"
#include "tissue/organ/organ_manifest.h"

namespace trocar {

struct ImportSource {
  std::optional<ImageVolume> image;
  LabelMap map;
  std::vector<LabelVolume> on_image;  ///< the map's layers on the image's grid, when their own is another; else empty
  OrganSource source;                 ///< file, sha256, modality, unit; the label is filled in later
  std::map<int, OrganSource> origin;  ///< of a label, by its number, where each has a file of its own; else empty
  std::string file;                   ///< of the label map, as the user named it, for messages
  std::string stem;                   ///< default name of an organ
};

/// Whether the input is a surface of another program.
bool is_surface_input(const OrganImportOptions& options);

/// Reads image and labels, segments by a window of values when one was given, and checks that the labels lie in the
/// image.
/// @param masks that the input is, one an organ; nothing for another input
/// @throws InputError naming the file and what is wrong; EnvironmentError
ImportSource read_import_source(const OrganImportOptions& options, const std::optional<OrganFiles>& masks = {});

/// What the image holds under a segment, related through patient space; no voxels without an image.
LabelValues image_values(const ImportSource& source, const Segment& segment);

/// sha256 of a file; of a folder: of the sorted sha256 of its files.
std::string hash_of_input(const std::string& input);

}  // namespace trocar
