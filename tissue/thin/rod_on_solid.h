// A rod's end on a soft solid: how the two step in turn.
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

/// The load of a rod's end for the solid's step, along the principal axes of its stiffness.
std::array<SoftSpring, 3> anchor_springs(const ElasticRod& rod, RodEnd end, const NodeShares& place);

}  // namespace trocar
