// What an attempt on a board looks like: pens and their states, blocks and rings, port, camera, feedback modes, dial.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/picture/attempt/attempt_hud.h"
#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/scene/scope_optics.h"
#include "tissue/tissue_frame.h"

namespace trocar::attempt_boards_test {
namespace {

using Shape = SceneObject::Shape;
using Style = SceneObject::Style;

Mat3 turned(double x, double y, double z) {
  return (Eigen::AngleAxisd(x, Vec3::UnitX()) * Eigen::AngleAxisd(y, Vec3::UnitY()) *
          Eigen::AngleAxisd(z, Vec3::UnitZ()))
      .toRotationMatrix();
}

/// Four pens on a shell; the second one is lit, the first done.
struct PenMoment {
  PenMoment() {
    scene.setup.exercise.kind = ExerciseKind::kReach;
    scene.setup.exercise.number = "E01";
    scene.setup.exercise.title = "Reach and orient";
    scene.setup.exercise.start_sphere_m = 0.010;
    scene.setup.exercise.pens.length_m = 0.060;
    scene.setup.exercise.pens.radius_m = 0.0025;
    scene.level.name = "L1";
    for (int i = 0; i < 4; ++i) {
      Target pen;
      pen.centre_T = Vec3(0.03 * std::cos(i), 0.03 * std::sin(i), 0.005 * i);
      pen.R_TI = turned(std::numbers::pi - 0.5 - 0.1 * i, 0.4, 0.1 * i);
      scene.board.targets.push_back(pen);
    }
    status.phase = Phase::kRun;
    status.target_index = 1;
    status.targets_done = 1;
    status.done.set(0);
    light(1);
    record.stylus.X_TI = {scene.board.targets[1].R_TI, scene.board.targets[1].centre_T};
  }
  void light(std::size_t pen) {
    status.demand.centre_T = scene.board.targets[pen].centre_T;
    status.demand.R_TI = scene.board.targets[pen].R_TI;
    status.demand.oriented = true;
    status.demand.radius_m = 0.003;
    status.demand.angle_tolerance_rad = 0.14;
  }
  SessionView view() const { return {scene, record, {status, scene.board}, 0, tissue}; }
  SceneView drawn() const { return attempt_scene(view()); }
  Hud hud() const { return attempt_hud(view(), attempt_camera(scene), "T-1"); }

  Scene scene;
  DirectorStatus status;
  TickRecord record;
  const TissueFrame* tissue = nullptr;
};

std::vector<SceneObject> of(const SceneView& view, Shape shape) {
  std::vector<SceneObject> out;
  for (const SceneObject& object : view.objects)
    if (object.shape == shape) out.push_back(object);
  return out;
}

TEST(PenScene, ShowsEachPenWhereTheInstrumentShallBeInItsState) {
  const PenMoment moment;
  const auto pens = of(moment.drawn(), Shape::kPen);
  ASSERT_EQ(pens.size(), 4U);
  const Style wanted[4] = {Style::kGhostDone, Style::kGhostLit, Style::kGhost, Style::kGhost};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(pens[i].X_TO.p, moment.scene.board.targets[i].centre_T);
    EXPECT_EQ(pens[i].X_TO.R, moment.scene.board.targets[i].R_TI);
    EXPECT_EQ(pens[i].style, wanted[i]) << i;
    EXPECT_EQ(pens[i].size_m.z(), 0.060);
  }
}

TEST(PenScene, APenThatTimedOutIsNotShownAsDone) {
  PenMoment moment;  // the first pen came back to the end of the queue, the second was matched
  moment.status.done.reset();
  moment.status.done.set(1);
  moment.status.target_index = 2;
  const auto pens = of(moment.drawn(), Shape::kPen);
  EXPECT_EQ(pens[0].style, Style::kGhost);
  EXPECT_EQ(pens[1].style, Style::kGhostDone);
  EXPECT_EQ(pens[2].style, Style::kGhostLit);
}

TEST(PenScene, GuidesAreAPlumbLineFromTheLitTipToTheBoard) {
  PenMoment moment;
  const SceneView guided = moment.drawn();
  const auto poles = of(guided, Shape::kCylinder);
  ASSERT_EQ(poles.size(), 1U);
  const Vec3 tip = moment.status.demand.centre_T;
  const auto boards = of(guided, Shape::kBoard);
  ASSERT_EQ(boards.size(), 1U);
  EXPECT_NEAR(poles[0].X_TO.p.z() + 0.5 * poles[0].size_m.z(), tip.z(), 1e-12);
  EXPECT_NEAR(poles[0].X_TO.p.z() - 0.5 * poles[0].size_m.z(), boards[0].X_TO.p.z(), 1e-12);
  EXPECT_LT(boards[0].X_TO.p.z(), -0.02) << "seen, not felt: out of the instrument's way";
  moment.scene.level.guides = false;
  EXPECT_TRUE(of(moment.drawn(), Shape::kCylinder).empty());
}

TEST(PenScene, TheStartSphereIsShownUntilTheRunBegins) {
  PenMoment moment;
  EXPECT_TRUE(of(moment.drawn(), Shape::kSphere).empty());
  for (const Phase phase : {Phase::kReady, Phase::kArmed}) {
    moment.status.phase = phase;
    const auto spheres = of(moment.drawn(), Shape::kSphere);
    ASSERT_EQ(spheres.size(), 1U);
    EXPECT_EQ(spheres[0].size_m.x(), 0.020);
  }
}

TEST(PenScene, TheCameraHoldsAllPensInTheFrame) {
  const PenMoment moment;
  const Camera camera = attempt_camera(moment.scene);
  const ScopeOptics optics(camera, {0, 0, 960, 640});
  for (const Target& pen : moment.scene.board.targets)
    for (const double back : {0.0, 0.036}) {
      const auto at = optics.project(pen.centre_T - back * pen.R_TI.col(2));
      ASSERT_TRUE(at);
      EXPECT_GT(at->y(), 0);
      EXPECT_LT(at->y(), 640);
    }
  EXPECT_LT(camera.eye_T.y(), camera.look_at_T.y()) << "from the trainee's side";
  EXPECT_GT(camera.eye_T.z(), camera.look_at_T.z()) << "and from above";
}

TEST(PenScene, TheBackdropSurroundsTheBoardAndStandsStill) {
  PenMoment moment;
  const Eigen::AlignedBox3d stage = moment.drawn().stage_T;
  EXPECT_GT(stage.sizes().x(), 0.099);
  moment.status.target_index = 3;
  moment.record.stylus.X_TI.p += Vec3(0.05, 0, 0);
  EXPECT_EQ(moment.drawn().stage_T.min(), stage.min());
  EXPECT_EQ(moment.drawn().camera.eye_T, attempt_camera(moment.scene).eye_T);
}

TEST(PortScene, TheSleeveRidesOnTheShaftAtThePivot) {
  PenMoment moment;
  EXPECT_TRUE(of(moment.drawn(), Shape::kSleeve).empty()) << "direct mapping has no port";
  Fulcrum fulcrum;
  fulcrum.port_T = Vec3(0.02, 0.05, 0.15);
  moment.scene.loop.map.fulcrum = fulcrum;
  const auto sleeves = of(moment.drawn(), Shape::kSleeve);
  ASSERT_EQ(sleeves.size(), 1U);
  EXPECT_GT(sleeves[0].size_m.x(), 2 * moment.scene.loop.tool.radius_m) << "the shaft fits";
  const Vec3 axis = moment.record.stylus.X_TI.R.col(2);
  EXPECT_NEAR((sleeves[0].X_TO.p - fulcrum.port_T).normalized().dot(axis), 1, 1e-9);
  EXPECT_LT((sleeves[0].X_TO.p - fulcrum.port_T).norm(), sleeves[0].size_m.z()) << "the pivot lies inside the tube";
}

RigidScene blocks() {
  RigidScene rigid;
  rigid.board.emplace();
  for (int i = 0; i < 3; ++i) {
    FoamBlock block;
    block.size_m = {0.014, 0.014, 0.020};
    block.colour = i;
    block.X_TO.p = {-0.02, 0.02 * i, 0.010};
    rigid.blocks.push_back(block);
    rigid.rings.push_back({{0.03, 0.02 * i, 0}, 0.010, i});
  }
  return rigid;
}

TEST(RigidObjects, AreDrawnAsLaidOutWithTheirFoam) {
  const auto objects = rigid_objects(blocks(), nullptr, 1);
  ASSERT_EQ(objects.size(), 7U);
  EXPECT_EQ(objects[0].shape, Shape::kBoard);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(objects[1 + i].shape, Shape::kRing);
    EXPECT_EQ(objects[4 + i].look, SceneObject::Look::kFoam);
    EXPECT_EQ(objects[4 + i].bands, static_cast<int>(i) + 1);
    EXPECT_EQ(objects[4 + i].style, i == 1 ? Style::kLit : Style::kSolid) << "the lit block";
    EXPECT_EQ(objects[1 + i].style, i == 1 ? Style::kLit : Style::kSolid) << "and its ring";
  }
}

TEST(RigidObjects, FollowTheFrame) {
  TissueFrame frame;
  frame.object_count = 3;
  frame.object[2].X_TO.p = {0.01, 0.02, 0.05};
  frame.object[2].size_m = {0.014, 0.010, 0.020};
  frame.object[2].crushed = true;
  const auto objects = rigid_objects(blocks(), &frame, -1);
  EXPECT_EQ(objects[6].X_TO.p, frame.object[2].X_TO.p);
  EXPECT_EQ(objects[6].size_m, frame.object[2].size_m);
  EXPECT_EQ(objects[6].wear, 1);
  EXPECT_EQ(objects[5].wear, 0);
}

TEST(RigidObjects, WithoutAColourCueAllBlocksLookAlike) {
  RigidScene rigid = blocks();
  for (FoamBlock& block : rigid.blocks) block.colour = -1;
  const auto objects = rigid_objects(rigid, nullptr, -1);
  EXPECT_EQ(objects[4].colour, objects[6].colour);
  EXPECT_EQ(objects[4].bands, 0);
}

TEST(RigidObjects, AHeldBlockGivesWayToTheJaws) {
  PenMoment moment;
  moment.scene.board.rigid = blocks();
  moment.record.stylus.X_TI.R = turned(std::numbers::pi, 0, 0);
  moment.record.stylus.jaw_opening_m = 0.011;
  TissueFrame frame;
  frame.object_count = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    frame.object[i].X_TO = moment.scene.board.rigid.blocks[i].X_TO;
    frame.object[i].size_m = moment.scene.board.rigid.blocks[i].size_m;
  }
  moment.tissue = &frame;
  const auto depths = [&] {
    std::vector<double> out;
    for (const SceneObject& box : of(moment.drawn(), Shape::kBox)) out.push_back(box.pinch_depth_m);
    return out;
  };
  EXPECT_EQ(depths(), (std::vector<double>{0, 0, 0})) << "nothing held";
  frame.grip = GripState::kHolding;
  frame.grip_object = 2;
  EXPECT_NEAR(depths().at(2), 0.003, 1e-12) << "14 mm of foam between jaws 11 mm apart";
  EXPECT_EQ(depths().at(1), 0);
  EXPECT_NEAR(std::abs(of(moment.drawn(), Shape::kBox)[2].pinch_O.y()), 1, 1e-12) << "jaws open along y";
  moment.record.stylus.jaw_opening_m = 0.020;
  EXPECT_EQ(depths().at(2), 0);
}

TEST(Dial, SpeaksInThePicturesAxes) {
  Camera camera;
  camera.eye_T = Vec3(0, -0.1, 0);  // looking along +y, z up: right is +x
  camera.look_at_T = Vec3::Zero();
  const Pose wanted{turned(std::numbers::pi, 0, 0), Vec3(0.01, 0.02, 0.03)};
  const PoseDial dial = pose_dial({wanted.R, wanted.p + Vec3(0.004, 0.002, -0.001)}, wanted, camera);
  EXPECT_NEAR(dial.offset_C.x(), 0.004, 1e-12);
  EXPECT_NEAR(dial.offset_C.y(), -0.001, 1e-12);
  EXPECT_NEAR(dial.offset_C.z(), 0.002, 1e-12) << "too far from the lens";
  EXPECT_NEAR(dial.position_error_m, std::sqrt(21e-6), 1e-12);
  EXPECT_NEAR(dial.angle_error_rad, 0, 1e-7);
}

TEST(Dial, TellsLeanFromRoll) {
  const Camera camera;
  const Pose wanted{turned(2.2, 0.3, 0.1), Vec3::Zero()};
  const PoseDial rolled = pose_dial({wanted.R * turned(0, 0, 0.2), Vec3::Zero()}, wanted, camera);
  EXPECT_NEAR(rolled.roll_rad, 0.2, 1e-9);
  EXPECT_NEAR(rolled.angle_error_rad, 0.2, 1e-9);
  EXPECT_LT(rolled.lean_C.norm(), 1e-9);
  const PoseDial leant = pose_dial({wanted.R * turned(0.15, 0, 0), Vec3::Zero()}, wanted, camera);
  EXPECT_NEAR(leant.roll_rad, 0, 1e-9);
  EXPECT_NEAR(leant.lean_C.norm(), 2 * std::sin(0.075), 1e-9) << "the chord between the two directions";
}

TEST(BoardHud, FeedbackModesShowTheDialAlwaysOutsideTheLimitsOrNever) {
  PenMoment moment;
  const auto hidden = [&](const char* display, double off) {
    moment.scene.level.force_display = display;
    moment.record.stylus.X_TI.p = moment.status.demand.centre_T + Vec3(off, 0, 0);
    const Hud hud = moment.hud();
    EXPECT_TRUE(hud.dial) << "its place is kept";
    return !hud.dial || hud.dial->hidden;
  };
  EXPECT_FALSE(hidden("always", 0));
  EXPECT_FALSE(hidden("always", 0.02));
  EXPECT_TRUE(hidden("band", 0.001));
  EXPECT_FALSE(hidden("band", 0.02));
  EXPECT_TRUE(hidden("after", 0.001));
  EXPECT_TRUE(hidden("after", 0.02));
}

TEST(BoardHud, NamesLevelAndMappingAndCountsPens) {
  PenMoment moment;
  moment.scene.level.mapping = Mapping::kFulcrum;
  moment.status.timeouts = 2;
  const Hud hud = moment.hud();
  EXPECT_EQ(hud.title, "E01 Reach and orient · L1 · fulcrum");
  EXPECT_EQ(hud.rows.at(0).value, "1 / 4");
  EXPECT_EQ(hud.rows.at(1).value, "2");
  EXPECT_TRUE(hud.bars.empty()) << "nothing is to be touched";
  EXPECT_EQ(hud.credit.find("Organ"), std::string::npos);
}

TEST(BoardHud, SaysWhatTheMapDoesWithTheHand) {
  PenMoment moment;
  EXPECT_TRUE(moment.hud().notices.empty());
  moment.record.stylus.port_held = true;
  ASSERT_EQ(moment.hud().notices.size(), 1U);
  EXPECT_EQ(moment.hud().notices[0].kind, HudNotice::Kind::kWarning);
  moment.record.stylus.clutched = true;
  ASSERT_EQ(moment.hud().notices.size(), 2U);
  EXPECT_NE(moment.hud().notices[1].text.find("Clutch"), std::string::npos);
}

TEST(BoardHud, TellsTheDepthInThePortOnlyWhereThereIsOne) {
  PenMoment moment;
  const auto rows = moment.hud().device.size();
  moment.scene.loop.map.fulcrum = Fulcrum{};
  moment.record.stylus.depth_in_port_m = 0.1234;
  const auto device = moment.hud().device;
  ASSERT_EQ(device.size(), rows + 1);
  EXPECT_EQ(device.back().value, "123");
}

TEST(BoardHud, BandFeedbackCallsOutOverThePicture) {
  PenMoment moment;
  moment.scene.setup.exercise.kind = ExerciseKind::kTouch;
  moment.scene.setup.exercise.hard_force_n = 1.5;
  moment.scene.level.force_display = "band";
  moment.status.demand = {};
  moment.status.demand.band = {0.4, 0.8};
  const auto notices = [&](double force, bool shown) {
    moment.status.force_shown = shown;
    moment.record.stylus.F_I_T.force = Vec3(0, 0, force);
    const Hud hud = moment.hud();
    EXPECT_EQ(hud.bars.at(0).hidden, !shown);
    return hud.notices;
  };
  EXPECT_TRUE(notices(0.6, false).empty());
  ASSERT_EQ(notices(1.1, true).size(), 1U);
  EXPECT_EQ(notices(1.1, true)[0].kind, HudNotice::Kind::kTooMuch);
  EXPECT_NE(notices(1.1, true)[0].text.find("1.10 N"), std::string::npos);
  EXPECT_EQ(notices(0.2, true).at(0).kind, HudNotice::Kind::kTooLittle);
}

}  // namespace
}  // namespace trocar::attempt_boards_test
