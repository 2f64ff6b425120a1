// Sensors whose peers are hostile, break off and come back: random bytes, and an hour of it in simulated time. Whenever
// a sample is valid it is one that the peer has said, and no older than the bound.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "haptics/force_sensor/ati/ati_serial.h"
#include "haptics/force_sensor/ati/net_ft.h"
#include "tests/haptics/haptics_fixtures.h"
#include "tests/support/repeats.h"

namespace trocar::hostile_peers_test {
namespace {

using test::Random;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr int kFrames = 20'000;  // in every run; a million where the label long asks for them

/// The hour's clock: goes only as the test says.
std::atomic<std::int64_t> virtual_ns{kSecond_ns};
std::int64_t virtual_now() { return virtual_ns; }

bool soon(const std::function<bool()>& holds) {
  for (int k = 0; k < 20000 && !holds(); ++k)
    std::this_thread::sleep_for(std::chrono::microseconds(k < 200 ? 20 : 500));
  return holds();
}

/// A box on the loopback, played by the test itself.
class Box {
 public:
  std::string address() const { return "127.0.0.1:" + std::to_string(link_.port()); }
  static WrenchStreamOptions options() { return {}; }
  static Vec3 newtons(int counts) { return Vec3(counts, -counts, 7) / WrenchStreamOptions{}.counts_per_n; }
  bool asked() { return link_.receive(heard_, 0.5) && heard_.size() == 8; }
  void hear() {
    while (link_.receive(heard_, 0)) {
    }
  }
  void say(int counts, bool sound) { put(++sequence_, counts, sound); }
  void say_again(int counts) { put(sequence_, counts, true); }
  void babble(Random& random) {
    lbp16::Datagram noise;
    const int bytes = random.below(3) ? random.below(100) : 36;
    while (static_cast<int>(noise.size()) < bytes) noise.add(static_cast<std::uint64_t>(random.below(256)), 1);
    link_.send(noise);
  }
  /// It says nothing then until it is asked to.
  void restart() {
    sequence_ = 0;
    hear();
    for (int k = 0; k < 20 && !asked(); ++k) {
    }
  }
  std::unique_ptr<NetFt> open(const WrenchStreamOptions& options) {
    auto sensor = std::make_unique<NetFt>(address(), options);
    EXPECT_TRUE(asked());
    return sensor;
  }

 private:
  void put(std::uint32_t sequence, int counts, bool sound) {
    lbp16::Datagram out;
    for (const std::uint32_t word : {sequence, sequence, sound ? 0U : 0x80000000U}) out.add(__builtin_bswap32(word), 4);
    for (const int c : {counts, -counts, 7, 1, 2, 3}) out.add(__builtin_bswap32(static_cast<std::uint32_t>(c)), 4);
    link_.send(out);
  }
  UdpLink link_ = UdpLink::on_loopback();
  lbp16::Datagram heard_;
  std::uint32_t sequence_ = 100;
};

/// A controller at the other end of a pseudo-terminal, behind a name that stays when it is plugged in anew.
class Controller {
 public:
  Controller() : name_(std::filesystem::temp_directory_path() / ("trocar_ati_" + std::to_string(::getpid()))) {
    plug_in();
  }
  ~Controller() {
    unplug();
    std::filesystem::remove(name_);
  }
  static WrenchStreamOptions options() { return nano25_options(); }
  static Vec3 newtons(int counts) { return Vec3(counts, -counts, 7) / nano25_options().counts_per_n; }
  void plug_in() {
    port_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    ASSERT_TRUE(port_ >= 0 && ::grantpt(port_) == 0 && ::unlockpt(port_) == 0);
    termios line = {};
    ::tcgetattr(port_, &line);
    ::cfmakeraw(&line);
    ::tcsetattr(port_, TCSANOW, &line);
    std::filesystem::remove(name_);
    std::filesystem::create_symlink(::ptsname(port_), name_);
  }
  void unplug() {
    ::close(port_);
    port_ = -1;
  }
  void hear() {
    std::array<char, 256> bytes{};
    while (::read(port_, bytes.data(), bytes.size()) > 0) {
    }
  }
  void say(int counts, bool sound) {
    put((sound ? "0, " : "2, ") + std::to_string(counts) + ", " + std::to_string(-counts) + ", 7, 1, 2, 3\r\n");
  }
  void say_again(int /*counts*/) { put("\r\n>\r\n"); }
  void babble(Random& random) {
    std::string noise;
    for (int n = random.below(80); n > 0; --n) noise += static_cast<char>(random.below(256));
    put(noise + "\r");
  }
  void restart() { put("ATI F/T controller\r\n>\r\n"); }
  std::unique_ptr<AtiSerial> open(const WrenchStreamOptions& options) {
    return std::make_unique<AtiSerial>(name_.string(), options);
  }

 private:
  void put(const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t sent = ::write(port_, text.data() + at, text.size() - at);
      if (sent > 0)
        at += static_cast<std::size_t>(sent);
      else
        std::this_thread::sleep_for(std::chrono::microseconds(50));  // the line is full
    }
  }
  std::filesystem::path name_;
  int port_ = -1;
};

template <class Peer>
class HostilePeers : public testing::Test {
 protected:
  Peer peer;
};
using Peers = testing::Types<Box, Controller>;
TYPED_TEST_SUITE(HostilePeers, Peers);

TYPED_TEST(HostilePeers, AMillionRandomFramesGiveNoForceThatNobodySaid) {
  Random random(3);
  const auto sensor = this->peer.open(TypeParam::options());
  const int frames = test::repeats("PEER_FRAMES", kFrames);
  const Vec3 said = TypeParam::newtons(5000);
  std::uint64_t valid = 0;
  for (int k = 0; k < frames; ++k) {
    this->peer.babble(random);
    if (k % 16 == 0) this->peer.say(5000, true);
    if (k % 512 == 0) this->peer.hear();
    const ForceSample sample = sensor->sample(Vec3::Zero());
    if (!sample.valid) continue;
    ++valid;
    ASSERT_LT((sample.force - said).norm(), 1e-12) << "frame " << k;
  }
  EXPECT_GT(valid, 0U);
  EXPECT_TRUE(soon([&] {
    this->peer.say(-300, true);
    return sensor->sample(Vec3::Zero()).valid &&
           (sensor->sample(Vec3::Zero()).force - TypeParam::newtons(-300)).norm() < 1e-12;
  })) << "sound again once it is left alone";
  EXPECT_GT(sensor->link().malformed, 0U) << "and what was broken is counted";
}

TYPED_TEST(HostilePeers, AnHourOfSilencesErrorsAndRestartsNeverGivesAnOldForce) {
  Random random(8);
  const double seconds = test::repeats("PEER_HOUR_S", 40);
  constexpr double kRecord_s = 0.01;
  WrenchStreamOptions options = TypeParam::options();
  options.now_ns = virtual_now;
  const auto sensor = this->peer.open(options);
  const auto taken = [&] { return sensor->link().records; };
  std::int64_t said_ns = -kSecond_ns, begun_ns = virtual_ns, quiet_until_ns = 0;
  Vec3 said = Vec3::Zero();
  bool sound = true, sick = false;
  int valid = 0, silences = 0, back = 0;
  bool was_valid = false;
  while (virtual_ns - begun_ns < static_cast<std::int64_t>(seconds * kSecond_ns)) {
    virtual_ns += static_cast<std::int64_t>(kRecord_s * kSecond_ns);
    if (random.below(150) == 0) {
      quiet_until_ns = virtual_ns + static_cast<std::int64_t>(random.between(0.02, 1.5) * kSecond_ns);
      ++silences;
    }
    if (random.below(100) == 0) sick = !sick;
    if (random.below(700) == 0) this->peer.restart();
    if (virtual_ns >= quiet_until_ns) {
      const int counts = random.below(20001) - 10000;
      const auto before = taken();
      sound = !sick;
      this->peer.say(counts, sound);
      ASSERT_TRUE(soon([&] { return taken() > before; })) << "each record is taken in";
      said = TypeParam::newtons(counts);
      said_ns = virtual_ns;
      if (random.below(20) == 0) this->peer.say_again(counts);
    }
    if (random.below(300) == 0) this->peer.hear();
    const ForceSample sample = sensor->sample(Vec3::Zero());
    const bool fresh = virtual_ns - said_ns < static_cast<std::int64_t>(options.silent_s * kSecond_ns);
    ASSERT_EQ(sample.valid, fresh && sound) << "at " << static_cast<double>(virtual_ns - begun_ns) / kSecond_ns << " s";
    if (sample.valid) {
      ASSERT_LT((sample.force - said).norm(), 1e-12);
    }
    back += sample.valid && !was_valid;
    valid += sample.valid;
    was_valid = sample.valid;
  }
  EXPECT_GT(valid, seconds / kRecord_s / 10);
  EXPECT_GT(silences, seconds / 10);
  EXPECT_GT(back, seconds / 10) << "each time it came back";
}

TEST(HostileController, PulledOutAndPluggedInAgainItIsFoundAgain) {
  Controller controller;
  const auto sensor = controller.open(nano25_options());
  for (int n = 0; n < 5; ++n) {
    const auto heard = [&](int counts) {
      return soon([&] {
        controller.say(counts, true);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        return sensor->sample(Vec3::Zero()).valid;
      });
    };
    ASSERT_TRUE(heard(100 + n)) << n;
    const auto begun = sensor->link().begun;
    controller.unplug();
    ASSERT_TRUE(soon([&] { return !sensor->sample(Vec3::Zero()).valid; })) << "nobody there is no force";
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    controller.plug_in();
    ASSERT_TRUE(soon([&] { return sensor->link().begun > begun; })) << "asked to begin anew";
  }
}

}  // namespace
}  // namespace trocar::hostile_peers_test
