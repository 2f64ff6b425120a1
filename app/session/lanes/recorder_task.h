// The recorder task (10 Hz): drains the rings of ticks, tissue steps, keyframes and events into the recording.
//
// A row shows the phase after the last tissue step that saw it or an earlier one, so it waits until a step has seen it
// or a later one. Thread: its own, never the haptic thread; it may wait for the disk.
#pragma once

#include <deque>
#include <memory>

#include "app/session/lanes/haptic_task.h"
#include "app/session/lanes/task.h"
#include "app/session/lanes/tissue_task.h"
#include "app/session/recording/recording_writer.h"

namespace trocar {

/// What scoring and report keep of one tick.
TraceSample trace_sample(const TickRecord& record);

/// What the recorder reads, big: on the heap.
struct RecorderRings {
  TickRing ticks;
  StepRing steps;
  EventRing events;
  KeyframeRings tissue;
};

class RecorderTask final : public Task {
 public:
  static constexpr double kRateHz = 10;

  RecorderTask(RecorderRings& rings, double rate_hz, RecordingWriter& writer)
      : rings_(rings), rate_hz_(rate_hz), writer_(writer) {}

  std::uint32_t period() const override { return static_cast<std::uint32_t>(rate_hz_ / kRateHz); }
  void run(std::uint64_t tick) override;
  /// What came after the last call. The recording stays open.
  void stop() override;
  /// Ticks, steps, keyframes and events that found their ring full.
  std::uint64_t lost() const {
    return rings_.ticks.dropped() + rings_.steps.dropped() + rings_.events.dropped() +
           rings_.tissue.keyframes.dropped() + rings_.tissue.changes.dropped();
  }

 private:
  void drain();
  void write(const TickRecord& record);

  RecorderRings& rings_;
  double rate_hz_;
  RecordingWriter& writer_;
  std::deque<TickRecord> waiting_;
  std::deque<std::shared_ptr<TissueKeyframe>> keyframes_;  ///< of ticks behind the last row written
  std::deque<TissueStep> unused_;                          ///< steps that saw a later tick than the last row written
  std::uint64_t seen_period_ = 0;                          ///< newest tick that a step has seen
  std::uint64_t patch_stamp_ = 0;                          ///< that the last row saw
  std::uint8_t phase_ = 0;
};

}  // namespace trocar
