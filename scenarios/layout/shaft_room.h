// Room for the instrument behind its tip: many a spot that the tip reaches lies so that the shaft would press on the
// organ first.
//
// The instrument stands as contact leaves it, its tip sphere on the surface: however deep the hand presses, the force
// pushes along the normal of that place (contact_renderer.h), so what is clear there stays clear. Direct mapping: at
// its resting orientation; through a port: on the line from the port. Behind kNearTip every part of it must be
// kLeastGap off the surface; before, tip and tissue are as near as a touch is. Frame T, m. Thread: const after
// construction, one thread.
#pragma once

#include <optional>
#include <vector>

#include "haptics/contact/tool_shape.h"
#include "haptics/mapping/instrument_map.h"
#include "tissue/collision/surface_tree.h"

namespace trocar {

class ShaftRoom {
 public:
  static constexpr double kNearTip = 0.010;    ///< m behind the tip
  static constexpr double kLeastGap = 0.0015;  ///< m
  static constexpr double kFarthest = 0.030;   ///< m: gaps are not told beyond

  /// @param felt_T all that the instrument can touch; must outlive this. @param map its registration is not clutched.
  ShaftRoom(const TriangleSurface& felt_T, const ToolShape& tool, const InstrumentMap& map);
  /// The same at one orientation wherever the tip is: what a port asks only at the region's centre.
  ShaftRoom(const TriangleSurface& felt_T, const ToolShape& tool, const Mat3& R_TI);

  /// Between surface and instrument behind kNearTip while the tip touches at `point_T`; below 0: it would be in the
  /// tissue.
  double gap_m(const Vec3& point_T, const Vec3& normal_T) const {
    return gap_up_to(kFarthest, touching(point_T, normal_T));
  }
  /// The same with the tip's centre at `tip_T`.
  double gap_m(const Vec3& tip_T) const { return gap_up_to(kFarthest, tip_T); }
  /// Is it kLeastGap?
  bool free(const Vec3& point_T, const Vec3& normal_T) const {
    return gap_up_to(kLeastGap, touching(point_T, normal_T)) >= kLeastGap;
  }
  /// Does nothing of it meet the surface with the tip's centre at `tip_T`?
  bool passes(const Vec3& tip_T) const { return gap_up_to(0, tip_T) >= 0; }

 private:
  Vec3 touching(const Vec3& point_T, const Vec3& normal_T) const;
  /// The gap, or `farthest_m` when it is wider.
  double gap_up_to(double farthest_m, const Vec3& tip_T) const;

  SurfaceTree tree_;
  ToolShape tool_;
  Mat3 R_TI_;
  std::optional<InstrumentMap> through_port_;
  mutable std::vector<SurfaceTree::Hit> hits_;
};

}  // namespace trocar
