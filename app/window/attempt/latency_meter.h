// From a person's event to the end of the first frame whose picture includes it.
//
// An event is what the window handed over; the time before that (input device, X server, waiting for the poll: at most
// one frame) is not in it, nor is what the screen itself takes. Times of CLOCK_MONOTONIC given by the caller, s.
// Thread: the window's.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

namespace trocar {

class LatencyMeter {
 public:
  /// An intent that began with the event handed over at t.
  void steered(std::uint64_t number, double t_s) { waiting_.push_back({number, t_s}); }
  /// The picture being drawn includes all intents up to this one.
  void drawn(std::uint64_t number) {
    for (; !waiting_.empty() && waiting_.front().number <= number; waiting_.pop_front())
      drawn_.push_back(waiting_.front().t_s);
  }
  /// That picture is complete.
  void shown(double t_s) {
    for (const double from : drawn_) taken_s_.push_back(t_s - from);
    drawn_.clear();
  }
  /// Times so far, s; sorted.
  std::vector<double> sorted() const {
    std::vector<double> times = taken_s_;
    std::sort(times.begin(), times.end());
    return times;
  }
  void forget() { waiting_.clear(), drawn_.clear(), taken_s_.clear(); }

 private:
  struct Waiting {
    std::uint64_t number;
    double t_s;
  };
  std::deque<Waiting> waiting_;
  std::vector<double> drawn_, taken_s_;
};

}  // namespace trocar
