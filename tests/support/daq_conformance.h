// What every DataAcquisition back-end owes the controller, as checks to call from a test of that back-end.
//
// A back-end is described by DaqUnderTest; hooks it cannot offer stay empty and the checks that need them must not be
// called for it (each check says what it needs and fails loudly when it is missing).
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>

#include "haptics/device/data_acquisition.h"
#include "tests/support/allocation_guard.h"

namespace trocar::test {

struct DaqUnderTest {
  DataAcquisition& daq;
  std::function<void()> before_read;            ///< whatever must happen before each read (a hand's intent)
  std::function<ChannelVector()> true_outputs;  ///< true joint angles and jaw opening, when known
  std::function<ChannelVector()> motor_loads;   ///< loads that the motors deliver now, when known
};

inline DaqSample read_once(const DaqUnderTest& t) {
  if (t.before_read) t.before_read();
  return t.daq.read();
}

/// A period as the haptic task has it, with one code on all channels.
inline DaqSample period(DataAcquisition& daq, bool armed, std::int32_t code = 0) {
  const DaqSample sample = daq.read();
  daq.arm(armed);
  DacFrame frame;
  frame.codes.fill(code);
  daq.write(frame);
  return sample;
}

/// Counter difference that is right across the 32-bit wrap.
inline std::int32_t count_difference(std::int32_t now, std::int32_t before) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(now) - static_cast<std::uint32_t>(before));
}

inline void expect_sane_capabilities(const DaqUnderTest& t) {
  const DaqCapabilities c = t.daq.capabilities();
  EXPECT_NE(c.name, nullptr);
  EXPECT_GT(std::strlen(c.name), 0u);
  EXPECT_GE(c.rate_hz, 100.0);
  EXPECT_LE(c.rate_hz, 10000.0);
  EXPECT_GE(c.dac_bits, 8);
  EXPECT_LE(c.dac_bits, 24);
}

/// Samples are well formed and no counter moves further in a period than a motor can turn.
inline void expect_well_formed_samples(const DaqUnderTest& t, int periods, std::int32_t largest_step) {
  DaqSample before = read_once(t);
  for (int k = 0; k < periods; ++k) {
    const DaqSample now = read_once(t);
    ASSERT_GE(now.elapsed_periods, 1u) << "read " << k;
    ASSERT_EQ(now.valid & ~0x7Fu, 0u) << "read " << k << ": bit of a channel that does not exist";
    for (int i = 0; i < kChannels; ++i) {
      const std::int64_t step = count_difference(now.counts[i], before.counts[i]);
      ASSERT_LE(std::llabs(step), std::int64_t{largest_step} * now.elapsed_periods) << "read " << k << " channel " << i;
    }
    before = now;
  }
}

/// Needs true_outputs. Every counter rises and falls with its output, to the count.
inline void expect_counts_follow_motion(const DaqUnderTest& t, int periods, const ChannelVector& counts_per_output) {
  ASSERT_TRUE(t.true_outputs) << "back-end does not tell its true outputs";
  const DaqSample first = read_once(t);
  const ChannelVector start = t.true_outputs();
  ChannelVector farthest = ChannelVector::Zero();
  for (int k = 0; k < periods; ++k) {
    const DaqSample now = read_once(t);
    const ChannelVector moved = (t.true_outputs() - start).cwiseProduct(counts_per_output);
    for (int i = 0; i < kChannels; ++i) {
      // Two floor operations at unknown phase: the difference is exact to less than one count.
      ASSERT_LT(std::abs(count_difference(now.counts[i], first.counts[i]) - moved[i]), 1.0) << "channel " << i;
    }
    farthest = farthest.cwiseMax(moved.cwiseAbs());
  }
  for (int i = 0; i < kChannels; ++i) EXPECT_GT(farthest[i], 5.0) << "channel " << i << " did not move: nothing shown";
}

/// Needs motor_loads; amplifiers must be armed. One write changes all channels at the same SYNC, none before it.
inline void expect_atomic_write(const DaqUnderTest& t, std::int32_t code) {
  ASSERT_TRUE(t.motor_loads) << "back-end does not tell its motor loads";
  t.daq.write({});
  for (int k = 0; k < 4; ++k) read_once(t);
  const ChannelVector rest = t.motor_loads();
  DacFrame frame;
  frame.codes.fill(code);
  t.daq.write(frame);
  EXPECT_EQ(t.motor_loads(), rest) << "codes act before the SYNC";
  std::array<int, kChannels> changed_at{};
  for (int k = 1; k <= 4; ++k) {
    read_once(t);
    const ChannelVector loads = t.motor_loads();
    for (int i = 0; i < kChannels; ++i) {
      const double due = std::abs(loads[i] - rest[i]);
      if (changed_at[i] == 0 && due > 1e-3) changed_at[i] = k;
    }
  }
  for (int i = 0; i < kChannels; ++i) EXPECT_EQ(changed_at[i], 2) << "channel " << i << " read in which it first acted";
  t.daq.write({});
}

/// Needs motor_loads. arm(false) removes all torque at once, and codes do nothing until arm(true).
inline void expect_disarm_removes_torque(const DaqUnderTest& t, std::int32_t code) {
  ASSERT_TRUE(t.motor_loads) << "back-end does not tell its motor loads";
  DacFrame frame;
  frame.codes.fill(code);
  t.daq.arm(true);
  t.daq.write(frame);
  for (int k = 0; k < 5; ++k) read_once(t);
  EXPECT_GT(t.motor_loads().cwiseAbs().minCoeff(), 1e-3) << "armed amplifiers deliver nothing";
  t.daq.arm(false);
  EXPECT_EQ(t.motor_loads(), ChannelVector(ChannelVector::Zero()));
  t.daq.write(frame);
  for (int k = 0; k < 5; ++k) {
    read_once(t);
    EXPECT_EQ(t.motor_loads(), ChannelVector(ChannelVector::Zero())) << "inhibited amplifiers follow the codes";
  }
}

/// read, write and arm stay off the heap.
inline void expect_no_allocation(const DaqUnderTest& t, int periods) {
  DacFrame frame;
  std::uint64_t allocations = 0;
  for (int k = 0; k < periods; ++k) {
    if (t.before_read) t.before_read();
    const AllocationGuard guard;
    const DaqSample sample = t.daq.read();
    frame.codes[0] = sample.counts[0] & 0xFF;
    t.daq.write(frame);
    t.daq.arm(k % 50 != 49);
    allocations += guard.allocations();
  }
  EXPECT_EQ(allocations, 0u);
}

}  // namespace trocar::test
