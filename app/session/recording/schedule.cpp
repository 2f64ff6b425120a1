#include "app/session/recording/schedule.h"

#include <zstd.h>

#include <algorithm>

#include "app/session/recording/varint.h"

namespace trocar {
namespace {

constexpr int kScheduleLevel = 3;
constexpr std::uint32_t kMaxEntries = 1u << 16;  // of a chunk of half a second: ten minutes of tissue steps

void put(std::string& out, std::uint64_t difference) {
  char digits[bytes::kMaxVarint];
  out.append(digits, bytes::put_varint(digits, bytes::zigzag(difference)));
}

}  // namespace

std::string encode_schedule(const Schedule& schedule) {
  std::string packed;
  PatchSeen before;
  for (const PatchSeen& seen : schedule.patches) {
    put(packed, seen.period - before.period);
    put(packed, seen.stamp - before.stamp);
    before = seen;
  }
  std::uint64_t last = 0;
  for (const std::uint64_t period : schedule.steps) {
    put(packed, period - last);
    last = period;
  }
  std::string payload;
  bytes::put(payload, static_cast<std::uint32_t>(schedule.patches.size()));
  bytes::put(payload, static_cast<std::uint32_t>(schedule.steps.size()));
  bytes::put(payload, static_cast<std::uint32_t>(packed.size()));
  const std::size_t head = payload.size();
  payload.resize(head + ZSTD_compressBound(packed.size()));
  const std::size_t size =
      ZSTD_compress(payload.data() + head, payload.size() - head, packed.data(), packed.size(), kScheduleLevel);
  if (ZSTD_isError(size)) throw EnvironmentError(std::string("zstd: ") + ZSTD_getErrorName(size));
  payload.resize(head + size);
  return payload;
}

Schedule decode_schedule(std::string_view payload) {
  bytes::Reader head(payload);
  const auto patches = head.take<std::uint32_t>(), steps = head.take<std::uint32_t>();
  const auto packed_size = head.take<std::uint32_t>();
  if (patches > kMaxEntries || steps > kMaxEntries || packed_size > 3 * std::size_t{kMaxEntries} * bytes::kMaxVarint) {
    throw InputError("the size of the schedule is out of range");
  }
  std::string packed(packed_size, '\0');
  const std::size_t size = ZSTD_decompress(packed.data(), packed.size(), head.rest().data(), head.rest().size());
  if (ZSTD_isError(size) || size != packed.size()) throw InputError("the compressed schedule is damaged");

  bytes::Reader reader(packed);
  Schedule schedule;
  PatchSeen seen;
  for (std::uint32_t i = 0; i < patches; ++i) {
    const PatchSeen before = seen;
    seen.period += bytes::unzigzag(bytes::take_varint(reader));
    seen.stamp += bytes::unzigzag(bytes::take_varint(reader));
    if (seen.period <= before.period || seen.stamp <= before.stamp)
      throw InputError("the schedule's patches do not increase");
    schedule.patches.push_back(seen);
  }
  std::uint64_t period = 0;
  for (std::uint32_t i = 0; i < steps; ++i) {
    const std::uint64_t before = period;
    period += bytes::unzigzag(bytes::take_varint(reader));
    if (period < before) throw InputError("the schedule's steps go back");
    schedule.steps.push_back(period);
  }
  if (!reader.rest().empty()) throw InputError("bytes are left over after the schedule");
  return schedule;
}

Schedule declared_schedule(std::span<const RecordedTick> rows, std::uint64_t every, std::uint64_t delay) {
  Schedule schedule;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (row % every == delay % every && row >= delay) {
      schedule.patches.push_back({rows[row].tick, schedule.patches.size() + 1});
    }
    if (row % every == 0) schedule.steps.push_back(rows[row].tick);
  }
  return schedule;
}

std::uint64_t lost_rows(std::span<const RecordedTick> rows) {
  std::uint64_t lost = 0, before = 0;
  for (const RecordedTick& row : rows) {
    const std::uint64_t expected = before + std::max<std::uint32_t>(1, row.elapsed_periods);
    lost += row.tick - std::min(row.tick, expected);
    before = row.tick;
  }
  return lost;
}

}  // namespace trocar
