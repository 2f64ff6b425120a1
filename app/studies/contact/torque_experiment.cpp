#include <stdexcept>

#include "app/studies/contact/contact_torque_study.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/least_turn.h"

namespace trocar {
namespace {

constexpr double kHalfLength = 0.1, kRadius = 0.005;  // m, of the cylinder
constexpr double kToFace = 0.010;                     // m between the cylinder at rest and the face
constexpr double kLever = 0.090;                      // m from the origin to the middle of the face
constexpr double kCube = 0.08, kLongCube = 0.24;      // m; the long one reaches under both ends
constexpr double kNearHome = -0.255;                  // m, height of the stylus in W'; at home it is -0.272
constexpr double kDrawnIn = -0.200;                   // m, where pushing along the arm, X6, meets less friction
constexpr double kTurnTravel = 1.2;                   // s, the hand's way in or out

/// Shaft of the tool along Y6 or Z6 of the stylus, its middle in the origin.
Pose shaft_along(int axis) {
  Pose X_SI;
  X_SI.R = least_turn(Vec3::UnitZ(), Vec3::Unit(axis)).toRotationMatrix();
  X_SI.p = kHalfLength * Vec3::Unit(axis);
  return X_SI;
}

/// Rest, tool and cube: the shaft along `shaft`, the face before it along `facing` of the stylus at rest.
ContactExperiment scene(int shaft, int facing, double height_m, double cube_m, double lever_m) {
  ContactExperiment e;
  e.rest = {home_pose().R, Vec3(0, home_pose().p.y(), height_m)};
  e.tool.radius_m = kRadius;
  e.tool.shaft_length_m = 2 * kHalfLength;
  e.X_SI = shaft_along(shaft);
  const Vec3 middle = lever_m * e.rest.R.col(shaft) - (kRadius + kToFace + 0.5 * cube_m) * e.rest.R.col(facing);
  add_cube(e.surface, {e.rest.R, e.rest.p + middle}, cube_m);
  return e;
}

ContactExperiment clocked(ContactExperiment e, double begins_s, double ends_s) {
  e.begins_s = begins_s;
  e.ends_s = ends_s;
  return e;
}

/// Turned about an axis of the stylus at rest.
Pose turned(const ContactExperiment& e, int axis, double angle) {
  return {e.rest.R * Eigen::AngleAxisd(angle, Vec3::Unit(axis)), e.rest.p};
}

void press(TorqueExperiment& t, int facing, const Pose& deep, const TorqueContact& contact) {
  const Vec3 normal = t.experiment.rest.R.col(facing);
  const ContactFace face{t.experiment.rest.p - (kRadius + kToFace) * normal, normal};
  add_contact(t.experiment, face, deep, contact.touch_s, contact.leave_s, kTurnTravel);
  t.contacts.push_back(contact);
}

}  // namespace

TorqueExperiment torque_experiment(char axis, double turn_rad) {
  using enum Component;
  TorqueExperiment t;
  t.axis = axis;
  if (axis == 'x') {
    t.experiment = clocked(scene(1, 2, kNearHome, kCube, kLever), 8.5, 21.5);
    const std::vector<ExpectedSign> expected{{kMx, +1}, {kFz, +1}, {kFy, -1}};
    press(t, 2, turned(t.experiment, 0, -turn_rad), {10.15, 15.65, true, expected});
    press(t, 2, turned(t.experiment, 0, -turn_rad), {17.5, 20.5, false, expected});
  } else if (axis == 'y') {
    t.experiment = clocked(scene(2, 0, kDrawnIn, kCube, kLever), 5.5, 15.0);
    const std::vector<ExpectedSign> expected{{kMy, +1}, {kFx, +1}, {kFz, -1}};
    press(t, 0, turned(t.experiment, 1, -turn_rad), {6.98, 9.35, true, expected});
    press(t, 0, turned(t.experiment, 1, -turn_rad), {11.5, 13.9, false, expected});
  } else if (axis == 'z') {
    t.experiment = clocked(scene(1, 0, kDrawnIn, kLongCube, 0), 4.0, 16.0);
    press(t, 0, turned(t.experiment, 2, +turn_rad), {5.60, 8.70, true, {{kMz, -1}, {kFx, +1}, {kFy, -1}}});
    press(t, 0, turned(t.experiment, 2, -turn_rad), {11.50, 14.70, true, {{kMz, +1}, {kFx, +1}, {kFy, +1}}});
  } else {
    throw std::invalid_argument("torque experiment: an axis is x, y or z");
  }
  return t;
}

}  // namespace trocar
