// Where the organ lies in the theatre: upright where it can, turned where the instrument would otherwise have no room.
//
// Theatre T: z up = anterior (the patient lies supine), y = superior (towards the head), x = the patient's left; so
// from RAS image axes x_T = -x, y_T = z, z_T = y (a proper rotation). An organ is turned as a patient would be: rolled
// on the table about its long axis, and the table turned about the vertical; never head down, where the flat cap of an
// organ that the image cut would come up. Lengths m. Thread: loading only.
#pragma once

#include <string>

#include "haptics/contact/tool_shape.h"
#include "haptics/mapping/instrument_map.h"
#include "scenarios/exercise.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Pose X_TO of an organ (RAS axes, m) such that the middle of its best board region lies at T's origin on the surface:
/// the region_x by region_y patch, seen from above, with the most surface inside slope and relief limits.
/// @throws InputError when no point of the organ qualifies.
Pose place_organ(const TriangleSurface& organ_RAS, const TargetLayout& layout);

/// How an organ was laid.
struct OrganPlacement {
  Pose X_TO;
  double roll_rad = 0;  ///< about y of T, to the patient's left; 0: supine
  double turn_rad = 0;  ///< about z of T, counter-clockwise from above
  double even_m2 = 0;   ///< of the region's inside, that could carry discs but for the shaft
  double free_m2 = 0;   ///< and where the instrument has room
};

/// The instrument of a level, as the search for a place has to know it.
struct Instrument {
  ToolShape tool;
  InstrumentMap map;
};

/// The place of place_organ() where it has ample room for discs and instrument, or room for boards that the shaft
/// hardly narrows. Else the first with ample room: upright round another middle, then rolled and turned, the least turn
/// first. Else, of those with most room, the first where boards can be laid; failing that the roomiest: laying out a
/// board then says what is short. The same for all boards of the level.
/// @throws InputError when no point of the organ qualifies.
OrganPlacement place_organ(const TriangleSurface& organ_RAS, const Exercise& exercise, const ExerciseLevel& level,
                           const Instrument& instrument);

/// "the organ is rolled by 30 degrees ..."; empty when it lies as the patient does, supine.
std::string turned_words(const OrganPlacement& placement);

/// What was found at a pose: area for discs with and without room for the instrument.
OrganPlacement measure_placement(const TriangleSurface& organ_RAS, const Pose& X_TO, const TargetLayout& layout,
                                 const Instrument& instrument);

}  // namespace trocar
