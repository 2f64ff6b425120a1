// A grip's spring that changes from patch to patch: the force goes over and never beyond what either patch asks for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>

#include "haptics/contact/contact_renderer.h"
#include "tests/haptics/contact/surfaces.h"

namespace trocar::gliding_hold_test {
namespace {

constexpr double kGlide_s = 0.010;
constexpr int kPeriods = 10;

/// Jaws that stand still at the origin, a patch every 10 ms.
class Held {
 public:
  /// @return the largest force of the next 10 ms, N. @param force_T that the new patch has on the tool, N
  double most(const Vec3& force_T, double stiffness_n_per_m) {
    patch_->stamp++;
    patch_->glide_s = kGlide_s;
    patch_->hold = {Vec3(0, 0, -0.005), X_TI_ * Vec3(0, 0, -0.005) + force_T / stiffness_n_per_m, stiffness_n_per_m};
    double most = 0;
    for (int i = 0; i < kPeriods; ++i) {
      last_T = renderer_.update(X_TI_, {}, *patch_).F_I_T.force;
      most = std::max(most, last_T.norm());
    }
    return most;
  }
  Vec3 last_T = Vec3::Zero();

 private:
  Pose X_TI_ = test::tip_down(Vec3(0.01, -0.02, 0.03));
  std::unique_ptr<ContactPatch> patch_ = std::make_unique<ContactPatch>();
  ContactRenderer renderer_{ContactLaw::kProxy};
};

TEST(GlidingHold, ASpringThatGrowsSoftDoesNotKick) {
  // Of a slack duct whose pull turns: nearly no force, and soft across it.
  for (const double soft : {1.0, 10.0, 100.0}) {
    Held held;
    const Vec3 first(0.03, 0.02, 0), second(-0.02, 0.04, 0.01);
    held.most(first, 216);
    EXPECT_NEAR((held.last_T - first).norm(), 0, 1e-9);
    EXPECT_LE(held.most(second, soft), std::max(first.norm(), second.norm()) + 1e-9) << soft;
    EXPECT_LE(held.most(first, 216), std::max(first.norm(), second.norm()) + 1e-9) << soft;
  }
}

TEST(GlidingHold, TheForceArrives) {
  Held held;
  const Vec3 first(0.3, 0, 0.2), second(0, -0.4, 0.1);
  held.most(first, 250);
  held.most(second, 40);
  held.most(second, 40);
  EXPECT_NEAR((held.last_T - second).norm(), 0, 1e-6);
}

TEST(GlidingHold, ComesAndGoesWithoutALeap) {
  Held held;
  const Vec3 force(0.5, 0, 0);
  EXPECT_LE(held.most(force, 200), force.norm() + 1e-9);
  EXPECT_LE(held.most(Vec3::Zero(), 1e-9), force.norm() + 1e-9);
}

/// Tissue that is pressed and, taken by the jaws, no contact in the next patch.
TEST(GlidingHold, APressedPlaceThatIsNoContactAnyMoreIsLetGoSlowlyAndGivesNoEnergy) {
  const ToolShape tool;
  const auto patch = std::make_unique<ContactPatch>();
  test::flat_patch(*patch, 0, 0.04, 6);
  patch->material[0] = {200, 0, 0, 0};
  patch->glide_s = kGlide_s;
  patch->moving = true;
  patch->velocity.fill(Vec3::Zero());
  // Up with the force, as fast as a hand that is pushed away.
  for (const double speed : {0.0, 0.02, 1.0}) {
    ContactRenderer renderer{ContactLaw::kProxy, tool};
    Vec3 tip(0, 0, tool.radius_m + 0.001);
    ContactResult last;
    const auto period = [&](double z) {
      tip.z() = z;
      return renderer.update(test::tip_down(tip), {}, *patch);
    };
    const std::int32_t count = patch->count;
    for (int i = 0; i < 100; ++i) {
      if (i % kPeriods == 0) ++patch->stamp;
      last = period(tool.radius_m + 0.001 - 0.00004 * i);
    }
    EXPECT_GT(last.F_I_T.force.z(), 0.5);
    const double stored = last.stored_j;
    ++patch->stamp;
    patch->count = 0;
    double work = 0, most_drop = 0;
    for (int i = 0; i < 60; ++i) {
      const double before = last.F_I_T.force.z(), z = tip.z() + speed * 1e-3;
      last = period(z);
      work += last.F_I_T.force.z() * speed * 1e-3;
      most_drop = std::max(most_drop, before - last.F_I_T.force.z());
      if (i % kPeriods == kPeriods - 1) ++patch->stamp;
    }
    EXPECT_LE(work, stored) << speed;
    EXPECT_EQ(last.F_I_T.force, Vec3::Zero()) << speed;
    if (speed < 0.1) {
      EXPECT_LT(most_drop, 0.03) << speed << ": it was all of it in one period";
    }
    patch->count = count;
    ++patch->stamp;
  }
}

/// Tissue that is suddenly 2 mm higher, or gone: what is felt follows within 0.3 N a period, and a hand that goes with
/// it gets no more than was stored.
TEST(GlidingContact, TissueThatLeapsIsNoBlow) {
  const ToolShape tool;
  const auto patch = std::make_unique<ContactPatch>();
  const auto lay = [&](double z) {
    const std::uint64_t stamp = patch->stamp;
    test::flat_patch(*patch, z, 0.04, 6);
    patch->material[0] = {2000, 0, 0, 0};
    patch->glide_s = kGlide_s;
    patch->moving = true;
    patch->velocity.fill(Vec3::Zero());
    patch->stamp = stamp + 1;
    patch->topology++;
  };
  for (const double speed : {0.0, 0.3}) {
    ContactRenderer renderer{ContactLaw::kProxy, tool};
    Vec3 tip(0, 0, tool.radius_m);
    ContactResult last;
    double most_change = 0, work = 0;
    const auto run = [&](int periods, double way) {
      for (int i = 0; i < periods; ++i) {
        const Vec3 before = last.F_I_T.force;
        tip.z() += way;
        last = renderer.update(test::tip_down(tip), {}, *patch);
        most_change = std::max(most_change, (last.F_I_T.force - before).norm());
        work += last.F_I_T.force.z() * way;
      }
    };
    lay(0);
    run(20, 0);
    lay(0.002);
    run(40, 0);
    EXPECT_NEAR(last.F_I_T.force.z(), 4, 0.2);
    EXPECT_LE(most_change, 0.3 + 1e-9);
    const double stored = last.stored_j;
    most_change = work = 0;
    lay(-0.050);
    run(40, speed * 1e-3);
    EXPECT_LE(work, stored + 1e-9) << speed;
    EXPECT_EQ(last.F_I_T.force, Vec3::Zero()) << speed;
    if (speed == 0) {
      EXPECT_LE(most_change, 0.3 + 1e-9);
    }
  }
}

}  // namespace
}  // namespace trocar::gliding_hold_test
