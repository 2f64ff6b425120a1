// Surfaces and motions of the contact-law study. Frame T, metres.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "haptics/contact/contact_renderer.h"

namespace trocar::contact_law {

inline constexpr double kStiffness = 150;
inline constexpr double kStep = 1e-5;  ///< m a tick: 10 mm/s

std::unique_ptr<ContactPatch> empty_patch();
/// Sheet 2 mm thick about z = 0.
std::unique_ptr<ContactPatch> thin_sheet();
/// Top z = 0 and side x = 0 of a block that fills x < 0, z < 0.
std::unique_ptr<ContactPatch> block();
/// Cap of a ball of 40 mm radius, facets of 2 mm, its top at the origin.
std::unique_ptr<ContactPatch> faceted_ball();
/// Roof whose ridge runs along y at x = 100 mm, z = 0.
std::unique_ptr<ContactPatch> ridge();
/// Level ground z = 0.
std::unique_ptr<ContactPatch> ground();

/// Upright, tip down at p.
Pose upright(const Vec3& p);
/// Tip at p, shaft along +x.
Pose lying(const Vec3& p);

/// One law fed with a path: velocities are those of the path.
class Probe {
 public:
  Probe(ContactLaw law, const ContactPatch& patch) : renderer_(law), patch_(patch), law_(law) {}
  ContactResult go(const Pose& X);
  /// Comes down along the shaft from `height` in the air in steps of kStep.
  ContactResult descend(const Pose& X, double height);
  /// Where the law's tool touches first, above the surface: the thesis knows a point, Trocar a ball.
  double clearance() const { return law_ == ContactLaw::kThesis ? 0 : ToolShape{}.radius_m; }

 private:
  ContactRenderer renderer_;
  const ContactPatch& patch_;
  ContactLaw law_;
  Pose last_;
  bool started_ = false;
};

}  // namespace trocar::contact_law
