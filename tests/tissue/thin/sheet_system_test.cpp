// A flap on an organ that gives way: it lies, is pressed, lifted, let fall, cut, and played again.
#include "tissue/thin/sheet_system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "haptics/input_error.h"
#include "tests/tissue/solid/soft_organ_rig.h"
#include "tissue/tissue_world.h"

namespace trocar::sheet_system_test {
namespace {

using test::from_above;

/// A flap of 30 by 24 mm over the pole of an ellipsoid, hung on along its edge at +y, in a world of its own.
class Flap {
 public:
  explicit Flap(InstrumentKind kind = InstrumentKind::kGrasper) : rest_(test::ellipsoid({0.06, 0.05, 0.035}, 40)) {
    auto soft = std::make_shared<SoftSetup>();
    soft->lattice = build_lattice(*rest_, {.cell_m = 0.010}).lattice;
    setup_.organ_T = rest_.get();
    setup_.seen_T = rest_;
    setup_.tools = {make_tool(kind), make_tool(InstrumentKind::kScissors)};
    setup_.soft = soft;
    SheetSetup sheet{"flap", rectangular_sheet(0.030, 0.024, 0.004), {}, 0.002, {}};
    sheet.material.young_pa = 6000;
    for (std::size_t v = 0; v < sheet.drawn_T.vertices.size(); ++v) {
      Vec3& at = sheet.drawn_T.vertices[v];
      if (at.y() < 1e-9) sheet.hinge.push_back(static_cast<std::int32_t>(v));
      const double x = 0.015 - at.x(), y = 0.012 - at.y();
      at = Vec3(x, y, top(x, y) + 0.0012);
    }
    setup_.sheets = {sheet};
    world_ = std::make_unique<TissueWorld>(setup_);
  }

  void step(const Vec3& tip, double opening_m, bool present = true) {
    state_.stylus.t_s += 0.01;
    state_.stylus.X_TI = from_above(tip);
    state_.stylus.jaw_opening_m = opening_m;
    world_->step(state_, present, *patch_);
  }
  void wait(int steps) {
    for (int i = 0; i < steps; ++i) step({0, 0, 0.3}, 0.02, false);
  }
  void go(Vec3 from, const Vec3& to, double opening_m, int steps) {
    for (int i = 1; i <= steps; ++i) step(from + (to - from) * i / steps, opening_m);
  }
  /// Takes the free edge, at y = -12 mm.
  void take() {
    const Vec3 edge(0, -0.0115, top(0, -0.0115) - 0.001);
    go(edge + Vec3(0, 0, 0.02), edge, 0.014, 20);
    for (double o = 0.014; o >= 0; o -= 0.001) step(edge, o);
    for (int i = 0; i < 5; ++i) step(edge, 0);
  }
  /// The place of the free edge that is nearest to its middle, above.
  Vec3 middle_of_edge() const {
    const std::vector<Vec3>& drawn = setup_.sheets[0].drawn_T.vertices;
    const auto off = [](const Vec3& v) { return std::abs(v.y() + 0.012) + std::abs(v.x()); };
    const auto nearest =
        std::min_element(drawn.begin(), drawn.end(), [&](const Vec3& a, const Vec3& b) { return off(a) < off(b); });
    return world_->thin()[0]->vertices[static_cast<std::size_t>(nearest - drawn.begin())];
  }
  static double top(double x, double y) { return 0.035 * std::sqrt(1 - std::pow(x / 0.06, 2) - std::pow(y / 0.05, 2)); }
  const TissueFrame& frame() const { return world_->frame(); }
  const ContactPatch& patch() const { return *patch_; }
  TissueWorld& world() { return *world_; }
  const TissueSetup& setup() const { return setup_; }
  HapticState& state() { return state_; }

 private:
  SurfacePtr rest_;
  TissueSetup setup_;
  std::unique_ptr<TissueWorld> world_;
  HapticState state_;
  std::unique_ptr<ContactPatch> patch_ = std::make_unique<ContactPatch>();
};

TEST(SheetSystem, AFlapLiesOnTheOrganAndStaysThere) {
  Flap flap;
  const std::vector<Vec3> drawn = flap.world().thin()[0]->vertices;
  flap.wait(200);
  const std::vector<Vec3>& now = flap.world().thin()[0]->vertices;
  ASSERT_EQ(now.size(), drawn.size());
  for (std::size_t v = 0; v < now.size(); ++v) EXPECT_LT((now[v] - drawn[v]).norm(), 0.002) << v;
  const std::vector<Vec3> before = now;
  flap.wait(1);
  for (std::size_t v = 0; v < before.size(); ++v)
    EXPECT_LT((flap.world().thin()[0]->vertices[v] - before[v]).norm(), 5e-5);
}

TEST(SheetSystem, TakenByItsEdgeItIsLiftedFeltAndFallsBack) {
  Flap flap;
  flap.wait(50);
  const double lay = flap.middle_of_edge().z();
  flap.take();
  ASSERT_EQ(flap.frame().grip, GripState::kHolding);
  flap.go({0, -0.0115, lay}, {0, 0.0, lay + 0.020}, 0, 150);
  EXPECT_TRUE(flap.frame().held());
  EXPECT_GT(flap.middle_of_edge().z(), lay + 0.014);
  // The hand feels it: its weight is 14 mN, the rest is what it is stretched and bent by.
  const GripHold& hold = flap.patch().hold;
  ASSERT_GT(hold.stiffness_n_per_m, 0);
  const double pull = hold.stiffness_n_per_m * (from_above({0, 0, lay + 0.020}) * hold.point_I - hold.anchor_T).norm();
  EXPECT_GT(pull, 0.005);
  EXPECT_LT(pull, 1);
  // Let go it falls back, and nothing is left.
  for (int i = 0; i < 20; ++i) flap.step({0, 0, lay + 0.020}, 0.02);
  flap.wait(300);
  EXPECT_EQ(flap.frame().grip, GripState::kEmpty);
  EXPECT_EQ(flap.patch().hold.stiffness_n_per_m, 0);
  EXPECT_NEAR(flap.middle_of_edge().z(), lay, 0.003);
}

TEST(SheetSystem, PressedItIsTouchedBeforeTheOrgan) {
  Flap flap(InstrumentKind::kProbe);
  flap.wait(20);
  flap.step({0, 0, 0.04}, 0);
  const auto organ = static_cast<std::int32_t>(flap.setup().organ_T->triangles.size());
  int sheets = 0;
  double lowest = 1;
  for (int i = 0; i < flap.patch().count; ++i) {
    const bool sheet = flap.patch().triangle[std::size_t(i)].id >= organ;
    sheets += sheet;
    for (const Vec3& corner : flap.patch().corners(i))
      if (sheet && corner.head<2>().norm() < 0.008) lowest = std::min(lowest, corner.z());
  }
  EXPECT_GT(sheets, 40);
  EXPECT_GT(lowest, 0.0345);
}

TEST(SheetSystem, ScissorsCutItAndNotTheOrganAndPlaybackDoesTheSame) {
  Flap flap;
  flap.wait(20);
  flap.state().stylus.instrument = 1;
  // Blades across the free edge: the shaft lies along y.
  const auto along_y = [&](double y, double opening) {
    flap.state().stylus.t_s += 0.01;
    Pose X_TI;
    X_TI.R.col(0) = Vec3::UnitZ();
    X_TI.R.col(1) = Vec3::UnitX();
    X_TI.R.col(2) = Vec3::UnitY();
    X_TI.p = Vec3(0, y, Flap::top(0, y) + 0.001);
    flap.state().stylus.X_TI = X_TI;
    flap.state().stylus.jaw_opening_m = opening;
    auto patch = std::make_unique<ContactPatch>();
    flap.world().step(flap.state(), true, *patch);
  };
  const std::size_t nodes = flap.world().shape().thin_T.size();
  for (double o = 0.002; o <= 0.012; o += 0.002) along_y(-0.002, o);
  for (double o = 0.012; o >= 0; o -= 0.002) along_y(-0.002, o);
  EXPECT_EQ(flap.frame().surgery.cuts, 1);
  EXPECT_EQ(flap.world().surface()->topology, 0U) << "the organ is whole";
  EXPECT_GT(flap.world().shape().thin_T.size(), nodes);
  ASSERT_EQ(flap.world().shape().changes.size(), 1U);
  flap.wait(20);
  const TissueShape shape = flap.world().shape();
  EXPECT_TRUE(is_sheet_change(shape.changes[0]));
  const SheetPlayback playback(flap.setup().sheets, shape.changes);
  ASSERT_EQ(playback.nodes(), shape.thin_T.size());
  const std::vector<SurfacePtr> seen = playback.at(shape.thin_T);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0]->triangles, flap.world().thin()[0]->triangles);
  for (std::size_t v = 0; v < seen[0]->vertices.size(); ++v)
    EXPECT_LT((seen[0]->vertices[v] - flap.world().thin()[0]->vertices[v]).norm(), 1e-6);
  EXPECT_THROW(SheetPlayback({}, shape.changes), InputError);
  EXPECT_THROW(parse_sheet_change("abc"), InputError);
}

TEST(SheetSystem, TheShellIsClosed) {
  const Flap flap;
  const SurfacePtr shell = drawn_sheets(flap.setup().sheets)[0];
  EXPECT_NEAR(shell->volume_m3(), 0.030 * 0.024 * 0.002, 0.1 * 0.030 * 0.024 * 0.002);
}

}  // namespace
}  // namespace trocar::sheet_system_test
