#include "haptics/device/hostmot2/card_inquiry.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <random>

#include "haptics/input_error.h"

namespace trocar::hostmot2 {
namespace {

using lbp16::Command;
using lbp16::Size;
using lbp16::Space;

constexpr std::uint16_t kHostCounterAt = 0x10;  // of the timers' space: kept for the host
constexpr int kTries = 3;

std::string words_of(std::uint32_t low, std::uint32_t high) {
  std::string out;
  for (const std::uint32_t word : {low, high})
    for (int i = 0; i < 4; ++i) out += static_cast<char>(word >> 8 * i & 0x7F);
  std::erase_if(out, [](char c) { return c < 0x20; });
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

}  // namespace

void add_counter(lbp16::Datagram& to, std::uint32_t counter) {
  to.add(Command{.write = true, .space = Space::kTimers, .size = Size::k16, .count = 2, .address = kHostCounterAt});
  to.add(counter, 4);
}

void add_counter_read(lbp16::Datagram& to) {
  to.add(Command{.space = Space::kTimers, .size = Size::k16, .count = 2, .address = kHostCounterAt});
}

CardInquiry::CardInquiry(const std::string& card, double wait_s)
    : name_("card " + card),
      wait_s_(wait_s),
      link_(card, name_),
      claim_(link_, name_),
      counter_(std::random_device()()) {}

/// One register, before the loop begins.
std::uint32_t CardInquiry::ask(std::uint16_t address) {
  lbp16::Datagram question, answer;
  for (int n = 0; n < kTries; ++n) {
    question.clear();
    add_counter(question, ++counter_);
    add_counter_read(question);
    question.add(Command{.address = address});
    if (link_.send(question)) ++asked_;
    for (int k = 0; k < kMostStale && link_.receive(answer, wait_s_); ++k)
      if (answer.size() == 8 && answer.value32(0) == counter_) return answer.value32(4);
  }
  throw EnvironmentError(name_ +
                         ": no answer; is it powered, connected, and this computer's network card in its network (" +
                         "a card as delivered is 192.168.1.121)?");
}

Identity CardInquiry::identify() {
  const std::string card = name_ + ": ";
  Identity identity;
  if (ask(kCookieAt) != kCookie || words_of(ask(kNameAt), ask(kNameAt + 4)) != kName)
    throw EnvironmentError(card + "answers, but has no HostMot2 firmware");
  const auto idrom = static_cast<std::uint16_t>(ask(kIdromOffsetAt));
  std::array<std::uint32_t, kIdromWords> word{};
  for (int i = 0; i < kIdromWords; ++i)
    word[static_cast<std::size_t>(i)] = ask(static_cast<std::uint16_t>(idrom + 4 * i));
  if (std::find(std::begin(kIdromTypes), std::end(kIdromTypes), word[kIdromType]) == std::end(kIdromTypes))
    throw EnvironmentError(card + "describes itself in a way that is not known (IDROM type " +
                           std::to_string(word[kIdromType]) + ")");
  identity.board = words_of(word[kBoardName], word[kBoardName + 1]);
  identity.ports = static_cast<int>(word[kIoPorts]);
  identity.port_width = static_cast<int>(word[kPortWidth]);
  for (int i = 0; i < kMostModules; ++i) {
    const auto at = static_cast<std::uint16_t>(idrom + word[kModulesOffset] + 12U * static_cast<std::uint32_t>(i));
    const std::uint32_t first = ask(at), second = ask(at + 4);
    if ((first & 0xFF) == 0) break;
    Module m;
    m.tag = static_cast<Tag>(first & 0xFF);
    m.clock_hz = (first >> 16 & 0xFF) == 2 ? word[kClockHigh] : word[kClockLow];
    m.instances = static_cast<int>(first >> 24);
    m.base = static_cast<std::uint16_t>(second);
    m.register_stride = static_cast<std::uint16_t>(word[second >> 24 & 0xF ? kRegisterStride1 : kRegisterStride0]);
    m.instance_stride = static_cast<std::uint16_t>(word[second >> 28 ? kInstanceStride1 : kInstanceStride0]);
    identity.modules.push_back(m);
  }
  const int pins = std::min(static_cast<int>(word[kIoWidth]), kMostPins);
  for (int i = 0; i < pins; ++i) {
    const std::uint32_t pin =
        ask(static_cast<std::uint16_t>(idrom + word[kPinsOffset] + 4U * static_cast<std::uint32_t>(i)));
    identity.pins.push_back({static_cast<Tag>(pin >> 8 & 0xFF), static_cast<int>(pin >> 16 & 0xFF), (pin & 0x80) != 0});
  }
  if (identity.port_width < 1 || identity.port_width > 32)
    throw EnvironmentError(card + "says that its ports are " + std::to_string(identity.port_width) + " pins wide");
  return identity;
}

}  // namespace trocar::hostmot2
