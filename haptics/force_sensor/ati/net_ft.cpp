#include "haptics/force_sensor/ati/net_ft.h"

#include <utility>

#include "haptics/force_sensor/ati/net_ft_counts.h"

namespace trocar {
namespace {

constexpr std::uint16_t kHeader = 0x1234, kStop = 0, kStream = 2;
constexpr std::size_t kRecordBytes = 36;
constexpr double kListen_s = 0.05;
constexpr std::uint32_t kOlder = 1U << 31;
constexpr std::uint32_t kRestarted = 10'000;  // a leap back so far is a box that began anew

std::uint32_t big_endian(const lbp16::Datagram& from, std::size_t at) { return __builtin_bswap32(from.value32(at)); }

std::string udp_of(const NetFtAddress& box) { return box.host + ":" + std::to_string(box.udp); }

}  // namespace

NetFt::NetFt(const std::string& box, const WrenchStreamOptions& options)
    : WrenchStream(options), link_(udp_of(net_ft_address(box)), "force sensor net-ft:" + box) {
  start();
}

NetFt::~NetFt() {
  stop();
  ask(kStop);
}

void NetFt::ask(std::uint16_t command) {
  lbp16::Datagram request;
  request.add(__builtin_bswap16(kHeader), 2);
  request.add(__builtin_bswap16(command), 2);
  request.add(0, 4);  // without end
  link_.send(request);
}

void NetFt::listen() {
  lbp16::Datagram datagram;
  double silent_s = options().silent_s;
  bool heard = false;  // since it was asked
  while (!ends()) {
    if (silent_s >= options().silent_s) {
      ask(kStream);
      stopped_ = std::exchange(heard, false);
      first_ = true;  // a box that began anew counts from the start
      count(&WrenchLink::begun);
      silent_s = 0;
    }
    if (!link_.receive(datagram, kListen_s)) {
      silent_s += kListen_s, stopped_ = false;
      continue;
    }
    if (take_in(datagram)) silent_s = 0, heard = true;
  }
}

/// @return whether it was a record that is news.
bool NetFt::take_in(const lbp16::Datagram& datagram) {
  if (datagram.size() != kRecordBytes) {
    count(&WrenchLink::malformed);
    return false;
  }
  const std::uint32_t sequence = big_endian(datagram, 0), ahead = sequence - sequence_;
  const bool older = ahead == 0 || ahead >= kOlder;
  if (!first_ && older && sequence_ - sequence < kRestarted) {
    count(&WrenchLink::out_of_order);
    return false;
  }
  if (!first_ && !older && ahead > 1 && ahead < kRestarted) count(&WrenchLink::lost, ahead - 1);
  const std::uint32_t sensors = big_endian(datagram, 4);
  if (std::exchange(stopped_, false) && sensors - sensors_ - 1 < kRestarted) count(&WrenchLink::taken_away);
  first_ = false;
  sequence_ = sequence;
  sensors_ = sensors;
  std::array<std::int64_t, 6> counts{};
  for (std::size_t i = 0; i < 6; ++i) counts[i] = static_cast<std::int32_t>(big_endian(datagram, 12 + 4 * i));
  take(counts, big_endian(datagram, 8) == 0);
  return true;
}

}  // namespace trocar
