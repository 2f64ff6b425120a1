#include "app/session/recording/tissue_codec.h"

#include <zstd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "app/session/recording/keyframe_words.h"
#include "app/session/recording/varint.h"

namespace trocar {
namespace {

constexpr int kKeyframeLevel = 3;
constexpr std::size_t kMostUnpacked = std::size_t{1} << 26, kMostNodes = std::size_t{1} << 20;
// Keyframes of a chunk: one a tissue step at most, 50 in half a second; a loop that was held up has more of them to a
// chunk. Ten shapes of 20 000 nodes, with four shares at as many vertices, take 6 MiB.
constexpr std::uint32_t kMostKeyframes = 1u << 11;
constexpr std::size_t kMostInChunk = std::size_t{1} << 26;
constexpr std::uint8_t kNodeToNode = 4;
using Quanta = std::vector<std::int32_t>;

void put_number(std::string& out, std::uint64_t value) {
  char digits[bytes::kMaxVarint];
  out.append(digits, bytes::put_varint(digits, value));
}

std::size_t take_count(bytes::Reader& reader, std::size_t most) {
  const std::uint64_t count = bytes::take_varint(reader);
  if (count > most) throw InputError("a count of a keyframe is out of its range");
  return static_cast<std::size_t>(count);
}

void put_packed(std::string& out, std::string_view packed) {
  bytes::put(out, static_cast<std::uint32_t>(packed.size()));
  const std::size_t head = out.size();
  out.resize(head + ZSTD_compressBound(packed.size()));
  const std::size_t size =
      ZSTD_compress(out.data() + head, out.size() - head, packed.data(), packed.size(), kKeyframeLevel);
  if (ZSTD_isError(size)) throw EnvironmentError(std::string("zstd: ") + ZSTD_getErrorName(size));
  out.resize(head + size);
}

std::string take_packed(std::string_view compressed, std::size_t most) {
  bytes::Reader reader(compressed);
  const auto size = reader.take<std::uint32_t>();
  const std::string_view frame = reader.rest();
  if (size > most || ZSTD_getFrameContentSize(frame.data(), frame.size()) != size)
    throw InputError("the compressed size of keyframes disagrees");
  std::string packed(size, '\0');
  const std::size_t got = ZSTD_decompress(packed.data(), packed.size(), frame.data(), frame.size());
  if (ZSTD_isError(got) || got != size) throw InputError("compressed keyframes are damaged");
  return packed;
}

/// What the keyframes of one chunk may still take in memory: what stays as it was costs a byte, whatever its size.
class Room {
 public:
  void take(std::size_t bytes) {
    if (bytes > left_) throw InputError("a chunk of keyframes holds more than any has");
    left_ -= bytes;
  }

 private:
  std::size_t left_ = kMostInChunk;
};

void put_words(std::string& out, const std::vector<std::uint64_t>& words, std::vector<std::uint64_t>& before) {
  put_number(out, words.size());
  before.resize(words.size(), 0);
  for (std::size_t i = 0; i < words.size(); ++i) put_number(out, words[i] ^ before[i]);
  before = words;
}

void take_words(bytes::Reader& reader, std::vector<std::uint64_t>& words) {
  words.resize(take_count(reader, kMostNodes), 0);
  for (std::uint64_t& word : words) word ^= bytes::take_varint(reader);
}

/// Modulo 2^32 like all sums of quanta here: exact for every value, and no overflow whatever a damaged file holds.
std::int32_t wrapped(std::int64_t value) { return static_cast<std::int32_t>(static_cast<std::uint32_t>(value)); }

std::int64_t predicted(int order, const Quanta& last, const Quanta& before, std::size_t i) {
  if (order == 0) return 0;
  if (order == 1) return last[i];
  return 2 * std::int64_t{last[i]} - before[i];
}

/// What a prediction leaves of `now`.
Quanta left_of(const Quanta& now, std::uint8_t prediction, const Quanta& last, const Quanta& before) {
  Quanta left(now.size());
  for (std::size_t i = 0; i < now.size(); ++i) left[i] = wrapped(now[i] - predicted(prediction & 3, last, before, i));
  if (prediction & kNodeToNode)
    for (std::size_t i = now.size(); i-- > 1;) left[i] = wrapped(std::int64_t{left[i]} - left[i - 1]);
  return left;
}

/// Bits that they take, nearly.
std::uint64_t cost_of(const Quanta& left) {
  std::uint64_t bits = 0;
  for (const std::int32_t value : left)
    bits += static_cast<std::uint64_t>(std::bit_width(bytes::zigzag(static_cast<std::uint64_t>(value))));
  return bits;
}

void put_axis(std::string& out, const Quanta& now, const Quanta& last, const Quanta& before) {
  const int orders = last.empty() ? 0 : before.empty() ? 1 : 2;
  std::uint8_t best = 0;
  Quanta least;
  std::uint64_t cost = 0;
  for (int order = 0; order <= orders; ++order)
    for (const std::uint8_t spatial : {std::uint8_t{0}, kNodeToNode}) {
      const auto prediction = static_cast<std::uint8_t>(order | spatial);
      Quanta left = left_of(now, prediction, last, before);
      const std::uint64_t bits = cost_of(left);
      if (!least.empty() && bits >= cost) continue;
      best = prediction;
      cost = bits;
      least = std::move(left);
    }
  out += static_cast<char>(best);
  for (const std::int32_t value : least) put_number(out, bytes::zigzag(static_cast<std::uint64_t>(value)));
}

Quanta take_axis(bytes::Reader& reader, std::size_t nodes, const Quanta& last, const Quanta& before) {
  const auto prediction = reader.take<std::uint8_t>();
  const int order = prediction & 3;
  if (prediction > (2 | kNodeToNode) || order == 3 || (order > 0 && last.size() != nodes) ||
      (order > 1 && before.size() != nodes))
    throw InputError("a keyframe is predicted from one that is not there");
  Quanta now(nodes);
  for (std::int32_t& value : now)
    value = wrapped(static_cast<std::int64_t>(bytes::unzigzag(bytes::take_varint(reader))));
  if (prediction & kNodeToNode)
    for (std::size_t i = 1; i < nodes; ++i) now[i] = wrapped(std::int64_t{now[i]} + now[i - 1]);
  for (std::size_t i = 0; i < nodes; ++i) now[i] = wrapped(now[i] + predicted(order, last, before, i));
  return now;
}

std::int32_t quanta_of(float place, float reference) {
  const double quanta = std::round((double{place} - double{reference}) / kNodeQuantum);
  constexpr double kMost = 1 << 30;
  return std::isfinite(quanta) ? static_cast<std::int32_t>(std::clamp(quanta, -kMost, kMost)) : 0;
}

void put_nodes(std::string& out, const std::vector<NodePlace>& nodes, const ReferenceShape& reference,
               KeyframeMemory& memory) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    Quanta now(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) now[i] = quanta_of(nodes[i][axis], reference.nodes_T[i][axis]);
    put_axis(out, now, memory.quanta[a], memory.before[a]);
    memory.before[a] = std::exchange(memory.quanta[a], std::move(now));
  }
}

std::vector<NodePlace> take_nodes(bytes::Reader& reader, const ReferenceShape& reference, KeyframeMemory& memory) {
  std::vector<NodePlace> nodes(reference.nodes_T);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    Quanta now = take_axis(reader, nodes.size(), memory.quanta[a], memory.before[a]);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      nodes[i][axis] = static_cast<float>(double{nodes[i][axis]} + kNodeQuantum * now[i]);
    memory.before[a] = std::exchange(memory.quanta[a], std::move(now));
  }
  return nodes;
}

void put_fields(std::string& out, const std::vector<ShapeField>& fields, std::vector<KeyframeMemory::Field>& memory) {
  put_number(out, fields.size());
  memory.resize(fields.size());
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const ShapeField& field = fields[f];
    std::vector<std::uint8_t>& before = memory[f].value;
    put_number(out, field.name.size());
    out += field.name;
    out += static_cast<char>(field.place);
    put_number(out, field.value.size());
    before.resize(field.value.size(), 0);
    std::string changes;
    std::size_t changed = 0, next = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const float share = field.value[i];
      const auto now = static_cast<std::uint8_t>(std::lround(kFieldSteps * (share > 0 ? std::min(share, 1.0f) : 0)));
      if (now == before[i]) continue;
      put_number(changes, i - next);
      changes += static_cast<char>(now);
      before[i] = now;
      next = i + 1;
      ++changed;
    }
    put_number(out, changed);
    out += changes;
  }
}

void take_fields(bytes::Reader& reader, std::vector<KeyframeMemory::Field>& memory, TissueKeyframe& keyframe,
                 Room& room) {
  memory.resize(take_count(reader, 256));
  for (KeyframeMemory::Field& field : memory) {
    field.name = std::string(reader.take_bytes(take_count(reader, 4096)));
    const auto place = reader.take<std::uint8_t>();
    if (place > static_cast<std::uint8_t>(FieldPlace::kVertices)) throw InputError("a field has an unknown place");
    field.place = static_cast<FieldPlace>(place);
    const std::size_t values = take_count(reader, kMostNodes);
    room.take(sizeof(ShapeField) + field.name.size() + values * sizeof(float));
    field.value.resize(values, 0);
    std::size_t next = 0;
    for (std::size_t changes = take_count(reader, field.value.size()); changes > 0; --changes) {
      next += take_count(reader, field.value.size());
      if (next >= field.value.size()) throw InputError("a field changes beyond its end");
      field.value[next++] = reader.take<std::uint8_t>();
    }
    ShapeField& out = keyframe.fields.emplace_back(ShapeField{field.name, field.place, {}});
    out.value.reserve(values);
    for (const std::uint8_t value : field.value) out.value.push_back(static_cast<float>(value) / kFieldSteps);
  }
}

std::string encode_shape(const ReferenceShape& shape) {
  std::string payload, places;
  bytes::put(payload, kKeyframeVersion);
  bytes::put(payload, shape.number);
  bytes::put(payload, shape.topology);
  bytes::put(payload, static_cast<std::uint32_t>(shape.nodes_T.size()));
  for (const NodePlace& node : shape.nodes_T)
    for (Eigen::Index axis = 0; axis < 3; ++axis) bytes::put(places, std::bit_cast<std::uint32_t>(node[axis]));
  put_packed(payload, places);
  return payload;
}

void check_version(bytes::Reader& reader) {
  if (const auto version = reader.take<std::uint8_t>(); version != kKeyframeVersion)
    throw InputError("keyframes of version " + std::to_string(version) + " are not known to this program");
}

/// What a new topology makes worthless.
void forget_nodes(KeyframeMemory& memory, std::uint32_t shape) {
  memory.shape = shape;
  for (auto* axes : {&memory.quanta, &memory.before})
    for (Quanta& axis : *axes) axis.clear();
  memory.fields.clear();
}

}  // namespace

void TissueEncoder::refer(const TissueKeyframe& keyframe, std::vector<std::string>& shapes) {
  const bool known = reference_.number > 0 && keyframe.topology == reference_.topology &&
                     keyframe.nodes_T.size() == reference_.nodes_T.size();
  if (known) return;
  reference_ = {reference_.number + 1, keyframe.topology, keyframe.nodes_T};
  shapes.push_back(encode_shape(reference_));
}

TissueEncoder::Chunks TissueEncoder::encode(std::span<const TissueKeyframe> keyframes) {
  Chunks chunks;
  const bool independent = chunk_ % kIndependentEvery == 0;
  if (independent) memory_ = {};
  ++chunk_;
  std::string heads, packed;
  std::uint64_t period = 0;
  std::uint32_t first = 0, last = 0;
  for (const TissueKeyframe& keyframe : keyframes) {
    put_number(heads, (keyframe.period - period) << 1 | (keyframe.shaped ? 1 : 0));
    period = keyframe.period;
    put_words(packed, words_of(keyframe), memory_.words);
    if (!keyframe.shaped) continue;
    refer(keyframe, chunks.shapes);
    if (memory_.shape != reference_.number) forget_nodes(memory_, reference_.number);
    last = reference_.number;
    if (first == 0) first = last;
    put_number(packed, last);
    put_nodes(packed, keyframe.nodes_T, reference_, memory_);
    put_fields(packed, keyframe.fields, memory_.fields);
  }
  std::string& payload = chunks.keyframes;
  bytes::put(payload, kKeyframeVersion);
  bytes::put(payload, static_cast<std::uint8_t>(independent));
  for (const std::uint32_t number : {chunk_, first, last, static_cast<std::uint32_t>(keyframes.size())})
    bytes::put(payload, number);
  payload += heads;
  put_packed(payload, packed);
  return chunks;
}

std::string encode_changes(std::span<const TopologyEvent> events) {
  std::string payload;
  bytes::put(payload, static_cast<std::uint32_t>(events.size()));
  for (const TopologyEvent& event : events) {
    bytes::put(payload, event.period);
    bytes::put(payload, static_cast<std::uint32_t>(event.bytes.size()));
    payload += event.bytes;
  }
  return payload;
}

std::vector<TopologyEvent> decode_changes(std::string_view payload) {
  bytes::Reader reader(payload);
  std::vector<TopologyEvent> events;
  for (auto count = reader.take<std::uint32_t>(); count > 0; --count) {
    const auto period = reader.take<std::uint64_t>();
    const auto size = reader.take<std::uint32_t>();
    events.push_back({period, std::string(reader.take_bytes(size))});
  }
  if (!reader.rest().empty()) throw InputError("bytes are left over after the last change of topology");
  return events;
}

const ReferenceShape* shape_numbered(std::span<const ReferenceShape> shapes, std::uint64_t number) {
  const auto shape = std::ranges::lower_bound(shapes, number, {}, &ReferenceShape::number);
  return shape != shapes.end() && shape->number == number ? &*shape : nullptr;
}

ReferenceShape decode_shape(std::string_view payload) {
  bytes::Reader head(payload);
  check_version(head);
  ReferenceShape shape;
  shape.number = head.take<std::uint32_t>();
  shape.topology = head.take<std::uint64_t>();
  const auto nodes = head.take<std::uint32_t>();
  if (nodes > kMostNodes) throw InputError("a shape has more nodes than any has");
  const std::string places = take_packed(head.rest(), std::size_t{nodes} * 12);
  if (places.size() != std::size_t{nodes} * 12) throw InputError("a shape does not have the nodes that it says");
  bytes::Reader reader(places);
  shape.nodes_T.resize(nodes);
  for (NodePlace& node : shape.nodes_T)
    for (Eigen::Index axis = 0; axis < 3; ++axis) node[axis] = std::bit_cast<float>(reader.take<std::uint32_t>());
  return shape;
}

KeyframesHead decode_keyframes_head(std::string_view payload) {
  bytes::Reader reader(payload);
  check_version(reader);
  KeyframesHead head;
  head.independent = reader.take<std::uint8_t>() != 0;
  head.number = reader.take<std::uint32_t>();
  head.first_shape = reader.take<std::uint32_t>();
  head.last_shape = reader.take<std::uint32_t>();
  const auto count = reader.take<std::uint32_t>();
  if (count == 0 || count > kMostKeyframes) throw InputError("the number of keyframes is out of range");
  std::uint64_t period = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t word = bytes::take_varint(reader);
    if (period + (word >> 1) < period) throw InputError("keyframes go back");
    period += word >> 1;
    head.periods.push_back(period);
    head.shaped.push_back((word & 1) != 0);
  }
  head.packed = reader.rest();
  return head;
}

std::vector<TissueKeyframe> decode_keyframes(const KeyframesHead& head, std::span<const ReferenceShape> shapes,
                                             KeyframeMemory& memory) {
  if (head.independent) memory = {};
  Room room;
  room.take(head.periods.size() * sizeof(TissueKeyframe));
  const std::string packed = take_packed(head.packed, kMostUnpacked);
  bytes::Reader reader(packed);
  std::vector<TissueKeyframe> keyframes(head.periods.size());
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    TissueKeyframe& keyframe = keyframes[i];
    keyframe.period = head.periods[i];
    keyframe.shaped = head.shaped[i];
    take_words(reader, memory.words);
    read_words(memory.words, keyframe);
    room.take(keyframe.status.message.size() + keyframe.status.hint.size());
    if (!keyframe.shaped) continue;
    const std::uint64_t number = bytes::take_varint(reader);
    const ReferenceShape* shape = number == 0 ? nullptr : shape_numbered(shapes, number);
    if (!shape) throw InputError("a keyframe is of a shape that is not there");
    if (memory.shape != shape->number) forget_nodes(memory, shape->number);
    keyframe.topology = shape->topology;
    room.take(shape->nodes_T.size() * sizeof(NodePlace));
    keyframe.nodes_T = take_nodes(reader, *shape, memory);
    take_fields(reader, memory.fields, keyframe, room);
  }
  if (!reader.rest().empty()) throw InputError("bytes are left over after the last keyframe");
  return keyframes;
}

}  // namespace trocar
