#include "haptics/mapping/fulcrum.h"

#include <cmath>

#include "haptics/least_turn.h"

namespace trocar {
namespace {

/// Smallest rotation that turns unit vector a into unit vector b.
Mat3 swing(const Vec3& a, const Vec3& b) { return least_turn(a, b).toRotationMatrix(); }

/// Twist angle about `axis` of a rotation: the part that is left when the smallest rotation of the axis is taken off.
double twist(const Mat3& R, const Vec3& axis) {
  const Eigen::Quaterniond q(R);
  return 2 * std::atan2(q.vec().dot(axis), q.w());
}

struct Lever {
  double d;  ///< m
  Vec3 u;    ///< handle to port
};

Lever lever(const Fulcrum& f, const Vec3& handle_T) {
  const Vec3 way = f.port_T - handle_T;
  const double d = way.norm();
  return {d, way / d};
}

Vec3 roll_axis(const Fulcrum& f, const Pose& X_TS) {
  const Vec3 z0 = f.R_TS_reference.col(2), z = X_TS.R.col(2);
  return (z0 + z) / (1 + z0.dot(z));
}

Vec3 roll_coupling(const Fulcrum& f, const Vec3& u) {
  const Vec3 u0 = f.R_TI_reference.col(2);
  return u0.cross(u) / (1 + u0.dot(u));
}

Vec3 along_and_across(const Fulcrum& f, const Lever& l, const Vec3& v) {
  const Vec3 along = l.u * l.u.dot(v);
  return along + (1 - f.length_m / l.d) * (v - along);  // A is symmetric
}

}  // namespace

Pose Fulcrum::instrument_pose(const Pose& X_TS) const {
  const Lever l = lever(*this, X_TS.p);
  const Vec3 z0 = R_TS_reference.col(2), u0 = R_TI_reference.col(2);
  const double roll = twist(X_TS.R * R_TS_reference.transpose(), z0);
  return {swing(u0, l.u) * (Eigen::AngleAxisd(roll, u0) * R_TI_reference), X_TS.p + length_m * l.u};
}

Twist Fulcrum::instrument_twist(const Pose& X_TS, const Twist& V_TS_T) const {
  const Lever l = lever(*this, X_TS.p);
  const double roll = V_TS_T.angular.dot(roll_axis(*this, X_TS)) + V_TS_T.linear.dot(roll_coupling(*this, l.u)) / l.d;
  return {along_and_across(*this, l, V_TS_T.linear), -l.u.cross(V_TS_T.linear) / l.d + roll * l.u};
}

Wrench Fulcrum::handle_wrench(const Pose& X_TS, const Wrench& F_I_T) const {
  const Lever l = lever(*this, X_TS.p);
  const double about_shaft = F_I_T.moment.dot(l.u);
  return {along_and_across(*this, l, F_I_T.force) +
              (l.u.cross(F_I_T.moment) + about_shaft * roll_coupling(*this, l.u)) / l.d,
          about_shaft * roll_axis(*this, X_TS)};
}

Vec3 Fulcrum::followed_axis(const Vec3& handle_T) const {
  return swing(R_TI_reference.col(2), lever(*this, handle_T).u) * R_TS_reference.col(2);
}

Pose Fulcrum::mapped_stylus(const Pose& X_TI) const {
  const Vec3 u0 = R_TI_reference.col(2), beyond_port = X_TI.p - port_T;
  Vec3 u = beyond_port.norm() > 0 ? Vec3(beyond_port.normalized()) : u0;
  if (u.dot(u0) < 0) u = -u;  // the tip is drawn back out of the port
  // What the instrument's roll is once its own shaft has been swung onto u.
  const Mat3 onto_u = swing(X_TI.R.col(2), u) * X_TI.R;
  const double roll = twist(swing(u0, u).transpose() * onto_u * R_TI_reference.transpose(), u0);
  const Vec3 z0 = R_TS_reference.col(2);
  return {Eigen::AngleAxisd(roll, z0) * R_TS_reference, X_TI.p - length_m * u};
}

}  // namespace trocar
