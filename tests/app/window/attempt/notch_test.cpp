// The notch of thesis figure 3.40: its shape, and what a hand feels at its walls through the whole loop, in simulated
// time.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <thread>

#include "app/window/attempt/notch_run.h"

namespace trocar::notch_test {
namespace {

AssetRoots source_assets() {
  const std::filesystem::path root = TROCAR_SOURCE_DIR;
  return {root / "scenarios" / "exercises", root / "scenarios" / "hands", root / "assets"};
}

/// Goes to the middle, then to a place, and stays.
class GoAndStay final : public Hand {
 public:
  explicit GoAndStay(const Vec3& to_T) : to_T_(to_T) {}
  HandIntent update(const Percept& percept, double dt_s) override {
    if (!held_) {
      intent_.X_TI = {percept.R_TI, percept.tip_T};
      intent_.jaw_opening_m = percept.jaw_opening_m;
      held_ = true;
    }
    if (!percept.device_ready) return intent_;
    t_s_ += dt_s;
    const Vec3 goal = t_s_ < 1.2 ? Vec3(Vec3::Zero()) : to_T_;
    const Vec3 way = goal - intent_.X_TI.p;
    const double most = 0.1 * dt_s;
    intent_.X_TI.p += way.norm() > most ? Vec3(most / way.norm() * way) : way;
    return intent_;
  }

 private:
  Vec3 to_T_;
  HandIntent intent_;
  bool held_ = false;
  double t_s_ = 0;
};

struct Felt {
  RunMoment last;
  double most_n = 0;
  bool faulted = false;
};

Felt press(const Vec3& to_T, double stiffness) {
  const Scene scene = notch_scene(source_assets(), 1);
  Felt felt;
  run_notch(scene, stiffness, std::make_unique<GoAndStay>(to_T), 5.0, [&](const RunMoment& m) {
    felt.last = m;
    felt.most_n = std::max(felt.most_n, m.record.stylus.F_I_T.force.norm());
    felt.faulted = felt.faulted || m.record.stylus.fault;
  });
  return felt;
}

TEST(NotchShape, IsClosedAndHoldsTheVolumeOfItsThreeWalls) {
  const Notch n;
  const TriangleSurface s = notch_surface(n);
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : s.triangles)
    for (int i = 0; i < 3; ++i) ++edges[{t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>((i + 1) % 3)]}];
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "every edge has its opposite: the surface is closed";
  }
  const double outer = 2 * (n.half_width_m + n.thickness_m) * (n.front_m + n.back_m + n.thickness_m);
  const double slot = 2 * n.half_width_m * (n.front_m + n.back_m);
  EXPECT_NEAR(s.volume_m3(), (outer - slot) * 2 * n.half_height_m, 1e-12)
      << "outward triangles, and no more than the walls";
}

TEST(NotchShape, WallsAreNamedByTheirInnerNormals) {
  EXPECT_EQ(notch_wall(Vec3::UnitX()), NotchWall::kLeft) << "the left wall pushes to the right";
  EXPECT_EQ(notch_wall(-Vec3::UnitX()), NotchWall::kRight);
  EXPECT_EQ(notch_wall(-Vec3::UnitY()), NotchWall::kBack);
  EXPECT_EQ(notch_wall(Vec3::UnitY()), NotchWall::kNone);
  EXPECT_EQ(notch_wall(Vec3(0.7, 0.7, 0).normalized()), NotchWall::kNone) << "an edge";
}

TEST(NotchShape, TheHandCannotBeLedThroughAWall) {
  const Notch n;
  const double radius = 0.0025;
  EXPECT_LT(n.reach_m - (n.half_width_m - radius), kPatchRadius) << "the wall stays within the patch";
  EXPECT_LT(n.reach_m - n.half_width_m, n.thickness_m);
}

TEST(NotchFelt, NothingIsFeltInTheMiddle) {
  const Felt felt = press(Vec3::Zero(), kThesisWall_n_per_m);
  ASSERT_FALSE(felt.faulted);
  EXPECT_EQ(felt.last.status.phase, Phase::kRun) << "the walls are there";
  EXPECT_LT(felt.last.record.stylus.X_TI.p.norm(), 0.006);
  EXPECT_EQ(felt.most_n, 0);
}

struct WallCase {
  const char* name;
  Vec3 to_T, pushes_T;
  NotchWall wall;
};

void PrintTo(const WallCase& c, std::ostream* out) { *out << c.name; }

class NotchWalls : public ::testing::TestWithParam<WallCase> {};

TEST_P(NotchWalls, PushBackAtRightAnglesWithTheirStiffnessTimesTheDepth) {
  const WallCase& c = GetParam();
  for (const double stiffness : {kThesisWall_n_per_m, kFirmWall_n_per_m}) {
    const Felt felt = press(c.to_T, stiffness);
    ASSERT_FALSE(felt.faulted) << stiffness;
    const StylusState& s = felt.last.record.stylus;
    ASSERT_TRUE(s.contact) << stiffness;
    EXPECT_EQ(notch_wall(s.contact_normal_T), c.wall);
    const Notch n;
    const double reached = -s.X_TI.p.dot(c.pushes_T),
                 depth = reached - ((c.wall == NotchWall::kBack ? n.back_m : n.half_width_m) - 0.0025);
    EXPECT_GT(depth, 0.002) << stiffness;
    EXPECT_NEAR(s.depth_m, depth, 0.3e-3) << "the tip's sphere beyond the wall";
    const Vec3 force = s.F_I_T.force;
    EXPECT_NEAR(force.norm(), stiffness * depth, 0.15 * stiffness * depth)
        << stiffness << " N/m at " << 1e3 * depth << " mm";
    EXPECT_GT(force.normalized().dot(c.pushes_T), std::cos(8 * M_PI / 180))
        << "out of the wall, at right angles but for friction";
  }
}

INSTANTIATE_TEST_SUITE_P(All, NotchWalls,
                         ::testing::Values(WallCase{"left", {-0.030, 0, 0}, Vec3::UnitX(), NotchWall::kLeft},
                                           WallCase{"right", {0.030, 0, 0}, -Vec3::UnitX(), NotchWall::kRight},
                                           WallCase{"back", {0, 0.030, 0}, -Vec3::UnitY(), NotchWall::kBack}));

TEST(NotchFelt, FrontIsOpen) {
  const Felt felt = press({0, -0.030, 0}, kFirmWall_n_per_m);
  ASSERT_FALSE(felt.faulted);
  EXPECT_EQ(felt.most_n, 0);
  EXPECT_LT(felt.last.record.stylus.X_TI.p.y(), -0.024);
}

TEST(NotchFelt, AStifferWallLetsTheSameHandInLess) {
  const Felt soft = press({-0.030, 0, 0}, kThesisWall_n_per_m), firm = press({-0.030, 0, 0}, kFirmWall_n_per_m);
  EXPECT_GT(soft.last.record.stylus.depth_m, 1.2 * firm.last.record.stylus.depth_m);
  EXPECT_GT(firm.last.record.stylus.F_I_T.force.norm(), soft.last.record.stylus.F_I_T.force.norm());
}

TEST(NotchRunLive, BeginsBecomesReadyAndEndsWhenLeft) {
  NotchRun run(source_assets(), 1);
  EXPECT_EQ(run.stiffness(), kThesisWall_n_per_m);
  for (int i = 0; i < 2000 && !run.ready() && !run.finished(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(run.ready()) << run.fault();
  HandIntent intent;
  intent.X_TI = run.newest().record.stylus.X_TI;
  intent.X_TI.p.setZero();
  for (int i = 0; i < 1000 && run.newest().status.phase != Phase::kRun && !run.finished(); ++i) {
    run.steer(intent);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(run.newest().status.phase, Phase::kRun) << run.fault();
  run.set_stiffness(kFirmWall_n_per_m);
  EXPECT_EQ(run.stiffness(), kFirmWall_n_per_m);
}

}  // namespace
}  // namespace trocar::notch_test
