// Where the instrument presses on the surface and how much, as the contact stage solved it in one tick: what the tissue
// task gives back to the tissue.
//
// Frame T; forces in scene newtons ON the instrument, the tissue feels the opposite. They add up to the force of the
// contact. Fixed size: copying allocates nothing.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/exchange/material_point.h"
#include "haptics/exchange/stylus_state.h"
#include "haptics/quantities.h"

namespace trocar {

inline constexpr int kMaxContacts = 16;

struct SolvedContact {
  MaterialPoint place;
  Vec3 normal_T;               ///< unit, out of the surface
  Vec3 force_T;                ///< spring, damping and friction
  MaterialPoint anchor;        ///< what friction holds on to; triangle -1: no friction
  Vec3 tool_T = Vec3::Zero();  ///< the point of the tool that presses there, as deep in the surface as it is
  double share = 1;            ///< of the force that a spring of the whole depth at this place would give, 0..1
};

struct SolvedContacts {
  std::uint64_t topology = 0;  ///< of the patch that the triangles' ids are from
  std::int32_t count = 0;
  std::array<SolvedContact, kMaxContacts> at;
};

/// What the haptic task tells the tissue task each tick.
struct HapticState {
  StylusState stylus;
  SolvedContacts contacts = {};
};

}  // namespace trocar
