// Latest and Ring: single steps in one thread, then two threads that hand over as fast as they can. The stress tests
// are most worth under ThreadSanitizer.
#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <string>
#include <thread>

#include "haptics/exchange/latest.h"
#include "haptics/exchange/ring.h"

namespace trocar::exchange_test {
namespace {

constexpr std::uint64_t kHandovers = 200'000;

/// 30 words that all say the same: a torn one shows.
struct Whole {
  std::array<std::uint64_t, 30> words{};
  static Whole of(std::uint64_t value) {
    Whole whole;
    whole.words.fill(value);
    return whole;
  }
  bool intact() const {
    return std::accumulate(words.begin(), words.end(), std::uint64_t{0}) == words[0] * words.size() &&
           words.front() == words.back();
  }
};

TEST(Latest, TheNewestWins) {
  Latest<int> latest(-1);
  EXPECT_FALSE(latest.fresh());
  EXPECT_EQ(latest.read(), -1);
  for (int value : {1, 2, 3}) latest.write(value);
  EXPECT_TRUE(latest.fresh());
  EXPECT_EQ(latest.read(), 3);
  EXPECT_FALSE(latest.fresh());
  EXPECT_EQ(latest.read(), 3) << "what was read stays";
}

TEST(Latest, WhatTheReaderHoldsDoesNotChangeUnderIt) {
  Latest<int> latest;
  latest.write(1);
  const int& held = latest.read();
  for (int value = 2; value < 10; ++value) {
    latest.write(value);
    EXPECT_EQ(held, 1);
  }
  EXPECT_EQ(latest.read(), 9);
}

TEST(Latest, AnUnpublishedValueIsNotSeen) {
  Latest<std::string> latest("old");
  latest.back() = "new";
  EXPECT_EQ(latest.read(), "old");
  latest.publish();
  EXPECT_EQ(latest.read(), "new");
}

TEST(Latest, SlotsDoNotShareACacheLine) {
  Latest<char> latest;
  const char* reader = &latest.read();
  const char* writer = &latest.back();
  EXPECT_GE(static_cast<std::size_t>(std::abs(reader - writer)), kCacheLine);
}

TEST(LatestStress, ValuesArriveWholeAndNeverGoBack) {
  Latest<Whole> latest;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kHandovers; ++i) latest.write(Whole::of(i));
  });
  std::uint64_t last = 0, seen = 0, torn = 0, backwards = 0;
  while (last < kHandovers) {
    const Whole& whole = latest.read();
    torn += whole.intact() ? 0 : 1;
    backwards += whole.words[0] < last ? 1 : 0;
    seen += whole.words[0] != last ? 1 : 0;
    last = whole.words[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backwards, 0u);
  EXPECT_GE(seen, 1u);
}

TEST(Ring, KeepsTheOrderAndLosesNothingUpToItsCapacity) {
  Ring<int, 4> ring;
  int value = 0;
  EXPECT_FALSE(ring.pop(value));
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.push(10 * round + i));
    for (int i = 0; i < 4; ++i) {
      ASSERT_TRUE(ring.pop(value));
      EXPECT_EQ(value, 10 * round + i);
    }
    EXPECT_FALSE(ring.pop(value));
  }
  EXPECT_EQ(ring.dropped(), 0u);
}

TEST(Ring, WhenFullTheNewValueIsDroppedAndCounted) {
  Ring<int, 2> ring;
  EXPECT_TRUE(ring.push(1));
  EXPECT_TRUE(ring.push(2));
  EXPECT_FALSE(ring.push(3));
  EXPECT_FALSE(ring.push(4));
  EXPECT_EQ(ring.dropped(), 2u);
  int value = 0;
  EXPECT_TRUE(ring.pop(value));
  EXPECT_EQ(value, 1) << "the old ones are not overwritten";
  EXPECT_TRUE(ring.push(5));
  EXPECT_TRUE(ring.pop(value));
  EXPECT_EQ(value, 2);
  EXPECT_TRUE(ring.pop(value));
  EXPECT_EQ(value, 5);
}

TEST(Ring, CarriesTextWithoutLeavingItBehind) {
  Ring<std::string, 2> ring;
  ring.push(std::string(100, 'x'));
  std::string text;
  ASSERT_TRUE(ring.pop(text));
  EXPECT_EQ(text, std::string(100, 'x'));
}

TEST(RingStress, EverythingArrivesOnceInOrderAndWhole) {
  Ring<Whole, 64> ring;
  std::thread producer([&] {
    for (std::uint64_t i = 1; i <= kHandovers; ++i) {
      while (!ring.push(Whole::of(i))) std::this_thread::yield();
    }
  });
  std::uint64_t wrong = 0;
  Whole whole;
  for (std::uint64_t expected = 1; expected <= kHandovers; ++expected) {
    while (!ring.pop(whole)) std::this_thread::yield();
    wrong += whole.words[0] == expected && whole.intact() ? 0 : 1;
  }
  producer.join();
  EXPECT_EQ(wrong, 0u);
}

TEST(RingStress, WhatIsMissingIsWhatWasCounted) {
  Ring<std::uint64_t, 16> ring;
  std::uint64_t refused = 0, counted = 0;
  std::thread producer([&] {
    for (std::uint64_t i = 1; i <= kHandovers; ++i) refused += ring.push(i) ? 0 : 1;
    counted = ring.dropped();
    while (!ring.push(0)) std::this_thread::yield();  // the end mark
  });
  std::uint64_t arrived = 0, backwards = 0, last = 0, value = 1;
  while (value != 0) {
    if (!ring.pop(value) || value == 0) continue;
    ++arrived;
    backwards += value <= last ? 1 : 0;
    last = value;
  }
  producer.join();
  EXPECT_EQ(backwards, 0u);
  EXPECT_EQ(arrived + refused, kHandovers);
  EXPECT_EQ(counted, refused);
}

}  // namespace
}  // namespace trocar::exchange_test
