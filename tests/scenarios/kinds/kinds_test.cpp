// The table of kinds: every shipped exercise has its kind, and who is judged at which limit is the same for all who
// ask.
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "scenarios/director/director.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/kind.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar::kinds_test {
namespace {

Exercise shipped(const std::string& name) {
  return find_exercise(name, std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises");
}

Board laid_out(const Exercise& exercise, const ExerciseLevel& level) {
  const TriangleSurface no_organ;
  return kind_of(exercise).lay_out(exercise, level, 3, {no_organ});
}

TEST(Kinds, AreFoundByTheNameThatFilesGive) {
  for (const KindDescription& kind : all_kinds()) EXPECT_EQ(kind_named(kind.name)->kind, kind.kind);
  EXPECT_EQ(kind_named("suture"), nullptr);
}

TEST(Kinds, TouchJudgesTheTipAndWhileGrippingTheGrip) {
  const Exercise touch = shipped("E02");
  DirectorStatus status;
  status.cue = Cue::kPress;
  EXPECT_EQ(watched_now(touch, status), WatchedForce::kTip);
  status.cue = Cue::kGrip;
  EXPECT_EQ(watched_now(touch, status), WatchedForce::kGrip);
  const JudgedForces limits = judged_forces(touch, touch.levels.front(), {}, status);
  EXPECT_EQ(limits.tip_n, touch.hard_force_n);
  EXPECT_EQ(limits.grip_n, touch.grip.excess_n);
}

TEST(Kinds, AnOrganWithoutDiscsAsksForNothingAndDoesNotEnd) {
  const Exercise free =
      load_exercise(std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises/ungraded/free-play.toml");
  Board board;
  board.start_T = Vec3(0, 0, 0.05);
  Director director(free, free.levels.front(), board);
  StylusState state;
  state.loop = LoopState::kActive;
  state.X_TI.p = board.start_T;
  for (; state.t_s < 60; state.t_s += 0.05) director.update(state);
  EXPECT_EQ(director.status().phase, Phase::kRun);
  EXPECT_EQ(director.status().cue, Cue::kNone);
  EXPECT_EQ(director.status().message + director.status().hint, "");
}

TEST(Kinds, OnlyAnOrganIsWithoutTargets) {
  Exercise reach = shipped("E01");
  const std::string count = "count = 8";
  reach.text.replace(reach.text.find(count), count.size(), "count = 0");
  EXPECT_THROW(parse_exercise(reach.text, "reach.toml"), InputError);
}

TEST(Kinds, ReachJudgesNoForce) {
  const Exercise reach = shipped("E01");
  const JudgedForces limits = judged_forces(reach, reach.levels.front(), {});
  EXPECT_FALSE(limits.tip_n || limits.grip_n);
  EXPECT_EQ(watched_now(reach, {}), WatchedForce::kNone);
}

TEST(Kinds, GraspJudgesTheLitBlockWhereItsColourTellsItsFoamElseTheHardest) {
  const Exercise grasp = shipped("E03");
  const ExerciseLevel& told = find_level(grasp, "L1");
  const Board board = laid_out(grasp, told);
  double hardest_n = 0;
  for (const FoamKind& foam : grasp.grasp.kinds) hardest_n = std::max(hardest_n, foam.crush_above_n);
  DirectorStatus status;
  ExerciseLevel untold = told;
  untold.grasp.colour_cue = false;
  for (std::size_t i = 0; i < board.rigid.blocks.size(); ++i) {
    status.target_index = static_cast<int>(i);
    EXPECT_EQ(judged_forces(grasp, told, board, status).grip_n, board.rigid.blocks[i].crush_above_n);
    EXPECT_EQ(judged_forces(grasp, untold, board, status).grip_n, hardest_n);
  }
  EXPECT_EQ(judged_forces(grasp, told, board).grip_n, hardest_n);
  EXPECT_FALSE(judged_forces(grasp, told, board).tip_n);
}

}  // namespace
}  // namespace trocar::kinds_test
