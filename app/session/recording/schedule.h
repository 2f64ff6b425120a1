// What each task of a run saw of the others, and when: with the device's input all that a replay needs to repeat the
// run, whatever the threads did.
//
// A tick is named by its SYNC period (RecordedTick::tick), a tissue step by its number from 1, which is also the stamp
// of the patch that it made. SCHEDULE payload: u32 rows of each list, then varints of zigzag differences (patches:
// period, stamp in turn; steps: period), compressed by zstd. Thread: any, plain values.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/recording/recorded_tick.h"

namespace trocar {

/// From the tick of `period` on the haptic task saw patch `stamp`; before the first it saw none (stamp 0).
struct PatchSeen {
  std::uint64_t period = 0, stamp = 0;
  bool operator==(const PatchSeen&) const = default;
};

struct Schedule {
  std::vector<PatchSeen> patches;
  std::vector<std::uint64_t> steps;  ///< period of the state that each tissue step saw; 0: none yet

  bool operator==(const Schedule&) const = default;
};

std::string encode_schedule(const Schedule& schedule);

/// @throws InputError saying what is wrong with the payload: sizes, order.
Schedule decode_schedule(std::string_view payload);

/// The schedule that lockstep kept before recordings had one (format 1): a step each `every` rows, seen `delay` rows
/// later.
Schedule declared_schedule(std::span<const RecordedTick> rows, std::uint64_t every, std::uint64_t delay);

/// Periods for which a row is missing though the device said that the loop had run: ticks that the recorder lost.
std::uint64_t lost_rows(std::span<const RecordedTick> rows);

}  // namespace trocar
