#include "app/window/attempt/surroundings.h"

#include <algorithm>
#include <optional>

#include "app/picture/kinds/kind_picture.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/layout/height_field.h"

namespace trocar {
namespace {

constexpr double kOverOrgan = 0.008;  // m: the foot is seen beside the tip, the way down is short
constexpr double kOverBoard = 0.050;  // m: over blocks that stand, and over one that hangs from the jaws
constexpr int kStartGround = 1, kWorkGround = 2, kFirstPen = 3;

bool starting(Phase phase) { return phase == Phase::kReady || phase == Phase::kArmed; }

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

  GlideGround ground_of(const DirectorStatus& status) const {
    const auto level = [](double z) { return [z](double, double) { return z; }; };
    if (starting(status.phase)) return {kStartGround, level(scene.board.start_T.z()), 0};
    if (status.demand.oriented) return {kFirstPen + status.target_index, level(status.demand.centre_T.z()), 0};
    return {kWorkGround, [this](double x, double y) { return height(x, y); }, organ ? kOverOrgan : kOverBoard};
  }

  const Scene& scene;
  double board_z = 0;  ///< of the board that is seen under pens
  std::optional<HeightField> organ;
  GlideGround ground;
};

Surroundings::Surroundings(const Scene& scene) : state_(std::make_unique<State>(scene)) {}
Surroundings::~Surroundings() = default;

AtHand Surroundings::around(const TickRecord& record, const DirectorStatus& status, const HandIntent& hand) {
  State& s = *state_;
  AtHand out;
  out.now = hand;
  out.jaws = kind_of(s.scene.setup.exercise).jaws_hold || status.cue == Cue::kGrip;
  out.touching = record.stylus.contact;
  if (out.touching) out.normal_T = record.stylus.contact_normal_T;
  out.gripping = record.stylus.grip_force_n > 0;
  if (!s.scene.level.pointer.glide && !starting(status.phase)) return out;
  if (const GlideGround next = s.ground_of(status); next.number != s.ground.number) s.ground = next;
  out.ground = &s.ground;
  return out;
}

Vec3 Surroundings::below(const Vec3& p_T) const { return {p_T.x(), p_T.y(), state_->height(p_T.x(), p_T.y())}; }

}  // namespace trocar
