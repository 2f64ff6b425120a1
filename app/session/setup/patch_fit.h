// Does a surface fit into the contact patches of a board: how many triangles lie near the instrument, and what to
// import instead.
//
// A patch holds kMaxPatchTriangles, the nearest of those within kPatchRadius of the tool. More than that are felt all
// the same while the patch reaches as far as the tool may move until the next one; nearer than that the surface is
// refused. Frame T, SI units. Thread: loading only.
#pragma once

#include <string>

#include "app/session/setup/scene.h"

namespace trocar {

struct PatchFit {
  int most = 0;        ///< triangles within kPatchRadius of the instrument, at the disc where there are most
  double reach_m = 0;  ///< from the tool's axis that a patch reaches, where it reaches least
  double needed_m = 0;
  int advised = 0;  ///< of so many a patch holds all; for `organ import --triangles`

  bool felt() const { return reach_m >= needed_m; }
  bool whole() const;
  /// "a contact patch holds 512 triangles within 25 mm of the tool, here are up to 900; ..."
  std::string words() const;
};

/// @param scene with its board and instrument.
PatchFit patch_fit(const Scene& scene);

}  // namespace trocar
