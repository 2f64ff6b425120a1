#include "tests/scenarios/support/practice_world.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "haptics/least_turn.h"
#include "scenarios/director/cue_percept.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/hand_random.h"
#include "scenarios/hands/make_hand.h"
#include "scenarios/kinds/kind.h"
#include "tests/scenarios/support/test_organs.h"

namespace trocar {
namespace {

constexpr double kDt = 1e-3;
constexpr int kEyeDelay = 150;  // ticks
constexpr double kEyeNoise = 0.3e-3, kTouchNoise = 0.03;
constexpr double kFingerStiffness = 400;  // N/m
constexpr double kFingerLag = 0.04;       // s

const std::filesystem::path kRoot = TROCAR_SOURCE_DIR;

Mat3 resting() { return Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix(); }

struct World {
  World(const PracticeRoom& room_in, const ExerciseLevel& level_in, const WorldTuning& tuning_in, const Vec3& tip,
        std::uint64_t seed)
      : room(room_in), level(level_in), tuning(tuning_in), random(seed) {
    state.X_TI.p = tip;
    state.X_TI.R = resting();
    state.loop = LoopState::kActive;
    state.jaw_opening_m = 0.02;
    intent_before = tip;
    seen.fill(tip);
  }

  void touch() {
    state.contact = state.tip_contact = false;
    state.depth_m = 0;
    state.F_I_T = {};
    if (!kind_of(room.exercise).on_organ) return;
    const auto surface = room.field.top(state.X_TI.p.x(), state.X_TI.p.y());
    if (!surface) return;
    const double depth = (surface->position - state.X_TI.p).dot(surface->normal);
    if (depth <= 0) return;
    const double closing = -state.V_TI_T.linear.dot(surface->normal);
    const double force = room.exercise.surface.stiffness_n_per_m * depth *
                         std::max(0.0, 1 + room.exercise.surface.damping_s_per_m * closing);
    state.contact = state.tip_contact = true;
    state.depth_m = depth;
    state.contact_point_T = state.X_TI.p + depth * surface->normal;
    state.contact_normal_T = surface->normal;
    state.F_I_T.force = force * surface->normal;
  }

  void step(const HandIntent& intent, const GripBlock& block) {
    const Vec3 intent_velocity = (intent.X_TI.p - intent_before) / kDt;
    intent_before = intent.X_TI.p;
    touch();
    const Vec3 pull = tuning.hand_stiffness_n_per_m * (intent.X_TI.p - state.X_TI.p) +
                      tuning.hand_damping * (intent_velocity - state.V_TI_T.linear);
    state.V_TI_T.linear += (pull + state.F_I_T.force) / tuning.mass_kg * kDt;
    state.X_TI.p += state.V_TI_T.linear * kDt;
    state.X_TI.R = intent.X_TI.R;
    if (level.mapping == Mapping::kFulcrum) {  // the shaft passes the port, whatever the wrist would like
      const Vec3 axis = (state.X_TI.p - level.port_m).normalized();
      state.X_TI.R = least_turn(state.X_TI.R.col(2), axis) * state.X_TI.R;
    }
    double rest = intent.jaw_opening_m;
    if (block.stiffness_n_per_m > 0 && rest < block.thickness_m)
      rest = (kFingerStiffness * rest + block.stiffness_n_per_m * block.thickness_m) /
             (kFingerStiffness + block.stiffness_n_per_m);
    state.jaw_opening_m += (rest - state.jaw_opening_m) * kDt / kFingerLag;
    state.grip_force_n = block.stiffness_n_per_m * std::max(0.0, block.thickness_m - state.jaw_opening_m);
    ++state.tick;
    state.t_s = static_cast<double>(state.tick) * kDt;
  }

  Percept perceive(const DirectorStatus& status) {
    seen[state.tick % seen.size()] = state.X_TI.p;
    if (state.tick % 20 == 0)
      for (int axis = 0; axis < 3; ++axis) eye_error[axis] = kEyeNoise * random.normal();
    Percept percept;
    percept.t_s = state.t_s;
    percept.device_ready = state.tick > 300;
    percept.tip_T = seen[(state.tick + seen.size() - kEyeDelay) % seen.size()] + eye_error;
    percept.R_TI = state.X_TI.R;
    percept.felt_force_T = state.F_I_T.force + kTouchNoise * Vec3(random.normal(), random.normal(), random.normal());
    percept.felt_grip_n = std::max(0.0, state.grip_force_n + kTouchNoise * random.normal());
    percept.jaw_opening_m = state.jaw_opening_m;
    percept.shown_force_n = status.force_shown ? state.F_I_T.force.norm() : std::nan("");
    return percept;
  }

  const PracticeRoom& room;
  const ExerciseLevel& level;
  WorldTuning tuning;
  HandRandom random;
  StylusState state;
  Vec3 intent_before = Vec3::Zero(), eye_error = Vec3::Zero();
  std::array<Vec3, 256> seen;
};

TraceSample sample_of(const StylusState& state) {
  TraceSample sample;
  sample.t_s = state.t_s;
  sample.tip_T = state.X_TI.p;
  sample.shaft_T = state.X_TI.R.col(2);
  sample.force_T = state.F_I_T.force;
  sample.grip_n = state.grip_force_n;
  sample.jaw_opening_m = state.jaw_opening_m;
  sample.contact = state.contact;
  return sample;
}

TriangleSurface placed_organ(const Exercise& exercise) {
  if (!kind_of(exercise).on_organ) return {};
  const TriangleSurface organ = liver_like();
  return organ.transformed(place_organ(organ, exercise.layout));
}

}  // namespace

PracticeRoom::PracticeRoom(const std::string& exercise_id)
    : exercise(find_exercise(exercise_id, kRoot / "scenarios/exercises")),
      organ_T(placed_organ(exercise)),
      field(organ_T) {}

PracticeAttempt practise(const PracticeRoom& room, Hand& hand, int board, std::uint64_t seed,
                         const WorldTuning& tuning) {
  const ExerciseLevel& level = find_level(room.exercise, tuning.level);
  Director director(room.exercise, level,
                    kind_of(room.exercise).lay_out(room.exercise, level, board, {room.organ_T, nullptr, resting()}));
  World world(room, level, tuning, director.board().start_T + Vec3(0.02, 0.03, 0.02), seed + 1000003);
  PracticeAttempt attempt;
  while (!director.finished() && world.state.t_s < tuning.longest_s) {
    Percept percept = world.perceive(director.status());
    show_cue(director.status(), percept);
    world.step(hand.update(percept, kDt), director.status().grip);
    attempt.trace.samples.push_back(sample_of(world.state));
    if (world.state.tick % 10 == 0) director.update(world.state);
  }
  attempt.events = director.events();
  attempt.context = scoring_context(room.exercise, level, director.board(), attempt.events, director.outcome());
  attempt.grade = score_attempt(attempt.trace, attempt.events, level.rubric, attempt.context);
  return attempt;
}

PracticeAttempt practise(const PracticeRoom& room, const std::string& hand, int board, std::uint64_t seed,
                         const WorldTuning& tuning) {
  const auto made = make_hand(hand, seed, kRoot / "scenarios/hands");
  return practise(room, *made, board, seed, tuning);
}

std::optional<double> metric(const Grade& grade, const std::string& name) {
  for (const Metric& candidate : grade.metrics) {
    if (candidate.name == name) return candidate.value;
  }
  std::abort();
}

}  // namespace trocar
