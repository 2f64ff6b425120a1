// The world that the instrument is in, tissue and board alike, as the loop's neighbours see it: tissue task, director,
// hands and pictures.
//
// step() takes the newest haptic state at the tissue rate (100 Hz) and gives back what the loop needs until the next
// step (ContactPatch); frame() and surface() are what everybody else may know of it, shape() what the recorder keeps of
// it. Frame T, SI units. Deterministic: same states in, same frames out. Thread: tissue task.
#pragma once

#include <cstdint>
#include <span>

#include "haptics/exchange/contact_patch.h"
#include "haptics/exchange/solved_contacts.h"
#include "tissue/surface_snapshot.h"
#include "tissue/tissue_frame.h"
#include "tissue/tissue_shape.h"

namespace trocar {

class World {
 public:
  virtual ~World() = default;
  /// @param state with what the last tick's contacts do to the surface of an earlier patch.
  /// @param present the instrument is in the scene: before that nothing is felt or moved by it. @param patch filled.
  virtual void step(const HapticState& state, bool present, ContactPatch& patch) = 0;
  virtual const TissueFrame& frame() const = 0;
  /// The organ after the step; nullptr: none is to be seen.
  virtual SurfacePtr surface() const = 0;
  /// The thin parts after the step, one surface each: ducts and vessels, then a needle and its thread; empty: there are
  /// none.
  virtual std::span<const SurfacePtr> thin() const { return {}; }
  /// What deforms, after the step. A world with a shape is played from what was recorded of it and not solved again.
  virtual TissueShape shape() const { return {}; }
  /// Triangles in reach that did not fit into a patch, over the run.
  virtual std::uint64_t dropped() const = 0;
};

}  // namespace trocar
