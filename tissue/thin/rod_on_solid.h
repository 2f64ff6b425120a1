// A rod's end, or a sheet's hinge, on a soft solid: how the two step in turn.
//
// (1) The rod steps with its anchor where the solid's place is and is going. (2) The solid steps with three springs for
// the end: the rod's force at that place, and its stiffness within the step, so that the solid meets a rod that gives
// way as it does and not a fixed force: with a fixed one, an anchorage of 2000 N/m on a node of a gram would not be
// stable at 10 ms. T, SI. Thread: tissue task; pure functions.
#pragma once

#include <array>

#include "tissue/solid/soft_solid.h"
#include "tissue/thin/elastic_rod.h"

namespace trocar {

/// Where the shares' place is and how fast it goes, as an anchor. @param rotation of the solid there since drawn
RodAnchor anchor_on(const SoftSolid& solid, const NodeShares& place, double stiffness_n_per_m,
                    const Mat3& rotation = Mat3::Identity());

/// What an end, or a sheet's node, does to the solid's place that it hangs on.
struct AnchorLoad {
  Vec3 force = Vec3::Zero();         ///< N, where the place was expected after the step ...
  Vec3 expected_way = Vec3::Zero();  ///< ... that far from where it is, m
  Mat3 stiffness = Mat3::Zero();     ///< from there on, N/m
};
/// It for the solid's step, along the principal axes of its stiffness.
std::array<SoftSpring, 3> load_springs(const AnchorLoad& load, const NodeShares& place);
inline AnchorLoad anchor_load(const ElasticRod& rod, RodEnd end) {
  return {rod.anchor_load(end).force, rod.anchor_way(end), rod.anchor_stiffness(end)};
}

}  // namespace trocar
