// The keyframes of a recording as they lie there, compressed, with an index by time; and the decoder that takes out
// those that somebody asks for.
//
// Thread: a track is immutable once it has been read; a decoder belongs to one thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/session/recording/tissue_codec.h"

namespace trocar {

class TissueTrack {
 public:
  /// Take over the payload of one chunk (tissue_codec.h), in the order of the file. @throws InputError saying why it
  /// cannot be used: damaged, repeated, or what it builds upon is lost.
  void add_shape(std::string_view payload);
  void add_keyframes(std::string_view payload);
  void add_changes(std::string_view payload);

  bool empty() const { return index_.empty(); }
  std::size_t size() const { return index_.size(); }  ///< keyframes
  std::uint64_t period(std::size_t keyframe) const { return index_[keyframe].period; }
  /// The last keyframe at or before a period, of those with a shape where that is asked for.
  std::optional<std::size_t> at_or_before(std::uint64_t period, bool shaped = false) const;
  /// The first keyframe behind a period.
  std::optional<std::size_t> after(std::uint64_t period, bool shaped = false) const;
  const std::vector<TopologyEvent>& changes() const { return changes_; }
  std::size_t bytes() const { return bytes_; }  ///< that it takes, nearly

 private:
  friend class TissueDecoder;
  struct Entry {
    std::uint64_t period = 0;
    std::uint32_t chunk = 0, place = 0;  ///< in chunks_, and within it
    bool shaped = false;
  };
  struct Stored {
    std::string payload;
    bool independent = false;
  };

  std::vector<Stored> chunks_;
  std::vector<Entry> index_;
  std::vector<ReferenceShape> shapes_;
  std::vector<TopologyEvent> changes_;
  std::uint32_t last_number_ = 0;
  std::size_t bytes_ = 0;
};

/// Decodes a chunk and those that it builds upon when it is asked for one of its keyframes, and keeps the newest few.
class TissueDecoder {
 public:
  /// @param track outlives it.
  explicit TissueDecoder(const TissueTrack& track) : track_(track) {}

  /// @throws InputError when its chunk cannot be decoded though its CRC agrees.
  std::shared_ptr<const TissueKeyframe> at(std::size_t keyframe);

 private:
  struct Decoded {
    std::size_t chunk = 0;
    std::vector<std::shared_ptr<const TissueKeyframe>> keyframes;
    KeyframeMemory memory;  ///< after the last
  };
  const Decoded& chunk(std::size_t wanted);
  const Decoded* kept(std::size_t wanted) const;

  const TissueTrack& track_;
  std::array<Decoded, 2 * kIndependentEvery> kept_;  ///< chunk n at n % size; empty where there are no keyframes
};

}  // namespace trocar
