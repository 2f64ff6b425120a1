// The way of a needle through tissue: places that it has cut past, held to its axis.
//
//   across  each place that lies along the needle has two springs to the needle's axis
//   along   friction, so much a metre inside: it sticks to the tissue and is dragged beyond that
//   ahead   the tip pushes the end of the way before it; beyond J times the wire's width the tissue is cut and the end
//           goes on. At the surface it takes a puncture to come out
// Places are those of the tissue at rest, so a cut beside them or a step of the solid changes nothing about them. What
// the needle has left is not held; with the path gone nothing is left. T, SI. Thread: tissue task.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "tissue/collision/surface_walk.h"
#include "tissue/solid/soft_organ.h"
#include "tissue/thin/needle_shape.h"

namespace trocar {

struct NeedleTissueOptions {
  double across_n_per_m = 1000, along_n_per_m = 400;  ///< of each place (choices)
  double tip_n_per_m = 1000;                          ///< of what the tip presses (a choice)
  double spacing_m = 0.003;                           ///< between places
  double friction_n_per_m =
      10;  ///< a metre inside; 10 to 20 of a needle of 1.3 mm in bovine liver, from memory: unchecked
  /// Force that opens the surface over that of cutting on; unchecked. At 2.5 a point that a shaft leaning 50 degrees
  /// rolls in dents liver by 4 mm and does not open it.
  double puncture_over_cut = 1.5;
  double most_contact_m2 = 4e-6;  ///< of what presses, beyond which nothing is punctured (tissue.md 3)
  double touch_friction = 0.5;    ///< of the point on the surface; unchecked
  double free_share = 0.25;       ///< of the springs' stiffness when nothing holds the needle: else it drags
  double most_pull_out_n = 4.62;  ///< human small bowel 4.62 +- 1.40 N, doi 10.1115/1.4063951
  double least_bridge_m = 0.003;  ///< of tissue between two holes, that its strength is counted over (a choice)
  double overload_s = 0.020;      ///< how long a limit must be passed (tissue.md 3)
};

/// With which the tip cuts on, N: J times the width of the wire.
double cutting_force(const TissueSolid& tissue, const NeedleShape& shape);
/// With which it opens the surface.
double puncture_force(const TissueSolid& tissue, const NeedleShape& shape, const NeedleTissueOptions& options);
/// Of a thread or a needle, pulled across the tissue between two holes: tension that it tears at times its width.
double pull_out_force(const TissueSolid& tissue, double bridge_m, const NeedleTissueOptions& options);

/// The organ, and how to walk on its surface.
struct OrganView {
  const SoftOrgan& organ;
  const SurfaceWalk& walk;
  double floor_m = -INFINITY;  ///< z of what lies under it, that nothing falls through
};

/// Of the organ's step, with the place of the needle that it pulls on.
struct NeedleSpring {
  SoftSpring soft;
  Vec3 at_T = Vec3::Zero();

  Vec3 on_needle() const { return soft.force_n * soft.direction; }  ///< N, after the step
};

class NeedlePath {
 public:
  /// @param entry_rest_T where the surface was opened. @param along_T the point's way there, unit. @param number by
  /// which it is known
  NeedlePath(const OrganView& view, const NeedleShape& shape, const Vec3& entry_rest_T, const Vec3& along_T,
             std::int32_t number);

  /// Before the organ's step. @param share of the springs' stiffness
  void add_springs(const OrganView& view, const NeedleShape& shape, const NeedleTissueOptions& options,
                   const Pose& X_TN, double share, std::vector<NeedleSpring>& springs);
  enum class Event : std::uint8_t { kNone, kCameOut, kTore };
  /// After it. @param springs those that add_springs() added, with their forces
  Event feel(const OrganView& view, const NeedleShape& shape, const NeedleTissueOptions& options, const Pose& X_TN,
             std::span<const NeedleSpring> springs);
  /// The organ has been cut: what is held is held by the cells that there are now.
  void follow_cut(const SoftOrgan& organ);

  std::int32_t number() const { return number_; }
  bool through() const { return through_; }                   ///< the tip has come out
  double inside_m() const { return inside_; }                 ///< of the needle, in the last step
  double entry_arc_m() const { return places_.front().arc; }  ///< where on the needle the holes are, as BesideNeedle
  double end_arc_m() const { return places_.back().arc; }
  const Vec3& entry_rest_T() const { return places_.front().rest; }
  const Vec3& end_rest_T() const { return places_.back().rest; }
  const Vec3& entry_along_T() const { return entry_along_; }  ///< unit: the point's way where it went in, as it went
  double bridge_m() const { return (end_rest_T() - entry_rest_T()).norm(); }
  double load_n() const { return load_; }            ///< across the needle, in the last step
  double end_force_n() const { return end_force_; }  ///< of the tip on what is before it
  /// Of all places that are held from the axis, the most, m.
  double furthest_m(const SoftOrgan& organ, const NeedleShape& shape, const Pose& X_TN) const;

 private:
  struct Place {
    Vec3 rest = Vec3::Zero();
    NodeShares shares;
    double arc = 0;  ///< on the needle now
    bool held = false;
    double stuck = 0;     ///< arc at which friction holds it, and
    double foreseen = 0;  ///< how far that has gone ahead
  };
  /// The end of a way that has not come out goes with the point: no friction acts on it.
  bool slides(const Place& place) const { return through_ || &place != &places_.back(); }
  void locate(const SoftOrgan& organ, const NeedleShape& shape, const Pose& X_TN);
  void move_end(const OrganView& view, const Vec3& way_T);
  void cut_on(const OrganView& view, const NeedleTissueOptions& options, const NeedleShape& shape, const Pose& X_TN,
              double force_n, double stiffness);

  std::int32_t number_ = 0;
  std::vector<Place> places_;  ///< entry first, the end of the way last
  Vec3 entry_along_ = Vec3::UnitZ(), end_before_ = Vec3::Zero();
  double end_foreseen_ = 0;
  bool through_ = false, at_surface_ = false, came_out_ = false;
  std::int32_t vertex_ = -1;  ///< of the surface at rest, near the end
  double inside_ = 0, load_ = 0, end_force_ = 0, overload_s_ = 0;
};

}  // namespace trocar
