// The driver of a Mesa card against a card that is not there: bytes, identity, and every trouble of link and card.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <random>
#include <thread>

#include "haptics/device/hostmot2/fake_hostmot2.h"
#include "haptics/device/hostmot2/hostmot2_daq.h"
#include "haptics/input_error.h"
#include "tests/support/daq_conformance.h"
#include "tests/support/repeats.h"

namespace trocar::hostmot2_test {
namespace {

using namespace hostmot2;

using test::period;

class Hostmot2 : public testing::Test {
 protected:
  Hostmot2Options options(double wait_s = 0.5) const {
    Hostmot2Options out;
    out.card = card_.address();
    out.wait_share = wait_s * out.rate_hz;
    return out;
  }
  SimulatedDaq device_{FakeHostmot2::device_config({})};
  FakeHostmot2 card_{device_, {}, standard_wiring()};
};

TEST(Lbp16, TheGoldenVectorOfTheReference) {
  lbp16::Datagram datagram;
  datagram.add(lbp16::Command{.count = 2, .address = 0x0104});
  ASSERT_EQ(datagram.size(), 4U);
  EXPECT_EQ(datagram.value32(0), 0x01044282U) << "82 42 04 01";
  const auto back = lbp16::command_at(datagram, 0);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, (lbp16::Command{.count = 2, .address = 0x0104}));
  EXPECT_FALSE(lbp16::command_at(datagram, 1)) << "cut off";
}

TEST(Lbp16, CodesAreSizeAndSign) {
  for (const std::int32_t code : {0, 1, -1, 4095, -4095}) EXPECT_EQ(code_of(pdm_of(code)), code);
  EXPECT_EQ(pdm_of(-4095), 0x8FFF0000U);
  EXPECT_EQ(code_of(pdm_of(70000)), 4095) << "kept at full scale";
}

TEST_F(Hostmot2, TheCardAnswersTheGoldenVectorByteForByte) {
  UdpLink link(card_.address(), "card");
  lbp16::Datagram datagram;
  datagram.add(0x01044282, 4);
  ASSERT_TRUE(link.send(datagram));
  ASSERT_TRUE(link.receive(datagram, 1));
  EXPECT_EQ(std::string(datagram.data(), datagram.data() + datagram.size()), "HOSTMOT2");
}

TEST_F(Hostmot2, WhoTheCardIsIsReadFromIt) {
  const Hostmot2Daq daq(options());
  EXPECT_EQ(daq.identity().board, "7I80HD");
  EXPECT_EQ(daq.identity().ports, 3);
  EXPECT_EQ(daq.identity().pins.size(), 72U);
  EXPECT_EQ(daq.identity().modules.size(), 4U);
  EXPECT_EQ(daq.capabilities().dac_bits, 13);
}

TEST_F(Hostmot2, AnotherCardIsRefusedWithTheReason) {
  const auto refusal = [this](const CardTroubles& troubles, const std::string& said) {
    FakeHostmot2 card(device_, {}, standard_wiring(), troubles);
    Hostmot2Options own = options();
    own.card = card.address();
    own.setup_wait_s = 0.02;
    try {
      const Hostmot2Daq daq(own);
      ADD_FAILURE() << "taken: " << said;
    } catch (const EnvironmentError& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(card.address()), std::string::npos) << error.what();
    }
  };
  refusal({.silent = true}, "no answer");
  refusal({.cookie = 0xDEADBEEF}, "no HostMot2 firmware");
  refusal({.name = "HOSTMOT3"}, "no HostMot2 firmware");
  refusal({.encoders = 6}, "has not 7 of quadrature counter");
  refusal({.outputs = 4}, "has not 7 of analogue output");
  Hostmot2Options far = options();
  far.wiring.inputs[0].pin = 90;
  EXPECT_THROW(Hostmot2Daq{far}, EnvironmentError);
  for (const char* wrong : {"", "card", "192.168.1.300", "127.0.0.1:", "127.0.0.1:x", "127.0.0.1:99999"}) {
    far.card = wrong;
    EXPECT_THROW(Hostmot2Daq{far}, InputError) << wrong;
  }
}

TEST_F(Hostmot2, CountsAreThoseOfTheDeviceItself) {
  SimulatedDaq alone(FakeHostmot2::device_config({}));
  Hostmot2Daq daq(options());
  std::array<std::int32_t, kChannels> own{}, others{};
  for (int k = 0; k < 3000; ++k) {
    const DaqSample a = alone.read(), b = daq.read();
    if (k == 0) own = b.counts, others = a.counts;
    for (std::size_t i = 0; i < kChannels; ++i) ASSERT_EQ(b.counts[i] - own[i], a.counts[i] - others[i]) << k;
    EXPECT_EQ(a.digital_in, b.digital_in) << k;
    EXPECT_EQ(b.elapsed_periods, 1U) << k;
    DacFrame frame;
    for (std::size_t i = 0; i < kChannels; ++i) frame.codes[i] = k % 200 < 100 ? 300 : -300;
    alone.arm(k > 10);
    alone.write(frame);
    daq.arm(k > 10);
    daq.write(frame);
    EXPECT_EQ(card_.amplifiers_enabled(), k > 11) << "an enable goes with the next datagram";
  }
}

TEST_F(Hostmot2, EdgesAreDatedByTheCard) {
  Hostmot2Daq daq(options());
  DaqSample before = period(daq, true);
  int moved = 0;
  for (int k = 0; k < 500; ++k) {
    const DaqSample now = period(daq, true, k > 100 ? 800 : 0);
    for (std::size_t i = 0; i < kChannels; ++i) {
      if (now.counts[i] == before.counts[i]) {
        EXPECT_TRUE(now.edge_age_us[i] == 65535 || now.edge_age_us[i] >= 999) << "at least this period ago";
      } else {
        ++moved;
        EXPECT_GE(now.edge_age_us[i], 1);
        EXPECT_LE(now.edge_age_us[i], 1001);
      }
    }
    before = now;
  }
  EXPECT_GT(moved, 100);
}

TEST_F(Hostmot2, OneLostAnswerIsOneStaleTickAndSeveralAreSilence) {
  Hostmot2Daq daq(options(0.1));
  for (int k = 0; k < 5; ++k) EXPECT_EQ(period(daq, false).elapsed_periods, 1U);
  card_.trouble({.loses_answers = 1});
  const DaqSample stale = period(daq, false);
  EXPECT_EQ(stale.elapsed_periods, 1U);
  EXPECT_TRUE(stale.digital_in & kHomeBeam) << "as it was";
  card_.trouble({});
  EXPECT_EQ(period(daq, false).elapsed_periods, 1U) << "two went by, of which the stale one stood for one";
  EXPECT_EQ(period(daq, false).elapsed_periods, 1U);
  card_.trouble({.silent = true});
  EXPECT_EQ(period(daq, false).elapsed_periods, 1U);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(period(daq, false).elapsed_periods, 0U) << "no news";
  card_.trouble({});
  EXPECT_EQ(period(daq, false).elapsed_periods, 1U) << "and it goes on: no question came, so no time went by";
  EXPECT_EQ(daq.link().lost, 5U);
}

TEST_F(Hostmot2, OlderRepeatedAndBrokenAnswersAreDropped) {
  Hostmot2Options patient = options(0.02);
  patient.lost_in_a_row = 5;
  Hostmot2Daq daq(patient);
  card_.trouble({.repeats = 0.5, .swaps = 0.2, .babbles = 0.3, .seed = 3});
  std::int32_t news = 0;
  for (int k = 0; k < 300; ++k) news += period(daq, false).elapsed_periods > 0 ? 1 : 0;
  EXPECT_EQ(news, 300) << "one swapped is lost, and the next one comes";
  EXPECT_GT(daq.link().stale, 50U);
  EXPECT_GT(daq.link().malformed, 50U);
  card_.trouble({});
  for (int k = 0; k < 3; ++k) period(daq, false);
  const auto stale = daq.link().stale;
  for (int k = 0; k < 20; ++k) EXPECT_EQ(period(daq, false).elapsed_periods, 1U);
  EXPECT_EQ(daq.link().stale, stale) << "nothing is left behind";
}

TEST_F(Hostmot2, ACardWhoseTimeStandsStillIsNoNews) {
  Hostmot2Daq daq(options());
  for (int k = 0; k < 3; ++k) period(daq, false);
  card_.trouble({.frozen = true});
  for (int k = 0; k < 3; ++k) EXPECT_EQ(period(daq, false).elapsed_periods, 0U);
  card_.trouble({});
  EXPECT_EQ(period(daq, false).elapsed_periods, 4U);
}

TEST_F(Hostmot2, AQuestionThatComesLateIsThatPeriods) {
  Hostmot2Daq daq(options());
  for (int k = 0; k < 5; ++k) EXPECT_EQ(period(daq, false).elapsed_periods, 1U);
  // A loop never catches up: after a wait that ended late the next one ends on the grid, sooner on the card's clock.
  for (const double late_s : {0.0003, 0.00055, 0.0009}) {
    card_.trouble({.shift_s = late_s});
    EXPECT_EQ(period(daq, false).elapsed_periods, 1U) << late_s;
    card_.trouble({});
    EXPECT_EQ(period(daq, false).elapsed_periods, 1U) << late_s << ", the one behind it";
  }
  card_.miss_sync();  // 1.6 periods late: one of the grid is left out
  card_.trouble({.shift_s = 0.0006});
  EXPECT_EQ(period(daq, false).elapsed_periods, 2U);
  card_.trouble({});
  EXPECT_EQ(period(daq, false).elapsed_periods, 1U);
}

TEST_F(Hostmot2, PeriodsAddUpToTheCardsTimeWhateverTheLoopsPaceAndTheLink) {
  Hostmot2Daq daq(options(0.02));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> late(0, 0.0009);
  period(daq, false);
  const double begun_s = card_.time_s();
  std::uint64_t periods = 0;
  for (int k = 0; k < 3000; ++k) {
    card_.trouble({.loses_answers = k % 40 == 20 ? 1.0 : 0.0, .shift_s = k % 3 == 0 ? late(random) : 5e-5});
    if (k % 250 == 100) card_.miss_sync();
    const DaqSample sample = period(daq, false);
    ASSERT_GT(sample.elapsed_periods, 0U) << k;
    periods += sample.elapsed_periods;
  }
  card_.trouble({});
  periods += period(daq, false).elapsed_periods;
  EXPECT_NEAR(static_cast<double>(periods), 1000 * (card_.time_s() - begun_s), 1);
}

TEST_F(Hostmot2, OneProgramHasTheCardAndAnotherOnTheLinkIsFoundOut) {
  auto daq = std::make_unique<Hostmot2Daq>(options());
  EXPECT_THROW(Hostmot2Daq{options()}, EnvironmentError);
  for (int k = 0; k < 5; ++k) EXPECT_EQ(period(*daq, true, 100).digital_in & kDacMismatch, 0U);
  lbp16::Datagram others;  // of another computer, which no claim here keeps away
  add_counter(others, 77);
  add_counter_read(others);
  UdpLink link(card_.address(), "card");
  ASSERT_TRUE(link.send(others));
  ASSERT_TRUE(link.receive(others, 1));
  EXPECT_TRUE(period(*daq, true, 100).digital_in & kDacMismatch);
  EXPECT_EQ(daq->link().foreign, 1U);
  daq.reset();
  const Hostmot2Daq next(options());
  EXPECT_EQ(next.link().foreign, 0U);
}

TEST_F(Hostmot2, AQuadratureErrorIsThatChannelsAndThatRead) {
  Hostmot2Daq daq(options());
  period(daq, false);
  card_.trouble({.quadrature_errors = 1 << 2 | 1 << 6});
  EXPECT_EQ(period(daq, false).valid, 0x7F & ~(1 << 2 | 1 << 6));
  EXPECT_EQ(period(daq, false).valid, 0x7F);
}

TEST_F(Hostmot2, WithoutWritesTheWatchdogBitesUntilDisarmed) {
  Hostmot2Daq daq(options());
  for (int k = 0; k < 30; ++k) period(daq, true, 500);
  EXPECT_TRUE(card_.amplifiers_enabled());
  EXPECT_EQ(card_.codes_in_force()[0], 500);
  int k = 0;
  while (!(daq.read().digital_in & kWatchdogFired) && k < 100) ++k;
  EXPECT_GE(k, 14);
  EXPECT_LE(k, 18);
  EXPECT_FALSE(card_.amplifiers_enabled()) << "pins that are inputs inhibit";
  for (int n = 0; n < 5; ++n)
    EXPECT_TRUE(period(daq, true, 500).digital_in & kWatchdogFired) << "a write is no way out";
  EXPECT_FALSE(card_.amplifiers_enabled());
  EXPECT_EQ(card_.codes_in_force()[0], 0);
  period(daq, false);
  for (int n = 0; n < 5; ++n) EXPECT_FALSE(period(daq, true, 500).digital_in & kWatchdogFired);
  EXPECT_TRUE(card_.amplifiers_enabled());
  EXPECT_EQ(daq.link().bites, 1U);
}

TEST_F(Hostmot2, AProgramThatDiesIsSwitchedOffByTheCard) {
  auto daq = std::make_unique<Hostmot2Daq>(options());
  for (int k = 0; k < 5; ++k) period(*daq, true, 500);
  card_.trouble({.loses_questions = 1});  // what it says last does not arrive either
  daq.reset();
  card_.trouble({});
  EXPECT_TRUE(card_.amplifiers_enabled());
  for (int k = 0; k < 20; ++k) card_.miss_sync();
  EXPECT_FALSE(card_.amplifiers_enabled());
}

TEST_F(Hostmot2, DisarmingActsAtOnceAndClosingToo) {
  auto daq = std::make_unique<Hostmot2Daq>(options());
  const auto enabled_soon = [this](bool wanted) {
    for (int k = 0; k < 200 && card_.amplifiers_enabled() != wanted; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return card_.amplifiers_enabled() == wanted;
  };
  for (int k = 0; k < 5; ++k) period(*daq, true, 500);
  daq->arm(false);
  EXPECT_TRUE(enabled_soon(false)) << "without another read";
  for (int k = 0; k < 5; ++k) period(*daq, true, 500);
  EXPECT_TRUE(card_.amplifiers_enabled());
  daq.reset();
  EXPECT_TRUE(enabled_soon(false));
  Hostmot2Daq again(options());
  EXPECT_EQ(period(again, false).elapsed_periods, 1U) << "opened anew";
}

TEST_F(Hostmot2, ACardThatLostItsPowerGivesNoTorqueAndIsFoundOut) {
  Hostmot2Daq daq(options());
  for (int k = 0; k < 5; ++k) period(daq, true, 500);
  card_.power_cycle();
  EXPECT_FALSE(card_.amplifiers_enabled());
  for (int k = 0; k < 40; ++k) EXPECT_TRUE(period(daq, true, 500).digital_in & kWatchdogFired);
  EXPECT_FALSE(card_.amplifiers_enabled()) << "its pins are inputs until somebody sets them up";
  period(daq, false);
  for (int k = 0; k < 5; ++k) period(daq, true, 500);
  EXPECT_TRUE(card_.amplifiers_enabled());
  EXPECT_EQ(card_.codes_in_force()[0], 500) << "outputs and counters are set up too";
}

/// A card on a noisy line that makes up what it says: before each answer a datagram of random bytes, and the data of
/// the answer itself random; while a stranger throws random datagrams at the card.
TEST_F(Hostmot2, AMillionRandomDatagramsBreakNeitherCardNorDriver) {
  const int frames = test::repeats("PEER_FRAMES", 5000);
  Hostmot2Daq daq(options(0.05));
  UdpLink stranger(card_.address(), "card");
  std::mt19937_64 random(1);
  lbp16::Datagram noise;
  const auto throw_noise = [&] {
    noise.clear();
    const std::size_t bytes = random() % 200;
    while (noise.size() < bytes) noise.add(random(), 1);
    stranger.send(noise);
  };
  card_.trouble({.babbles = 1, .lies = true, .seed = 9});
  const test::AllocationGuard guard;
  for (int k = 0; k < frames; ++k) {
    if (k % 64 == 0) throw_noise();
    const DaqSample sample = period(daq, k % 3 != 0, 4000);
    ASSERT_EQ(sample.valid & ~0x7F, 0);
    ASSERT_LE(sample.elapsed_periods, 66U) << "no more than the card's clock can say";
  }
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_GT(daq.link().malformed, static_cast<std::uint64_t>(frames) / 2);
  for (int k = 0; k < 1000; ++k) throw_noise();
  card_.trouble({});
  card_.power_cycle();
  period(daq, false);
  for (int k = 0; k < 30; ++k) period(daq, false);
  for (int k = 0; k < 20; ++k) {
    const DaqSample sample = period(daq, false);
    EXPECT_EQ(sample.elapsed_periods, 1U) << "and it goes on";
    EXPECT_EQ(sample.valid, 0x7F);
  }
}

}  // namespace
}  // namespace trocar::hostmot2_test
