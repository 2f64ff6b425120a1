// Moments in little room: to the bit, found by time, bounded.
#include "app/session/playback/moment_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace trocar::moment_store_test {
namespace {

RunMoment moment_at(double t_s) {
  RunMoment m;
  m.t_s = t_s;
  m.seen = true;
  m.record.stylus.t_s = t_s;
  m.record.q[2] = std::sin(t_s);
  m.status.run_time_s = t_s;
  m.status.message = "at " + std::to_string(t_s);
  m.status.done.set(3);
  return m;
}

/// Three objects and a pair, every number another.
RunMoment crowded(double t_s) {
  RunMoment m = moment_at(t_s);
  TissueFrame& f = m.tissue;
  f.stamp = 77;
  f.t_s = t_s - 0.01;
  f.object_count = 3;
  for (int i = 0; i < 3; ++i) {
    ObjectState& o = f.object[static_cast<std::size_t>(i)];
    o.X_TO.p = Vec3(0.1 * i, -0.2, std::sqrt(2.0 + i));
    o.X_TO.R = Eigen::AngleAxisd(0.3 * i, Vec3::UnitX()).toRotationMatrix();
    o.size_m = Vec3(0.01, 0.02, 0.03 + i);
    o.kind = i;
    o.motion = ObjectMotion::kHeld;
    o.crushed = i == 2;
  }
  f.grip = GripState::kSlipping;
  f.grip_object = 1;
  f.slipped_m = 1e-3;
  f.pair_count = 1;
  f.pair[0].a = kPartyJaw;
  f.pair[0].b = 2;
  f.pair[0].force_n = 0.125;
  return m;
}

TEST(MomentStore, GivesBackEveryBitOfAMoment) {
  MomentStore store;
  const RunMoment in = crowded(3.25);
  store.add(in);
  const RunMoment out = store.at(3.25);
  EXPECT_TRUE(out.seen);
  EXPECT_EQ(out.record.q, in.record.q);
  EXPECT_EQ(out.status.message, in.status.message);
  EXPECT_EQ(out.status.done, in.status.done);
  EXPECT_EQ(out.tissue.stamp, 77u);
  EXPECT_EQ(out.tissue.t_s, in.tissue.t_s);
  EXPECT_EQ(out.tissue.object_count, 3);
  for (std::size_t i = 0; i < kMaxObjects; ++i) {
    const ObjectState &a = in.tissue.object[i], &b = out.tissue.object[i];
    EXPECT_EQ(a.X_TO.p, b.X_TO.p);
    EXPECT_EQ(a.X_TO.R, b.X_TO.R);
    EXPECT_EQ(a.size_m, b.size_m);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.motion, b.motion);
    EXPECT_EQ(a.crushed, b.crushed);
  }
  EXPECT_EQ(out.tissue.grip, GripState::kSlipping);
  EXPECT_EQ(out.tissue.grip_object, 1);
  EXPECT_EQ(out.tissue.slipped_m, 1e-3);
  EXPECT_EQ(out.tissue.pair_count, 1);
  EXPECT_EQ(out.tissue.pair[0].a, std::int32_t{kPartyJaw});
  EXPECT_EQ(out.tissue.pair[0].force_n, 0.125);
  EXPECT_EQ(out.tissue.pair[1].b, 0);
}

TEST(MomentStore, FindsTheMomentAtOrBeforeATime) {
  MomentStore store;
  EXPECT_THROW(store.at(0), std::out_of_range);
  EXPECT_EQ(store.first_s(), 0);
  for (int i = 5; i <= 20; ++i) store.add(moment_at(0.01 * i));
  EXPECT_EQ(store.size(), 16u);
  EXPECT_EQ(store.at(0.10).t_s, 0.01 * 10);
  EXPECT_EQ(store.at(0.109).t_s, 0.01 * 10);
  EXPECT_EQ(store.at(9).t_s, 0.01 * 20);
  EXPECT_EQ(store.at(-1).t_s, 0.01 * 5) << "before the first: the first";
  EXPECT_EQ(store.first_s(), 0.01 * 5);
  EXPECT_EQ(store.last_s(), 0.01 * 20);
}

TEST(MomentStore, IsThinnedEvenlyInsteadOfGrowing) {
  MomentStore store(100);
  for (int i = 0; i < 3000; ++i) store.add(moment_at(0.01 * i));
  EXPECT_LE(store.size(), 100u);
  EXPECT_GE(store.size(), 45u);
  EXPECT_EQ(store.last_s(), 0.01 * 2999) << "how far it is known is not forgotten";
  double widest = 0;
  for (double t = 0; t < 29; t += 0.07) widest = std::max(widest, t - store.at(t).t_s);
  EXPECT_LT(widest, 0.7) << "30 s in some 50 moments, evenly";
  EXPECT_EQ(store.at(0).t_s, 0);
}

TEST(MomentStore, FiveMinutesTakeLessThanAHundredMegabytes) {
  MomentStore plain, full;
  for (int i = 0; i < 1000; ++i) {
    plain.add(moment_at(0.01 * i));
    full.add(crowded(0.01 * i));
  }
  EXPECT_LT(30 * plain.bytes(), std::size_t{60'000'000});
  EXPECT_LT(30 * full.bytes(), std::size_t{100'000'000});
  EXPECT_GT(full.bytes(), plain.bytes());
}

}  // namespace
}  // namespace trocar::moment_store_test
