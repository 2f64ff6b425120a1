// Runs a recorded schedule again: every haptic tick with the patch that it saw, every tissue step with the state that
// it saw, in one thread, whatever threads had made them.
//
// A tissue step runs right after the tick whose state it saw; its patch is kept until the ticks that saw it have
// passed. Patches that no tick saw are made and dropped, as live. Thread: one.
#pragma once

#include <cstdint>
#include <deque>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include "app/session/lanes/channel.h"
#include "app/session/lanes/task.h"
#include "app/session/recording/schedule.h"
#include "haptics/exchange/contact_patch.h"

namespace trocar {

/// The channel of patches of a replay: gives each tick the patch that it saw, by its stamp.
class RecordedPatches final : public Channel<ContactPatch> {
 public:
  /// @param stamps of the patch that each row saw.
  explicit RecordedPatches(std::vector<std::uint64_t> stamps) : stamps_(std::move(stamps)) {}

  ContactPatch& begin(std::uint64_t) noexcept override;
  void commit() noexcept override { made_.push_back(std::move(open_)); }
  /// @param row number of the tick's row.
  const ContactPatch& newest(std::uint64_t row) noexcept override;

 private:
  std::vector<std::uint64_t> stamps_;
  std::unique_ptr<ContactPatch> open_;
  std::deque<std::unique_ptr<ContactPatch>> made_;  ///< those that a tick may still see, by stamp
  const ContactPatch none_{};
};

class ReplayExecutor {
 public:
  /// @throws InputError when rows are missing or the schedule cannot have happened.
  ReplayExecutor(std::span<const RecordedTick> rows, const Schedule& schedule);

  /// Stamp of the patch that each row saw.
  const std::vector<std::uint64_t>& stamps() const { return stamps_; }
  /// @param haptic run once a row. @param with_tissue run in this order once a tissue step.
  void run(Task& haptic, std::initializer_list<Task*> with_tissue) const;

 private:
  std::vector<std::uint64_t> stamps_;
  std::vector<std::uint64_t> steps_after_;  ///< tissue steps that saw each row; the first entry: none yet
};

}  // namespace trocar
