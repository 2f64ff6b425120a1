// Experiments of thesis 3.7: their geometry, the way of the hand, and what is recorded of a contact.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "app/studies/contact/contact_comparison.h"
#include "app/studies/contact/contact_torque_study.h"
#include "app/studies/contact/walls_study.h"
#include "haptics/device/plant/plant_parameters.h"
#include "haptics/kinematics/device_geometry.h"

namespace trocar::contact_experiment_test {
namespace {

constexpr double kTurn = 25 * std::numbers::pi / 180;

ContactExperiment ball_before_a_wall() {
  ContactExperiment e;
  e.begins_s = 0;
  e.ends_s = 5;
  e.rest = {home_pose().R, Vec3(0, -0.006, -0.245)};
  e.tool.shaft_length_m = 1e-3;
  return e;
}

const ContactFace kWall{Vec3(-0.03, -0.006, -0.245), Vec3(1, 0, 0)};

Pose deep() { return {home_pose().R, Vec3(-0.05, -0.006, -0.245)}; }

TEST(ContactSurface, RectangleFacesWhereItSays) {
  std::vector<SurfaceTriangle> surface;
  add_rectangle(surface, Vec3(1, 2, 3), Vec3(0.1, 0, 0), Vec3(0, 0.2, 0));
  ASSERT_EQ(surface.size(), 2u);
  Vec3 area = Vec3::Zero();
  for (const auto& [a, b, c] : surface) area += 0.5 * (b - a).cross(c - a);
  EXPECT_NEAR((area - Vec3(0, 0, 0.08)).norm(), 0, 1e-15) << "0.2 by 0.4 m, towards u x v";
}

TEST(ContactSurface, CubeIsClosedAndFacesOutwards) {
  std::vector<SurfaceTriangle> surface;
  const Pose X{Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(), Vec3(0.1, -0.2, 0.3)};
  add_cube(surface, X, 0.08);
  ASSERT_EQ(surface.size(), 12u);
  Vec3 area = Vec3::Zero();
  double volume = 0;
  for (const auto& [a, b, c] : surface) {
    area += 0.5 * (b - a).cross(c - a);
    volume += a.dot(b.cross(c)) / 6;
    EXPECT_GT((b - a).cross(c - a).dot((a + b + c) / 3 - X.p), 0);
  }
  EXPECT_NEAR(area.norm(), 0, 1e-15);
  EXPECT_NEAR(volume, 0.08 * 0.08 * 0.08, 1e-15) << "divergence theorem";
}

TEST(ContactScript, ClearanceIsThatOfTheNearestPointOfTheShaft) {
  const TorqueExperiment t = torque_experiment('z', kTurn);
  const ContactFace face{Vec3(0, 0, -0.25), Vec3(0.1, -0.2, 1).normalized()};
  const ContactExperiment& e = t.experiment;
  for (const double angle : {-0.6, -0.1, 0.0, 0.3, 0.8}) {
    const Pose X{e.rest.R * Eigen::AngleAxisd(angle, Vec3::UnitZ()), e.rest.p};
    double least = 1;
    for (int i = 0; i <= 1000; ++i) {
      const Vec3 point = X * e.X_SI * Vec3(0, 0, -0.001 * i * e.tool.shaft_length_m);
      least = std::min(least, face.normal.dot(point - face.point) - e.tool.radius_m);
    }
    EXPECT_NEAR(clearance(e, X, face), least, 1e-12) << angle;
  }
}

TEST(ContactScript, TheGoalMeetsAndLeavesTheFaceWhenItShould) {
  ContactExperiment e = ball_before_a_wall();
  add_contact(e, kWall, deep(), 1.0, 3.0, 0.8);
  const auto gap = [&](double t) { return clearance(e, goal_at(e, t), kWall); };
  EXPECT_NEAR(gap(1.0), 0, 1e-9);
  EXPECT_NEAR(gap(3.0), 0, 1e-9);
  EXPECT_GT(gap(0.99), 0);
  EXPECT_GT(gap(3.01), 0);
  for (double t = 1.01; t < 2.99; t += 0.01) EXPECT_LT(gap(t), 0) << t;
  EXPECT_NEAR((goal_at(e, 5).p - e.rest.p).norm(), 0, 1e-12) << "back at rest";
}

TEST(ContactScript, HalfWayThroughItsHoldTheHandEasesByAFifthOfTheDepth) {
  ContactExperiment e = ball_before_a_wall();
  add_contact(e, kWall, deep(), 1.0, 3.0, 0.8);
  ASSERT_EQ(e.moves.size(), 3u);
  const double pressed = clearance(e, goal_at(e, e.moves[0].to_s + 0.01), kWall);
  const double eased = clearance(e, goal_at(e, e.moves[1].to_s + 0.01), kWall);
  EXPECT_NEAR(eased / pressed, 0.8, 1e-9);
  EXPECT_NEAR(e.moves[1].from_s - e.moves[0].to_s, e.moves[2].from_s - e.moves[1].to_s, 1e-12);
}

TEST(ContactScript, RefusesWhatCannotBe) {
  ContactExperiment e = ball_before_a_wall();
  EXPECT_THROW(add_contact(e, kWall, e.rest, 1, 3, 0.8), std::invalid_argument) << "never reaches the face";
  const ContactFace behind{e.rest.p + Vec3(0.1, 0, 0), Vec3(1, 0, 0)};
  EXPECT_THROW(add_contact(e, behind, deep(), 1, 3, 0.8), std::invalid_argument) << "rest lies behind the face";
  EXPECT_THROW(add_contact(e, kWall, deep(), 1, 1.5, 0.8), std::invalid_argument) << "no time to hold";
  EXPECT_THROW(add_contact(e, kWall, deep(), 0.1, 3, 0.8), std::invalid_argument) << "sets out before the beginning";
  add_contact(e, kWall, deep(), 1, 3, 0.8);
  EXPECT_THROW(add_contact(e, kWall, deep(), 3.3, 5, 0.8), std::invalid_argument) << "not yet back from the last";
  EXPECT_EQ(e.moves.size(), 3u) << "a refused contact leaves nothing behind";
  EXPECT_THROW(torque_experiment('w', kTurn), std::invalid_argument);
}

TEST(ContactScript, HoldsEndWhenTheHandSetsOutToLeave) {
  ContactExperiment e = ball_before_a_wall();
  add_contact(e, kWall, deep(), 1.0, 3.0, 0.8);
  const auto found = holds(e, {{1.02, 2.95}}, 0.5);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_DOUBLE_EQ(found[0].from_s, 1.52);
  EXPECT_DOUBLE_EQ(found[0].to_s, e.moves[2].from_s);
  EXPECT_TRUE(holds(e, {{3.5, 4.0}}, 0.5).empty()) << "no contact of this script";
}

TEST(ContactScript, EveryExperimentKeepsEightDegreesFromTheJointLimits) {
  const double margin = 8 * std::numbers::pi / 180;
  EXPECT_GE(least_joint_margin(walls_experiment(0.03)), margin);
  for (const char axis : {'x', 'y', 'z'}) {
    EXPECT_GE(least_joint_margin(torque_experiment(axis, 30 * std::numbers::pi / 180).experiment), margin) << axis;
  }
  ContactExperiment far = ball_before_a_wall();
  far.rest.p.z() = -0.4;
  EXPECT_EQ(least_joint_margin(far), -1) << "out of reach";
}

TEST(ContactScript, NothingIsTouchedAtRest) {
  const ContactExperiment walls = walls_experiment(0.03);
  EXPECT_EQ(walls.surface.size(), 6u);
  for (const char axis : {'x', 'y', 'z'}) {
    const TorqueExperiment t = torque_experiment(axis, kTurn);
    double gap = -1;  // some face parts the tool from the cube
    for (const auto& [a, b, c] : t.experiment.surface) {
      gap = std::max(gap, clearance(t.experiment, t.experiment.rest, {a, (b - a).cross(c - a).normalized()}));
    }
    EXPECT_NEAR(gap, 0.010, 1e-12) << "torque-" << axis;
  }
}

TEST(ContactRecord, SameSeedSameSamplesAnotherHandOthers) {
  ContactExperiment e = ball_before_a_wall();
  e.ends_s = 1.5;
  add_rectangle(e.surface, kWall.point, Vec3(0, 0.05, 0), Vec3(0, 0, 0.05));
  add_contact(e, kWall, deep(), 0.6, 2.2, 0.7);
  ContactSetting setting = soft_manner().setting;
  const ContactRecording one = record_contacts(e, setting), two = record_contacts(e, setting);
  ASSERT_EQ(one.t.size(), 1500u);
  for (std::size_t i = 0; i < one.t.size(); ++i) ASSERT_EQ(one.desired[i].force, two.desired[i].force) << i;
  for (std::size_t i = 0; i < one.sensor_t.size(); ++i) ASSERT_EQ(one.read[i].force, two.read[i].force) << i;
  setting.seed = 2;
  EXPECT_GT(one.desired.back().force.norm(), 0.1);
  EXPECT_NE(record_contacts(e, setting).desired.back().force, one.desired.back().force);
}

TEST(ContactRecord, TheSensorReadsFortyTimesASecondAfterItsLagAndCarriesItsFixture) {
  ContactExperiment e = ball_before_a_wall();
  e.ends_s = 1.0;
  ContactSetting setting = soft_manner().setting;
  setting.fixture_kg = 0.1;
  const ContactRecording r = record_contacts(e, setting);
  EXPECT_NEAR(r.sensor_t.front(), 0.15, 1e-9);
  EXPECT_NEAR(r.sensor_t[1] - r.sensor_t[0], 0.025, 1e-9);
  EXPECT_EQ(r.sensor_t.size(), 34u) << "40 in a second, six on their way";
  for (std::size_t i = 0; i < r.read.size(); ++i) {
    const Vec3 fixture = r.read[i].force - r.measured[i].force;
    EXPECT_NEAR(fixture.norm(), 0.1 * nominal_parameters().gravity, 1e-12);
    EXPECT_LT(fixture.x(), -0.98) << "hangs along -X6";
    EXPECT_EQ(r.read[i].moment, r.measured[i].moment);
  }
  for (const Wrench& w : r.desired) EXPECT_EQ(w.force.norm() + w.moment.norm(), 0) << "nothing touched";
}

TEST(ContactRecord, TheMomentIsThatOfTheForceAtTheEndOfTheCylinder) {
  TorqueExperiment t = torque_experiment('z', kTurn);
  t.experiment.ends_s = 8.0;  // within the first contact: the end at +Y6
  const ContactRecording r = record_contacts(t.experiment, soft_manner().setting);
  int seen = 0;
  for (std::size_t i = 0; i < r.t.size(); ++i) {
    const Vec3 &f = r.desired[i].force, &m = r.desired[i].moment;
    if (f.norm() < 0.1) continue;
    ++seen;
    EXPECT_NEAR(m.dot(f), 0, 1e-12) << "one contact without friction: M is at right angles to F";
    // The contact lies on the end sphere: 100 mm along Y6, 5 mm round it.
    const Vec3 foot = f.cross(m) / f.squaredNorm();  // nearest point of the line of action to the origin
    const double along = (0.1 - foot.y()) / (f.y() / f.norm());
    EXPECT_NEAR((foot + along * f / f.norm() - Vec3(0, 0.1, 0)).norm(), 0, 0.0051);
    EXPECT_LT(r.printed_moment[i].dot(m), 0) << "the lever as printed turns the moment round";
  }
  EXPECT_GT(seen, 1000);
}

TEST(ContactRecord, ComponentsAreInTheOrderOfTheirNames) {
  Wrench w;
  w.force = Vec3(1, 2, 3);
  w.moment = Vec3(4, 5, 6);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(component(w, static_cast<Component>(i)), i + 1);
  EXPECT_STREQ(component_name(Component::kFy), "force along Y6");
  EXPECT_STREQ(component_name(Component::kMz), "torque about Z6");
  const Curve curve = curve_of({0, 1}, {w, w * 2}, Component::kMy);
  EXPECT_EQ(curve.y, (std::vector<double>{5, 10}));
}

TEST(BenchSurface, PressesAsTheWallDoesAndRefusesTooManyTriangles) {
  HapticLoopConfig loop;
  loop.tool.shaft_length_m = 1e-3;
  PlantBench bench(nominal_device(), loop);
  bench.start();
  bench.move({home_pose().R, Vec3(0, -0.006, -0.245)}, 1.0);
  PlantBench other(bench);
  ContactMaterial material;
  bench.put_wall(Vec3(-0.01, -0.006, -0.245), Vec3(1, 0, 0), material);
  std::vector<SurfaceTriangle> surface;
  add_rectangle(surface, Vec3(-0.01 - loop.tool.radius_m, -0.006, -0.245), Vec3(0, 0.04, 0), Vec3(0, 0, 0.04));
  other.put_surface(surface, material);
  for (PlantBench* b : {&bench, &other}) b->move({home_pose().R, Vec3(-0.02, -0.006, -0.245)}, 0.5);
  EXPECT_GT(bench.record().stylus.depth_m, 1e-3);
  EXPECT_NEAR(bench.record().stylus.depth_m, other.record().stylus.depth_m, 1e-9);
  surface.resize(kMaxPatchTriangles + 1, surface.front());
  EXPECT_THROW(bench.put_surface(surface, material), std::invalid_argument);
}

TEST(HandSense, TheMomentOnTheHandIsThatOfItsTurnSpring) {
  SimulatedDaqConfig config = nominal_device();
  SimulatedDaq daq(config);
  const Pose held = daq.sense().X_BS;  // clamped in the jig
  const Pose turned{Eigen::AngleAxisd(0.1, Vec3::UnitX()) * held.R, held.p};
  for (int i = 0; i < 500; ++i) {
    daq.set_hand_intent(turned, 0.02);
    daq.read();
    daq.write({});
  }
  const Vec3 moment = daq.sense().moment_on_hand;
  EXPECT_NEAR(moment.x(), -config.hand.turn_stiffness * 0.1, 1e-6) << "the jig turns the hand back";
  EXPECT_NEAR(moment.y(), 0, 1e-6);
  EXPECT_NEAR(moment.z(), 0, 1e-6);
}

/// The tool's end that lies deepest below a face, in stylus axes.
Vec3 deepest_end(const ContactExperiment& e, const Pose& X, const Vec3& normal) {
  const Vec3 tip = e.X_SI.p, end = e.X_SI * Vec3(0, 0, -e.tool.shaft_length_m);
  return normal.dot(X.R * tip) < normal.dot(X.R * end) ? tip : end;
}

TEST(TorqueScript, GeometryAloneGivesTheSignsThatTheThesisExpects) {
  // Without any simulation: a unit force along the face's normal at the end that is in, M = r x F.
  for (const char axis : {'x', 'y', 'z'}) {
    const TorqueExperiment t = torque_experiment(axis, kTurn);
    const ContactExperiment& e = t.experiment;
    const Vec3 normal = e.rest.R.col(axis == 'x' ? 2 : 0);
    for (std::size_t i = 0; i < t.contacts.size(); ++i) {
      const Pose in = e.moves[3 * i].goal;
      Wrench w;
      w.force = in.R.transpose() * normal;
      w.moment = deepest_end(e, in, normal).cross(w.force);
      for (const ExpectedSign& expected : t.contacts[i].expected) {
        EXPECT_GT(expected.sign * component(w, expected.which), 0)
            << "torque-" << axis << ", contact " << i << ": " << component_name(expected.which);
      }
      const int main = axis - 'x';
      EXPECT_GT(std::abs(w.moment[main]), 10 * std::abs(w.moment[(main + 1) % 3]));
      EXPECT_GT(std::abs(w.moment[main]), 10 * std::abs(w.moment[(main + 2) % 3]));
      EXPECT_GT(std::abs(component(w, t.contacts[i].expected[1].which)),
                std::abs(component(w, t.contacts[i].expected[2].which)))
          << "the first force is the larger one";
    }
  }
}

TEST(TorqueScript, ContactTimesAreTheThesisOnes) {
  const TorqueExperiment x = torque_experiment('x', kTurn), y = torque_experiment('y', kTurn),
                         z = torque_experiment('z', kTurn);
  EXPECT_EQ(x.contacts[0].touch_s, 10.15);
  EXPECT_EQ(x.contacts[0].leave_s, 15.65);
  EXPECT_EQ(y.contacts[0].touch_s, 6.98);
  EXPECT_EQ(y.contacts[0].leave_s, 9.35);
  EXPECT_EQ(z.contacts[0].touch_s, 5.60);
  EXPECT_EQ(z.contacts[1].leave_s, 14.70);
  EXPECT_FALSE(x.contacts[1].thesis_times) << "a choice, held against nothing";
  EXPECT_TRUE(z.contacts[1].thesis_times);
  for (const TorqueExperiment* t : {&x, &y, &z}) {
    EXPECT_EQ(t->contacts.size(), 2u);
    EXPECT_EQ(t->experiment.moves.size(), 6u);
    EXPECT_LE(t->experiment.moves.back().to_s, t->experiment.ends_s) << "the hand is back before the end";
  }
}

TEST(TorqueScript, TheEndMeetsTheFaceWellWithinItsBorders) {
  for (const char axis : {'x', 'y', 'z'}) {
    const TorqueExperiment t = torque_experiment(axis, kTurn);
    const ContactExperiment& e = t.experiment;
    Vec3 low = Vec3::Constant(1), high = -low;
    for (const SurfaceTriangle& triangle : e.surface) {
      for (const Vec3& vertex : triangle) {
        const Vec3 p = e.rest.inverse() * vertex;
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
    const int facing = axis == 'x' ? 2 : 0;
    for (const std::size_t move : {0u, 3u}) {
      const Pose in = e.moves[move].goal;
      const Vec3 end = e.rest.inverse() * (in * deepest_end(e, in, e.rest.R.col(facing)));
      for (int i = 0; i < 3; ++i) {
        if (i == facing) continue;
        EXPECT_GT(end[i], low[i] + 0.01) << "torque-" << axis;
        EXPECT_LT(end[i], high[i] - 0.01) << "torque-" << axis;
      }
    }
  }
}

TEST(WallsScript, EachContactMeetsItsOwnWallOnly) {
  const ContactExperiment e = walls_experiment(0.03);
  const std::array<Vec3, 3> into{Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)};
  for (std::size_t contact = 0; contact < 3; ++contact) {
    const Pose in = e.moves[3 * contact].goal;
    EXPECT_NEAR((e.rest.inverse() * in.p - 0.06 * into[contact]).norm(), 0, 1e-12)
        << "30 mm to the wall, 30 mm past it";
    for (std::size_t wall = 0; wall < 3; ++wall) {
      const auto& [a, b, c] = e.surface[2 * wall];
      const ContactFace face{a, (b - a).cross(c - a).normalized()};
      EXPECT_NEAR((e.rest.R.transpose() * face.normal + into[wall]).norm(), 0, 1e-12) << "faces the stylus";
      EXPECT_NEAR(clearance(e, e.rest, face), 0.03, 1.001e-3) << "the ball is 1 mm long along -Z6";
      EXPECT_EQ(clearance(e, in, face) < 0, wall == contact);
    }
  }
}

TEST(ContactRecord, TheFixtureTurnsWithTheStylusAndHidesASign) {
  TorqueExperiment t = torque_experiment('y', kTurn);
  t.experiment.ends_s = 9.0;  // within the first contact
  ContactSetting setting = stiff_manner().setting;
  const ContactRecording r = record_contacts(t.experiment, setting);
  const MeanWrenches mean = mean_wrenches(r, {7.2, 8.9});
  const double read = mean_over(curve_of(r.sensor_t, r.read, Component::kFz), {7.5, 8.8});
  EXPECT_LT(mean.desired.force.z(), -0.1);
  EXPECT_LT(mean.measured.force.z(), -0.1) << "as the thesis expects";
  EXPECT_GT(read, mean.measured.force.z() + 0.2) << "tip down, the fixture pulls along +Z6";
}

TEST(ContactRecord, AGainLeftInMultipliesTheForceAndTheLawLeavesASoftWallAlone) {
  ContactExperiment e = ball_before_a_wall();
  e.ends_s = 2.2;
  add_rectangle(e.surface, kWall.point, Vec3(0, 0.05, 0), Vec3(0, 0, 0.05));
  add_contact(e, kWall, deep(), 0.6, 2.6, 0.7);
  const auto at_the_end = [&](const ContactSetting& setting) {
    const ContactRecording r = record_contacts(e, setting);
    EXPECT_DOUBLE_EQ(r.t.front(), e.begins_s);
    const Spell hold{1.2, 2.2};
    return std::pair(mean_over(curve_of(r.t, r.desired, Component::kFy), hold),
                     mean_over(curve_of(r.sensor_t, r.measured, Component::kFy), hold));
  };
  const auto [soft, soft_felt] = at_the_end(soft_manner().setting);
  EXPECT_LT(soft, -0.15) << "the wall stands at +Y6";
  EXPECT_NEAR(soft_felt / soft, 1, 0.25) << "held from one side only, friction stays in";
  const auto [thesis, thesis_felt] = at_the_end(thesis_manner().setting);
  EXPECT_GT(thesis_felt / thesis, 4);
  EXPECT_LT(thesis / soft, 0.8) << "five times as stiff the wall lets the hand in less deep";
  ContactSetting with_law = soft_manner().setting;
  with_law.law = PassivityLaw::kBudgeted;
  EXPECT_NEAR(at_the_end(with_law).first / soft, 1, 0.03);
}

TEST(HandSense, WithoutAHandThereIsNoMoment) {
  SimulatedDaq daq(nominal_device());
  for (int i = 0; i < 10; ++i) {
    daq.read();
    daq.write({});
  }
  EXPECT_EQ(daq.sense().moment_on_hand.norm(), 0);
  EXPECT_EQ(daq.sense().force_on_hand.norm(), 0);
}

}  // namespace
}  // namespace trocar::contact_experiment_test
