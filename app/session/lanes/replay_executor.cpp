#include "app/session/lanes/replay_executor.h"

#include <string>

#include "app/session/lanes/real_time.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("the recording can be graded but not replayed: " + what);
}

/// Stamp that each row saw. Every one must have been made by a step that saw an earlier row.
std::vector<std::uint64_t> stamps_of(std::span<const RecordedTick> rows, const Schedule& schedule) {
  std::vector<std::uint64_t> stamps;
  std::size_t next = 0;
  std::uint64_t stamp = 0;
  for (const RecordedTick& row : rows) {
    if (next < schedule.patches.size() && schedule.patches[next].period == row.tick)
      stamp = schedule.patches[next++].stamp;
    if (stamp > schedule.steps.size() || (stamp > 0 && schedule.steps[stamp - 1] >= row.tick)) {
      refuse("tick " + std::to_string(row.tick) + " is said to have seen patch " + std::to_string(stamp) +
             ", which had not been made");
    }
    stamps.push_back(stamp);
  }
  return stamps;
}

/// How many steps saw each row; those that saw none stand first, those that saw a row after the last are left out.
std::vector<std::uint64_t> steps_of(std::span<const RecordedTick> rows, const Schedule& schedule) {
  std::vector<std::uint64_t> counts(rows.size() + 1, 0);
  std::size_t row = 0;
  for (const std::uint64_t period : schedule.steps) {
    if (period > rows.back().tick) break;
    while (period > 0 && rows[row].tick < period) ++row;
    if (period > 0 && rows[row].tick != period)
      refuse("a tissue step saw tick " + std::to_string(period) + ", which is missing");
    ++counts[period > 0 ? row + 1 : 0];
  }
  return counts;
}

}  // namespace

ContactPatch& RecordedPatches::begin(std::uint64_t) noexcept {
  open_ = std::make_unique<ContactPatch>();
  return *open_;
}

const ContactPatch& RecordedPatches::newest(std::uint64_t row) noexcept {
  const std::uint64_t wanted = stamps_[row];
  while (!made_.empty() && made_.front()->stamp < wanted) made_.pop_front();
  return wanted == 0 ? none_ : *made_.front();
}

ReplayExecutor::ReplayExecutor(std::span<const RecordedTick> rows, const Schedule& schedule) {
  if (rows.empty()) throw InputError("the recording holds no tick to replay");
  if (const std::uint64_t lost = lost_rows(rows); lost > 0) refuse(std::to_string(lost) + " of its ticks are missing");
  stamps_ = stamps_of(rows, schedule);
  steps_after_ = steps_of(rows, schedule);
}

void ReplayExecutor::run(Task& haptic, std::initializer_list<Task*> with_tissue) const {
  const FlushDenormals flush;
  for (std::size_t row = 0; row <= stamps_.size(); ++row) {
    if (row > 0) haptic.run(row - 1);
    for (std::uint64_t step = 0; step < steps_after_[row]; ++step) {
      for (Task* task : with_tissue) task->run(row > 0 ? row - 1 : 0);
    }
  }
}

}  // namespace trocar
