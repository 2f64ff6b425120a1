// Where a blade meets a surface: the line of a cut over the triangles, and how deep it goes.
//
// The blade is a convex outline in the plane x = 0 of its frame B. What of the surface lies within the outline is cut,
// from there straight into the tissue to where the outline ends. So two blades that close cut what lay between them, a
// hook's track what the hook has passed through. Frame T, the surface as it is now; depths come out in T and are turned
// to rest by the caller. Thread: tissue task. Same input, same cut.
#pragma once

#include <string_view>
#include <vector>

#include "tissue/mesh/surface/groove.h"

namespace trocar {

struct Blade {
  Pose X_TB;                             ///< plane x = 0
  std::vector<Eigen::Vector2d> outline;  ///< y, z in B, convex, counter-clockwise seen against x; m
};

/// Two straight blades of this length from the hinge, opened so far at their ends, that close on what lies between
/// them.
Blade scissor_blade(const Pose& X_TI, double length_m, double opening_m);
/// The track of an edge from one place to another. @param inward unit, along the edge into the tissue
Blade track_blade(const Vec3& from_T, const Vec3& to_T, const Vec3& inward_T, double depth_m, double above_m);

/// Numbers as recorded.
enum class CutRefusal : std::uint8_t {
  kNone,
  kNothingThere,
  kTooShallow,
  kTooFine,
  kThrough,
  kPieceOff,
  kNoWound,   ///< the clip applier's
  kBesideCut  ///< only a strip would be left between the line and a wound
};
std::string_view refusal_words(CutRefusal refusal);

struct CutTracingOptions {
  double bite_m = 0.0008;         ///< beyond the outline: how far an edge bites into what it lies against
  double taper_m = 0.003;         ///< from each end, over which the bite grows
  double least_depth_m = 0.0005;  ///< of the deepest place
  double least_edge_m = 0.0006;   ///< of a triangle that the line runs through: finer ones are not divided any more
  double gape_per_depth = 0.35;   ///< lips at once apart by this of the depth: what opens below the cells
  double most_gape_m = 0.002;
};

struct TracedCut {
  CutRefusal refusal = CutRefusal::kNothingThere;
  SurfaceCut cut;
  double length_m = 0, depth_m = 0, area_m2 = 0;  ///< of the line; the greatest; of one wall
  Vec3 middle_T = Vec3::Zero();                   ///< of the line's crossings
};

/// Whether most of a line runs along a wound, nearer to it than `least_strip_m`. One that crosses a wound, or goes on
/// from its end or down from its bottom, does not.
/// @param inside of each triangle: the wall of a wound; empty: there is none
bool runs_beside_wound(const TriangleSurface& now, const std::vector<bool>& inside, const SurfaceCut& cut,
                       double least_strip_m = 0.003);

TracedCut trace_cut(const TriangleSurface& now, const Blade& blade, const CutTracingOptions& options = {});

}  // namespace trocar
