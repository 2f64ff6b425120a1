// Gauze in a frame over an organ: it is taut, is cut by the tips of scissors that press on it, and told where.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/tissue/solid/soft_organ_rig.h"
#include "tissue/thin/sheet_system.h"
#include "tissue/tissue_world.h"

namespace trocar::gauze_frame_test {
namespace {

constexpr double kHigh = 0.07, kSide = 0.060, kEdge = 0.005;  // m

/// 60 by 60 mm, level, over the pole of an ellipsoid; all of its rim is held. The x of T is the way of the blades.
class Gauze {
 public:
  Gauze() : rest_(test::ellipsoid({0.06, 0.05, 0.035}, 40)) {
    auto soft = std::make_shared<SoftSetup>();
    soft->lattice = build_lattice(*rest_, {.cell_m = 0.010}).lattice;
    setup_.organ_T = rest_.get();
    setup_.seen_T = rest_;
    setup_.tools = {make_tool(InstrumentKind::kScissors)};
    setup_.soft = soft;
    SheetSetup sheet{"gauze", rectangular_sheet(kSide, kSide, kEdge), {}, 0.0005, {}};
    sheet.framed = true;
    sheet.material.young_pa = 5e6;
    sheet.material.poisson = 0.3;
    sheet.material.density_kg_m3 = 200;
    sheet.material.rupture_n_per_m = 1500;
    for (std::size_t v = 0; v < sheet.drawn_T.vertices.size(); ++v) {
      Vec3& at = sheet.drawn_T.vertices[v];
      const double rim = std::min({at.x(), at.y(), kSide - at.x(), kSide - at.y()});
      if (rim < 1e-9) sheet.hinge.push_back(static_cast<std::int32_t>(v));
      at += Vec3(-kSide / 2, -kSide / 2, kHigh);
    }
    setup_.sheets = {sheet};
    setup_.followed = {{Vec3(0.010, 0, kHigh), Vec3::UnitZ()}};
    world_ = std::make_unique<TissueWorld>(setup_);
  }

  /// @param press_n of the tips on the gauze, at its middle, as the loop would tell it
  /// @param aside_m of the instrument, along its blades, while the blade that bears stays where it was
  void step(double opening_m, double press_n, double roll_rad = 0, double aside_m = 0) {
    state_.stylus.t_s += 0.01;
    state_.stylus.X_TI.R.col(2) = -Vec3::UnitZ();
    state_.stylus.X_TI.R.col(1) = Vec3(std::cos(roll_rad), std::sin(roll_rad), 0);
    state_.stylus.X_TI.R.col(0) = state_.stylus.X_TI.R.col(1).cross(state_.stylus.X_TI.R.col(2));
    state_.stylus.X_TI.p = aside_m * state_.stylus.X_TI.R.col(1) + Vec3(0, 0, kHigh);
    state_.stylus.jaw_opening_m = opening_m;
    state_.contacts = {};
    if (press_n > 0) {
      state_.contacts.count = 1;
      SolvedContact& contact = state_.contacts.at[0];
      contact.place = {static_cast<std::int32_t>(setup_.organ_T->triangles.size()) + middle(),
                       {1. / 3, 1. / 3, 1. / 3}};
      contact.normal_T = Vec3::UnitZ();
      contact.force_T = press_n * Vec3::UnitZ();
      contact.tool_T = Vec3(0, 0, kHigh - 0.002);
    }
    world_->step(state_, true, *patch_);
  }
  void close(double press_n, double roll_rad = 0) {
    for (double o = 0.001; o <= 0.008; o += 0.001) step(o, press_n, roll_rad);
    for (double o = 0.008; o > -0.001; o -= 0.001) step(o, press_n, roll_rad);
  }
  const TissueFrame& frame() const { return world_->frame(); }
  TissueWorld& world() { return *world_; }
  /// Where the tips press, as the gauze was drawn: the middle of a triangle, beside the tips.
  Vec3 pressed_T() const {
    const TriangleSurface& drawn = setup_.sheets[0].drawn_T;
    Vec3 at = Vec3::Zero();
    for (const std::int32_t v : drawn.triangles[static_cast<std::size_t>(middle())])
      at += drawn.vertices[static_cast<std::size_t>(v)] / 3;
    return at;
  }

 private:
  std::int32_t middle() const {
    const TriangleSurface& drawn = setup_.sheets[0].drawn_T;
    std::int32_t best = 0;
    double least = 1;
    for (std::size_t t = 0; t < drawn.triangles.size(); ++t) {
      Vec3 at = Vec3::Zero();
      for (const std::int32_t v : drawn.triangles[t]) at += drawn.vertices[static_cast<std::size_t>(v)] / 3;
      if (const double off = at.head<2>().norm(); off < least) least = off, best = static_cast<std::int32_t>(t);
    }
    return best;
  }

  SurfacePtr rest_;
  TissueSetup setup_;
  std::unique_ptr<TissueWorld> world_;
  HapticState state_;
  std::unique_ptr<ContactPatch> patch_ = std::make_unique<ContactPatch>();
};

TEST(GauzeFrame, ItIsTautLevelAndAtRest) {
  Gauze gauze;
  for (int i = 0; i < 100; ++i) gauze.step(0, 0);
  for (const Vec3& vertex : gauze.world().thin()[0]->vertices) EXPECT_NEAR(vertex.z(), kHigh, 0.001);
  EXPECT_EQ(gauze.frame().sheet_cut_count, 0);
  EXPECT_EQ(gauze.frame().sheet_pull_n, 0);
  ASSERT_EQ(gauze.frame().place_count, 1);
  EXPECT_LT((gauze.frame().place[0].point_T - Vec3(0.010, 0, kHigh)).norm(), 0.001)
      << "a place on it goes along with it";
}

TEST(GauzeFrame, PressedTipsThatCloseCutASnipAlongTheirWay) {
  Gauze gauze;
  for (int i = 0; i < 20; ++i) gauze.step(0, 0);
  gauze.close(0.5);
  ASSERT_EQ(gauze.frame().sheet_cut_count, 1);
  const SheetCutSeen& cut = gauze.frame().sheet_cut[0];
  const Vec3 way = cut.to_rest_T - cut.from_rest_T;
  EXPECT_NEAR(way.norm(), 0.005, 3e-4) << "no further than a snip, though they stood open by 8 mm";
  EXPECT_LT(std::abs(way.y()), 1e-4);
  EXPECT_LT(((cut.from_rest_T + cut.to_rest_T) / 2 - gauze.pressed_T()).norm(), 3e-4) << "where the tips press";
  EXPECT_EQ(gauze.frame().surgery.cuts, 1);
  EXPECT_EQ(gauze.world().surface()->topology, 0U) << "the organ beneath is whole";
  constexpr double kRoll = 0.7;
  gauze.close(0.5, kRoll);
  ASSERT_EQ(gauze.frame().sheet_cut_count, 2);
  const Vec3 turned = gauze.frame().sheet_cut[1].to_rest_T - gauze.frame().sheet_cut[1].from_rest_T;
  EXPECT_NEAR(std::abs(std::atan2(turned.y(), turned.x())), kRoll, 0.05);
}

TEST(GauzeFrame, TheCutIsWhereTheBladesBeganToClose) {
  Gauze gauze;
  for (int i = 0; i < 20; ++i) gauze.step(0, 0);
  constexpr double kOpen = 0.008, kDrawn = 0.003;  // m: one blade sticks, the closing jaw draws the instrument to it
  for (double o = 0.001; o <= kOpen; o += 0.001) gauze.step(o, 0.5);
  for (double o = kOpen; o > -0.001; o -= 0.001) gauze.step(o, 0.5, 0, kDrawn * (1 - o / kOpen));
  ASSERT_EQ(gauze.frame().sheet_cut_count, 1);
  const SheetCutSeen& cut = gauze.frame().sheet_cut[0];
  EXPECT_LT(((cut.from_rest_T + cut.to_rest_T) / 2 - gauze.pressed_T()).norm(), 8e-4) << "not 3 mm on";
}

TEST(GauzeFrame, BladesThatStandHalfClosedOrOpenAgainCutWhereTheyCloseThen) {
  constexpr double kOpen = 0.008, kHalf = 0.005, kOn = 0.008;  // m
  for (const bool opens : {false, true}) {
    Gauze gauze;
    for (int i = 0; i < 20; ++i) gauze.step(0, 0);
    for (double o = 0.001; o <= kOpen; o += 0.001) gauze.step(o, 0.5);
    for (double o = kOpen; o > kHalf; o -= 0.001) gauze.step(o, 0.5);
    for (int i = 0; i < (opens ? 1 : 40); ++i) gauze.step(kHalf, 0.5, 0, kOn);
    const double then = opens ? kHalf + 0.001 : kHalf;
    for (double o = then; o > -0.001; o -= 0.001) gauze.step(o, 0.5, 0, kOn);
    ASSERT_EQ(gauze.frame().sheet_cut_count, 1);
    const SheetCutSeen& cut = gauze.frame().sheet_cut[0];
    const Vec3 off = (cut.from_rest_T + cut.to_rest_T) / 2 - gauze.pressed_T();
    EXPECT_NEAR(off.norm(), kOn, 8e-4) << (opens ? "opened again" : "stood");
  }
}

TEST(GauzeFrame, TipsThatDoNotPressOrHardlyOpenCutNothing) {
  Gauze gauze;
  for (int i = 0; i < 20; ++i) gauze.step(0, 0);
  gauze.close(0);
  gauze.close(0.05);
  for (double o = 0; o < 0.0025; o += 0.0005) gauze.step(o, 0.5);
  gauze.step(0, 0.5);
  EXPECT_EQ(gauze.frame().sheet_cut_count, 0);
}

TEST(GauzeFrame, ThePullIsThatOfTheContacts) {
  Gauze gauze;
  gauze.step(0, 0);
  gauze.step(0, 1.7);
  EXPECT_NEAR(gauze.frame().sheet_pull_n, 1.7, 1e-9);
  gauze.step(0, 0);
  EXPECT_EQ(gauze.frame().sheet_pull_n, 0);
}

}  // namespace
}  // namespace trocar::gauze_frame_test
