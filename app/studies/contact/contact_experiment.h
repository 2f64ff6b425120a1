// Experiments of thesis 3.7 on the bench: a hand leads the stylus into virtual walls or a cube and out again, and what
// the environment asks for is written down beside what a force/torque sensor at the stylus reads.
//
// Desired: the wrench of contact about the stylus origin, at the loop's rate. Measured: the force and moment that the
// device truly exerts on the hand, through a sensor of 40 Hz and 0.15 s lag with the weight of its fixture,
//   F_S = R_WS^T (F_on_hand + m g),
// which hangs along -X6 at rest as in figure 3.49. Both in the axes of the stylus (X6, Y6, Z6). Poses in W'. Times are
// those of the thesis' figures; what lies before begins_s is left out. SI. Thread: one owner.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "app/device_bench/plant_bench.h"
#include "app/studies/contact/contact_measures.h"

namespace trocar {

using SurfaceTriangle = std::array<Vec3, 3>;

/// Plane face of the environment that a contact is meant for.
struct ContactFace {
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();  ///< W'; unit, outward
};

/// The hand's goal goes from where it was to `goal` with minimum jerk.
struct ContactMove {
  double from_s = 0, to_s = 0;
  Pose goal;
};

struct ContactExperiment {
  double begins_s = 0, ends_s = 0;  ///< clock of the thesis' figures
  Pose rest;                        ///< where the hand holds the stylus before, between and after
  ToolShape tool;
  Pose X_SI;  ///< the tool's tip and shaft in the stylus frame
  std::vector<SurfaceTriangle> surface;
  std::vector<ContactMove> moves;  ///< in order of time
};

/// Rectangle about `centre`, its sides 2u and 2v, facing u x v.
void add_rectangle(std::vector<SurfaceTriangle>& surface, const Vec3& centre, const Vec3& u, const Vec3& v);
/// Cube of side `side_m` about X_WC.
void add_cube(std::vector<SurfaceTriangle>& surface, const Pose& X_WC, double side_m);

/// Least distance of the tool's shaft from the face, negative when it is in.
double clearance(const ContactExperiment& experiment, const Pose& X_WS, const ContactFace& face);

/// The hand leads the stylus from rest to `deep` and back, each way in `travel_s`, so that its goal meets the face at
/// touch_s and leaves it at leave_s. Half way through its hold it eases by a fifth of the depth: what friction adds to
/// the force while pressing it takes away afterwards.
/// @throws std::invalid_argument when rest is not before the face, `deep` not in it, or this contact overlaps the one
/// before or itself.
void add_contact(ContactExperiment& experiment, const ContactFace& face, const Pose& deep, double touch_s,
                 double leave_s, double travel_s);

/// Where the hand wants the stylus at a time of the experiment.
Pose goal_at(const ContactExperiment& experiment, double t);

/// Smallest distance of a joint to its limit on the way of the hand's goal, rad; -1 where a goal cannot be reached.
double least_joint_margin(const ContactExperiment& experiment);

/// From `late_s` after each contact's touch until the hand sets out to leave it: where a settled force is asked for.
std::vector<Spell> holds(const ContactExperiment& experiment, const std::vector<Spell>& touched, double late_s);

struct ContactSetting {
  double stiffness = 20;  ///< N/m
  PassivityLaw law = PassivityLaw::kBudgeted;
  double gain = 1;           ///< of the amplifiers over what the loop believes
  bool compensation = true;  ///< of weight and friction, as identified
  double fixture_kg = 0;     ///< on the hand's side of the sensor; its inertia is left out
  std::uint64_t seed = 1;    ///< of hand, tremor and sensor
};

struct ContactRecording {
  std::vector<double> t;               ///< s, a tick each
  std::vector<Wrench> desired;         ///< in stylus axes
  std::vector<Vec3> printed_moment;    ///< the same moment with the lever of thesis 3.3.3, from contact to origin
  std::vector<double> rendered_n;      ///< magnitude of the force that law and limits left
  std::vector<double> sensor_t;        ///< s, when each reading came out
  std::vector<Wrench> read, measured;  ///< as read; without the fixture's weight
};

/// @throws BenchFault when the loop faults.
ContactRecording record_contacts(const ContactExperiment& experiment, const ContactSetting& setting);

/// Components of a wrench in stylus axes, and their names: "force along X6", ...
enum class Component { kFx, kFy, kFz, kMx, kMy, kMz };
double component(const Wrench& wrench, Component which);
const char* component_name(Component which);
/// Curve of one component of wrenches[i] at t[i].
Curve curve_of(const std::vector<double>& t, const std::vector<Wrench>& wrenches, Component which);

}  // namespace trocar
