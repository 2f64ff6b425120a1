#include "app/session/playback/moment_store.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace trocar {

namespace {

constexpr std::size_t kFrameWords = sizeof(TissueFrame) / sizeof(std::uint64_t);
static_assert(sizeof(TissueFrame) % sizeof(std::uint64_t) == 0 && kFrameWords < (1u << 31));
using FrameWords = std::array<std::uint64_t, kFrameWords>;

/// The frame is plain numbers without pointers (its header promises a fixed size), so its bytes are all of it.
FrameWords words_of(const TissueFrame& frame) {
  FrameWords words;
  std::memcpy(words.data(), static_cast<const void*>(&frame), sizeof frame);
  return words;
}

const FrameWords& empty_words() {
  static const TissueFrame frame;
  static const FrameWords words = words_of(frame);
  return words;
}

std::vector<std::uint64_t> packed(const TissueFrame& frame) {
  const FrameWords words = words_of(frame);
  const FrameWords& empty = empty_words();
  std::vector<std::uint64_t> out;
  for (std::size_t i = 0; i < kFrameWords;) {
    if (words[i] == empty[i]) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < kFrameWords && words[end] != empty[end]) ++end;
    out.push_back(static_cast<std::uint64_t>(i) << 32 | (end - i));
    out.insert(out.end(), words.begin() + static_cast<std::ptrdiff_t>(i),
               words.begin() + static_cast<std::ptrdiff_t>(end));
    i = end;
  }
  out.shrink_to_fit();
  return out;
}

TissueFrame unpacked(const std::vector<std::uint64_t>& runs) {
  FrameWords words = empty_words();
  for (std::size_t i = 0; i < runs.size();) {
    const std::size_t place = runs[i] >> 32, count = runs[i] & 0xffffffffu;
    std::copy_n(runs.begin() + static_cast<std::ptrdiff_t>(i + 1), count,
                words.begin() + static_cast<std::ptrdiff_t>(place));
    i += 1 + count;
  }
  TissueFrame frame;
  std::memcpy(static_cast<void*>(&frame), words.data(), sizeof frame);
  return frame;
}

}  // namespace

void MomentStore::thin() {
  std::size_t to = 0;
  for (std::size_t from = 0; from < kept_.size(); from += 2, ++to) {
    if (to != from) kept_[to] = std::move(kept_[from]);
  }
  kept_.resize(to);
  step_ *= 2;
}

void MomentStore::add(const RunMoment& moment) {
  const std::lock_guard lock(mutex_);
  last_s_ = moment.t_s;
  if (since_++ % step_ != 0) return;
  kept_.push_back({moment.record, moment.status, packed(moment.tissue), moment.t_s, moment.organ_T, moment.thin_T});
  if (kept_.size() > most_) thin();
}

RunMoment MomentStore::at(double t_s) const {
  const std::lock_guard lock(mutex_);
  if (kept_.empty()) throw std::out_of_range("no moment of the run is known yet");
  const auto after =
      std::upper_bound(kept_.begin(), kept_.end(), t_s, [](double t, const Kept& k) { return t < k.t_s; });
  const Kept& kept = after == kept_.begin() ? kept_.front() : *std::prev(after);
  return {kept.record, kept.status, unpacked(kept.tissue), kept.t_s, true, 0, kept.organ_T, kept.thin_T};
}

std::size_t MomentStore::size() const {
  const std::lock_guard lock(mutex_);
  return kept_.size();
}

double MomentStore::first_s() const {
  const std::lock_guard lock(mutex_);
  return kept_.empty() ? 0 : kept_.front().t_s;
}

double MomentStore::last_s() const {
  const std::lock_guard lock(mutex_);
  return last_s_;
}

std::size_t MomentStore::bytes() const {
  const std::lock_guard lock(mutex_);
  std::size_t sum = kept_.size() * sizeof(Kept);
  for (const Kept& k : kept_) sum += k.tissue.capacity() * sizeof(std::uint64_t);
  return sum;
}

}  // namespace trocar
