// TICKS payload: rows stored column by column as differences, zigzag varints, compressed by zstd (level 3).
//
// payload = u32 rows, u32 size of the packed bytes, zstd frame. Packed bytes of a column: u8 mode, then varints:
//   mode 0  first value, step                 (every row adds the same step: constants, counters)
//   mode 1  first differences d_i = x_i - x_(i-1), x_(-1) = 0
//   mode 2  differences of differences, both starting from 0 (smooth motion)
// Differences are taken in 64 bits, so counters may wrap at 32 bits. A chunk needs no other chunk to be decoded.
// Thread: one encoder belongs to one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/recording/recorded_tick.h"

namespace trocar {

/// Rows of a chunk at most: chunks were a second once, and the fastest device runs at 10 kHz. Constant columns cost a
/// few bytes for any number of rows.
inline constexpr std::uint32_t kMostChunkRows = 1u << 14;

/// One column of a row, as named in the recording's header.
struct RecordedChannel {
  enum class Kind : std::uint8_t { kInt32, kUint32, kUint64, kUint8 };
  std::string_view name, unit;
  double quantum;      ///< value of one step of the stored whole number, in `unit`
  std::size_t offset;  ///< of the field in RecordedTick
  Kind kind;
};

/// All columns in the order in which this program stores them. An older recording has some of them, as its header says.
std::span<const RecordedChannel> recorded_channels();

class TickEncoder {
 public:
  TickEncoder();
  ~TickEncoder();
  /// @param channels those to be stored, in their order.
  std::string encode(std::span<const RecordedTick> rows,
                     std::span<const RecordedChannel> channels = recorded_channels());

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// @param channels of the recording in their order; fields of others keep their defaults.
/// @throws InputError saying what is wrong with the payload: sizes, values out of range, ticks not increasing.
std::vector<RecordedTick> decode_ticks(std::string_view payload,
                                       std::span<const RecordedChannel> channels = recorded_channels());

}  // namespace trocar
