// The tissue task (100 Hz): steps the world with the newest haptic state, publishes its patch, tells the director.
#pragma once

#include "app/executor/delayed_channel.h"
#include "app/executor/haptic_task.h"
#include "app/executor/state_hash.h"
#include "app/executor/task.h"
#include "app/scene.h"
#include "scenarios/director.h"
#include "tissue/tissue_world.h"

namespace trocar {

inline constexpr double kTissueRateHz = 100;

class TissueTask final : public Task {
 public:
  TissueTask(const Scene& scene, const HapticTask& haptic, DelayedChannel<ContactPatch>& patch, Director& director,
             StateHash& hash)
      : haptic_(haptic),
        patch_(patch),
        director_(director),
        hash_(hash),
        world_({&scene.organ_T, scene.setup.exercise.surface, scene.rigid, scene.loop.tool}),
        period_(static_cast<std::uint32_t>(scene.loop.daq.rate_hz / kTissueRateHz)) {}

  std::uint32_t period() const override { return period_; }
  void run(std::uint64_t tick) override {
    const StylusState& state = haptic_.record().stylus;
    ContactPatch& patch = patch_.begin_publish(tick);
    world_.step(state, inserted_, patch);
    director_.update(state, &world_.frame());
    // The jig lies beneath the board: the world is there from the moment the tip first rests at the start, in free space.
    inserted_ = inserted_ || director_.status().phase != Phase::kReady;
    if (patch.grip.stiffness_n_per_m <= 0) patch.grip = director_.status().grip;
    hash_.add(patch);
    hash_.add(world_.frame());
    hash_.add(director_.status());
  }
  const TissueWorld& world() const { return world_; }

 private:
  const HapticTask& haptic_;
  DelayedChannel<ContactPatch>& patch_;
  Director& director_;
  StateHash& hash_;
  TissueWorld world_;
  std::uint32_t period_;
  bool inserted_ = false;
};

}  // namespace trocar
