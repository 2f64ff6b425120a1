// Where a body, box or ring, touches something else. Frame T, m. Thread: tissue task.
#pragma once

#include "tissue/rigid/rigid_body.h"
#include "tissue/rigid/rigid_scene.h"

namespace trocar {

/// Capsule first.
RigidContacts capsule_body(const CapsuleShape& capsule, const RigidBody& body);
/// @param skin_m distance that still counts as touching.
RigidContacts body_body(const RigidBody& a, const RigidBody& b, double skin_m);
/// Body first, the half space below height_m second.
RigidContacts body_plane(const RigidBody& body, double height_m);
/// Of its lowest corner.
double lowest(const RigidBody& body);

/// A peg with a round end.
CapsuleShape capsule_of(const PegPost& peg);
/// Turns a ring that is held askew towards the peg in its hole, as far as the peg has come into it.
void turn_on_pegs(const std::vector<PegPost>& pegs, RigidBody& ring);
/// Moves a body that is carried past pegs, as far as they let it: in small steps, pushed out of each after each.
void carry_past(const std::vector<PegPost>& pegs, const Vec3& to_T, RigidBody& body);

}  // namespace trocar
