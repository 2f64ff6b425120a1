// Which labels of a map the user means, with their names: by the file's own names, a table that was named, or a number.
//
// A bare number is never given a name from a table that nobody named. Thread: any.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/organs/import_options.h"
#include "tissue/imaging/labels/label_map.h"
#include "tissue/organ/organ_manifest.h"

namespace trocar {

struct ChosenLabel {
  Segment segment;
  std::string table;  ///< that gave the name; "" when the file did, or nothing
};

/// "; did you mean "liver"?" where a known word is near, else nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

/// --name takes the label that the file calls so, where --label says nothing.
/// @param file of the map, for messages. @param decisions what was left out, as sentences
/// @param origin of labels that have files of their own, by their numbers
/// @throws InputError naming file and option: unknown or ambiguous label, table that does not exist
std::vector<ChosenLabel> choose_labels(const OrganImportOptions& options, const LabelMap& map, const std::string& file,
                                       std::vector<std::string>& decisions,
                                       const std::map<int, OrganSource>& origin = {});

/// Name for files: lower case letters, digits, '-' and '_'; "label-7" when nothing is left of it.
std::string file_name_of(const Segment& segment);

}  // namespace trocar
