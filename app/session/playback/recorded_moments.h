// The moments of a recording that has keyframes, taken from them and from its rows: nothing is run again.
//
// There is a moment for every row that a tissue step saw (100 Hz), as in a run. Position, forces, opening and contact
// are the row's; what keyframes say is theirs, and between two of them numbers, poses and nodes are interpolated. What
// a picture does not need stays at its default (joints, torques, velocities); forces at the stylus have the size that
// was recorded and the direction of the scene's. Frame T, SI. Thread: any.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "app/session/recording/recording_reader.h"
#include "app/session/run_moment.h"
#include "tissue/interaction/suturing.h"
#include "tissue/solid/cut_lattice.h"
#include "tissue/solid/embedded_surface.h"
#include "tissue/thin/duct_tube.h"
#include "tissue/thin/sheet_body.h"

namespace trocar {

/// The tissue as it was: nodes and what is written on them.
struct RecordedShape {
  std::uint64_t topology = 0;
  std::vector<NodePlace> nodes_T;
  std::vector<ShapeField> fields;
};

class RecordedMoments {
 public:
  /// @param scene outlives it. @param recording with rows and keyframes.
  RecordedMoments(const Scene& scene, const Recording& recording);

  /// The moment at or before t; the first when t is before it. @throws InputError when a keyframe cannot be decoded
  /// though its CRC agrees.
  RunMoment at(double t_s) const;
  /// Interpolated at the same moment; none before the first shape. @throws InputError as above.
  std::optional<RecordedShape> shape_at(double t_s) const;
  /// What the rows alone know of it.
  RunMoment bare(double t_s) const;
  const std::vector<TopologyEvent>& changes() const { return track_.changes(); }
  std::size_t bytes() const;  ///< that it takes, nearly

 private:
  const RecordedTick& row_at(double t_s) const;
  std::optional<RecordedShape> shape_of(std::uint64_t period) const;
  /// Organ and thin parts, as last_surface_ and last_thin_.
  void make_surfaces(std::uint64_t period) const;
  struct ThinParts {
    std::optional<DuctPlayback> ducts;
    std::optional<SheetPlayback> sheets;
    std::optional<SuturePlayback> suture;
    std::uint64_t changes = 0;  ///< that they are after

    std::size_t nodes() const {
      return (ducts ? ducts->nodes() : 0) + (sheets ? sheets->nodes() : 0) + (suture ? suture->nodes() : 0);
    }
    std::vector<SurfacePtr> at(std::span<const NodePlace> nodes_T) const;
  };
  const ThinParts& thin_for(std::uint64_t topology) const;
  /// The organ's surface on its nodes after the cuts that make up a topology; nullptr: there are none such.
  const EmbeddedSurface* embedded_for(std::uint64_t topology) const;

  const Scene& scene_;
  double rate_hz_;
  std::vector<RecordedTick> rows_;
  TissueTrack track_;
  mutable std::mutex mutex_;  // what follows
  mutable TissueDecoder decoder_{track_};
  mutable std::optional<RunMoment> last_;
  mutable RecordedShape last_shape_;  ///< of last_surface_
  mutable SurfacePtr last_surface_;
  mutable std::vector<SurfacePtr> last_thin_;
  mutable std::optional<ThinParts> thin_;
  mutable std::optional<CutLattice> cut_;  ///< after the last cuts asked for
  mutable std::optional<EmbeddedSurface> cut_surface_;
};

}  // namespace trocar
