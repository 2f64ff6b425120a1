#include "app/session/recording/tick_codec.h"

#include <zstd.h>

#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>

#include "app/session/recording/varint.h"

namespace trocar {
namespace {

using Kind = RecordedChannel::Kind;

constexpr int kCompressionLevel = 3;
using bytes::kMaxVarint, bytes::put_varint, bytes::take_varint, bytes::zigzag, bytes::unzigzag;

static_assert(std::is_standard_layout_v<RecordedTick> && std::is_trivially_copyable_v<RecordedTick>);
static_assert(kChannels == 7);

constexpr std::size_t at(std::size_t field, std::size_t index) { return field + index * sizeof(std::int32_t); }
constexpr std::size_t kCounts = offsetof(RecordedTick, counts), kTip = offsetof(RecordedTick, tip);
constexpr std::size_t kShaft = offsetof(RecordedTick, shaft), kForce = offsetof(RecordedTick, force);

constexpr RecordedChannel kTable[] = {
    {"tick", "", 1, offsetof(RecordedTick, tick), Kind::kUint64},
    {"count_1", "", 1, at(kCounts, 0), Kind::kInt32},
    {"count_2", "", 1, at(kCounts, 1), Kind::kInt32},
    {"count_3", "", 1, at(kCounts, 2), Kind::kInt32},
    {"count_4", "", 1, at(kCounts, 3), Kind::kInt32},
    {"count_5", "", 1, at(kCounts, 4), Kind::kInt32},
    {"count_6", "", 1, at(kCounts, 5), Kind::kInt32},
    {"count_pinch", "", 1, at(kCounts, 6), Kind::kInt32},
    {"valid", "bits", 1, offsetof(RecordedTick, valid), Kind::kUint8},
    {"elapsed_periods", "", 1, offsetof(RecordedTick, elapsed_periods), Kind::kUint32},
    {"digital_in", "bits", 1, offsetof(RecordedTick, digital_in), Kind::kUint32},
    {"tip_x", "m", kLengthQuantum, at(kTip, 0), Kind::kInt32},
    {"tip_y", "m", kLengthQuantum, at(kTip, 1), Kind::kInt32},
    {"tip_z", "m", kLengthQuantum, at(kTip, 2), Kind::kInt32},
    {"shaft_x", "", kDirectionQuantum, at(kShaft, 0), Kind::kInt32},
    {"shaft_y", "", kDirectionQuantum, at(kShaft, 1), Kind::kInt32},
    {"shaft_z", "", kDirectionQuantum, at(kShaft, 2), Kind::kInt32},
    {"force_x", "N", kForceQuantum, at(kForce, 0), Kind::kInt32},
    {"force_y", "N", kForceQuantum, at(kForce, 1), Kind::kInt32},
    {"force_z", "N", kForceQuantum, at(kForce, 2), Kind::kInt32},
    {"commanded", "N", kForceQuantum, offsetof(RecordedTick, commanded), Kind::kInt32},
    {"rendered", "N", kForceQuantum, offsetof(RecordedTick, rendered), Kind::kInt32},
    {"grip", "N", kForceQuantum, offsetof(RecordedTick, grip), Kind::kInt32},
    {"jaw_opening", "m", kLengthQuantum, offsetof(RecordedTick, jaw_opening), Kind::kInt32},
    {"flags", "bits", 1, offsetof(RecordedTick, flags), Kind::kUint8},
    {"loop_state", "code", 1, offsetof(RecordedTick, loop_state), Kind::kUint8},
    {"phase", "code", 1, offsetof(RecordedTick, phase), Kind::kUint8},
    {"stiffness", "N/m", kStiffnessQuantum, offsetof(RecordedTick, stiffness), Kind::kInt32},
    {"k_max", "N/m", kStiffnessQuantum, offsetof(RecordedTick, k_max), Kind::kInt32},
};

// All arithmetic modulo 2^64: exact for every column, and no overflow whatever a damaged file holds.
using Column = std::vector<std::uint64_t>;

template <class T>
void gather_as(std::span<const RecordedTick> rows, std::size_t offset, Column& column) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    T value;
    std::memcpy(&value, reinterpret_cast<const char*>(&rows[i]) + offset, sizeof value);
    column[i] = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
  }
}

void gather(std::span<const RecordedTick> rows, const RecordedChannel& channel, Column& column) {
  switch (channel.kind) {
    case Kind::kInt32:
      return gather_as<std::int32_t>(rows, channel.offset, column);
    case Kind::kUint32:
      return gather_as<std::uint32_t>(rows, channel.offset, column);
    case Kind::kUint64:
      return gather_as<std::uint64_t>(rows, channel.offset, column);
    case Kind::kUint8:
      return gather_as<std::uint8_t>(rows, channel.offset, column);
  }
}

template <class T>
void scatter_as(const Column& column, std::size_t offset, std::vector<RecordedTick>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const T value = static_cast<T>(column[i]);
    if (static_cast<std::uint64_t>(static_cast<std::int64_t>(value)) != column[i]) {
      throw InputError("a value is out of its channel's range");
    }
    std::memcpy(reinterpret_cast<char*>(&rows[i]) + offset, &value, sizeof value);
  }
}

void scatter(const Column& column, const RecordedChannel& channel, std::vector<RecordedTick>& rows) {
  switch (channel.kind) {
    case Kind::kInt32:
      return scatter_as<std::int32_t>(column, channel.offset, rows);
    case Kind::kUint32:
      return scatter_as<std::uint32_t>(column, channel.offset, rows);
    case Kind::kUint64:
      return scatter_as<std::uint64_t>(column, channel.offset, rows);
    case Kind::kUint8:
      return scatter_as<std::uint8_t>(column, channel.offset, rows);
  }
}

void accumulate(Column& column) {
  std::uint64_t sum = 0;
  for (std::uint64_t& value : column) value = sum += value;
}

/// Columns as varints appended to `out`, which has room for them.
class ColumnPacker {
 public:
  explicit ColumnPacker(std::size_t rows) : first_(rows), second_(rows) {}

  Column& column() { return first_; }

  /// Packs what stands in column().
  char* pack(char* out) {
    const std::size_t n = first_.size();
    const std::uint64_t start = first_[0];
    std::uint64_t previous = 0, previous_step = 0, cost_first = 0, cost_second = 0, changes = 0;
    const std::uint64_t step_wanted = n > 1 ? first_[1] - first_[0] : 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint64_t step = first_[i] - previous;
      const std::uint64_t first = zigzag(step), second = zigzag(step - previous_step);
      changes |= i == 0 ? 0 : step ^ step_wanted;
      previous = first_[i];
      previous_step = step;
      first_[i] = first;
      second_[i] = second;
      cost_first += first;
      cost_second += second;
    }
    if (changes == 0) {
      *out++ = 0;
      return put_varint(put_varint(out, zigzag(start)), zigzag(step_wanted));
    }
    const bool smooth = cost_second < cost_first;
    *out++ = smooth ? 2 : 1;
    for (const std::uint64_t value : smooth ? second_ : first_) out = put_varint(out, value);
    return out;
  }

 private:
  Column first_, second_;
};

void unpack_column(bytes::Reader& reader, Column& column) {
  const auto mode = reader.take<std::uint8_t>();
  if (mode > 2) throw InputError("a column has an unknown mode");
  if (mode == 0) {
    const std::uint64_t start = unzigzag(take_varint(reader)), step = unzigzag(take_varint(reader));
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = start + step * i;
    return;
  }
  for (std::uint64_t& value : column) value = unzigzag(take_varint(reader));
  for (int order = 0; order < mode; ++order) accumulate(column);
}

std::string decompress(std::string_view frame, std::uint32_t packed_size) {
  if (ZSTD_getFrameContentSize(frame.data(), frame.size()) != packed_size) {
    throw InputError("the compressed size disagrees");
  }
  std::string packed(packed_size, '\0');
  const std::size_t size = ZSTD_decompress(packed.data(), packed.size(), frame.data(), frame.size());
  if (ZSTD_isError(size) || size != packed.size()) throw InputError("the compressed rows are damaged");
  return packed;
}

}  // namespace

std::span<const RecordedChannel> recorded_channels() { return kTable; }

struct TickEncoder::Context {
  std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> zstd{ZSTD_createCCtx(), ZSTD_freeCCtx};
  std::string packed;
};

TickEncoder::TickEncoder() : context_(std::make_unique<Context>()) {}
TickEncoder::~TickEncoder() = default;

std::string TickEncoder::encode(std::span<const RecordedTick> rows, std::span<const RecordedChannel> channels) {
  std::string payload;
  bytes::put(payload, static_cast<std::uint32_t>(rows.size()));
  std::string& packed = context_->packed;
  packed.resize(channels.size() * (1 + kMaxVarint * (rows.size() + 2)));
  char* end = packed.data();
  if (!rows.empty()) {
    ColumnPacker packer(rows.size());
    for (const RecordedChannel& channel : channels) {
      gather(rows, channel, packer.column());
      end = packer.pack(end);
    }
  }
  const auto packed_size = static_cast<std::size_t>(end - packed.data());
  bytes::put(payload, static_cast<std::uint32_t>(packed_size));
  const std::size_t head = payload.size();
  payload.resize(head + ZSTD_compressBound(packed_size));
  const std::size_t size = ZSTD_compressCCtx(context_->zstd.get(), payload.data() + head, payload.size() - head,
                                             packed.data(), packed_size, kCompressionLevel);
  if (ZSTD_isError(size)) throw EnvironmentError(std::string("zstd: ") + ZSTD_getErrorName(size));
  payload.resize(head + size);
  return payload;
}

std::vector<RecordedTick> decode_ticks(std::string_view payload, std::span<const RecordedChannel> channels) {
  bytes::Reader head(payload);
  const auto count = head.take<std::uint32_t>(), packed_size = head.take<std::uint32_t>();
  if (count == 0 || count > kMostChunkRows) throw InputError("the number of rows is out of range");
  if (packed_size > channels.size() * (1 + kMaxVarint * (count + std::size_t{2}))) {
    throw InputError("the size of the rows is out of range");
  }
  const std::string packed = decompress(head.rest(), packed_size);
  bytes::Reader reader(packed);
  std::vector<RecordedTick> rows(count);
  Column column(count);
  for (const RecordedChannel& channel : channels) {
    unpack_column(reader, column);
    scatter(column, channel, rows);
  }
  if (!reader.rest().empty()) throw InputError("bytes are left over after the last column");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].tick <= rows[i - 1].tick) throw InputError("ticks do not increase");
  }
  return rows;
}

}  // namespace trocar
