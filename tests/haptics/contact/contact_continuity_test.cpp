// No step and no way through: the force follows the motion over edges, corners and facets with probe, shaft, jaws and
// held object, with and without friction; a sheet of 2 mm stands against each of them up to 1 m/s from any side.
#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <memory>

#include "haptics/contact/contact_renderer.h"
#include "haptics/least_turn.h"
#include "tests/haptics/contact/surfaces.h"

namespace trocar::contact_continuity_test {
namespace {

using test::Random;
using test::tip_down;

constexpr double kMostPer100um = 0.03;  // N at 150 N/m: twice the slope of the spring itself
constexpr double kStep = 1e-5;          // m: 10 mm/s for a millisecond

Mat3 lying() { return (Mat3() << 0, 0, -1, 0, 1, 0, 1, 0, 0).finished(); }

struct Tool {
  const char* name;
  ToolShape shape;
  double opening;
  HeldObject held;
  Mat3 R;
  double depth;      ///< of the sweep: half the radius at most, see worst_step
  double rise = -1;  ///< of I above the surface when the lowest part just touches
};

std::vector<Tool> tools() {
  const ToolShape probe, grasper{.jaw_length_m = 0.020};
  std::vector<Tool> all{
      {"tip", probe, 0, {}, tip_down(Vec3::Zero()).R, 0.001},
      {"shaft", probe, 0, {}, lying(), 0.001},
      {"closed jaws", grasper, 0, {}, tip_down(Vec3::Zero()).R, 0.0006},
      {"open jaws", grasper, 0.012, {}, tip_down(Vec3::Zero()).R, 0.0006},
      {"jaws across", grasper, 0.012, {}, lying(), 0.00125 + 0.0006},
      {"held object", grasper, 0.008, {{0.008, 0, 0.002}, {-0.008, 0, 0.002}, 0.004}, tip_down(Vec3::Zero()).R, 0.001}};
  for (Tool& tool : all) {
    const ToolCapsules capsules = tool_capsules(tool.shape, tool.opening, tool.held);
    for (int c = 0; c < capsules.count; ++c) {
      const Capsule& capsule = capsules.at[std::size_t(c)];
      for (const double along : {0.0, capsule.length_m}) {
        const Vec3 end = tool.R * (capsule.X_IC.p - capsule.X_IC.R.col(2) * along);
        tool.rise = std::max(tool.rise, capsule.radius_m - end.z());
      }
    }
  }
  return all;
}

/// Top and side of a block that ends at x = 0.
void block_edge(ContactPatch& patch) {
  test::add_sheet(patch, {-0.03, -0.02, 0}, {0.03, 0, 0}, {0, 0.04, 0}, 6);
  test::add_sheet(patch, {0, -0.02, 0}, {0, 0, -0.02}, {0, 0.04, 0}, 6);
}
/// Roof of 120 degrees with its ridge along y at x = 0.
void ridge(ContactPatch& patch) {
  test::add_sheet(patch, {0, -0.03, 0}, {0, 0.06, 0}, {-0.03, 0, -0.0173}, 6);
  test::add_sheet(patch, {0, -0.03, 0}, {0.03, 0, -0.0173}, {0, 0.06, 0}, 6);
}
/// Valley of 170 degrees.
void valley(ContactPatch& patch) {
  test::add_sheet(patch, {0, -0.03, 0}, {0, 0.06, 0}, {-0.03, 0, 0.0026}, 6);
  test::add_sheet(patch, {0, -0.03, 0}, {0.03, 0, 0.0026}, {0, 0.06, 0}, 6);
}
/// Ball of 2048 facets, its top at the origin.
void ball(ContactPatch& patch) {
  TriangleSurface s = test::sphere(4, 0.04);
  for (Vec3& v : s.vertices) v.z() -= 0.04;
  test::patch_near(s, {0, 0, 0}, 0.022, patch);
}

struct Surface {
  const char* name;
  void (*make)(ContactPatch&);
};
constexpr Surface kSurfaces[] = {{"block edge", block_edge}, {"ridge", ridge}, {"valley", valley}, {"ball", ball}};

class Continuity : public ::testing::TestWithParam<Surface> {
 protected:
  /// Largest change of force within 0.1 mm of motion. Over a convex edge a tool of radius r pressed in by d turns its
  /// force d / (r - d) times as fast as it moves: up to d = r / 2 the spring's own slope is the bound.
  double worst_step(const Tool& tool, double slant) {
    ContactRenderer renderer(ContactLaw::kProxy, tool.shape);
    patch->held = tool.held;
    const Vec3 way(std::cos(slant), std::sin(slant), 0);
    const auto place = [&](double s, double lift) {
      return Pose{tool.R, Vec3(0.0003, 0.0002, tool.rise - tool.depth + lift) + way * s};
    };
    for (int i = 600; i >= 0; --i) renderer.update(place(-0.009, i * kStep), Twist{}, *patch, tool.opening);
    std::deque<Vec3> past;
    double worst = 0;
    for (int i = 0; i <= 1800; ++i) {
      const Twist V{way * (kStep / 1e-3), Vec3::Zero()};
      past.push_back(renderer.update(place(-0.009 + i * kStep, 0), V, *patch, tool.opening).F_I_T.force);
      if (past.size() > 11) past.pop_front();
      most_force = std::max(most_force, past.back().norm());
      for (const Vec3& F : past) worst = std::max(worst, (past.back() - F).norm());
    }
    return worst;
  }
  std::unique_ptr<ContactPatch> patch = std::make_unique<ContactPatch>();
  double most_force = 0;
};

TEST_P(Continuity, NoStepWithAnyPartOfTheTool) {
  for (const double mu : {0.0, 0.1}) {
    for (const Tool& tool : tools()) {
      const bool jammed = GetParam().make == valley && tool.R == lying();  // its shaft would start inside the walls
      if (jammed) continue;
      most_force = 0;
      patch->clear();
      GetParam().make(*patch);
      patch->material[0].mu_static = mu;
      patch->material[0].mu_dynamic = mu / 2;
      for (const double slant : {0.0, 0.5, 1.2}) {
        EXPECT_LT(worst_step(tool, slant), kMostPer100um)
            << tool.name << " over the " << GetParam().name << ", friction " << mu << ", direction " << slant;
      }
      EXPECT_GT(most_force, 0.05) << tool.name << " pressed nothing";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Continuity, ::testing::ValuesIn(kSurfaces));

TEST(OverAStep, TheForceDoesNotGoOutWhileTheProxyFalls) {
  for (const Tool& tool : tools()) {
    if (tool.R == lying()) continue;  // its length bridges the step
    auto patch = std::make_unique<ContactPatch>();
    patch->held = tool.held;
    test::add_sheet(*patch, {-0.03, -0.02, 0}, {0.03, 0, 0}, {0, 0.04, 0}, 6);
    test::add_sheet(*patch, {0, -0.02, 0}, {0, 0, -0.005}, {0, 0.04, 0}, 6);
    test::add_sheet(*patch, {0, -0.02, -0.005}, {0.04, 0, 0}, {0, 0.04, 0}, 6);
    ContactRenderer renderer(ContactLaw::kProxy, tool.shape);
    const auto at = [&](double x, double z) {
      return renderer.update({tool.R, Vec3(x, 0.0002, tool.rise + z)}, Twist{}, *patch, tool.opening);
    };
    for (double z = 0.002; z > -0.0065; z -= 5e-5) at(-0.015, z);
    double fell = 0, before = 0.0065;
    for (double x = -0.015; x < 0.015; x += 5e-5) {
      const ContactResult felt = at(x, -0.0065);
      ASSERT_TRUE(felt.contact) << tool.name << " at x " << x;
      fell = std::max(fell, before - felt.depth_m);
      before = felt.depth_m;
    }
    EXPECT_GT(fell, 0.001) << tool.name << ": further than the proxy slides in a period";
  }
}

class ThinSheet : public ::testing::Test {
 protected:
  ThinSheet() {
    test::add_sheet(*patch, {-0.05, -0.05, 0.001}, {0.10, 0, 0}, {0, 0.10, 0}, 8);
    test::add_sheet(*patch, {-0.05, -0.05, -0.001}, {0, 0.10, 0}, {0.10, 0, 0}, 8);
  }
  std::unique_ptr<ContactPatch> patch = std::make_unique<ContactPatch>();
};

class ThinSheetAtSpeed : public ThinSheet, public ::testing::WithParamInterface<double> {};

TEST_P(ThinSheetAtSpeed, IsNeverPassed) {
  const double speed = GetParam();
  for (const double drag : {0.0, 1.0}) {  // m/s along the sheet meanwhile
    for (const double mu : {0.0, 0.3}) {
      patch->material[0].mu_static = patch->material[0].mu_dynamic = mu;
      for (const Tool& tool : tools()) {
        patch->held = tool.held;
        ContactRenderer renderer(ContactLaw::kProxy, tool.shape);
        const Vec3 V(drag, -0.6 * drag, -speed);
        const double time = 0.020 / speed;
        for (double t = 0; t < time; t += 1e-3) {
          // Dragging goes to and fro, so that it stays over the sheet.
          const double swing = drag * 0.01 * std::sin(t / 0.01);
          const Vec3 p(swing, -0.6 * swing, tool.rise + 0.001 + 0.008 - speed * t);
          const ContactResult r = renderer.update({tool.R, p}, Twist{V, Vec3::Zero()}, *patch, tool.opening);
          const double depth = speed * t - 0.008;
          if (depth < 2e-4) continue;
          ASSERT_GT(r.spring_I_T.force.z(), 0.97 * 150 * depth) << tool.name << " at " << speed << " m/s, dragged at "
                                                                << drag << ", friction " << mu << ", depth " << depth;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Speeds, ThinSheetAtSpeed, ::testing::Values(0.01, 0.1, 0.3, 0.7, 1.0));

TEST_F(ThinSheet, IsNeverPassedFromARandomSide) {
  Random random(17);
  for (int trial = 0; trial < 300; ++trial) {
    Vec3 way = random.direction();
    if (std::abs(way.z()) < 0.5) continue;
    const double side = way.z() < 0 ? 1 : -1;  // comes from above: side +1
    const Mat3 R = least_turn(Vec3::UnitZ(), way).toRotationMatrix();
    const ToolShape shape{.jaw_length_m = trial % 2 == 0 ? 0.020 : 0.0};
    ContactRenderer renderer(ContactLaw::kProxy, shape);
    const double opening = trial % 4 == 0 ? 0.015 : 0;
    for (double s = -0.03; s < 0.008; s += 1e-3) {  // 1 m/s along its shaft
      const ContactResult r = renderer.update({R, way * s}, Twist{way, Vec3::Zero()}, *patch, opening);
      ASSERT_TRUE(!r.contact || side * r.spring_I_T.force.z() > 0) << "trial " << trial << ", " << s;
      ASSERT_TRUE(r.contact || s <= 0.002) << "trial " << trial << ", " << s;
    }
  }
}

TEST_F(ThinSheet, ASwingingShaftDoesNotPass) {
  // Hinged 60 mm outside, swept down through the sheet at 1 m/s at the tip.
  ContactRenderer renderer(ContactLaw::kProxy);
  const Vec3 hinge(-0.06, 0, 0.02);
  for (double angle = 0; angle < 0.5; angle += 1e-3 / 0.08) {
    const Mat3 R = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix() *
                   Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()).toRotationMatrix();
    const Pose X{R, hinge + R.col(2) * 0.08};
    const ContactResult r = renderer.update(X, Twist{}, *patch);
    const double depth = 0.001 + ToolShape{}.radius_m - X.p.z();
    if (depth < 5e-4) continue;
    ASSERT_GT(r.F_I_T.force.z(), 0.5 * 150 * depth) << "angle " << angle;
  }
}

}  // namespace
}  // namespace trocar::contact_continuity_test
