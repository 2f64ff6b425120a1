// The recorder task: every loop tick as a quantised row, the director's new events with them.
//
// Runs after the haptic and the tissue task of a tick. Thread: the executor's, never the haptic thread.
#pragma once

#include "app/executor/haptic_task.h"
#include "app/executor/task.h"
#include "app/recorder/recording_writer.h"
#include "scenarios/director.h"

namespace trocar {

/// What scoring keeps of one haptic state.
TraceSample trace_sample(const StylusState& state);

class RecorderTask final : public Task {
 public:
  RecorderTask(const HapticTask& haptic, const Director& director, RecordingWriter& writer)
      : haptic_(haptic), director_(director), writer_(writer) {}

  std::uint32_t period() const override { return 1; }
  void run(std::uint64_t tick) override;
  /// Events that came after the last tick.
  void append_new_events();

 private:
  const HapticTask& haptic_;
  const Director& director_;
  RecordingWriter& writer_;
  std::size_t events_written_ = 0;
};

}  // namespace trocar
