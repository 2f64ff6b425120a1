// One board taken through a few steps of the self-test, with every sample that it gave. Internal to the checks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "app/device_bench/board_bench.h"
#include "haptics/input_error.h"

namespace trocar {

class BoardRun {
 public:
  static constexpr double kJigS = 0.060;  ///< armed with zero codes: longer than a jig takes to open

  /// @throws EnvironmentError when the bench cannot do the acts.
  BoardRun(BoardBench& bench, const BoardActs& acts) : board_(bench.open(acts)) {
    if (!board_) throw EnvironmentError("self-test: the bench does not give a board");
    period_s_ = 1 / board_->capabilities().rate_hz;
    full_ = static_cast<double>((std::int64_t{1} << (board_->capabilities().dac_bits - 1)) - 1);
  }

  DataAcquisition& board() { return *board_; }
  double period_s() const { return period_s_; }
  double time_s() const { return static_cast<double>(reads_) * period_s_; }
  /// Since the start, or since forget().
  const std::vector<DaqSample>& samples() const { return samples_; }
  /// The samples so far; motion is counted from the last of them.
  void forget() {
    if (!samples_.empty()) origin_ = samples_.back();
    samples_.clear();
  }

  /// Disarmed, nothing written.
  void rest(double seconds) {
    repeat(seconds, [this] { read(); });
  }
  /// Armed with zero codes until the jig is open.
  void arm_in_jig() {
    board_->write({});
    board_->arm(true);
    hold_zero(kJigS);
  }
  void hold_zero(double seconds) {
    repeat(seconds, [this] { read(), board_->write({}); });
  }
  /// A steady command on one channel. @param share of full scale.
  void command(int channel, double share, double seconds) {
    DacFrame frame;
    frame.codes[static_cast<std::size_t>(channel)] = static_cast<std::int32_t>(std::lround(share * full_));
    board_->write(frame);
    repeat(seconds, [&] { read(), board_->write(frame); });
  }
  /// Other small codes on every channel each period, the same in every run.
  void vary(double seconds) {
    std::uint32_t state = 1;
    repeat(seconds, [&] {
      read();
      DacFrame frame;
      for (std::int32_t& code : frame.codes) {
        state = state * 1664525u + 1013904223u;
        code = static_cast<std::int32_t>((static_cast<double>(state >> 8) / (1 << 24) - 0.5) * 0.2 * full_);
      }
      board_->write(frame);
    });
  }
  /// Armed, without a write, until the input shows or the time is over.
  void starve(double seconds, std::uint32_t until) {
    repeat(seconds, [&] {
      if (samples_.empty() || !(samples_.back().digital_in & until)) read();
    });
  }

  /// Counts since forget(), right across the wrap.
  std::int32_t moved(std::size_t sample, int channel) const {
    const auto c = static_cast<std::size_t>(channel);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(samples_[sample].counts[c]) -
                                     static_cast<std::uint32_t>(origin_.counts[c]));
  }
  /// Between the lowest and the highest count of a channel at rest.
  std::int32_t span(int channel) const {
    std::int32_t low = 0, high = 0;
    for (const DaqSample& sample : samples_) {
      const auto c = static_cast<std::size_t>(channel);
      const auto step = static_cast<std::int32_t>(static_cast<std::uint32_t>(sample.counts[c]) -
                                                  static_cast<std::uint32_t>(samples_.front().counts[c]));
      low = std::min(low, step);
      high = std::max(high, step);
    }
    return high - low;
  }

 private:
  template <class Step>
  void repeat(double seconds, const Step& step) {
    for (long n = std::lround(seconds / period_s_); n > 0; --n) step();
  }
  void read() {
    samples_.push_back(board_->read());
    ++reads_;
  }

  std::unique_ptr<DataAcquisition> board_;
  double period_s_ = 0, full_ = 0;
  std::uint64_t reads_ = 0;
  DaqSample origin_;
  std::vector<DaqSample> samples_;
};

}  // namespace trocar
