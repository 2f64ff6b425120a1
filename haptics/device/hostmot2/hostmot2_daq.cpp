#include "haptics/device/hostmot2/hostmot2_daq.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "haptics/device/index_mark.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

using namespace hostmot2;
using lbp16::Command;

const Hostmot2Options& checked(const Hostmot2Options& o) {
  if (!is_board_pace(o.rate_hz, o.watchdog_s) || !(o.stamp_hz > 0) || !(o.pdm_hz > 0) || !(o.wait_share > 0))
    throw std::invalid_argument("hostmot2: rates from 100 to 10000 Hz, a watchdog of up to 1 s and times above 0");
  return o;
}

constexpr std::uint16_t kLongAgo = 65535;
constexpr double kStampGrain = 0.01;             // of a period, that two readings of the card's time may be off
constexpr std::uint32_t kOwnCounters = 1 << 16;  // so many back, a counter is still one of this program's
constexpr int kGivenUp = 6;  // answers lost in a row: from then on no longer than a period is waited for the next

/// Divider of a clock that comes nearest to a rate: clock / (divider + 2).
std::uint32_t divider_of(double clock_hz, double wanted_hz) {
  return static_cast<std::uint32_t>(std::clamp(std::round(clock_hz / wanted_hz) - 2, 0.0, 32767.0));
}

}  // namespace

Hostmot2Daq::Hostmot2Daq(const Hostmot2Options& options)
    : options_(checked(options)), card_(options.card, options.setup_wait_s), identity_(card_.identify()) {
  watchdog_ = module(kWatchdogs);
  io_ = module({kPorts.tag, kPorts.name, std::max(kPorts.instances, identity_.ports)});
  encoder_ = module(kEncoders);
  pwm_ = module(kOutputs);
  for (const Wiring::Input& input : options_.wiring.inputs)
    if (input.pin < 0 || static_cast<std::size_t>(input.pin) >= identity_.pins.size())
      throw EnvironmentError(card_.name() + " has " + std::to_string(identity_.pins.size()) +
                             " pins, the wiring needs pin " + std::to_string(input.pin));
  set_up();
}

Hostmot2Daq::~Hostmot2Daq() { send(off_); }

bool Hostmot2Daq::send(const lbp16::Datagram& datagram) noexcept {
  const bool sent = card_.link().send(datagram);
  if (sent) ++link_.sent;
  return sent;
}

const Module& Hostmot2Daq::module(const Need& need) const {
  for (const Module& m : identity_.modules) {
    if (m.tag != need.tag) continue;
    if (m.instances < need.instances) break;
    if (m.instance_stride == 4 && m.clock_hz > 0) return m;
    throw EnvironmentError(card_.name() + ", " + identity_.board + ": its firmware lays out its " + need.name +
                           " in a way that is not known (stride " + std::to_string(m.instance_stride) + ")");
  }
  throw EnvironmentError(card_.name() + ", " + identity_.board + ": its firmware has not " +
                         std::to_string(need.instances) + " of " + need.name + "; load one that has");
}

/// Directions and sources of the pins: outputs of the analogue channels in use are theirs, all else stays an input.
void Hostmot2Daq::add_pins(lbp16::Datagram& to) const {
  for (int port = 0; port < identity_.ports; ++port) {
    std::uint32_t outputs = 0;
    for (int i = 0; i < identity_.port_width; ++i) {
      const auto at = static_cast<std::size_t>(port * identity_.port_width + i);
      if (at >= identity_.pins.size()) break;
      const Pin& pin = identity_.pins[at];
      if (pin.output && pin.tag == Tag::kPwm && pin.unit < kChannels) outputs |= 1U << i;
    }
    to.write32(io_.at(IoPortRegister::kOpenDrain, port), 0);
    to.write32(io_.at(IoPortRegister::kInvert, port), 0);
    to.write32(io_.at(IoPortRegister::kAlternate, port), outputs);
    to.write32(io_.at(IoPortRegister::kDirection, port), outputs);
  }
}

void Hostmot2Daq::set_up() {
  off_.write32(pwm_.at(PwmRegister::kEnable), 0);
  for (int i = 0; i < kChannels; ++i) off_.write32(pwm_.at(PwmRegister::kValue, i), 0);
  restore_ = off_;
  const double share = std::clamp(options_.pdm_hz / pwm_.clock_hz, 0.0, 1.0);
  const std::uint32_t divider = divider_of(encoder_.clock_hz, options_.stamp_hz);
  stamp_hz_ = encoder_.clock_hz / (divider + 2);
  restore_.write32(pwm_.at(PwmRegister::kPdmRate), static_cast<std::uint32_t>(std::max(1.0, 65535 * share)));
  restore_.write32(encoder_.at(EncoderRegister::kStampDivider), divider);
  for (int i = 0; i < kChannels; ++i) {
    restore_.write32(pwm_.at(PwmRegister::kMode, i), kPdmMode);
    restore_.write32(encoder_.at(EncoderRegister::kControl, i), kFifteenClocks);
  }
  const double patience = std::clamp(options_.watchdog_s * watchdog_.clock_hz, 1.0, 2147483647.0);
  restore_.write32(watchdog_.at(WatchdogRegister::kTimer), static_cast<std::uint32_t>(patience) - 1);
  restore_.write32(watchdog_.at(WatchdogRegister::kStatus), 0);
  restore_.write32(watchdog_.at(WatchdogRegister::kKick), kWatchdogKick);
  add_pins(restore_);
  lay_out_exchange();
  if (!restore_.fits() || !question_.fits())
    throw EnvironmentError(card_.name() + ": has more ports than fit a datagram");
  send(restore_);
  if (card_.ask(watchdog_.at(WatchdogRegister::kTimer)) & kWatchdogOff || card_.ask(pwm_.at(PwmRegister::kEnable)) != 0)
    throw EnvironmentError(card_.name() + ", " + identity_.board +
                           ": did not take its set-up: watchdog off, or outputs enabled");
}

void Hostmot2Daq::lay_out_exchange() {
  lbp16::Datagram& q = question_;
  const auto read32 = [&](std::uint16_t address, int count) {
    q.add(Command{.count = static_cast<std::uint8_t>(count), .address = address});
    answer_bytes_ += 4 * static_cast<std::size_t>(count);
  };
  add_counter_read(q);
  add_counter(q, 0);
  counter_at_ = q.size() - 4;
  q.add(Command{.write = true, .count = kChannels, .address = pwm_.at(PwmRegister::kValue)});
  codes_at_ = q.size();
  for (int i = 0; i < kChannels; ++i) q.add(0, 4);
  enable_at_ = q.write32(pwm_.at(PwmRegister::kEnable), 0);
  kick_at_ = q.write32(watchdog_.at(WatchdogRegister::kKick), 0);
  add_counter_read(q);
  answer_bytes_ = 8;
  read32(encoder_.at(EncoderRegister::kCount), kChannels);
  read32(encoder_.at(EncoderRegister::kStampNow), 1);
  read32(encoder_.at(EncoderRegister::kControl), kChannels);
  read32(watchdog_.at(WatchdogRegister::kStatus), 1);
  read32(watchdog_.at(WatchdogRegister::kTimer), 1);
  read32(io_.at(IoPortRegister::kData), identity_.ports);
}

Hostmot2Link Hostmot2Daq::link() const {
  Hostmot2Link out = link_;
  out.sent += card_.asked();
  return out;
}

DaqCapabilities Hostmot2Daq::capabilities() const noexcept { return {options_.name, options_.rate_hz, kPdmBits + 1}; }

bool Hostmot2Daq::exchange() noexcept {
  question_.set32(counter_at_, ++card_.counter());
  for (std::size_t i = 0; i < kChannels; ++i) question_.set32(codes_at_ + 4 * i, pdm_of(written_.codes[i]));
  question_.set32(enable_at_, armed_ ? (1U << kChannels) - 1 : 0);
  question_.set32(kick_at_, fed_ || !armed_ ? kWatchdogKick : 0);
  fed_ = false;
  if (!send(question_)) return false;
  const double wait_share = lost_in_a_row_ < kGivenUp ? options_.wait_share : std::min(options_.wait_share, 0.8);
  for (int n = 0; n < kMostStale; ++n) {
    if (!card_.link().receive(answer_, wait_share / options_.rate_hz)) return false;
    if (answer_.size() != answer_bytes_)
      ++link_.malformed;
    else if (answer_.value32(4) != card_.counter())
      ++link_.stale;
    else
      return true;
  }
  return false;
}

DaqSample Hostmot2Daq::read() noexcept {
  if (exchange()) {
    lost_in_a_row_ = 0;
    return last_ = sample_of_answer();
  }
  ++link_.lost;
  const bool stands_in = ++lost_in_a_row_ <= options_.lost_in_a_row && read_once_;
  last_.elapsed_periods = stands_in ? 1 : 0;
  if (stands_in) late_ -= 1;
  return last_;
}

/// @param passed periods of the card's time since the last answer, above 0.
std::uint32_t Hostmot2Daq::periods_in(double passed) noexcept {
  if (!read_once_) return 1;
  late_ += passed;
  const double periods = std::max(1.0, std::floor(late_ + kStampGrain));
  late_ = std::max(0.0, late_ - periods);
  return static_cast<std::uint32_t>(periods);
}

DaqSample Hostmot2Daq::sample_of_answer() noexcept {
  DaqSample out = last_;
  out.digital_in = 0;
  out.valid = (1U << kChannels) - 1;
  std::size_t at = 8;
  const auto stamp = static_cast<std::uint16_t>(answer_.value32(at + 4 * kChannels));
  const auto passed = static_cast<std::uint16_t>(stamp - stamp_);
  if (read_once_ && passed == 0) {  // its time stands still: whatever it counts is no news
    last_.elapsed_periods = 0;
    return last_;
  }
  const double to_us = 1e6 / stamp_hz_, passed_us = passed * to_us;
  out.elapsed_periods = periods_in(passed_us * 1e-6 * options_.rate_hz);
  const double late_us = 1e6 * late_ / options_.rate_hz;
  for (std::size_t i = 0; i < kChannels; ++i, at += 4) {
    const std::uint32_t word = answer_.value32(at);
    const auto raw = static_cast<std::uint16_t>(word);
    const auto step = static_cast<std::int16_t>(static_cast<std::uint16_t>(raw - raw_[i]));
    const auto edge = static_cast<std::uint16_t>(stamp - static_cast<std::uint16_t>(word >> 16));
    double& age_us = edge_age_us_[i];
    age_us = step != 0 ? edge * to_us : read_once_ ? age_us + passed_us : kLongAgo;
    out.counts[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(out.counts[i]) +
                                              static_cast<std::uint32_t>(read_once_ ? step : std::int16_t{0}));
    out.edge_age_us[i] = static_cast<std::uint16_t>(std::clamp<double>(std::ceil(age_us - late_us), 1, kLongAgo));
    raw_[i] = raw;
  }
  stamp_ = stamp;
  at += 4;
  for (std::size_t i = 0; i < kChannels; ++i, at += 4) {
    if (answer_.value32(at) & kIndexInput && i < kArmJoints && marked_joint(out.digital_in) < 0)
      out.digital_in |= index_mark(static_cast<int>(i));
    if (!(answer_.value32(at) & kQuadratureError)) continue;
    out.valid = static_cast<std::uint8_t>(out.valid & ~(1U << i));
    lbp16::Datagram clear;
    clear.write32(encoder_.at(EncoderRegister::kControl, static_cast<int>(i)), kFifteenClocks | kQuadratureError);
    send(clear);
  }
  if (const std::uint32_t before = answer_.value32(0);  // 0: it lost its power, which the watchdog tells
      before != 0 && card_.counter() - before - 1 >= kOwnCounters) {
    ++link_.foreign;
    for (int i = 0; i < kChannels; ++i) out.digital_in |= static_cast<std::uint32_t>(kDacMismatch) << i;
  }
  // A card that lost its power has its watchdog off, as a new one has, and its pins are inputs likewise.
  const bool bitten = (answer_.value32(at) & kBitten) || (answer_.value32(at + 4) & kWatchdogOff);
  at += 8;
  if (bitten && !bitten_) ++link_.bites;
  bitten_ = bitten;
  if (bitten && armed_) out.digital_in |= kWatchdogFired;
  if (bitten && !armed_) arm(false);  // nothing hung on it: set up again
  for (const Wiring::Input& input : options_.wiring.inputs) {
    const auto port = static_cast<std::size_t>(input.pin / identity_.port_width);
    const bool high = answer_.value32(at + 4 * port) >> input.pin % identity_.port_width & 1;
    if (high != input.active_low) out.digital_in |= input.bits;
  }
  read_once_ = true;
  return out;
}

void Hostmot2Daq::write(const DacFrame& frame) noexcept {
  written_ = frame;
  fed_ = true;
}

void Hostmot2Daq::arm(bool enabled) noexcept {
  const bool ends = armed_ && !enabled;
  armed_ = enabled;
  if (enabled || !(ends || bitten_)) return;
  written_ = {};
  send(bitten_ ? restore_ : off_);
}

}  // namespace trocar
