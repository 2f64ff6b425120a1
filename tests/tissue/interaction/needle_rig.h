// A half-circle needle in a driver's jaws above an ellipsoid's top, turned about its own circle: how it should be
// driven.
#pragma once

#include <numbers>
#include <vector>

#include "tests/tissue/solid/soft_organ_rig.h"
#include "tests/tissue/thin/rod_rig.h"
#include "tissue/interaction/suture_needle.h"

namespace trocar::test {

struct NeedleRig {
  static constexpr double kTop = 0.035;   // m, of the organ
  static constexpr double kOver = 0.002;  // m of the circle's middle over it

  explicit NeedleRig(const TissueSolid& tissue = {}, const NeedleTissueOptions& options = {})
      : organ(build_lattice({rest->vertices, rest->triangles}, {.cell_m = 0.01}).lattice, rest, tissue, {}),
        needle(NeedleShape{}, turned(0), options) {
    const Vec3 held = turned(0) * needle.shape().place(0.3 * needle.shape().length_m);
    const Pose X_TI = jaws_from_above(held - Vec3(0, 0, 0.004));
    X_NI = turned(0).inverse() * X_TI;
    needle.load(X_TI, X_NI.inverse());
  }
  /// Turned by so much from where its point is level with the middle; the point goes down first.
  Pose turned(double angle, const Vec3& shift = Vec3::Zero()) const {
    Pose X;
    X.R.col(0) = Vec3::UnitX();
    X.R.col(1) = Vec3::UnitZ();
    X.R.col(2) = -Vec3::UnitY();
    X.R = Mat3(X.R * Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix());
    X.p = Vec3(0, 0, kTop + kOver) + shift;
    return X;
  }
  Pose jaws_at(double angle, const Vec3& shift = Vec3::Zero()) const { return turned(angle, shift) * X_NI; }
  void step(const std::optional<DriverJaws>& jaws, const ThreadPull& thread = {}) {
    std::vector<SoftSpring> springs;
    const OrganView view{organ, walk};
    needle.before(view, jaws, thread, springs);
    organ.step({}, nullptr, springs);
    needle.after(view, jaws, thread, springs);
  }
  void drive(double angle, const Vec3& shift = Vec3::Zero()) { step(DriverJaws{jaws_at(angle, shift), 0}); }
  /// Of the organ's surface.
  double furthest_from_rest() const {
    double most = 0;
    for (std::size_t v = 0; v < rest->vertices.size(); ++v)
      most = std::max(most, (organ.surface()->vertices[v] - rest->vertices[v]).norm());
    return most;
  }

  SurfacePtr rest = ellipsoid({0.06, 0.05, kTop}, 48);
  SoftOrgan organ;
  SurfaceWalk walk{*rest};
  SutureNeedle needle;
  Pose X_NI;
};

}  // namespace trocar::test
