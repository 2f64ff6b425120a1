#include "haptics/device/hostmot2/fake_hostmot2.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "haptics/device/index_mark.h"

namespace trocar {
namespace {

using namespace hostmot2;
using lbp16::Command;
using lbp16::Datagram;
using lbp16::Space;

constexpr std::uint16_t kIdromAt = 0x0400, kModulesAt = 0x0440, kPinsAt = 0x0600;
constexpr std::uint32_t kClockLowHz = 100'000'000, kClockHighHz = 200'000'000;  // 7I80
constexpr int kPinPorts = 3, kPinsInPort = 24, kTimerWords = 8;
constexpr std::size_t kWords = 0x10000 / 4;
constexpr int kCardPriority = 90;       // above the loop's
constexpr double kServeEvery_s = 0.05;  // looks whether it ends

Module module_of(Tag tag, int instances, std::uint16_t base) { return {tag, instances, base, 0x100, 4, 0}; }

const Module kWatchdogModule = module_of(Tag::kWatchdog, 1, 0x0C00),
             kIoModule = module_of(Tag::kIoPort, kPinPorts, 0x1000),
             kEncoderModule = module_of(Tag::kEncoder, 8, 0x3000), kPwmModule = module_of(Tag::kPwm, 8, 0x4000);

std::uint32_t four(const char* text) {
  std::uint32_t out = 0;
  for (int i = 0; i < 4; ++i) out |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])) << 8 * i;
  return out;
}

/// Instance of a register that a module has at an address. -1: another one.
int instance_at(const Module& m, int reg, std::uint16_t address) {
  const int offset = address - m.at(static_cast<PwmRegister>(reg));
  return offset >= 0 && offset % 4 == 0 && offset / 4 < m.instances ? offset / 4 : -1;
}

template <typename Register>
int instance_of(const Module& m, Register reg, std::uint16_t address) {
  return instance_at(m, static_cast<int>(reg), address);
}

/// Pins in the order of Mesa's servo firmwares for three ports of 24: counters on the first, outputs on the second.
std::uint32_t pin_descriptor(int pin) {
  const int port = pin / kPinsInPort, i = pin % kPinsInPort;
  const auto descriptor = [](Tag tag, int unit, int part, bool output) {
    return static_cast<std::uint32_t>(part | (output ? 0x80 : 0) | static_cast<int>(tag) << 8 | unit << 16 |
                                      static_cast<int>(Tag::kIoPort) << 24);
  };
  if (port == 0) return descriptor(Tag::kEncoder, i / 3, 1 + i % 3, false);
  if (port == 1) return descriptor(Tag::kPwm, i / 3, 1 + i % 3, true);
  return static_cast<std::uint32_t>(Tag::kIoPort) << 24;
}

}  // namespace

SimulatedDaqConfig FakeHostmot2::device_config(SimulatedDaqConfig config) {
  config.dac_bits = kPdmBits + 1;
  config.edge_times = true;
  config.dac_readback = false;
  config.watchdog_s = std::numeric_limits<double>::infinity();
  return config;
}

FakeHostmot2::FakeHostmot2(SimulatedDaq& device, const std::vector<InjectedFault>& faults, const Wiring& wiring,
                           const CardTroubles& troubles)
    : device_(device),
      faults_(faults),
      wiring_(wiring),
      troubles_(troubles),
      random_(troubles.seed),
      socket_(UdpLink::on_loopback()) {
  power_up();
  thread_ = std::thread([this] { serve(); });
}

FakeHostmot2::~FakeHostmot2() {
  ends_ = true;
  thread_.join();
}

std::string FakeHostmot2::address() const { return "127.0.0.1:" + std::to_string(socket_.port()); }

void FakeHostmot2::power_up() {
  memory_.assign(kWords, 0);
  const auto put = [this](std::uint16_t address, std::uint32_t value) { memory_[address / 4] = value; };
  put(kCookieAt, troubles_.cookie);
  put(kNameAt, four(troubles_.name.c_str()));
  put(kNameAt + 4, four(troubles_.name.c_str() + 4));
  put(kIdromOffsetAt, kIdromAt);
  const std::uint32_t idrom[kIdromWords] = {3,
                                            kModulesAt - kIdromAt,
                                            kPinsAt - kIdromAt,
                                            four("7I80"),
                                            four("HD  "),
                                            0,
                                            0,
                                            kPinPorts,
                                            kPinPorts * kPinsInPort,
                                            kPinsInPort,
                                            kClockLowHz,
                                            kClockHighHz,
                                            4,
                                            0x40,
                                            0x100,
                                            0x10};
  for (int i = 0; i < kIdromWords; ++i) put(static_cast<std::uint16_t>(kIdromAt + 4 * i), idrom[i]);
  int n = 0;
  for (const Module* m : {&kWatchdogModule, &kIoModule, &kEncoderModule, &kPwmModule}) {
    const int instances = m == &kEncoderModule ? troubles_.encoders
                          : m == &kPwmModule   ? troubles_.outputs
                                               : m->instances;
    const auto at = static_cast<std::uint16_t>(kModulesAt + 12 * n++);
    const std::uint32_t clock = m == &kPwmModule ? 2 : 1;
    put(at, static_cast<std::uint32_t>(m->tag) | clock << 16 | static_cast<std::uint32_t>(instances) << 24);
    put(static_cast<std::uint16_t>(at + 4), m->base);
  }
  for (int pin = 0; pin < kPinPorts * kPinsInPort; ++pin)
    put(static_cast<std::uint16_t>(kPinsAt + 4 * pin), pin_descriptor(pin));
  put(kWatchdogModule.at(WatchdogRegister::kTimer), kWatchdogOff);
  zero_ = latched_.counts;
  enabled_ = false;
  device_.arm(false);
}

void FakeHostmot2::power_cycle() {
  const std::lock_guard lock(mutex_);
  power_up();
}

void FakeHostmot2::trouble(const CardTroubles& troubles) {
  const std::lock_guard lock(mutex_);
  troubles_ = troubles;
}

void FakeHostmot2::serve() {
  // A card is not kept waiting by what else the computer does. Where that right is not given it is, as the loop is too.
  const sched_param as_hardware = {.sched_priority = kCardPriority};
  pthread_setschedparam(pthread_self(), SCHED_FIFO, &as_hardware);
  Datagram question;
  while (!ends_) {
    if (!socket_.receive(question, kServeEvery_s)) continue;
    const std::lock_guard lock(mutex_);
    deal_with(question);
    ++dealt_with_;
  }
}

void FakeHostmot2::deal_with(const Datagram& question) {
  if (troubles_.silent || happens(troubles_.loses_questions)) return;
  Datagram answer = answer_to(question);
  if (answer.size() == 0 || silent_now_ || happens(troubles_.loses_answers)) return;
  if (troubles_.late_s > 0) std::this_thread::sleep_for(std::chrono::duration<double>(troubles_.late_s));
  if (happens(troubles_.babbles)) {
    Datagram noise;
    const std::size_t bytes = 1 + random_() % answer.size();
    while (noise.size() < bytes) noise.add(random_(), 1);
    socket_.send(noise);
  }
  if (troubles_.lies)
    for (std::size_t at = 4; at + 4 <= answer.size(); at += 4) answer.set32(at, static_cast<std::uint32_t>(random_()));
  if (happens(troubles_.cuts)) answer.resize(random_() % answer.size());
  send(answer);
}

void FakeHostmot2::settle(std::uint64_t datagrams) const {
  for (int k = 0; k < 1000 && dealt_with_ < datagrams; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void FakeHostmot2::send(const Datagram& answer) {
  const bool held_before = holds_;
  if (!held_before && happens(troubles_.swaps)) {
    held_ = answer;
    holds_ = true;
    return;
  }
  socket_.send(answer);
  if (happens(troubles_.repeats)) socket_.send(answer);
  if (held_before) socket_.send(held_);
  holds_ = false;
}

Datagram FakeHostmot2::answer_to(const Datagram& question) {
  Datagram out;
  latch_due_ = true;
  silent_now_ = false;
  for (std::size_t at = 0; const auto command = lbp16::command_at(question, at);) {
    const Command& c = *command;
    const std::size_t each = bytes_of(c.size);
    at += 4;
    for (std::size_t k = 0; k < c.count; ++k) {
      const auto address = static_cast<std::uint16_t>(c.address + (c.increment ? k * each : 0));
      const bool known = (c.space == Space::kHostmot2 && c.size == lbp16::Size::k32) ||
                         (c.space == Space::kTimers && c.size == lbp16::Size::k16 && address / 2 < kTimerWords + 4);
      if (c.write) {
        const std::uint64_t value = question.value(at, each);
        at += each;
        if (!known) continue;
        if (c.space == Space::kHostmot2)
          write_register(address, static_cast<std::uint32_t>(value));
        else if (address / 2 >= kTimerWords)
          host_words_[address / 2 - kTimerWords] = static_cast<std::uint16_t>(value);
      } else if (!known) {
        out.add(0, each);
      } else if (c.space == Space::kHostmot2) {
        out.add(read_register(address), each);
      } else {
        out.add(address / 2 >= kTimerWords ? host_words_[address / 2 - kTimerWords] : 0U, each);
      }
    }
  }
  return out;
}

void FakeHostmot2::write_register(std::uint16_t address, std::uint32_t value) {
  if (address < kWatchdogModule.base) return;  // who it is cannot be changed
  if (instance_of(kWatchdogModule, WatchdogRegister::kKick, address) >= 0) {
    if (value >> 24 == kWatchdogKick >> 24 && !troubles_.no_kicks &&
        !faults_.lasts(InjectedFaultKind::kWatchdog, device_.time_s()))
      kicked_s_ = device_.time_s();
    return;
  }
  if (instance_of(kEncoderModule, EncoderRegister::kCount, address) >= 0) return;  // counters are not cleared here
  memory_[address / 4] = value;
  drive();
}

std::uint32_t FakeHostmot2::read_register(std::uint16_t address) {
  if (const int i = instance_of(kEncoderModule, EncoderRegister::kCount, address); i >= 0) {
    if (std::exchange(latch_due_, false)) silent_now_ = !sync();
    if (i >= kChannels) return 0;
    const auto c = static_cast<std::size_t>(i);
    return static_cast<std::uint32_t>(stamps_[c]) << 16 |
           (static_cast<std::uint32_t>(std::int64_t{latched_.counts[c]} - zero_[c]) & 0xFFFF);
  }
  if (instance_of(kEncoderModule, EncoderRegister::kStampNow, address) == 0) return stamp_;
  if (const int i = instance_of(kEncoderModule, EncoderRegister::kControl, address); i >= 0) {
    const bool error = troubles_.quadrature_errors >> i & 1 || (i < kChannels && !(latched_.valid >> i & 1));
    troubles_.quadrature_errors &= ~(1 << i);
    const bool mark = marked_joint(latched_.digital_in) == i;
    return (memory_[address / 4] & ~(kQuadratureError | kIndexInput)) | (error ? kQuadratureError : 0) |
           (mark ? kIndexInput : 0);
  }
  if (const int port = instance_of(kIoModule, IoPortRegister::kData, address); port >= 0) return inputs(port);
  return memory_[address / 4];
}

/// One period of the device, then everything is latched. @return whether the card answers: else an injected silence.
bool FakeHostmot2::sync() {
  DacFrame frame;
  for (int i = 0; i < kChannels; ++i) {
    const bool pdm = (memory_[kPwmModule.at(PwmRegister::kMode, i) / 4] & kPdmMode) == kPdmMode;
    const bool clocked = memory_[kPwmModule.at(PwmRegister::kPdmRate) / 4] > 0;
    if (pdm && clocked && outputs_connected())
      frame.codes[static_cast<std::size_t>(i)] = code_of(memory_[kPwmModule.at(PwmRegister::kValue, i) / 4]);
  }
  device_.write(frame);
  DaqSample now = device_.read();
  watch();
  if (now.elapsed_periods == 0) return false;
  const double divider = (memory_[kEncoderModule.at(EncoderRegister::kStampDivider) / 4] & 0xFFFF) + 2.0;
  const double rate = kClockLowHz / divider;
  const auto stamp = static_cast<std::uint16_t>(
      static_cast<std::uint64_t>(std::floor((device_.time_s() + troubles_.shift_s) * rate)) & 0xFFFF);
  if (troubles_.frozen) {
    now.counts = latched_.counts;
    latched_ = now;
    return true;
  }
  for (std::size_t i = 0; i < kChannels; ++i)
    if (now.counts[i] != latched_.counts[i])
      stamps_[i] = static_cast<std::uint16_t>(
          stamp - static_cast<std::uint16_t>((now.edge_age_us[i] * 1e-6 + troubles_.shift_s) * rate));
  stamp_ = stamp;
  latched_ = now;
  return true;
}

void FakeHostmot2::watch() {
  const std::uint32_t timer = memory_[kWatchdogModule.at(WatchdogRegister::kTimer) / 4];
  if (timer & kWatchdogOff) return;
  if (device_.time_s() - kicked_s_ <= (timer + 1.0) / kClockLowHz) return;
  memory_[kWatchdogModule.at(WatchdogRegister::kStatus) / 4] |= kBitten;
  for (int port = 0; port < kPinPorts; ++port) {
    memory_[kIoModule.at(IoPortRegister::kDirection, port) / 4] = 0;
    memory_[kIoModule.at(IoPortRegister::kOpenDrain, port) / 4] = 0;
  }
  drive();
}

/// Whether the pins of the second port are outputs, driven by the analogue channels.
bool FakeHostmot2::outputs_connected() const {
  constexpr std::uint32_t kUsed = (1U << 3 * kChannels) - 1;
  return (memory_[kIoModule.at(IoPortRegister::kDirection, 1) / 4] & kUsed) == kUsed &&
         (memory_[kIoModule.at(IoPortRegister::kAlternate, 1) / 4] & kUsed) == kUsed;
}

/// What the enables make of the amplifiers' inhibits: a pin that nobody drives is pulled up, and inhibits.
void FakeHostmot2::drive() {
  constexpr std::uint32_t kAll = (1U << kChannels) - 1;
  const bool enabled = outputs_connected() && (memory_[kPwmModule.at(PwmRegister::kEnable) / 4] & kAll) == kAll;
  if (enabled != enabled_) device_.arm(enabled);
  enabled_ = enabled;
}

std::uint32_t FakeHostmot2::inputs(int port) const {
  std::uint32_t out = (1U << kPinsInPort) - 1;  // pulled up
  for (const Wiring::Input& input : wiring_.inputs) {
    if (input.pin / kPinsInPort != port) continue;
    const bool says = (latched_.digital_in & input.bits) != 0;
    if (says == input.active_low) out &= ~(1U << input.pin % kPinsInPort);
  }
  return out;
}

std::array<std::int32_t, kChannels> FakeHostmot2::codes_in_force() const {
  const std::lock_guard lock(mutex_);
  return device_.codes_in_force().codes;
}

bool FakeHostmot2::amplifiers_enabled() const {
  const std::lock_guard lock(mutex_);
  return enabled_;
}

void FakeHostmot2::set_hand_intent(const Pose& X_BS, double jaw_opening_m) noexcept {
  const std::lock_guard lock(mutex_);
  device_.set_hand_intent(X_BS, jaw_opening_m);
}

void FakeHostmot2::press_clutch(bool pressed) noexcept {
  const std::lock_guard lock(mutex_);
  device_.press_clutch(pressed);
}

void FakeHostmot2::press_pedal(bool pressed) noexcept {
  const std::lock_guard lock(mutex_);
  device_.press_pedal(pressed);
}

void FakeHostmot2::press_exchange(bool pressed) noexcept {
  const std::lock_guard lock(mutex_);
  device_.press_exchange(pressed);
}

void FakeHostmot2::press_deadman(bool pressed) noexcept {
  const std::lock_guard lock(mutex_);
  device_.press_deadman(pressed);
}

void FakeHostmot2::lead_arm(const JointVector& from_jig, double seconds) noexcept {
  const std::lock_guard lock(mutex_);
  device_.lead_arm(from_jig, seconds);
}

HandSense FakeHostmot2::sense() const noexcept {
  const std::lock_guard lock(mutex_);
  return device_.sense();
}

void FakeHostmot2::miss_sync() noexcept {
  const std::lock_guard lock(mutex_);
  device_.miss_sync();
  watch();
}

double FakeHostmot2::time_s() const noexcept {
  const std::lock_guard lock(mutex_);
  return device_.time_s();
}

}  // namespace trocar
