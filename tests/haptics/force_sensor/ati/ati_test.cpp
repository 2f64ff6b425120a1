// The real force sensors' drivers against peers that speak byte for byte as they do: UDP on the loopback, a
// pseudo-terminal.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include "haptics/device/backends/make_backend.h"
#include "haptics/force_sensor/ati/ati_serial.h"
#include "haptics/force_sensor/ati/fake_sensor.h"
#include "haptics/force_sensor/ati/net_ft.h"
#include "haptics/force_sensor/ati/net_ft_counts.h"
#include "haptics/input_error.h"
#include "tests/support/allocation_guard.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::ati_test {
namespace {

bool soon(const std::function<bool()>& holds) {
  for (int k = 0; k < 1000 && !holds(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return holds();
}

/// What a Net F/T box answers who asks for its counts.
std::string calibration(int force_unit, int torque_unit, std::uint32_t per_force, std::uint32_t per_torque) {
  std::string out = {0x12, 0x34, static_cast<char>(force_unit), static_cast<char>(torque_unit)};
  for (const std::uint32_t word : {per_force, per_torque})
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(word >> shift);
  return out + std::string(12, 'x');  // factors of 16-bit counts
}

/// The end of a box that tells its counts, by TCP.
class FakeCounts {
 public:
  enum class Ends : std::uint8_t { kWaits, kCloses, kDribbles };
  FakeCounts() : door_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_in own = {};
    own.sin_family = AF_INET;
    own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof own;
    auto* at = reinterpret_cast<sockaddr*>(&own);
    EXPECT_TRUE(door_ >= 0 && ::bind(door_, at, size) == 0 && ::listen(door_, 4) == 0 &&
                ::getsockname(door_, at, &size) == 0);
    port = ntohs(own.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~FakeCounts() {
    ends_ = true;
    thread_.join();
    ::close(door_);
  }
  std::string heard() {
    const std::lock_guard lock(mutex_);
    return heard_;
  }
  void say(const std::string& answer, Ends ends = Ends::kWaits) {
    const std::lock_guard lock(mutex_);
    answer_ = answer, how_ = ends;
  }
  std::uint16_t port = 0;

 private:
  void serve() {
    while (!ends_) {
      pollfd ready = {door_, POLLIN, 0};
      if (::poll(&ready, 1, 3) <= 0) continue;
      const int guest = ::accept4(door_, nullptr, nullptr, SOCK_CLOEXEC);
      std::string heard(20, '\0');
      if (::recv(guest, heard.data(), heard.size(), MSG_WAITALL) == 20) answer(guest, heard);
      ::close(guest);
    }
  }
  void answer(int guest, const std::string& heard) {
    std::string answer;
    Ends how{};
    {
      const std::lock_guard lock(mutex_);
      heard_ = heard, answer = answer_, how = how_;
    }
    for (std::size_t at = 0; at < answer.size();) {
      const std::size_t piece = how == Ends::kDribbles ? 1 : answer.size();
      ::send(guest, answer.data() + at, piece, MSG_NOSIGNAL);
      at += piece;
      if (how == Ends::kDribbles) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    char last = 0;
    if (how != Ends::kCloses) ::recv(guest, &last, 1, 0);  // until the other end closes
  }
  int door_;
  std::mutex mutex_;
  std::string answer_ = calibration(2, 3, 1'000'000, 1'000'000), heard_;
  Ends how_ = Ends::kWaits;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

/// A Net F/T box: answers "begin" with records until it is told to stop.
class FakeBox {
 public:
  FakeBox() : thread_([this] { serve(); }) {}
  ~FakeBox() {
    ends = true;
    thread_.join();
  }
  std::string address() const {
    return "127.0.0.1:" + std::to_string(link_.port()) + ":" + std::to_string(calibration.port);
  }
  FakeCounts calibration;
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

TEST(NetFt, RecordsBecomeNewtonsInTheSensorsOwnAxes) {
  FakeBox box;
  NetFt sensor(box.address(), {});
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).valid; }));
  EXPECT_LT((sensor.sample(Vec3::Zero()).force - Vec3(1.5, -2, 0)).norm(), 1e-9);
  EXPECT_LT((sensor.sample(Vec3::Zero()).moment_nm - Vec3(0, 0, 0.5)).norm(), 1e-9);
  sensor.bias();
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).force.norm() < 1e-9; }));
  box.force_uN = 2'500'000;
  ASSERT_TRUE(soon([&] { return (sensor.sample(Vec3::Zero()).force - Vec3(1, 0, 0)).norm() < 1e-9; }));
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

TEST(NetFt, TwoThatListenToOneBoxAreTold) {
  FakeBox box;
  NetFt first(box.address(), {});
  ASSERT_TRUE(soon([&] { return first.sample(Vec3::Zero()).valid; }));
  EXPECT_EQ(first.link().taken_away, 0U);
  NetFt second(box.address(), {});
  EXPECT_TRUE(soon([&] { return first.link().taken_away >= 2 && second.link().taken_away >= 2; }));
  EXPECT_NE(link_words(first.link()).find("another program may be listening"), std::string::npos);
}

TEST(NetFt, ABoxThatWasSilentOrBeganAnewIsNotTakenAway) {
  FakeBox box;
  NetFt sensor(box.address(), {});
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).valid; }));
  ASSERT_TRUE(soon([&] { return sensor.link().records > 500; })) << "beyond the wrap";
  box.restart = true;
  const auto begun = sensor.link().begun;
  ASSERT_TRUE(soon([&] { return sensor.link().begun > begun && sensor.sample(Vec3::Zero()).valid; }));
  box.silent = true;
  ASSERT_TRUE(soon([&] { return sensor.link().begun >= begun + 3; })) << "asked twice in vain";
  box.silent = false;
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).valid; }));
  EXPECT_EQ(sensor.link().taken_away, 0U);
  EXPECT_EQ(link_words({.records = 5, .lost = 1, .begun = 1}),
            "5 records, 1 lost, 0 broken, 0 saturated or in error; asked to begin once");
}

TEST(ForceSensors, CountsOfANewtonAreThoseOfTheDeviceFile) {
  FakeBox box;
  SensorMount calibrated;
  calibrated.counts_per_n = 5e5;
  calibrated.counts_per_nm = 2e6;
  const auto sensor = make_force_sensor("net-ft:" + box.address(), calibrated);
  ASSERT_TRUE(soon([&] { return sensor->sample(Vec3::Zero()).valid; }));
  EXPECT_LT((sensor->sample(Vec3::Zero()).force - Vec3(3, -4, 0)).norm(), 1e-9);
  EXPECT_LT((sensor->sample(Vec3::Zero()).moment_nm - Vec3(0, 0, 0.25)).norm(), 1e-9);
  EXPECT_CONTAINS(sensor->link().counts.doubt,
                  "500000 counts a N and 2000000 a N m, from the device file, but the box says 1000000");
}

TEST(ForceSensors, ABoxIsAskedForTheCountsThatNoFileGives) {
  FakeBox box;
  box.calibration.say(calibration(1, 1, 1'000'000, 500'000));
  const auto sensor = make_force_sensor("net-ft:" + box.address());
  EXPECT_EQ(box.calibration.heard(), '\1' + std::string(19, '\0'));
  ASSERT_TRUE(soon([&] { return sensor->sample(Vec3::Zero()).valid; }));
  constexpr double kPound = 4.4482216152605;
  EXPECT_LT((sensor->sample(Vec3::Zero()).force - kPound * Vec3(1.5, -2, 0)).norm(), 1e-9);
  EXPECT_LT((sensor->sample(Vec3::Zero()).moment_nm - Vec3(0, 0, kPound * 0.0254)).norm(), 1e-9);
  EXPECT_EQ(counts_words(sensor->link().counts), "224808.943 counts a N and 4425372.9 a N m, from the box");
  EXPECT_EQ(sensor->link().counts.doubt, "");
}

TEST(ForceSensors, ThatTheFileRoundsIsNoDoubtAndHalfAFileLeavesTheRestToTheBox) {
  FakeBox box;
  box.calibration.say(calibration(1, 3, 1'000'000, 500'000));
  SensorMount file;
  file.counts_per_n = 224'800;
  const WrenchCounts half = make_force_sensor("net-ft:" + box.address(), file)->link().counts;
  EXPECT_EQ(counts_words(half), "224800 counts a N and 500000 a N m, from the device file and the box");
  EXPECT_EQ(half.doubt, "");
  file.counts_per_nm = 510'000;
  EXPECT_CONTAINS(make_force_sensor("net-ft:" + box.address(), file)->link().counts.doubt, "counts_per_nm in [sensor]");
}

TEST(ForceSensors, ABoxThatTellsNoCountsIsTakenWithThoseOfTheFileOnly) {
  FakeBox box;
  box.calibration.say("", FakeCounts::Ends::kCloses);
  const std::string words = "net-ft:" + box.address();
  EXPECT_CONTAINS(test::message_of<EnvironmentError>([&] { make_force_sensor(words); }), "force sensor " + words);
  SensorMount file;
  file.counts_per_n = 1e6;
  EXPECT_THROW(make_force_sensor(words, file), EnvironmentError) << "a newton metre is still open";
  file.counts_per_nm = 1e6;
  file.lag_s = 0.004;
  const auto sensor = make_force_sensor(words, file);
  EXPECT_EQ(sensor->config().lag_s, 0.004);
  EXPECT_TRUE(soon([&] { return sensor->sample(Vec3::Zero()).valid; }));
  EXPECT_EQ(sensor->link().counts.from, "the device file; the box was asked in vain");
  EXPECT_EQ(make_force_sensor("serial:/dev/ptmx")->link().counts.per_n, 192) << "nobody is asked there";
}

TEST(NetFtCounts, EveryUnitBecomesNewtonsAndNewtonMetres) {
  FakeCounts box;
  const std::string address = "127.0.0.1:1:" + std::to_string(box.port);
  const double newtons[] = {4.4482216152605, 1, 4448.2216152605, 1000, 9.80665, 0.00980665};
  const double newton_metres[] = {0.1129848290276167, 1.3558179483314004, 1, 0.001, 0.0980665, 1000};
  for (int unit = 1; unit <= 6; ++unit) {
    box.say(calibration(unit, unit, 4'000'000'000, 10'560), FakeCounts::Ends::kDribbles);
    const NetFtCounts counts = net_ft_counts(address);
    EXPECT_NEAR(counts.per_n * newtons[unit - 1] / 4e9, 1, 1e-12) << unit;
    EXPECT_NEAR(counts.per_nm * newton_metres[unit - 1] / 10'560, 1, 1e-12) << unit;
  }
}

TEST(NetFtCounts, WhatABoxCannotMeanIsRefusedAndTheWayOutIsSaid) {
  FakeCounts box;
  const std::string address = "127.0.0.1:1:" + std::to_string(box.port), sound = calibration(2, 3, 1000, 1000);
  struct Lie {
    std::string answer;
    FakeCounts::Ends ends;
    const char* told;
  };
  const Lie lies[] = {
      {"\x34\x12" + sound.substr(2), FakeCounts::Ends::kWaits, "does not begin its answer with 0x1234"},
      {calibration(0, 3, 1000, 1000), FakeCounts::Ends::kWaits, "a unit of force that nobody knows: 0"},
      {calibration(2, 7, 1000, 1000), FakeCounts::Ends::kWaits, "a unit of torque that nobody knows: 7"},
      {calibration(2, 255, 1000, 1000), FakeCounts::Ends::kWaits, "a unit of torque that nobody knows: 255"},
      {calibration(2, 3, 0, 1000), FakeCounts::Ends::kWaits, "says 0 counts"},
      {calibration(2, 3, 1000, 0), FakeCounts::Ends::kWaits, "says 0 counts"},
      {sound.substr(0, 12), FakeCounts::Ends::kWaits, "broke off after 12 of 24 bytes"},
      {sound.substr(0, 23), FakeCounts::Ends::kCloses, "closed the connection after 23 of 24 bytes"},
      {"", FakeCounts::Ends::kCloses, "closed the connection after 0 of 24 bytes"},
      {"", FakeCounts::Ends::kWaits, "says nothing within 0.2 s"}};
  for (const Lie& lie : lies) {
    box.say(lie.answer, lie.ends);
    const auto begun = std::chrono::steady_clock::now();
    const std::string told = test::message_of<EnvironmentError>([&] { net_ft_counts(address, 0.2); });
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(5)) << lie.told;
    EXPECT_CONTAINS(told, lie.told);
    EXPECT_CONTAINS(told, "force sensor net-ft:" + address);
    EXPECT_CONTAINS(told, "write counts_per_n and counts_per_nm");
  }
  EXPECT_CONTAINS(test::message_of<EnvironmentError>([] { net_ft_counts("127.0.0.1:1:1"); }), "Connection refused");
}

TEST(NetFtCounts, AnAddressHasTwoPortsAtMost) {
  EXPECT_EQ(net_ft_address("192.168.1.1").tcp, 49151);
  EXPECT_EQ(net_ft_address("192.168.1.1").udp, 49152);
  EXPECT_EQ(net_ft_address("192.168.1.1:5:6").host, "192.168.1.1");
  EXPECT_EQ(net_ft_address("192.168.1.1:5:6").udp, 5);
  EXPECT_EQ(net_ft_address("192.168.1.1:5:6").tcp, 6);
  for (const char* wrong : {"", "box", "192.168.1", "192.168.1.1:", "192.168.1.1:0",
                            "192.168.1.1:5:", "192.168.1.1:5:x", "192.168.1.1:5:6:7", "192.168.1.1:65536"})
    EXPECT_CONTAINS(test::message_of<InputError>([&] { net_ft_address(wrong); }), "force sensor net-ft:") << wrong;
}

TEST(NetFt, AnAddressThatNoBoxCanHaveIsSaidToBeTheSensors) {
  EXPECT_CONTAINS(test::message_of<EnvironmentError>([] { NetFt("255.255.255.255", {}); }),
                  "force sensor net-ft:255.255.255.255: no way to it");
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

using Counts = std::array<std::int64_t, 6>;

std::string binary_record(int status, const Counts& counts) {
  std::string out(1, static_cast<char>(status));
  for (const std::int64_t c : counts) {
    out += static_cast<char>(c >> 8);
    out += static_cast<char>(c);
  }
  return out;
}

/// Counts that tremble by a few, as a sensor's do.
Counts trembling(Counts counts, std::mt19937& random) {
  for (std::int64_t& c : counts) c += static_cast<std::int64_t>(random() % 9) - 4;
  return counts;
}

TEST(AtiFrames, FindThePlaceAndGiveEachRecordFromThenOn) {
  std::mt19937 random(4);
  AtiFrames frames;
  std::vector<Counts> said, given;
  std::string bytes = "CD R\r\n>QS\r\n";
  for (int n = 0; n < 100; ++n) {
    said.push_back(trembling({192, -384, 0, 10560, -5, 7}, random));
    bytes += binary_record(0, said.back());
  }
  for (const char byte : bytes)
    if (const auto read = frames.push(static_cast<std::uint8_t>(byte))) given.push_back(read->counts);
  ASSERT_GE(given.size(), 85U);
  EXPECT_TRUE(std::equal(given.rbegin(), given.rend(), said.rbegin() + 1))
      << "all that is given was said, without a gap";
  EXPECT_EQ(frames.broken(), 0U);
}

TEST(AtiFrames, LostAndAddedBytesNeverMakeAForceThatNobodySaid) {
  std::mt19937 random(11);
  AtiFrames frames;
  Counts around{};
  int given = 0;
  std::array<Counts, 4> last{};
  for (int n = 0; n < 200'000; ++n) {
    if (n % 50 == 0)
      for (std::int64_t& c : around) c = static_cast<std::int64_t>(random() % 4000) - 2000;
    if (random() % 3 == 0) around[random() % 6] = 0;  // small forces are where a slipped frame hides
    last = {last[1], last[2], last[3], trembling(around, random)};
    std::string record = binary_record(0, last[3]);
    if (random() % 40 == 0) record.erase(random() % record.size(), 1 + random() % 3);
    if (random() % 40 == 0) record.insert(random() % record.size(), 1 + random() % 3, static_cast<char>(random() % 3));
    for (const char byte : record) {
      const auto read = frames.push(static_cast<std::uint8_t>(byte));
      if (!read) continue;
      ++given;
      std::int64_t off = 1 << 20;
      for (const Counts& said : last) {
        std::int64_t worst = 0;
        for (std::size_t i = 0; i < 6; ++i) worst = std::max(worst, std::abs(read->counts[i] - said[i]));
        off = std::min(off, worst);
      }
      ASSERT_LE(off, AtiFrames::kStep) << "record " << n;
    }
  }
  EXPECT_GT(given, 20'000);
  EXPECT_GT(frames.broken(), 1'000U);
}

TEST(AtiFrames, AMillionRandomBytesAreNoRecord) {
  std::mt19937 random(7);
  AtiFrames frames;
  int taken = 0;
  for (int n = 0; n < 1'000'000; ++n) taken += frames.push(static_cast<std::uint8_t>(random())) ? 1 : 0;
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
          if (heard == "CD A" || heard == "CD B") binary_ = heard == "CD B";
          put(heard + "\r\n>");
          heard.clear();
        }
      }
      if (restart.exchange(false)) streams = false, put("ATI F/T controller\r\n>");
      if (!streams) continue;
      put(binary_ ? binary_record(status, trembling({counts, -384, 0, 0, 0, 7}, random_))
                  : std::to_string(status) + ", " + std::to_string(counts) + ",  -384,     0,     0,     0,     7\r\n");
      ++sent;
    }
  }
  int port_;
  std::string name_ = {};
  std::mt19937 random_{3};
  bool binary_ = false;
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

TEST(AtiSerial, BinaryRecordsBecomeNewtonsAndSlipsCostThemselvesOnly) {
  FakeController controller;
  AtiSerial sensor(controller.name(), nano25_options(), AtiRecords::kBinary);
  const auto near = [](const ForceSample& s) { return (s.force - Vec3(1, -2, 0)).norm() < 0.05; };  // it trembles
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).valid; }));
  EXPECT_TRUE(near(sensor.sample(Vec3::Zero())));
  controller.loses_bytes = true;
  ASSERT_TRUE(soon([&] {
    const ForceSample sample = sensor.sample(Vec3::Zero());
    EXPECT_TRUE(!sample.valid || near(sample)) << sample.force.transpose();
    return sensor.link().malformed >= 8;
  }));
  controller.loses_bytes = false;
  controller.noise = true;
  ASSERT_TRUE(soon([&] {
    const ForceSample sample = sensor.sample(Vec3::Zero());
    EXPECT_TRUE(!sample.valid || near(sample)) << sample.force.transpose();
    return sensor.link().malformed >= 14;
  }));
  controller.noise = false;
  ASSERT_TRUE(soon([&] { return sensor.sample(Vec3::Zero()).valid; }));
  controller.status = 2;
  ASSERT_TRUE(soon([&] { return !sensor.sample(Vec3::Zero()).valid; })) << "saturated";
  controller.status = 0;
  const auto begun = sensor.link().begun;
  controller.restart = true;
  ASSERT_TRUE(soon([&] { return sensor.link().begun > begun && sensor.sample(Vec3::Zero()).valid; }));
  EXPECT_TRUE(near(sensor.sample(Vec3::Zero())));
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
