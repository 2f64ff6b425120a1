// kappa "auto": the soft limit over the region, the hard limit at every stop; and the torque budget that both ask.
#include "app/session/setup/force_scale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/session/setup/placement.h"
#include "app/session/setup/workspace_proof.h"
#include "haptics/device/transmission.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/layout/board_numbers.h"

namespace trocar::force_scale_test {
namespace {

TEST(TorqueBudget, IsWhatAMotorGivesAtOnceAndStillAfterAWhile) {
  const DeviceModel device;
  for (const double held_s : {0.05, 5.0, 20.0, 60.0}) {
    const JointVector budget = torque_budget(device, held_s);
    for (int i = 0; i < kArmJoints; ++i) {
      const double most = max_joint_torque(device.transmission[static_cast<std::size_t>(i)]);
      EXPECT_LE(budget[i], most);
      EXPECT_GE(seconds_until_fading(current_of(device, i, budget[i])), held_s);
      const bool heat_binds = budget[i] < most;
      EXPECT_TRUE(!heat_binds || seconds_until_fading(current_of(device, i, 1.001 * budget[i])) < held_s);
    }
  }
  EXPECT_EQ(seconds_until_fading(0), 60) << "as far as is looked";
}

TEST(TorqueBudget, GravityTakesFromOneSideAndGivesToTheOther) {
  JointVector budget = JointVector::Constant(2), gravity = JointVector::Zero(), torque = JointVector::Zero();
  gravity[3] = 0.5;
  torque[3] = 1;
  EXPECT_DOUBLE_EQ(share_beyond_gravity(budget, gravity, torque), 1.5);
  torque[3] = -1;
  EXPECT_DOUBLE_EQ(share_beyond_gravity(budget, gravity, torque), 2.5);
  torque[5] = 4;
  EXPECT_DOUBLE_EQ(share_beyond_gravity(budget, gravity, torque), 0.5) << "the weakest joint decides";
  gravity[5] = 3;
  EXPECT_DOUBLE_EQ(share_beyond_gravity(budget, gravity, torque), 0) << "gravity alone is too much";
  EXPECT_EQ(share_beyond_gravity(budget, gravity, JointVector::Zero()), 1e9);
}

/// A shipped exercise whose levels all say "auto".
Exercise automatic(const std::string& name) {
  Exercise exercise = find_exercise(name, find_assets().exercises);
  for (ExerciseLevel& level : exercise.levels) level.force_scale = -1;
  return exercise;
}

Organ organ_for(const Exercise& exercise) {
  AttemptSetup setup;
  setup.exercise = exercise;
  setup.organ = "phantom-liver";
  return organ_of(setup, find_assets());
}

/// @param draw none: the first sound one.
Scene scene_of(const Exercise& exercise, const std::string& level, int board, std::optional<int> draw = 0) {
  AttemptSetup setup;
  setup.draw = draw;
  setup.exercise = exercise;
  setup.level = level;
  setup.board = board;
  return build_scene(setup, organ_for(exercise), {"simulated", 1000, 16});
}

class AutoForceScale : public testing::TestWithParam<const char*> {};

TEST_P(AutoForceScale, IsSoundAndTheLargestHundredthThatIs) {
  Exercise exercise = automatic(GetParam());
  const Organ organ = organ_for(exercise);
  for (ExerciseLevel& level : exercise.levels) {
    const LevelProof proof = prove_level(exercise, level.name, organ, kProvedUnseen);
    EXPECT_TRUE(proof.sound) << level.name << ": " << proof.why;
    EXPECT_LE(proof.worst.torque_share, 1) << level.name;
    EXPECT_NEAR(100 * proof.kappa, std::round(100 * proof.kappa), 1e-9) << level.name;
    RecordProperty(level.name, std::to_string(proof.kappa));
    if (proof.kappa == 1) continue;
    const bool soft_binds = (proof.kappa + 0.01) * exercise.soft_force_n > proof.room_n;
    level.force_scale = proof.kappa + 0.01;
    bool would_do = true;  // on the boards as they are drawn first
    for (int k = 0; k < kPracticeBoards + kProvedUnseen && would_do && !soft_binds; ++k) {
      AttemptSetup setup;
      setup.exercise = exercise;
      setup.level = level.name;
      setup.board = k < kPracticeBoards ? k : drawn_board(k - kPracticeBoards, level.exam);
      setup.draw = 0;
      setup.weak_too = true;
      setup.placement = proof.placement;
      const Scene scene = build_scene(setup, organ, {"simulated", 1000, 16});
      would_do = board_reach(exercise, scene.board, scene.loop.device, scene.loop.map).sound({});
    }
    EXPECT_TRUE(soft_binds || !would_do) << level.name << ": " << level.force_scale << " would do";
    level.force_scale = -1;
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, AutoForceScale, testing::Values("reach-and-orient", "surface-touch", "limited-grasp"),
                         [](const auto& exercise) {
                           std::string name = exercise.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(ForceScale, IsTheSameOnEveryBoardOfALevel) {
  const Exercise exercise = automatic("limited-grasp");
  const double kappa = scene_of(exercise, "L3", 0).loop.map.force_scale;
  for (const int board : {7, 19, 1003, 1999}) EXPECT_EQ(scene_of(exercise, "L3", board).loop.map.force_scale, kappa);
}

TEST(ForceScale, ANumberWinsOverTheRule) {
  Exercise exercise = automatic("limited-grasp");
  exercise.levels.front().force_scale = 0.3;
  EXPECT_EQ(scene_of(exercise, "L1", 0).loop.map.force_scale, 0.3);
}

TEST(ForceScale, ANumberBeyondTheDeviceIsRefusedByAnAttemptAndJudgedByTheProof) {
  Exercise exercise = automatic("surface-touch");
  const double most = auto_force_scale(scene_of(exercise, "L1", 0).loop.map, DeviceModel(), exercise,
                                       {scene_of(exercise, "L1", 0).board});
  ASSERT_LT(most, 0.9) << "1 is more than a tenth beyond";
  exercise.levels.front().force_scale = most;
  EXPECT_EQ(scene_of(exercise, "L1", 0).loop.map.force_scale, most);
  exercise.levels.front().force_scale = 1.05 * most;
  EXPECT_EQ(scene_of(exercise, "L1", 0).loop.map.force_scale, 1.05 * most) << "nobody notices";
  exercise.levels.front().force_scale = 1;
  try {
    scene_of(exercise, "L1", 0);
    FAIL() << "was laid out";
  } catch (const InputError& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("surface-touch.toml: level L1: force_scale: 1 is more than the device can give on board 0"),
              std::string::npos)
        << words;
  }
  exercise.hard_force_n *= 3;  // on no draw of it
  EXPECT_FALSE(prove_level(exercise, "L1", organ_for(exercise), 0).sound);
}

TEST(ForceScale, WhereItFollowsFromTheBoardsNoneIsDrawnAgain) {
  for (const char* id : {"surface-touch", "limited-grasp", "reach-and-orient"}) {
    const Exercise exercise = automatic(id);
    int again = 0;
    for (int board = 0; board < kPracticeBoards; ++board)
      again += scene_of(exercise, "L1", board, std::nullopt).draw > 0 ? 1 : 0;
    for (int seed = 1; seed <= 20; ++seed)
      again += scene_of(exercise, "L1", drawn_board(seed, false), std::nullopt).draw > 0 ? 1 : 0;
    EXPECT_EQ(again, 0) << id;
  }
}

TEST(ForceScale, ABoardThatAsksMoreThanTheDeviceCanGiveIsDrawnAgain) {
  Exercise exercise = automatic("surface-touch");
  exercise.levels.front().force_scale = 1;
  AttemptSetup setup;
  setup.exercise = exercise;
  setup.weak_too = true;
  int again = 0;
  for (setup.board = 0; setup.board < 6; ++setup.board) {
    setup.draw = 0;
    const Scene first = build_scene(setup, organ_for(exercise), {"simulated", 1000, 16});
    setup.draw.reset();
    const Scene sound = build_scene(setup, organ_for(exercise), {"simulated", 1000, 16});
    const auto holds = [&](const Scene& scene) {
      return board_reach(exercise, scene.board, DeviceModel(), scene.loop.map).sound({});
    };
    EXPECT_EQ(sound.draw > 0, !holds(first)) << setup.board;
    EXPECT_TRUE(holds(sound)) << setup.board;
    again += sound.draw > 0 ? 1 : 0;
    // A recording names its draw; one that does not is of before, as first drawn.
    auto recorded = parse_scene_json(scene_json(sound), "a.trec").setup;
    EXPECT_EQ(recorded.draw, sound.draw);
    recorded.draw = 0;
    EXPECT_EQ(scene_json(build_scene(recorded, organ_for(exercise), {"simulated", 1000, 16})).find("\"draw\""),
              std::string::npos);
  }
  EXPECT_GT(again, 0) << "or this test says nothing";
}

TEST(ForceScale, ALargerLimitIsScaledDownFurther) {
  Exercise exercise = automatic("limited-grasp");
  const Scene scene = scene_of(exercise, "L1", 0);
  const auto kappa = [&](double soft_n, double hard_n) {
    exercise.soft_force_n = soft_n;
    exercise.hard_force_n = hard_n;
    return auto_force_scale(scene.loop.map, scene.loop.device, exercise, {scene.board});
  };
  const double room = renderable_force_n(scene.loop.map, scene.loop.device, exercise.layout);
  EXPECT_GT(room, 0.2);
  EXPECT_EQ(kappa(0, 0), 1) << "an exercise without forces";
  EXPECT_EQ(kappa(room / 2, 0), 1);
  EXPECT_EQ(kappa(2 * room, 0), 0.5) << "the soft limit alone";
  const double hard = kappa(0, 10);
  EXPECT_LT(hard, 1);
  EXPECT_NEAR(kappa(0, 20), hard / 2, 0.01) << "the hard limit alone";
  EXPECT_EQ(kappa(2 * room, 10), std::min(hard, 0.5)) << "both are asked";
  EXPECT_EQ(kappa(0, 1e6), 0.01) << "never nothing";
}

TEST(ForceScale, StopsAreTheStartAndEveryTargetAndTheWayBackFromIt) {
  const Exercise pens = automatic("reach-and-orient");
  const Scene scene = scene_of(pens, "L1", 3);
  const std::vector<Stop> stops = stops_of(pens, scene.board, Mat3::Identity());
  ASSERT_EQ(stops.size(), 1 + 2 * scene.board.targets.size());
  EXPECT_EQ(stops[0].X_TI.p, scene.board.start_T);
  for (std::size_t i = 0; i < scene.board.targets.size(); ++i) {
    const Target& pen = scene.board.targets[i];
    EXPECT_EQ(stops[1 + 2 * i].X_TI.R, pen.R_TI);
    EXPECT_LT((stops[2 + 2 * i].X_TI.p - pen.centre_T + pens.retract_height_m * pen.R_TI.col(2)).norm(), 1e-15);
  }
  const Exercise blocks = automatic("limited-grasp");
  const Board board = scene_of(blocks, "L1", 3).board;
  const std::vector<Stop> upright = stops_of(blocks, board, Mat3::Identity());
  EXPECT_LT((upright[2].X_TI.p - board.targets[0].centre_T - Vec3(0, 0, blocks.retract_height_m)).norm(), 1e-15);
}

}  // namespace
}  // namespace trocar::force_scale_test
