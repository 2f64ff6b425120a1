// The instrument as capsules: shaft, two jaws whose pose follows the opening, and what the jaws hold.
//
// Frame I: origin at the tip with jaws closed, z along the shaft towards the tip, x the hinge axis of the jaws. The
// jaws' pads meet in the plane y = 0; opened, the ends of the pads stand `opening` apart. Lengths m. Thread: pure
// functions, any thread; no allocation.
#pragma once

#include <array>

#include "haptics/exchange/contact_patch.h"
#include "haptics/quantities.h"

namespace trocar {

inline constexpr int kMaxCapsules = 4;

/// Without jaws the shaft reaches the tip: a probe, its end sphere centred on the tip.
struct ToolShape {
  double radius_m = 0.0025;      ///< of the shaft: 5 mm instrument
  double shaft_length_m = 0.30;  ///< from the tip backwards along -z of I, jaws included
  double jaw_length_m = 0;       ///< hinge to tip, 0.020 for a grasper; 0: no jaws
  double jaw_radius_m = 0.00125;
};

/// Axis from the origin of its frame C backwards along -z of C.
struct Capsule {
  Pose X_IC;
  double length_m = 0, radius_m = 0;
  bool foremost = false;  ///< its end sphere is the instrument's tip
};

struct ToolCapsules {
  std::array<Capsule, kMaxCapsules> at;
  int count = 0;
};

/// @param jaw_opening_m clamped to what the hinge allows, 0 to 1.4 jaw lengths. @param drawn_m how far shaft and jaws
/// are drawn back along -z.
ToolCapsules tool_capsules(const ToolShape& shape, double jaw_opening_m, const HeldObject& held, double drawn_m = 0);

}  // namespace trocar
