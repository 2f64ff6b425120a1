#include "app/window/attempt/surroundings.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/kinds/kind_picture.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/layout/height_field.h"

namespace trocar {
namespace {

constexpr double kOverOrgan = 0.008;    // m: the foot is seen beside the tip, the way down is short
constexpr double kOverBoard = 0.044;    // m: over blocks that stand, with one that hangs from the jaws
constexpr double kOverBlock = 0.032;    // m over the board: the open jaws are clear of it
constexpr double kAbove = 1;            // m: over everything
constexpr double kOver = 0.0025;        // m beside the middle of the lit block: the open jaws go down round it
constexpr double kNear = 0.006;         // m: the tip settles over it while the hand rests
constexpr double kNearRing = 0.008;     // m: so does what is carried, over the middle of its ring
constexpr double kSticks = 0.3;         // of sideways movements, while a block is between the jaws or in its ring
constexpr double kPressed = 0.008;      // m that open jaws are pressed on tissue that they shall take
constexpr double kTissueSpeed = 0.015;  // m/s, with it under or between the jaws
constexpr double kOnDisc = 0.8, kLeavesDisc = 1.6;  // of its radius: the tip goes down to it, and up again
constexpr double kHangs = 0.002;                    // m of a block over the board before it is let go: no fall
constexpr double kInUse_n = 0.05;                   // on an instrument that stands in what it touches
enum GroundNumber : int {
  kStartGround = 1,
  kWorkGround = 2,
  kPenGround = 100,
  kNearBlockGround = 200,
  kBlockGround = 300,
  kNearRingGround = 400,
  kRingGround = 500,
  kPressGround = 600,
  kLiftGround = 700,
  kAnswerGround = 800
};

/// A needle that is in no tissue is carried out with its driver.
bool holds_something(const TissueFrame& tissue) {
  const bool carries = tissue.suture.held && tissue.needle.bite_count == 0;
  return tissue.held() && !carries;
}

/// With the jaws round what is touched, too: it is named by them.
bool asks_to_grip(const DirectorStatus& status) {
  switch (status.cue) {
    case Cue::kGrip:
    case Cue::kSearch:
    case Cue::kTake:
    case Cue::kLift:
    case Cue::kLower:
    case Cue::kClip:
    case Cue::kSever:
    case Cue::kSnip:
    case Cue::kTakeNeedle:
    case Cue::kDrive:
    case Cue::kPull:
      return true;
    case Cue::kReach:
    case Cue::kPress:
      return status.demand.instrument && describe(*status.demand.instrument).jaw_length_m > 0;
    default:
      return false;
  }
}

}  // namespace

struct Surroundings::State {
  explicit State(const Scene& scene_in) : scene(scene_in) {
    if (kind_of(scene.setup.exercise).on_organ) organ.emplace(felt_surface(scene));
    std::vector<SceneObject> objects;
    DirectorStatus waiting;
    const TickRecord at_rest;
    picture_of(scene.setup.exercise).add_objects({scene, at_rest, {waiting, scene.board}, 0}, objects);
    for (const SceneObject& object : objects)
      if (object.shape == SceneObject::Shape::kBoard) board_z = object.X_TO.p.z();
  }

  double height(double x, double y) const {
    if (organ) {
      const auto top = organ->top(x, y);
      return top ? top->position.z() : scene.board.centre_T.z() - scene.setup.exercise.layout.relief_m;
    }
    return scene.board.rigid.board ? scene.board.rigid.board->top_z_m : board_z;
  }

  Vec3 below(const Vec3& p_T) const {
    Vec3 out(p_T.x(), p_T.y(), height(p_T.x(), p_T.y()));
    for (int i = 0; i < tissue.object_count; ++i) {
      const ObjectState& object = tissue.object[static_cast<std::size_t>(i)];
      if (tissue.held() && i == tissue.grip_object) continue;
      const Vec3 half = 0.5 * object.size_m, in = object.X_TO.R.transpose() * (p_T - object.X_TO.p);
      const double top = object.X_TO.p.z() + half.z();
      if (std::abs(in.x()) < half.x() && std::abs(in.y()) < half.y()) out.z() = std::max(out.z(), top);
    }
    return out;
  }

  /// The lit block is gone down to by who stands over it, and set down within its ring; else the way is high.
  GlideGround block_ground(const DirectorStatus& status, const Vec3& tip_T) const {
    const auto board = [this](double x, double y) { return below(Vec3(x, y, kAbove)).z(); };
    const double level = height(0, 0);
    const SeenObject& block = status.demand.object;
    const double middle = 0.5 * block.size_m.z();
    const bool carried = status.cue == Cue::kCarry || status.cue == Cue::kPlace;
    // What is gripped aside of its middle is set down by its middle all the same.
    const Vec3 goal = carried ? Vec3(status.demand.goal_T - block.X_TO.p + tip_T) : block.X_TO.p;
    const double off_m = (goal - tip_T).head<2>().norm();
    const int near = carried ? kNearRingGround : kNearBlockGround, low = carried ? kRingGround : kBlockGround;
    const bool is_low = ground.number == low + status.target_index;
    if (off_m < (is_low && carried ? kNearRing : kOver))
      return {low + status.target_index, board, carried ? middle + kHangs : middle, goal, level, kSticks};
    if (off_m < (carried ? kNearRing : kNear))
      return {near + status.target_index, board, carried ? kOverBoard : kOverBlock, goal, level};
    return {kWorkGround, board, kOverBoard, {}, level};
  }

  /// The place is gone down to by who stands over it, the jaws pressed on a little; what is held firmly is lifted to
  /// where it shall be, and let down when that is over.
  GlideGround tissue_ground(const DirectorStatus& status, const Vec3& tip_T) const {
    const Demand& demand = status.demand;
    const auto level = [](double z) { return [z](double, double) { return z; }; };
    const double off_m = (demand.centre_T - tip_T).head<2>().norm();
    if (status.cue == Cue::kRead) return {kAnswerGround, level(demand.centre_T.z()), 0};
    if (status.cue == Cue::kLift) {
      GlideGround lifted{kLiftGround + status.target_index, level(demand.goal_T.z())};
      lifted.settle_m_per_s = kTissueSpeed;
      return lifted;
    }
    const double near = demand.radius_m * (ground.number == kPressGround + status.target_index ? kLeavesDisc : kOnDisc);
    if (status.cue == Cue::kLower || (status.cue == Cue::kTake && off_m < near)) {
      GlideGround pressed{kPressGround + status.target_index, level(demand.centre_T.z()), -kPressed};
      pressed.settle_m_per_s = kTissueSpeed;
      return pressed;
    }
    return {kWorkGround, [this](double x, double y) { return height(x, y); }, kOverOrgan};
  }

  GlideGround ground_of(const DirectorStatus& status, const Vec3& tip_T) const {
    const auto level = [](double z) { return [z](double, double) { return z; }; };
    if (waits_for_start(status.phase)) return {kStartGround, level(scene.board.start_T.z()), 0};
    if (status.demand.oriented) return {kPenGround + status.target_index, level(status.demand.centre_T.z()), 0};
    if (!organ) return block_ground(status, tip_T);
    return tissue_ground(status, tip_T);
  }

  const Scene& scene;
  double board_z = 0;  ///< of the board that is seen under pens
  std::optional<HeightField> organ;
  GlideGround ground;
  TissueFrame tissue = {};  ///< newest
};

Surroundings::Surroundings(const Scene& scene) : state_(std::make_unique<State>(scene)) {}
Surroundings::~Surroundings() = default;

AtHand Surroundings::around(const RunMoment& moment, const HandIntent& hand) {
  State& s = *state_;
  const TickRecord& record = moment.record;
  const DirectorStatus& status = moment.status;
  s.tissue = moment.tissue;
  AtHand out;
  out.now = hand;
  const std::vector<InstrumentKind>& instruments = s.scene.setup.exercise.instruments;
  out.jaws = kind_of(s.scene.setup.exercise).jaws_hold || asks_to_grip(status);
  out.in_tissue = !out.jaws && instruments.front() != InstrumentKind::kProbe;
  const auto in_hand = std::min(static_cast<std::size_t>(record.stylus.instrument), instruments.size() - 1);
  out.jaws_apart = out.in_tissue && describe(instruments[in_hand]).jaw_length_m > 0;
  out.touching = record.stylus.contact;
  if (out.touching) out.normal_T = record.stylus.contact_normal_T;
  if (out.touching) out.force_n = record.stylus.F_I_T.force.norm();
  out.grip_n = record.stylus.grip_force_n;
  out.gripping = out.grip_n > 0;
  out.in_use = out.force_n > kInUse_n || holds_something(moment.tissue);
  out.scope = is_scope(s.scene.setup.exercise);
  if (out.scope) return out;  // it moves along what it sees
  if (!s.scene.level.pointer.glide && !waits_for_start(status.phase)) return out;
  s.ground = s.ground_of(status, record.stylus.X_TI.p);
  out.ground = &s.ground;
  return out;
}

Vec3 Surroundings::below(const Vec3& p_T) const { return state_->below(p_T); }

}  // namespace trocar
