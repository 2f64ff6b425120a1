// Which segment of a label map a person means: by number, by the file's own names, or by a table that they name.
//
// One number means different organs in different tables, so a bare map never gets names unasked: without a table a name
// is refused, listing the tables that know it. Thread: any.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tissue/imaging/labels/label_map.h"
#include "tissue/imaging/labels/label_table.h"

namespace trocar {

/// @throws InputError naming the first label that the file calls otherwise than a built-in table
void require_agreement(const LabelMap& map, const LabelTable& table, const std::string& file);

/// Built-in tables that name every number of the map's unnamed segments; a hint for people, never used to name a
/// segment.
std::vector<std::string> guess_label_table(const LabelMap& map);

/// Layer and number of "1:5", which tells segments apart that overlap and have one number; nothing for any other text.
std::optional<std::pair<std::size_t, int>> layer_and_number(std::string_view wanted);

/// @param wanted number ("5"), name ("liver"), layer and number ("1:5"); "" when the map has one segment only
/// @param table names of numbers that the file leaves unnamed, a person's own one all that it has; nullptr when nobody
/// named one
/// @returns the segment, its name filled from the table where the file gives none ("" when no table names it)
/// @throws InputError naming `file`: no such number or name, a name in two segments, a name where nothing gives names
Segment choose_segment(const LabelMap& map, std::string_view wanted, const LabelTable* table, const std::string& file);

/// "1 spleen, 2 kidney_right, 3": what a map holds, for messages; at most `most` segments and a count of the rest.
std::string listed_segments(const LabelMap& map, const LabelTable* table, std::size_t most = 20);

}  // namespace trocar
