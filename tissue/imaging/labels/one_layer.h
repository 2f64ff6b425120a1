// Overlapping segments laid into one layer, so that the organs of a scene share their borders and none crosses another.
//
// Whoever has the fewer voxels keeps a voxel that two claim: the tumour its place in the liver, the liver its place in
// the body. Thread: any.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tissue/imaging/labels/label_map.h"

namespace trocar {

/// @param map its layers have one grid
/// @param wanted segments of the map; the others fill what is left over where their number is free
/// @return one layer in which every segment keeps its number, with a note on each that gave voxels away; nothing when
/// the wanted ones lie in one layer already, or when grids differ or two of them have one number
/// @throws InputError when less than a tenth of a wanted segment is left to it, naming the ones that it lies in
std::optional<LabelMap> in_one_layer(const LabelMap& map, const std::vector<Segment>& wanted);

}  // namespace trocar
