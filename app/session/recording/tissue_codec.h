// SHAPE, KEYFRAMES and TOPOLOGY payloads: what playback shows of an attempt without solving it again.
//
// SHAPE = u8 version, u32 number (from 1), u64 topology, u32 nodes, zstd of f32 x, y, z node by node: the nodes at the
// first keyframe of a topology, exact. Those of all others are whole kNodeQuantum from it.
// KEYFRAMES = u8 version, u8 independent, u32 number (from 1), u32 first and last SHAPE used (0: none), u32 count, per
// keyframe a varint of the difference of the period, doubled, plus 1 where it is shaped; u32 packed size, zstd of the
// keyframes. Packed keyframe: varint words, per word a varint of it XOR the word before (keyframe_words.h); where
// shaped a varint of the SHAPE, per axis u8 prediction and zigzag varints of what it leaves, then the fields: varint
// count, per field text, u8 place, varint values, varint changed ones, per change a varint of the gap and u8 of 255.
// Predictions, bits 0 and 1: 0 none, 1 the last shape, 2 the line through the last two; bit 2: differences from node to
// node of that. An independent chunk needs no other; the rest need the chunk before.
// TOPOLOGY = u32 count, per event u64 period, u32 size, bytes.
// Frame T, m. Thread: one encoder belongs to one thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/recording/tissue_keyframe.h"

namespace trocar {

inline constexpr std::uint8_t kKeyframeVersion = 1;
inline constexpr double kNodeQuantum = 5e-5;  ///< m; a decoded node is half of it away at most, along each axis
inline constexpr int kIndependentEvery = 4;   ///< chunks of keyframes: what a seek decodes at most
inline constexpr float kFieldSteps = 255;     ///< of a field from none to full

/// The nodes from which those of a topology are counted.
struct ReferenceShape {
  std::uint32_t number = 0;
  std::uint64_t topology = 0;
  std::vector<NodePlace> nodes_T;
};

/// What prediction starts from: the last keyframe, and of the one before the nodes.
struct KeyframeMemory {
  std::vector<std::uint64_t> words;
  std::uint32_t shape = 0;                                  ///< number; 0: none yet
  std::array<std::vector<std::int32_t>, 3> quanta, before;  ///< by axis; empty: not known
  struct Field {
    std::string name;
    FieldPlace place = FieldPlace::kVertices;
    std::vector<std::uint8_t> value;
  };
  std::vector<Field> fields;
};

class TissueEncoder {
 public:
  struct Chunks {
    std::vector<std::string> shapes;  ///< payloads that come before
    std::string keyframes;
  };
  /// @param keyframes of one chunk, at least one, periods not decreasing over all calls.
  Chunks encode(std::span<const TissueKeyframe> keyframes);

 private:
  void refer(const TissueKeyframe& keyframe, std::vector<std::string>& shapes);

  ReferenceShape reference_;
  KeyframeMemory memory_;
  std::uint32_t chunk_ = 0;
};

std::string encode_changes(std::span<const TopologyEvent> events);

/// What stands in front of a chunk's keyframes.
struct KeyframesHead {
  bool independent = false;
  std::uint32_t number = 0, first_shape = 0, last_shape = 0;
  std::vector<std::uint64_t> periods;
  std::vector<bool> shaped;
  std::string_view packed;  ///< u32 size, zstd; into the payload
};

/// nullptr: not there. @param shapes numbers increase.
const ReferenceShape* shape_numbered(std::span<const ReferenceShape> shapes, std::uint64_t number);

/// @throws InputError saying what is wrong with the payload, or that it holds more than any has.
ReferenceShape decode_shape(std::string_view payload);
KeyframesHead decode_keyframes_head(std::string_view payload);
std::vector<TopologyEvent> decode_changes(std::string_view payload);
/// @param shapes by number, from 1. @param memory of the chunk before, brought up to this one's end.
std::vector<TissueKeyframe> decode_keyframes(const KeyframesHead& head, std::span<const ReferenceShape> shapes,
                                             KeyframeMemory& memory);

}  // namespace trocar
