// The surface of tissue that deforms, as it is this period: every patch is glided into, never jumped to.
//
// A patch of the tissue task is a model of the surface for the next period of tissue. From the one in use to the next
// the vertices travel over glide_s, those of both from where they are: both models are faded into one another, and
// proxy and anchors are carried along. No step is longer than the proxy can follow without changing sides. What the
// moving surface does on the tool, sum F . ds + dk y^2 / 2, is paid from a tank of its own: filled by what the surface
// takes from the tool, by damping, and by the energy that the tissue lost in its step (ContactPatch::given_j); when it
// is empty the surface waits. So a surface can give no energy that nobody put in, and a late patch never makes force
// grow: after stale_s without one the force fades over fade_s, and comes back over return_s. Frame T. Thread: haptic
// task; no allocation.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/exchange/contact_patch.h"
#include "haptics/exchange/solved_contacts.h"

namespace trocar {

struct GlideParameters {
  double period_s = 1e-3;
  double tank_j = 2e-3;   ///< what it holds at most, and at first
  bool metered = true;    ///< false: the surface goes on whatever it costs; for comparison
  double stale_s = 0.05;  ///< without a new patch
  double fade_s = 0.2;
  double return_s = 0.05;  ///< over which faded force comes back once there are patches again
  double most_step = 0.4;  ///< of the thinnest capsule's radius that a vertex moves in a period
};

class GlidingPatch {
 public:
  explicit GlidingPatch(const GlideParameters& parameters = {}) : parameters_(parameters) {}

  /// One period on. @param pressed contacts of the last period; @param stored_j of their springs
  /// @param thinnest_m least radius of a capsule
  /// @return the newest patch itself where it does not glide, else the surface as it is now; until the next call
  const ContactPatch& follow(const ContactPatch& newest, const SolvedContacts& pressed, double stored_j,
                             double thinnest_m);
  void dissipated(double energy_j);
  void forget() { stamp_ = 0; }
  /// What the grip's spring did on the tool this period, and where the tool was.
  void pulled(const Vec3& force_T, const Pose& X_TI) { pull_T_ = force_T, X_TI_ = X_TI; }

  double period_s() const { return parameters_.period_s; }
  double moved_m() const { return moved_m_; }          ///< most that a vertex moved this period
  double force_share() const { return force_share_; }  ///< 1 while patches come

 private:
  using Places = std::array<std::int16_t, kMaxPatchVertices>;
  /// Where each vertex of the newest patch is in the present one, -1: not there. Of one topology.
  Places places_in_present(const ContactPatch& newest) const;
  void take(const ContactPatch& newest);
  /// What the rest of the way costs at the present forces, J.
  double cost_of_rest(const SolvedContacts& pressed, double stored_j) const;
  double cost_of_hold() const;
  void move(double share);

  GlideParameters parameters_;
  ContactPatch present_;
  std::array<Vec3, kMaxPatchVertices> start_, end_;
  std::array<double, kMaxPatchMaterials> stiff_start_{}, stiff_end_{};
  GripHold hold_start_, hold_end_;
  Vec3 pull_T_ = Vec3::Zero();
  Pose X_TI_;
  std::uint64_t stamp_ = 0;
  double progress_ = 1, longest_m_ = 0, age_s_ = 0;
  double moved_m_ = 0, force_share_ = 1;
  double tank_j_ = 0;
  bool filled_ = false;
};

}  // namespace trocar
