// Synthetic attempts for the recording's tests and benchmark. Seeded: same seed, same rows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/session/recording/recorded_tick.h"

namespace trocar {

/// Ticks of a hand that moves between points and presses for half of the time: encoders of 2000 counts a turn behind a
/// 14.5:1 reduction, 10 mN of white noise on every force component while in contact.
std::vector<RecordedTick> realistic_ticks(std::size_t count, std::uint64_t seed);

/// Rows of arbitrary values over the whole range of every field, with wrapping counters.
std::vector<RecordedTick> arbitrary_ticks(std::size_t count, std::uint64_t seed);

std::vector<Event> sample_events();

/// A small whole recording in memory: `seconds` chunks of `rate` rows, events, END.
std::string small_recording(int seconds, int rate, std::uint64_t seed);

/// The same chunks with every link made again, as somebody without a key does who has changed some of them.
std::string relinked(const std::string& recording);
/// The same chunks without links, as formats before 5 have them. @param version that the file says.
std::string unlinked(const std::string& recording, char version);

}  // namespace trocar
