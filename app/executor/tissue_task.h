// The tissue task (100 Hz): cuts the contact patch round the instrument and lets the director see the newest state.
#pragma once

#include "app/executor/delayed_channel.h"
#include "app/executor/haptic_task.h"
#include "app/executor/state_hash.h"
#include "app/executor/task.h"
#include "app/scene.h"
#include "scenarios/director.h"
#include "tissue/collision/patch_extraction.h"

namespace trocar {

inline constexpr double kTissueRateHz = 100;

class TissueTask final : public Task {
 public:
  TissueTask(const Scene& scene, const HapticTask& haptic, DelayedChannel<ContactPatch>& patch, Director& director,
             StateHash& hash)
      : scene_(scene), haptic_(haptic), patch_(patch), director_(director), hash_(hash), extraction_(scene.organ_T) {}

  std::uint32_t period() const override { return static_cast<std::uint32_t>(scene_.loop.daq.rate_hz / kTissueRateHz); }
  void run(std::uint64_t tick) override {
    const StylusState& state = haptic_.record().stylus;
    director_.update(state);
    ContactPatch& patch = patch_.begin_publish(tick);
    // The jig lies beneath the board: the tissue is there from the moment the tip first rests at the start, in free space.
    inserted_ = inserted_ || director_.status().phase != Phase::kReady;
    patch.count = patch.dropped = 0;
    patch.reach_m = kPatchRadius;
    if (inserted_) extraction_.extract(state.X_TI, scene_.loop.tool, patch, state.jaw_opening_m);
    patch.stamp = ++frame_;
    patch.material[0] = scene_.setup.exercise.surface;
    patch.grip = director_.status().grip;
    dropped_ += static_cast<std::uint64_t>(patch.dropped);
    hash_.add(patch);
    hash_.add(director_.status());
  }
  /// Triangles in reach that did not fit into a patch, over the run.
  std::uint64_t dropped() const { return dropped_; }

 private:
  const Scene& scene_;
  const HapticTask& haptic_;
  DelayedChannel<ContactPatch>& patch_;
  Director& director_;
  StateHash& hash_;
  PatchExtraction extraction_;
  std::uint64_t frame_ = 0, dropped_ = 0;
  bool inserted_ = false;
};

}  // namespace trocar
