// The page of an import: what the organ is, what is true of it and what is not, with pictures. One HTML file, no
// script, no request.
//
// Order: name and origin, verdict on the mesh, pictures, figures, what was lost and added, decisions and repairs,
// hashes and versions. It holds nothing that names a patient. Same input, same bytes but for the 3-D pictures, which
// depend on the driver. Thread: any.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tissue/imaging/labels/label_map.h"
#include "tissue/imaging/labels/label_values.h"
#include "tissue/imaging/volumes/image_volume.h"
#include "tissue/organ/organ_set.h"

namespace trocar {

struct OrganPageContent {
  const std::vector<CompiledMember>& organs;
  const OrganSet* set = nullptr;
  const ImageVolume* image = nullptr;
  const LabelMap* labels = nullptr;
  std::vector<std::string> notes;
  std::filesystem::path assets;          ///< for the 3-D pictures; "": none
  std::vector<LabelValues> values = {};  ///< of the image in each organ; empty without an image
};

/// The whole page as UTF-8 text.
std::string organ_page(const OrganPageContent& content);

}  // namespace trocar
