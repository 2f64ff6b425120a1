// Contact of the instrument with the tissue patch: the force of the local elasticity on tip sphere and shaft.
//
// The instrument is a capsule (tip sphere, shaft). A proxy of it, displaced by y without rotation, is kept outside the
// surface: it moves towards the instrument in steps under half a radius and is pushed out of every triangle nearer
// than the radius, so it can never change sides (side memory). At rest y is the shortest displacement that frees the
// capsule and F = k y; the moment is that of the contact forces about the tip (virtual work of V = k |y|^2 / 2, so the
// law is conservative). The radius rounds convex edges: the normal turns continuously. Damping multiplies the force by
// 1 + 1.5 c v, v the approach speed, bounded below by 0: it never pulls (Hunt and Crossley 1975, exponent 1).
// Zilles and Salisbury 1995 (god-object), Ortega, Redon and Coquillart 2007 (6-DOF god-object).
//
// The thesis' law (nearest point, F = k x, M = (p_contact - p_origin) x F) is kept as a selectable baseline.
// Frame T. Thread: haptic task; no allocation.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/exchange/contact_patch.h"
#include "haptics/quantities.h"

namespace trocar {

enum class ContactLaw : std::uint8_t { kProxy, kThesis };

/// The instrument's shape: a capsule whose end sphere is centred on the tip.
struct ToolShape {
  double radius_m = 0.0025;      ///< 5 mm instrument
  double shaft_length_m = 0.30;  ///< from the tip backwards along -z of I
};

struct ContactResult {
  Wrench F_I_T;               ///< spring and damping, on the instrument, moment about the tip
  double damping_factor = 1;  ///< F_I_T = factor * spring part, >= 0
  bool contact = false;
  bool tip_contact = false;       ///< the largest contact force acts on the tip sphere
  Vec3 point_T = Vec3::Zero();    ///< surface point under the largest contact
  Vec3 normal_T = Vec3::UnitZ();  ///< direction of the force
  double depth_m = 0;             ///< |y|
  double stored_j = 0;            ///< k |y|^2 / 2
};

class ContactRenderer {
 public:
  explicit ContactRenderer(ContactLaw law, ToolShape shape = {}) : law_(law), shape_(shape) {}

  /// Forgets the proxy: the next update starts at the instrument itself (after homing or a clutch).
  void reset() { started_ = false; }

  /// One period. @param X_TI instrument pose; @param V_TI_T its velocity, linear part at the tip.
  ContactResult update(const Pose& X_TI, const Twist& V_TI_T, const ContactPatch& patch);

 private:
  static constexpr int kMaxNear = 96;      ///< triangles considered in one tick
  static constexpr int kMaxContacts = 16;  ///< distinct contacts kept
  static constexpr int kMaxCarrying = 3;   ///< of them, those that can carry at once in space

  struct Touch {
    Vec3 normal, point;  ///< unit from surface to axis; surface point
    double distance;     ///< from the axis, m
    bool at_tip;
    double share = 0;  ///< part of y carried, m
  };

  /// A triangle that the proxy may meet this period.
  struct Near {
    double distance;  ///< from the axis, or less, when `travelled` was what it was; it changes no faster than that
    double travelled;
    std::int32_t index;  ///< in the patch
  };

  ContactResult thesis_law(const Pose& X_TI, const ContactPatch& patch) const;
  ContactResult proxy_law(const Pose& X_TI, const Twist& V_TI_T, const ContactPatch& patch);
  /// Speed at which the contacts are pressed in, conjugate to their forces, m/s.
  double approach_speed(const Twist& V_TI_T, double depth_m) const;
  void gather(double reach, const ContactPatch& patch);
  /// Pushes the proxy out of the near triangles and lists those within `slack` of touching.
  void project(const ContactPatch& patch, double slack);
  void add_touch(const Touch& touch);
  /// The part of a wish that the touched triangles allow, each with the gap that is left before it.
  Vec3 free_step(const Vec3& wish) const;
  /// Splits y among the contacts, all shares >= 0. @return the part of y that no contact carries.
  Vec3 share_out(const Vec3& y);
  /// Least-squares shares of the carrying contacts; those that would pull are dropped.
  void balance(const Vec3& y);

  ContactLaw law_;
  ToolShape shape_;
  bool started_ = false;
  Vec3 proxy_ = Vec3::Zero();       ///< tip centre of the proxy, T
  Vec3 last_goal_ = Vec3::Zero();   ///< tip of the instrument one period ago, T
  Vec3 backwards_ = Vec3::UnitZ();  ///< from the tip along the shaft, times its length
  std::array<Near, kMaxNear> near_{};
  int near_count_ = 0;
  double travelled_ = 0;  ///< of the proxy since the near triangles were gathered, m
  std::array<Touch, kMaxContacts> touch_{};
  int touch_count_ = 0;
  std::array<std::int32_t, kMaxCarrying> carrying_{};
  int carrying_count_ = 0;
};

}  // namespace trocar
