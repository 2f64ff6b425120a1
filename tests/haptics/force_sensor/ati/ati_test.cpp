// The real force sensors' drivers against peers that speak byte for byte as they do: UDP on the loopback, a
// pseudo-terminal.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <random>
#include <thread>

#include "haptics/force_sensor/ati/ati_serial.h"
#include "haptics/force_sensor/ati/fake_sensor.h"
#include "haptics/force_sensor/ati/net_ft.h"
#include "haptics/input_error.h"
#include "tests/support/allocation_guard.h"

namespace trocar::ati_test {
namespace {

bool soon(const std::function<bool()>& holds) {
  for (int k = 0; k < 1000 && !holds(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return holds();
}

/// A Net F/T box: answers "begin" with records until it is told to stop.
class FakeBox {
 public:
  FakeBox() : thread_([this] { serve(); }) {}
  ~FakeBox() {
    ends = true;
    thread_.join();
  }
  std::string address() const { return "127.0.0.1:" + std::to_string(link_.port()); }
  static lbp16::Datagram record(std::uint32_t sequence, std::uint32_t status,
                                const std::array<std::int32_t, 6>& counts) {
    lbp16::Datagram out;
    for (const std::uint32_t word : {sequence, sequence, status}) out.add(__builtin_bswap32(word), 4);
    for (const std::int32_t c : counts) out.add(__builtin_bswap32(static_cast<std::uint32_t>(c)), 4);
    return out;
  }
  std::atomic<bool> ends = false, silent = false, swaps = false, noise = false, restart = false;
  std::atomic<std::uint32_t> status = 0, skip = 1;
  std::atomic<std::int32_t> force_uN = 1'500'000;

 private:
  void serve() {
    std::mt19937 random(1);
    bool streams = false;
    std::uint32_t sequence = 4294967000U;  // wraps soon
    lbp16::Datagram heard;
    while (!ends) {
      if (link_.receive(heard, 0.001) && heard.size() == 8)
        streams = __builtin_bswap16(static_cast<std::uint16_t>(heard.value(2, 2))) == 2;
      if (restart.exchange(false)) sequence = 0, streams = false;
      if (!streams || silent) continue;
      sequence += skip;
      if (noise) {
        lbp16::Datagram bytes;
        for (std::uint32_t n = random() % 60; n > 0; --n) bytes.add(random(), 1);
        link_.send(bytes);
      }
      if (swaps) link_.send(record(sequence + 1, status, {force_uN, 0, 0, 0, 0, 0}));
      link_.send(record(sequence, status, {force_uN, -2'000'000, 0, 0, 0, 500'000}));
      if (swaps) ++sequence;
    }
  }
  UdpLink link_ = UdpLink::on_loopback();
  std::thread thread_;
};

TEST(NetFt, RecordsBecomeNewtonsFreedOfTheFixture) {
  FakeBox box;
  WrenchStreamOptions options;
  options.fixture_n = Vec3(0, 0, -0.5);
  options.R_out_sensor = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()).toRotationMatrix();
  NetFt sensor(box.address(), options);
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).valid; }));
  EXPECT_LT((sensor.sample(Vec3::Zero()).force - Vec3(2, 1.5, 0.5)).norm(), 1e-9)
      << "turned, and the weight taken away";
  sensor.bias();
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).force.norm() < 1e-9; }));
  box.force_uN = 2'500'000;
  ASSERT_TRUE(soon([&] { return (sensor.sample(Vec3::Zero()).force - Vec3(0, 1, 0)).norm() < 1e-9; }));
  EXPECT_EQ(sensor.link().lost, 0U) << "the sequence wraps without a gap";
  EXPECT_EQ(sensor.delay(), 6U);
}

TEST(NetFt, GapsOldRecordsNoiseAndStatusAreTold) {
  FakeBox box;
  NetFt sensor(box.address(), {});
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).valid; }));
  box.skip = 4;
  EXPECT_TRUE(soon([&] { return sensor.link().lost >= 30; }));
  box.skip = 1;
  box.swaps = true;
  EXPECT_TRUE(soon([&] { return sensor.link().out_of_order >= 10; }));
  box.swaps = false;
  box.noise = true;
  EXPECT_TRUE(soon([&] { return sensor.link().malformed >= 10; }));
  EXPECT_TRUE(sensor.sample(Vec3::Zero()).valid);
  box.noise = false;
  box.status = 0x80000000U;
  EXPECT_TRUE(soon([&] { return !sensor.sample(Vec3::Zero()).valid; })) << "saturated, or an error";
  EXPECT_GT(sensor.link().unsound, 0U);
  box.status = 0;
  box.force_uN = 126'000'000;
  EXPECT_TRUE(soon([&] { return sensor.link().unsound > 20 && !sensor.sample(Vec3::Zero()).valid; }))
      << "beyond its range";
}

TEST(NetFt, SilenceIsNotValidAndABoxThatBeganAnewIsAskedAgain) {
  FakeBox box;
  NetFt sensor(box.address(), {});
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).valid; }));
  const auto begun = sensor.link().begun;
  box.restart = true;
  EXPECT_TRUE(soon([&] { return sensor.link().begun > begun && sensor.sample(Vec3::Zero()).valid; }));
  box.silent = true;
  EXPECT_TRUE(soon([&] { return !sensor.sample(Vec3::Zero()).valid; }));
  box.silent = false;
  EXPECT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).valid; }));
}

TEST(NetFt, ASampleAllocatesNothingAndWaitsForNobody) {
  FakeBox box;
  NetFt sensor(box.address(), {});
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).valid; }));
  const test::AllocationGuard guard;
  for (int k = 0; k < 1000; ++k) sensor.sample(Vec3::Zero());
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_THROW(NetFt("nowhere", {}), InputError);
}

TEST(AtiLine, IsSevenWholeNumbersAndNothingElse) {
  AtiLine line;
  ASSERT_TRUE(read_ati_line("0,   192,  -384,     0, 10560,     0,    -1", line));
  EXPECT_EQ(line.status, 0);
  EXPECT_EQ(line.counts, (std::array<std::int64_t, 6>{192, -384, 0, 10560, 0, -1}));
  for (const char* wrong : {"", ">", "0,1,2,3,4,5", "0,1,2,3,4,5,6,7", "0,1,2,3,4,5,x", "0,1,2,3,4,5,40000",
                            "0,1,,3,4,5,6", "0 1 2 3 4 5 6", "QS", "0,1,2,3,4,5,6 >"})
    EXPECT_FALSE(read_ati_line(wrong, line)) << wrong;
}

TEST(AtiLine, AMillionRandomBytesAreNoRecord) {
  std::mt19937 random(7);
  AtiLine line;
  int taken = 0;
  for (int n = 0; n < 50'000; ++n) {
    std::string text(20, ' ');
    for (char& c : text) c = static_cast<char>(random());
    taken += read_ati_line(text, line) ? 1 : 0;
  }
  EXPECT_EQ(taken, 0);
}

/// A controller at the other end of a pseudo-terminal.
class FakeController {
 public:
  FakeController() : port_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    if (port_ < 0 || ::grantpt(port_) != 0 || ::unlockpt(port_) != 0) std::abort();
    name_ = ::ptsname(port_);
    termios line = {};
    ::tcgetattr(port_, &line);
    ::cfmakeraw(&line);
    ::tcsetattr(port_, TCSANOW, &line);
    thread_ = std::thread([this] { serve(); });
  }
  ~FakeController() {
    ends = true;
    thread_.join();
    ::close(port_);
  }
  const std::string& name() const { return name_; }
  std::atomic<bool> ends = false, loses_bytes = false, noise = false, restart = false;
  std::atomic<int> counts = 192, status = 0;
  std::atomic<std::uint64_t> sent = 0;

 private:
  void put(std::string text) {
    if (loses_bytes && random_() % 3 == 0 && !text.empty()) text.erase(random_() % text.size(), 1);
    if (noise && random_() % 3 == 0)
      for (int n = 0; n < 20; ++n)
        text.insert(text.begin() + static_cast<long>(random_() % (text.size() + 1)), static_cast<char>(random_()));
    if (::write(port_, text.data(), text.size()) < 0) return;
  }
  void serve() {
    bool streams = false;
    std::string heard;
    std::array<char, 64> bytes{};
    while (!ends) {
      pollfd ready = {port_, POLLIN, 0};
      if (::poll(&ready, 1, 3) > 0 && (ready.revents & POLLIN)) {
        const ssize_t got = ::read(port_, bytes.data(), bytes.size());
        for (ssize_t i = 0; i < got; ++i) {
          if (bytes[static_cast<std::size_t>(i)] != '\r') {
            heard += bytes[static_cast<std::size_t>(i)];
            continue;
          }
          streams = heard == "QS";
          put(heard + "\r\n>");
          heard.clear();
        }
      }
      if (restart.exchange(false)) streams = false, put("ATI F/T controller\r\n>");
      if (!streams) continue;
      put(std::to_string(status) + ", " + std::to_string(counts) + ",  -384,     0,     0,     0,     7\r\n");
      ++sent;
    }
  }
  int port_;
  std::string name_ = {};
  std::mt19937 random_{3};
  std::thread thread_;
};

TEST(AtiSerial, LinesBecomeNewtons) {
  FakeController controller;
  AtiSerial sensor(controller.name(), nano25_options());
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).valid; }));
  EXPECT_LT((sensor.sample(Vec3::Zero()).force - Vec3(1, -2, 0)).norm(), 1e-12);
  controller.status = 2;
  EXPECT_TRUE(soon([&] { return !sensor.sample(Vec3::Zero()).valid; }));
}

TEST(AtiSerial, LostBytesAndNoiseCostLinesAndNeverTheirNeighbours) {
  FakeController controller;
  AtiSerial sensor(controller.name(), nano25_options());
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).valid; }));
  controller.noise = true;
  ASSERT_TRUE(soon([&] { return sensor.link().malformed >= 50; }));
  controller.noise = false;
  controller.restart = true;
  ASSERT_TRUE(soon([&] { return sensor.link().begun >= 2 && sensor.sample(Vec3::Zero()).valid; }))
      << "asked to begin anew";
  ASSERT_TRUE(soon([&] { return (sensor.sample(Vec3::Zero()).force - Vec3(1, -2, 0)).norm() < 1e-12; }));
}

TEST(AtiSerial, WhatIsNoSensorIsRefusedWithTheReason) {
  const auto refusal = [](const std::string& device) -> std::string {
    try {
      const AtiSerial sensor(device, nano25_options());
      return "taken";
    } catch (const EnvironmentError& error) {
      return error.what();
    }
  };
  EXPECT_NE(refusal("/dev/nowhere").find("No such file"), std::string::npos);
  EXPECT_NE(refusal("/dev/null").find("no serial line"), std::string::npos);
}

class Lines : public ::testing::TestWithParam<const char*> {};

TEST_P(Lines, GiveWhatTheyAreGivenToACountAndVouchForNothingElse) {
  SensorLine line(GetParam());
  const double force_count = GetParam() == std::string("serial") ? 1.0 / 192 : 1e-6;
  const Wrench load{Vec3(1.25, -0.5, 3), Vec3(0.1, 0, -0.02)};
  const auto first = line.pass(load);
  ASSERT_TRUE(first);
  EXPECT_LT((first->force - load.force).cwiseAbs().maxCoeff(), 0.51 * force_count);
  EXPECT_LT((first->moment - load.moment).cwiseAbs().maxCoeff(), 0.51 / 10560);
  EXPECT_FALSE(line.pass(load, PeerAct::kSaysSaturated)) << "the peer says so itself";
  EXPECT_FALSE(line.pass(load, PeerAct::kStaysSilent));
  EXPECT_FALSE(line.pass({Vec3(126, 0, 0), Vec3::Zero()})) << "beyond its range";
  EXPECT_FALSE(line.pass({Vec3::Zero(), Vec3(0, 3.05, 0)}));
  line.bias();
  ASSERT_TRUE(line.pass(load));
  const auto zero = line.pass(load);
  ASSERT_TRUE(zero);
  EXPECT_LT(zero->force.norm() + zero->moment.norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Sensor, Lines, ::testing::Values("net-ft", "serial"),
                         [](const auto& kind) { return std::string(kind.param) == "serial" ? "Serial" : "NetFt"; });

}  // namespace
}  // namespace trocar::ati_test
