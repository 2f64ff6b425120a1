#include "app/commands/exercises_command.h"

#include <algorithm>
#include <iomanip>
#include <ostream>

#include "app/placement.h"
#include "app/scene.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/exercise_loader.h"

namespace trocar {
namespace {

constexpr int kPracticeBoards = 20;
constexpr double kJointMargin = 8 * kDegree;
constexpr double kSoundDetA = 0.30;

/// What a board asks of the arm at its worst waypoint.
struct Reach {
  double joint_margin = 1e9, det_a = 1e9;
  bool reachable = true;
};

Reach reach_of(const Scene& scene) {
  Reach reach;
  const Mat3 R_rest = scene.loop.map.instrument_pose(home_pose()).R;
  const bool pens = scene.setup.exercise.kind == ExerciseKind::kReach;
  const JointVector home = home_angles();
  const auto visit = [&](const Vec3& point_T, const Mat3& R_TI) {
    const auto q = inverse_within_limits(scene.loop.map.stylus_pose({R_TI, point_T}), home);
    if (!q) {
      reach.reachable = false;
      return;
    }
    reach.joint_margin = std::min(reach.joint_margin, joint_limit_margin(*q));
    reach.det_a = std::min(reach.det_a, arm_state(*q).det_a);
  };
  visit(scene.board.start_T, R_rest);
  for (const Target& target : scene.board.targets) {
    const Mat3 R_TI = pens ? target.R_TI : R_rest;
    visit(target.centre_T, R_TI);
    visit(target.centre_T + Vec3(0, 0, scene.setup.exercise.retract_height_m), R_TI);
  }
  return reach;
}

bool check_boards(const Exercise& exercise, const ExerciseLevel& level, const std::string& organ,
                  const AssetRoots& assets, std::ostream& out) {
  bool sound = true;
  AttemptSetup setup;
  setup.exercise = exercise;
  setup.level = level.name;
  setup.organ = organ;
  Reach worst;
  double kappa = 1;
  for (setup.board = 0; setup.board < kPracticeBoards; ++setup.board) {
    const Scene scene = build_scene(setup, assets, {"simulated", 1000, 16});
    const Reach reach = reach_of(scene);
    worst.joint_margin = std::min(worst.joint_margin, reach.joint_margin);
    worst.det_a = std::min(worst.det_a, reach.det_a);
    kappa = scene.loop.map.force_scale;
    if (!reach.reachable || reach.joint_margin < kJointMargin || reach.det_a < kSoundDetA) {
      out << exercise.id << ' ' << level.name << " board " << setup.board << ": out of the arm's good region\n";
      sound = false;
    }
  }
  out << exercise.id << ' ' << level.name << ": " << kPracticeBoards << " boards, worst joint margin " << std::fixed
      << std::setprecision(1) << worst.joint_margin / kDegree << " deg, worst det A " << std::setprecision(2)
      << worst.det_a << ", kappa " << kappa << (sound ? ": sound\n" : ": NOT sound\n");
  return sound;
}

}  // namespace

int check_command(const std::vector<std::string>& subjects, const std::string& organ, std::ostream& out,
                  std::ostream& err) {
  const AssetRoots assets = find_assets();
  bool sound = true;
  for (const std::string& subject : subjects) {
    try {
      const Exercise exercise = find_exercise(subject, assets.exercises);
      for (const ExerciseLevel& level : exercise.levels) sound &= check_boards(exercise, level, organ, assets, out);
    } catch (const InputError& error) {
      err << "trocar: " << error.what() << '\n';
      sound = false;
    }
  }
  return sound ? 0 : 2;
}

}  // namespace trocar
