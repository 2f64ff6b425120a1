#include "app/session/recording/tissue_track.h"

#include <algorithm>

#include "haptics/input_error.h"

namespace trocar {

void TissueTrack::add_shape(std::string_view payload) {
  ReferenceShape shape = decode_shape(payload);
  if (!shapes_.empty() && shape.number <= shapes_.back().number) throw InputError("repeats a shape that came before");
  bytes_ += sizeof shape + shape.nodes_T.size() * sizeof(NodePlace);
  shapes_.push_back(std::move(shape));
}

void TissueTrack::add_keyframes(std::string_view payload) {
  const KeyframesHead head = decode_keyframes_head(payload);
  if (head.number <= last_number_ || (!index_.empty() && head.periods.front() < index_.back().period))
    throw InputError("repeats keyframes that came before");
  if (!head.independent && head.number != last_number_ + 1) throw InputError("builds upon keyframes that are lost");
  for (const std::uint32_t shape : {head.first_shape, head.last_shape})
    if (shape > 0 && !shape_numbered(shapes_, shape)) throw InputError("builds upon a shape that is lost");
  last_number_ = head.number;
  const auto chunk = static_cast<std::uint32_t>(chunks_.size());
  for (std::size_t i = 0; i < head.periods.size(); ++i)
    index_.push_back({head.periods[i], chunk, static_cast<std::uint32_t>(i), head.shaped[i]});
  chunks_.push_back({std::string(payload), head.independent});
  bytes_ += head.periods.size() * sizeof(Entry) + sizeof(Stored) + payload.size();
}

void TissueTrack::add_changes(std::string_view payload) {
  std::vector<TopologyEvent> events = decode_changes(payload);
  for (const TopologyEvent& event : events) bytes_ += sizeof event + event.bytes.size();
  changes_.insert(changes_.end(), std::make_move_iterator(events.begin()), std::make_move_iterator(events.end()));
}

std::optional<std::size_t> TissueTrack::at_or_before(std::uint64_t period, bool shaped) const {
  auto i = static_cast<std::size_t>(std::ranges::upper_bound(index_, period, {}, &Entry::period) - index_.begin());
  while (i-- > 0)
    if (!shaped || index_[i].shaped) return i;
  return std::nullopt;
}

std::optional<std::size_t> TissueTrack::after(std::uint64_t period, bool shaped) const {
  auto i = static_cast<std::size_t>(std::ranges::upper_bound(index_, period, {}, &Entry::period) - index_.begin());
  for (; i < index_.size(); ++i)
    if (!shaped || index_[i].shaped) return i;
  return std::nullopt;
}

std::shared_ptr<const TissueKeyframe> TissueDecoder::at(std::size_t keyframe) {
  const TissueTrack::Entry& entry = track_.index_.at(keyframe);
  return chunk(entry.chunk).keyframes[entry.place];
}

const TissueDecoder::Decoded* TissueDecoder::kept(std::size_t wanted) const {
  const Decoded& decoded = kept_[wanted % kept_.size()];
  return decoded.chunk == wanted && !decoded.keyframes.empty() ? &decoded : nullptr;
}

const TissueDecoder::Decoded& TissueDecoder::chunk(std::size_t wanted) {
  if (const Decoded* there = kept(wanted)) return *there;
  std::size_t from = wanted;
  while (!track_.chunks_[from].independent && !kept(from - 1)) --from;
  for (; from <= wanted; ++from) {
    const TissueTrack::Stored& stored = track_.chunks_[from];
    KeyframeMemory memory = stored.independent ? KeyframeMemory{} : kept(from - 1)->memory;
    std::vector<TissueKeyframe> keyframes =
        decode_keyframes(decode_keyframes_head(stored.payload), track_.shapes_, memory);
    Decoded& decoded = kept_[from % kept_.size()];
    decoded.keyframes.clear();
    for (TissueKeyframe& keyframe : keyframes)
      decoded.keyframes.push_back(std::make_shared<const TissueKeyframe>(std::move(keyframe)));
    decoded.chunk = from;
    decoded.memory = std::move(memory);
  }
  return *kept(wanted);
}

}  // namespace trocar
