// Clips on a rod: each closes its lumen, pins its two sides together, rides with it, and comes off when it is pulled
// along it too hard.
//
// A clip is a V of titanium closed round the rod. Its frame C is that of the applier when it was closed: z along the
// legs to their tips (origin), y the way the legs close, x along the rod. T, SI. Thread: tissue task.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/thin/elastic_rod.h"
#include "tissue/thin/lumen.h"

namespace trocar {

struct ClipOptions {
  double length_m = 0.009;    ///< of the legs, closed: medium-large 8 to 9 mm (unchecked)
  double width_m = 0.0012;    ///< along the rod (unchecked)
  double leg_m = 0.0008;      ///< thickness of a leg (unchecked)
  double mass_kg = 4e-5;      ///< (unchecked)
  double holds_pa = 39997;    ///< 300 mmHg: what a whole clip withstands
  double pull_off_n = 5;      ///< along the rod, 3 to 8 N (unchecked)
  double stump_m = 0.002;     ///< of rod beyond it, below which it holds less: in proportion (a choice)
  double part_power = 1;      ///< of the share of the width that it closes, in what it bears: in proportion (a choice)
  double overload_s = 0.020;  ///< how long the pull must be too hard
};

struct Clip {
  std::int32_t number = 0;               ///< from 1, in the order in which they were placed
  double arc_m = 0;                      ///< on the rod
  double width_share = 1;                ///< of the rod's width between its legs
  bool on = true;                        ///< false: it came off
  Vec3 offset_rod = Vec3::Zero();        ///< of its origin from the axis, in the rod's material frame
  Mat3 rotation_rod = Mat3::Identity();  ///< of C in that frame
  Pose X_TC;                             ///< as of the last step
};

class ClipSet {
 public:
  explicit ClipSet(const ClipOptions& options = {}) : options_(options) {}

  /// Closes a clip round the rod. @param arc_m, width_share as the applier judged them
  /// @param X_TI of the applier, its tips where those of the clip are. @return its number
  std::int32_t place(ElasticRod& rod, Lumen& lumen, double arc_m, double width_share, const Pose& X_TI);
  /// Something pulls on a clip in this step, N in T; adds up.
  void pull(std::int32_t number, const Vec3& force_T);
  /// Jaws that hold the clips at these arcs pull on them, on each alike.
  void pull_held(std::span<const double> arcs, const Vec3& force_T);
  /// Springs of the rod's step: those within the width of a clip pull on it.
  void pull_touched(std::span<const RodSpring> springs);
  /// After the rod's step: where they are now, and which ones came off. @return numbers of those
  std::vector<std::int32_t> step(ElasticRod& rod, Lumen& lumen);
  /// Takes one off.
  void remove(std::int32_t number, ElasticRod& rod, Lumen& lumen);
  /// Of the one that is on whose width has this arc, the nearest; 0: none.
  std::int32_t number_at(double arc_m) const;

  /// What one bears along the rod: by its width share, and less with little rod beyond it. N
  double bears_n(const Clip& clip, const ElasticRod& rod) const;
  std::span<const Clip> clips() const { return clips_; }  ///< also those that came off
  /// Of those that are on, along the rod, ascending, m.
  std::vector<double> arcs() const;
  const ClipOptions& options() const { return options_; }

 private:
  struct Held {
    int splint = 0, closure = 0;
    Vec3 pull_T = Vec3::Zero();
    double over_s = 0;
  };
  Clip* find(std::int32_t number);

  ClipOptions options_;
  std::vector<Clip> clips_;
  std::vector<Held> held_;  ///< of the same index
};

/// A clip as pictures draw it, in C: two legs and the bridge between them, closed and manifold.
/// @param gap_m between the legs at their tips and @param crotch_m at the bridge: equal once it is closed
TriangleSurface clip_model(const ClipOptions& options, double gap_m, double crotch_m);

}  // namespace trocar
