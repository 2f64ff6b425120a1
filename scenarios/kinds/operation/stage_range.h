// Which objects, ducts and vessels of an operation are those of one stage: each stage numbers its own from 0.
// Thread: pure.
#pragma once

#include "scenarios/director/director.h"
#include "tissue/tissue_frame.h"

namespace trocar {

struct StageRange {
  int stage = 0;  ///< its number
  int first_object = 0, objects = 0;
  int first_duct = 0, ducts = 0;
  int first_vessel = 0, vessels = 0;  ///< of those that open once all strands are divided
};

/// @pre board is one of the operation
std::vector<StageRange> stage_ranges(const Exercise& operation, const Board& board);
/// The stage that has an object; nullptr: none has.
const StageRange* stage_with(const std::vector<StageRange>& ranges, int object);

/// What the tissue's frame tells of one stage, in its numbers.
TissueFrame frame_of(const StageRange& range, const TissueFrame& whole);
/// How far the stage is, in its numbers.
DirectorStatus status_of(const StageRange& range, const DirectorStatus& whole);

}  // namespace trocar
