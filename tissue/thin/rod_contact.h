// What presses on a rod from outside: the contacts that the loop has solved on its surface, as springs of its step.
//
// As SoftOrgan does it: each contact that carried force in the newest tick is a pushing spring between its place on the
// tube and the point of the tool that presses there, and friction one across it. Thread: tissue task; pure functions.
#pragma once

#include <vector>

#include "haptics/exchange/solved_contacts.h"
#include "tissue/thin/elastic_rod.h"
#include "tissue/thin/rod_surface.h"

namespace trocar {

/// Of a tube's ring pressed along two lines, force per length over what its diameter loses, N/m2.
double ring_stiffness(const RodOptions& rod);

/// Of a dent that a round tool makes in a tube: its ring over the length that the tool flattens, N/m. A thread's is
/// that of its stuff under the tool.
double dent_stiffness(const RodOptions& rod, double tool_radius_m);

/// @param first_triangle id of the tube's first triangle in the patch
/// @param stiffness_n_per_m of the dent. @return in the contacts' order, first all that push, then friction
std::vector<RodSpring> rod_contacts(const SolvedContacts& contacts, std::int32_t first_triangle, const RodSurface& tube,
                                    double stiffness_n_per_m);

/// How stiff a spring of the last step is with the rod behind it, for the loop within a step, N/m: in (0, k].
double loop_stiffness(const ElasticRod& rod, double arc_m, const Vec3& direction, double spring_n_per_m);

}  // namespace trocar
