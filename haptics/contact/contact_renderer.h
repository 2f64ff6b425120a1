// Contact of the instrument with the tissue patch: the force of the local elasticity on shaft, jaws and what they hold.
//
// The instrument is a set of capsules (tool_shape.h). A proxy of all of them, displaced by y without rotation, is kept
// outside the surface: it moves towards the instrument in steps under half a radius and is pushed out of every triangle
// nearer than the radius, so it can never change sides (side memory). Turning and opening jaws are followed in steps as
// short. At rest y is the shortest displacement that frees the instrument and F = k y; the moment is that of the
// contact forces about the tip (virtual work of V = k |y|^2 / 2, so the law is conservative). One k serves all
// contacts: that of the touched materials by the force they carry; where it changes it follows over 2 mm of travel, so
// that no border between materials is a step. The radius rounds convex edges: the normal turns continuously; where that
// is too fast (deep, or over facets) the proxy lags behind, so that the force turns no faster than over an edge of 3 mm
// and 0.5 deg a period: V then counts what contacts carry of y, and sliding on only lowers it. Damping
// multiplies the force by 1 + 1.5 c v, v the speed at which instrument and surface approach, bounded below by 0: it
// never pulls (Hunt and Crossley 1975, exponent 1). Friction comes on top (contact_friction.h). Zilles and Salisbury
// 1995 (god-object), Ortega, Redon and Coquillart 2007 (6-DOF god-object).
//
// The thesis' law (nearest point, F = k x, M = (p_contact - p_origin) x F) is kept as a selectable baseline.
// Frame T. Thread: haptic task; no allocation.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "haptics/contact/contact_friction.h"
#include "haptics/contact/gliding_patch.h"
#include "haptics/contact/near_pairs.h"
#include "haptics/contact/segment_triangle.h"
#include "haptics/contact/tool_shape.h"
#include "haptics/exchange/contact_patch.h"
#include "haptics/exchange/solved_contacts.h"
#include "haptics/quantities.h"

namespace trocar {

enum class ContactLaw : std::uint8_t { kProxy, kThesis };

struct ContactResult {
  Wrench F_I_T;               ///< on the instrument, moment about the tip: factor * normal springs + friction
  Wrench spring_I_T;          ///< of that what springs hold, without damping: normal springs + friction
  double damping_factor = 1;  ///< >= 0
  bool slipping = false;      ///< friction has reached its limit somewhere
  bool contact = false;
  bool tip_contact = false;       ///< the largest contact force acts on the tip sphere
  Vec3 point_T = Vec3::Zero();    ///< surface point under the largest contact
  Vec3 normal_T = Vec3::UnitZ();  ///< direction of the force
  double depth_m = 0;             ///< |y|
  double stored_j = 0;            ///< k |y|^2 / 2 and what friction stores
};

class ContactRenderer {
 public:
  explicit ContactRenderer(ContactLaw law, ToolShape shape = {}, const GlideParameters& glide = {})
      : law_(law), shape_(shape), glide_(glide) {}

  /// Forgets the proxy: the next update starts at the instrument itself (after homing or a clutch).
  void reset() {
    started_ = touching_ = false;
    contacts_.count = 0;
    near_.forget();
    glide_.forget();
    friction_.reset();
    parting_share_ = 0;
    eased_ = eased_spring_ = {};
    eased_stored_ = eased_j_ = 0;
  }

  /// Another instrument takes the place of the one in use, where the proxy is: it must fill no more than that one did.
  void take(const ToolShape& shape);

  /// What has been looked at since this was last asked; for benchmarks and tests.
  NearPairs::Work take_work() { return std::exchange(near_.work, {}); }

  /// One period. @param X_TI instrument pose; @param V_TI_T its velocity, linear part at the tip.
  /// @param jaw_opening_m gap between the ends of the jaw pads. @param drawn_m how far the instrument has been drawn
  /// back along its shaft; what it holds stays.
  ContactResult update(const Pose& X_TI, const Twist& V_TI_T, const ContactPatch& newest, double jaw_opening_m = 0,
                       double drawn_m = 0);
  /// Those that carried force in the last period; their forces add up to F_I_T.force.
  const SolvedContacts& contacts() const { return contacts_; }

 private:
  struct Touch {
    Vec3 normal, point;  ///< unit from surface to axis; surface point
    double gap;          ///< between the surfaces of capsule and triangle, m; negative: they overlap
    std::int32_t index;  ///< triangle in the patch
    std::int8_t capsule;
    bool at_tip;
    double share = 0;  ///< part of y carried, m
  };

  /// What tissue in the grip of the jaws does on the instrument.
  void add_hold(const Pose& X_TI, const GripHold& hold, ContactResult& result);
  /// What the wire does on a ring round it (ring_contact.h).
  void add_ring(const Pose& X_TI, const Twist& V_TI_T, const RingOnWire& ring, ContactResult& result);
  /// What a new patch has no more, of what was pressed, is let go slowly: jaws that take a fold press on it still.
  void part_with_lost(const Pose& X_TI, const ContactPatch& patch);
  void add_parting(const Pose& X_TI, ContactResult& result);
  /// Of tissue, what is felt changes by no more than so much a period, whatever its surface does: news is no blow. Only
  /// a force that lags, once it would give more than springs had stored, is let go at once.
  void ease(const Pose& X_TI, ContactResult& result);
  /// Weakens everything by what is left of the force without new patches.
  void fade(ContactResult& result);
  ContactResult thesis_law(const Pose& X_TI, const ContactPatch& patch);
  /// Where the axes of all capsules lie now; on the first call the proxy begins there.
  CapsuleAxes place_capsules(const Pose& X_TI);
  /// Moves the proxy to where it rests this period and shares out the force to what it touches.
  void move_proxy(const Vec3& goal, const CapsuleAxes& axes, const ContactPatch& patch);
  /// @return m that it has gone along the surface
  double slide(const Vec3& goal, double allowance, const ContactPatch& patch);
  /// By how much the force has turned since the last period, rad; both carry some.
  double turned() const;
  ContactResult proxy_law(const Pose& X_TI, const Twist& V_TI_T, const ContactPatch& patch);
  /// The n-th near pair as the proxy lies, and the gap between the surfaces, m.
  std::pair<ClosestPair, double> measure(int n, const ContactPatch& patch);
  /// How far back along its way the proxy first met what it has run into, m.
  /// @param least_cosine between its way and the way into the surface that counts
  double overshoot(const Vec3& along, double least_cosine, const ContactPatch& patch);
  /// The period ended in the middle of a slide, a hair off the surface: brings the proxy to what it slides along.
  void lean_on_nearest(const Vec3& goal, const ContactPatch& patch);
  /// Furthest that an end of a capsule has to go against the tip to take this place.
  double turn_to(const CapsuleAxes& axes) const;
  void blend_material(const ContactPatch& patch, double travel_m);
  /// Lists the contacts that carry.
  void list_pressed(const ContactPatch& patch);
  std::span<const PressedPlace> pressed() const { return {pressed_.data(), static_cast<std::size_t>(contacts_.count)}; }
  void add_friction(const Pose& X_TI, const Twist& V_TI_T, const ContactPatch& patch, ContactResult& result);
  /// Speed at which the contacts are pressed in, relative to the surface and conjugate to their forces, m/s.
  double approach_speed(const Twist& V_TI_T, double depth_m) const;
  /// Pushes the proxy out of the near triangles and lists those within `slack` of touching.
  void project(const ContactPatch& patch, double slack);
  /// One round of that over all of them. @return the deepest overlap that it met, m
  double sweep(const ContactPatch& patch, double slack);
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
  Vec3 proxy_ = Vec3::Zero();                            ///< tip centre of the proxy, T
  Vec3 last_goal_ = Vec3::Zero();                        ///< tip of the instrument one period ago, T
  Vec3 push_ = Vec3::Zero(), last_push_ = Vec3::Zero();  ///< of y what the contacts carry, now and one period ago, m
  ToolCapsules tool_;
  int known_ = 0;          ///< capsules of the last period
  double thinnest_m_ = 0;  ///< least radius in tool_
  CapsuleAxes axes_{};     ///< of the proxy
  ContactFriction friction_;
  ContactMaterial blend_;  ///< stiffness and damping in use
  bool touching_ = false;  ///< carried force in the last period
  NearPairs near_;
  GlidingPatch glide_;
  double stored_j_ = 0;  ///< of the normal springs, in the last period
  Wrench parting_;       ///< of contacts that are none any more, about the tip, when they were lost
  double parting_share_ = 0, parting_j_ = 0;  ///< what is left of it, and of the energy that it held
  Vec3 parting_tip_ = Vec3::Zero();           ///< where the tip was a period ago
  Wrench eased_, eased_spring_;               ///< what was felt of tissue in the last period, whole and of its springs
  Vec3 eased_tip_ = Vec3::Zero();             ///< where the tip was then
  double eased_stored_ = 0, eased_j_ = 0;     ///< what springs stored then, and have lost since the force lags
  std::uint64_t parted_stamp_ = 0;            ///< of the patch that was looked through last
  std::array<Touch, kMaxContacts> touch_{};
  int touch_count_ = 0;
  std::array<std::int32_t, kMaxPressedPlaces> carrying_{};
  int carrying_count_ = 0;
  std::array<PressedPlace, kMaxPressedPlaces> pressed_;
  SolvedContacts contacts_;  ///< of the same places
};

}  // namespace trocar
