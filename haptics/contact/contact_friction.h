// Coulomb friction of the instrument on the tissue, anchored to material points of both.
//
// Where the instrument presses with N it holds on to the tissue by a spring of k_t = 0.8 k across the normal: u is how
// far the material point of the instrument has moved against that of the tissue (triangle and barycentric place: it
// moves with the triangle) since both met. |k_t u| <= mu N, a cone: beyond it the anchor is dragged. mu is mu_static
// until it slips, then mu(v) = mu_d + (mu_s - mu_d) exp(-(v / v_s)^2) (Stribeck), approached over some periods so that
// a break-away is no step. The material points are taken anew when the contact has rolled on by 0.5 mm or 8 degrees; u
// is carried over, turned with the normal, so nothing jumps from triangle to triangle and a stuck contact cannot creep.
// Rolling without slip and spinning about the normal meet no resistance; a shaft that turns about itself does, on the
// lever of its radius. V = k_t |u|^2 / 2 is the stored energy; dragging, fading normal force and lost contact only ever
// shorten u. Several contacts share k_t as they share N: splitting one contact into two changes nothing. Frame T.
// Thread: haptic task; no allocation.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "haptics/contact/tool_shape.h"
#include "haptics/exchange/contact_patch.h"
#include "haptics/quantities.h"

namespace trocar {

inline constexpr int kMaxPressedPlaces = 3;  ///< contacts that can carry at once in space

/// Where the instrument presses this period.
struct PressedPlace {
  Vec3 foot, normal;       ///< on the surface; unit, out of it
  double share = 0;        ///< of the depth, m: N = k share
  std::int32_t index = 0;  ///< triangle in the patch
  std::int8_t capsule = 0;
  Vec3 velocity = Vec3::Zero();  ///< of the surface at the foot, m/s
};

/// What friction does at one pressed place.
struct PlaceFriction {
  Vec3 force = Vec3::Zero();  ///< on the instrument
  MaterialPoint anchor;       ///< what it holds on to
};

struct FrictionResult {
  Wrench F_I_T;  ///< on the instrument, moment about its tip
  double stored_j = 0;
  bool slipping = false;                            ///< any contact
  std::array<PlaceFriction, kMaxPressedPlaces> at;  ///< in the order of the places
};

/// What the friction must know of the instrument. proxy - tip = y.
struct PressingTool {
  const Pose& X_TI;
  const Twist& V_TI_T;
  const ToolCapsules& capsules;
  Vec3 y;
};

class ContactFriction {
 public:
  void reset() { count_ = 0; }

  /// One period. @param places at most kMaxPressedPlaces, shares > 0; @param stiffness k of the normal springs.
  FrictionResult update(const PressingTool& tool, std::span<const PressedPlace> places, double stiffness_n_per_m,
                        const ContactPatch& patch);

 private:
  struct Anchor {
    Vec3 on_tool;                ///< material point of the instrument, in the frame of its capsule
    MaterialPoint on_tissue;     ///< material point of the tissue
    std::int32_t index = 0;      ///< where its triangle was in the patch
    Vec3 origin = Vec3::Zero();  ///< tool point minus tissue point at u = 0
    Vec3 normal_then;            ///< when both points were taken
    Vec3 normal, foot;           ///< in the last period
    Vec3 u = Vec3::Zero();       ///< in the last period, across the normal
    double mu = 0;
    std::int8_t capsule = 0;
    bool slipping = false;
  };

  /// Pressed places as friction takes them: what is one contact to it is one place.
  struct Merged {
    std::array<PressedPlace, kMaxPressedPlaces> at;
    std::array<double, kMaxPressedPlaces> pressed{};  ///< sum of the shares
    int count = 0;
    std::array<int, kMaxPressedPlaces> into{};  ///< where each place has gone
  };
  static Merged merge(std::span<const PressedPlace> places);
  const Anchor* find(const PressedPlace& place) const;
  /// u of this period from the two material points; false when points are to be taken anew.
  bool stretch(Anchor& anchor, const PressedPlace& place, const Pose& X_TC, const ContactPatch& patch) const;
  void take_points(Anchor& anchor, const PressedPlace& place, const Pose& X_TC, const Vec3& y,
                   const ContactPatch& patch) const;
  /// Moves along mu(v) and drags the anchor. @param limit_m u at mu = 1
  void slide(Anchor& anchor, const ContactMaterial& material, double speed_m_s, double limit_m) const;

  std::array<Anchor, kMaxPressedPlaces> anchor_;
  int count_ = 0;
  std::uint64_t topology_ = 0;  ///< that the anchors' ids are of
};

}  // namespace trocar
