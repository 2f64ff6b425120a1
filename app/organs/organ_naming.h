// What an organ is called and what it feels like: from the file's words, or the user's; never from a bare number.
//
// A label without a name keeps its number ("label-7") and has no material until somebody says one: it is refused with
// the options to give. Materials: assets/materials.toml, by name in any spelling of case, or by the code that the file
// gives the label. Thread: any, not the tick (file I/O).
#pragma once

#include <string>
#include <vector>

#include "app/organs/chosen_labels.h"
#include "app/organs/import_options.h"

namespace trocar {

struct OrganNaming {
  std::string name, material;
  std::vector<std::string> decisions;  ///< how they were found, where the file does not simply say so
};

/// Names and materials of the labels of an import, in their order.
/// @param scene several organs: --name is the scene's then, and --material that of labels without a name
/// @param file_stem the label map's name, which counts for a map of one label; @param file for messages
/// @throws InputError naming the file and the labels that nothing names, with the options to give; a material that is
/// not in the table
std::vector<OrganNaming> name_labels(const OrganImportOptions& options, const std::vector<ChosenLabel>& labels,
                                     const LabelMap& map, const std::string& file_stem, const std::string& file,
                                     bool scene);

/// Of a surface. @param by_default where --name says nothing. @param own_material as its file says it, taken where
/// --material says nothing and the table knows it
OrganNaming name_surface(const OrganImportOptions& options, const std::string& by_default,
                         const std::string& own_material = "");

}  // namespace trocar
