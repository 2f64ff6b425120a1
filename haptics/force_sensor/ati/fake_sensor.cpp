#include "haptics/force_sensor/ati/fake_sensor.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "haptics/device/hostmot2/udp_link.h"
#include "haptics/force_sensor/ati/ati_serial.h"
#include "haptics/force_sensor/ati/net_ft.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kPatience_s = 10;              // of a busy machine
constexpr std::uint32_t kSaturated = 1u << 17;  // any but 0 will do [M]
constexpr std::uint16_t kBegin = 2;

template <typename Holds>
bool in_time(Holds holds) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(kPatience_s);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(20));
  }
  return true;
}

class FakeBox final : public FakeSensor {
 public:
  std::string words() const override { return "net-ft:127.0.0.1:" + std::to_string(link_.port()); }
  bool say(const std::array<std::int64_t, 6>& counts, bool saturated) override {
    if (!in_time([this] { return hear(); })) return false;
    lbp16::Datagram record;
    ++sequence_;
    for (const std::uint32_t word : {sequence_, sequence_, saturated ? kSaturated : 0U})
      record.add(__builtin_bswap32(word), 4);
    for (const std::int64_t c : counts)
      record.add(__builtin_bswap32(static_cast<std::uint32_t>(static_cast<std::int32_t>(c))), 4);
    return link_.send(record);
  }

 private:
  bool hear() {
    lbp16::Datagram heard;
    while (link_.receive(heard, 0))
      if (heard.size() == 8) streams_ = __builtin_bswap16(static_cast<std::uint16_t>(heard.value(2, 2))) == kBegin;
    return streams_;
  }

  UdpLink link_ = UdpLink::on_loopback();
  bool streams_ = false;
  std::uint32_t sequence_ = 0;
};

class FakeController final : public FakeSensor {
 public:
  FakeController() : port_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    std::array<char, 64> name{};
    if (port_ < 0 || ::grantpt(port_) != 0 || ::unlockpt(port_) != 0 ||
        ::ptsname_r(port_, name.data(), name.size()) != 0) {
      if (port_ >= 0) ::close(port_);
      throw EnvironmentError("force sensor: no pseudo-terminal for its peer");
    }
    name_ = name.data();
    termios line = {};
    ::tcgetattr(port_, &line);
    ::cfmakeraw(&line);
    ::tcsetattr(port_, TCSANOW, &line);
  }
  ~FakeController() override { ::close(port_); }
  FakeController(const FakeController&) = delete;
  FakeController(FakeController&&) = delete;
  FakeController& operator=(const FakeController&) = delete;
  FakeController& operator=(FakeController&&) = delete;

  std::string words() const override { return "serial:" + name_; }
  bool say(const std::array<std::int64_t, 6>& counts, bool saturated) override {
    if (!in_time([this] { return hear(); })) return false;
    std::string text = saturated ? "2" : "0";
    for (const std::int64_t c : counts) text += ", " + std::to_string(c);
    return put(text + "\r\n");
  }

 private:
  bool put(const std::string& text) {
    return ::write(port_, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  }
  bool hear() {
    std::array<char, 64> bytes{};
    for (ssize_t got = 0; (got = ::read(port_, bytes.data(), bytes.size())) > 0;)
      for (ssize_t i = 0; i < got; ++i) {
        if (bytes[static_cast<std::size_t>(i)] != '\r') {
          heard_ += bytes[static_cast<std::size_t>(i)];
          continue;
        }
        streams_ = heard_ == "QS";
        put(heard_ + (streams_ ? "\r\n" : "\r\n>"));  // no prompt before its records
        heard_.clear();
      }
    return streams_;
  }

  int port_;
  std::string name_ = {}, heard_ = {};
  bool streams_ = false;
};

}  // namespace

std::unique_ptr<FakeSensor> make_fake_sensor(const std::string& kind) {
  if (kind == "net-ft") return std::make_unique<FakeBox>();
  if (kind == "serial") return std::make_unique<FakeController>();
  throw InputError("--sensor " + kind + ": net-ft or serial is expected");
}

SensorLine::SensorLine(const std::string& kind) : peer_(make_fake_sensor(kind)) {
  const std::string words = peer_->words(), where = words.substr(words.find(':') + 1);
  options_ = kind == "serial" ? nano25_options() : WrenchStreamOptions{};
  options_.silent_s = kPatience_s;  // the study's time is not the clock's
  if (kind == "serial")
    stream_ = std::make_unique<AtiSerial>(where, options_);
  else
    stream_ = std::make_unique<NetFt>(where, options_);
}

std::optional<Wrench> SensorLine::pass(const Wrench& acting, PeerAct act) {
  if (act == PeerAct::kStaysSilent) return std::nullopt;
  std::array<std::int64_t, 6> counts{};
  for (int i = 0; i < 3; ++i) {
    counts[static_cast<std::size_t>(i)] = std::llround(acting.force[i] * options_.counts_per_n);
    counts[static_cast<std::size_t>(3 + i)] = std::llround(acting.moment[i] * options_.counts_per_nm);
  }
  const std::uint64_t before = stream_->link().records;
  if (!peer_->say(counts, act == PeerAct::kSaysSaturated)) return std::nullopt;
  if (!in_time([&] { return stream_->newest().first.number > before; })) return std::nullopt;
  const auto [record, holds] = stream_->newest();
  if (!holds) return std::nullopt;
  return Wrench{record.force_n, record.moment_nm};
}

}  // namespace trocar
