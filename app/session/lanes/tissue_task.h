// The tissue task (100 Hz): steps the world with the newest haptic state, publishes its patch and frame, tells the
// director.
//
// Reads and writes through its ports only. Thread: its own.
#pragma once

#include <memory>
#include <utility>

#include "app/session/lanes/channel.h"
#include "app/session/lanes/exercise_frame.h"
#include "app/session/lanes/keyframe_tap.h"
#include "app/session/lanes/state_hash.h"
#include "app/session/lanes/task.h"
#include "app/session/setup/scene.h"
#include "haptics/exchange/ring.h"
#include "scenarios/director/director.h"
#include "scenarios/kinds/dissect/dissect_layout.h"
#include "tissue/tissue_world.h"

namespace trocar {

inline constexpr double kTissueRateHz = 100;

using StepRing = Ring<TissueStep, 1024>;
using EventRing = Ring<Event, 1024>;

/// What the tissue task reads from and writes to. An absent reader costs nothing.
struct TissuePorts {
  Inlet<HapticState>& state;
  Outlet<ContactPatch>& patch;
  Outlet<ExerciseFrame>* hand = nullptr;
  Outlet<ExerciseFrame>* observer = nullptr;
  StepRing* steps = nullptr;
  EventRing* events = nullptr;
  KeyframeRings* keyframes = nullptr;
  KeyframeRule rule = {};
};

class TissueTask final : public Task {
 public:
  /// @param world another than the scene's own.
  TissueTask(const Scene& scene, Director& director, const TissuePorts& ports, std::unique_ptr<World> world = nullptr)
      : motors_(scene.loop.daq.motors),
        start_z_m_(scene.board.start_T.z()),
        director_(director),
        ports_(ports),
        world_(world ? std::move(world) : make_world(scene)),
        keyframes_(ports.keyframes, ports.rule, kTissueRateHz),
        period_(static_cast<std::uint32_t>(scene.loop.daq.rate_hz / kTissueRateHz)) {}

  std::uint32_t period() const override { return period_; }
  void run(std::uint64_t tick) override {
    const HapticState& state = ports_.state.newest(tick);
    ContactPatch& patch = ports_.patch.begin(tick);
    // The jig lies beneath the board: the world is there from the moment the tip first rests at the start, in free
    // space. Without a jig it is there as soon as the instrument has come in from above.
    inserted_ = inserted_ || (!motors_ && state.stylus.X_TI.p.z() > start_z_m_);
    world_->step(state, inserted_, patch);
    director_.update(state.stylus, &world_->frame());
    inserted_ = inserted_ || director_.status().phase != Phase::kReady;
    if (patch.grip.stiffness_n_per_m <= 0) patch.grip = director_.status().grip;
    if (const auto& ring = director_.status().ring)
      patch.ring = *ring;
    else
      patch.ring.count = 0;
    hash_.add(patch);
    hash_.add(world_->frame());
    for (const NodePlace& node : world_->shape().thin_T) hash_.add(node);
    hash_.add(director_.status());
    keyframes_.tell(state.stylus, director_.status(), *world_);  // before the step: who has that has its keyframe
    tell(tick, state.stylus.period);
    ports_.patch.commit();  // last: whoever sees this stamp finds its step in the ring
  }
  bool finished() const override { return director_.finished(); }

  const StateHash& hash() const { return hash_; }
  const World& world() const { return *world_; }

 private:
  static std::unique_ptr<World> make_world(const Scene& scene) {
    return std::make_unique<TissueWorld>(TissueSetup{.organ_T = &felt_surface(scene),
                                                     .seen_T = scene.organ_T,
                                                     .organ = scene.setup.exercise.surface,
                                                     .triangle_material = scene.adjacent.triangle_material,
                                                     .adjacent = scene.adjacent.materials,
                                                     .rigid = scene.board.rigid,
                                                     .tools = scene.loop.tools,
                                                     .soft = scene.soft,
                                                     .ducts = scene.ducts,
                                                     .sheets = scene.sheets,
                                                     .suture = scene.suture,
                                                     .bleeders = bleeders_of(scene.setup.exercise, scene.board),
                                                     .followed = followed(scene)});
  }
  /// Targets on an organ that gives way go along with it.
  static std::vector<SurfacePlace> followed(const Scene& scene) {
    std::vector<SurfacePlace> places;
    if (scene.soft)
      for (const Target& target : scene.board.targets) places.push_back({target.centre_T, target.normal_T});
    return places;
  }
  void tell(std::uint64_t tick, std::uint64_t seen_period) {
    for (Outlet<ExerciseFrame>* outlet : {ports_.hand, ports_.observer}) {
      if (!outlet) continue;
      ExerciseFrame& frame = outlet->begin(tick);
      frame.status = director_.status();
      frame.tissue = world_->frame();
      frame.organ_T = world_->surface();
      frame.thin_T.assign(world_->thin().begin(), world_->thin().end());
      outlet->commit();
    }
    if (ports_.steps) ports_.steps->push({seen_period, static_cast<std::uint8_t>(director_.status().phase)});
    const std::vector<Event>& events = director_.events();
    for (; ports_.events && told_ < events.size(); ++told_) ports_.events->push(events[told_]);
  }

  bool motors_;
  double start_z_m_;
  Director& director_;
  TissuePorts ports_;
  StateHash hash_;
  std::unique_ptr<World> world_;
  KeyframeTap keyframes_;
  std::uint32_t period_;
  std::size_t told_ = 0;  ///< events that the recorder has
  bool inserted_ = false;
};

}  // namespace trocar
