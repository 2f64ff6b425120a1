#include "haptics/contact/tool_shape.h"

#include <algorithm>
#include <cmath>

#include "haptics/least_turn.h"

namespace trocar {
namespace {

constexpr double kWidest = 0.7;  // sine of half the angle between fully open jaws

/// Jaw on the side +1 or -1 of the plane y = 0: its axis lies one radius behind the pad.
Capsule jaw(const ToolShape& shape, double opening_m, int side) {
  const double sine = side * std::clamp(0.5 * opening_m / shape.jaw_length_m, 0.0, kWidest);
  const double cosine = std::sqrt(1 - sine * sine);
  Capsule capsule;
  capsule.X_IC.R << 1, 0, 0, 0, cosine, sine, 0, -sine, cosine;
  const Vec3 pad = capsule.X_IC.R.col(2) * shape.jaw_length_m;
  const Vec3 behind = capsule.X_IC.R.col(1) * (side * shape.jaw_radius_m);
  capsule.X_IC.p = Vec3(0, 0, -shape.jaw_length_m) + pad + behind;
  capsule.length_m = shape.jaw_length_m;
  capsule.radius_m = shape.jaw_radius_m;
  capsule.foremost = true;
  return capsule;
}

Capsule held_capsule(const HeldObject& held) {
  Capsule capsule;
  const Vec3 axis = held.from_I - held.to_I;
  capsule.length_m = axis.norm();
  if (capsule.length_m > 0) capsule.X_IC.R = least_turn(Vec3::UnitZ(), axis).toRotationMatrix();
  capsule.X_IC.p = held.from_I;
  capsule.radius_m = held.radius_m;
  return capsule;
}

}  // namespace

ToolCapsules tool_capsules(const ToolShape& shape, double jaw_opening_m, const HeldObject& held, double drawn_m) {
  ToolCapsules tool;
  Capsule& shaft = tool.at[tool.count++];
  shaft.X_IC.p.z() = -shape.jaw_length_m;
  shaft.length_m = shape.shaft_length_m - shape.jaw_length_m;
  shaft.radius_m = shape.radius_m;
  shaft.foremost = shape.jaw_length_m <= 0;
  if (shape.jaw_length_m > 0) {
    tool.at[tool.count++] = jaw(shape, jaw_opening_m, +1);
    tool.at[tool.count++] = jaw(shape, jaw_opening_m, -1);
  }
  for (int c = 0; c < tool.count; ++c) tool.at[c].X_IC.p.z() -= drawn_m;
  if (held.radius_m > 0) tool.at[tool.count++] = held_capsule(held);
  return tool;
}

}  // namespace trocar
