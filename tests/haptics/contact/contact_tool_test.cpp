// The instrument as shaft, jaws and held object: where its capsules lie, what each of them feels, several materials.
#include <gtest/gtest.h>

#include <memory>

#include "haptics/contact/contact_renderer.h"
#include "tests/haptics/contact/surfaces.h"

namespace trocar::contact_tool_test {
namespace {

using test::tip_down;

constexpr ToolShape kGrasper{.jaw_length_m = 0.020};
constexpr double kForceTolerance = 1e-4;  // the proxy rests within 1e-7 m of its goal: 1.5e-5 N at 150 N/m

/// End of the pad of jaw 1 (upper) or 2 (lower), in I.
Vec3 pad_end(const ToolCapsules& tool, int jaw) {
  const Capsule& c = tool.at[std::size_t(jaw)];
  return c.X_IC.p - c.X_IC.R.col(1) * ((jaw == 1 ? 1 : -1) * c.radius_m);
}

TEST(ToolShape, AProbeIsOneCapsuleToTheTip) {
  const ToolCapsules probe = tool_capsules({}, 0.01, {});
  ASSERT_EQ(probe.count, 1);
  EXPECT_EQ(probe.at[0].X_IC.p, Vec3::Zero());
  EXPECT_EQ(probe.at[0].length_m, 0.30);
  EXPECT_TRUE(probe.at[0].foremost);
}

TEST(ToolShape, ClosedPadsMeetAtTheTipAndTurnAboutTheHinge) {
  for (const double opening : {0.0, 0.004, 0.012, 0.024}) {
    const ToolCapsules tool = tool_capsules(kGrasper, opening, {});
    ASSERT_EQ(tool.count, 3);
    EXPECT_FALSE(tool.at[0].foremost);
    EXPECT_NEAR(tool.at[0].X_IC.p.z(), -0.020, 1e-15) << "the shaft ends at the hinge";
    const Vec3 upper = pad_end(tool, 1), lower = pad_end(tool, 2);
    EXPECT_NEAR(upper.y(), opening / 2, 1e-15);
    EXPECT_NEAR(lower.y(), -opening / 2, 1e-15);
    for (const Vec3& end : {upper, lower}) EXPECT_NEAR((end - Vec3(0, 0, -0.020)).norm(), 0.020, 1e-15);
    for (int jaw : {1, 2}) EXPECT_NEAR((tool.at[std::size_t(jaw)].X_IC.R.determinant()), 1, 1e-12);
  }
  EXPECT_NEAR(pad_end(tool_capsules(kGrasper, 1.0, {}), 1).y(), 0.014, 1e-12) << "the hinge stops";
}

TEST(ToolShape, TheHeldObjectRunsFromEndToEnd) {
  const HeldObject held{{0.01, 0.002, 0.003}, {-0.01, 0.004, 0.001}, 0.0035};
  const ToolCapsules tool = tool_capsules({}, 0, held);
  ASSERT_EQ(tool.count, 2);
  const Capsule& c = tool.at[1];
  EXPECT_LT((c.X_IC.p - c.X_IC.R.col(2) * c.length_m - held.to_I).norm(), 1e-15);
  EXPECT_EQ(c.X_IC.p, held.from_I);
  EXPECT_EQ(tool_capsules({}, 0, {{0.01, 0, 0}, {0.01, 0, 0}, 0.002}).at[1].length_m, 0) << "a ball";
}

class ContactTool : public ::testing::Test {
 protected:
  ContactResult settle(ContactRenderer& r, const Pose& X, double opening = 0) {
    ContactResult result;
    for (int i = 0; i < 30; ++i) result = r.update(X, Twist{}, *patch, opening);
    return result;
  }
  std::unique_ptr<ContactPatch> patch = std::make_unique<ContactPatch>();
  ContactRenderer grasper{ContactLaw::kProxy, kGrasper};
};

TEST_F(ContactTool, BothJawEndsCarryOnAPlane) {
  test::flat_patch(*patch);
  const double r = kGrasper.jaw_radius_m, opening = 0.02, depth = 0.002;
  const double rise = -pad_end(tool_capsules(kGrasper, opening, {}), 1).z() - 0;  // the ends draw back as they open
  const ToolCapsules tool = tool_capsules(kGrasper, opening, {});
  const double lowest = -tool.at[1].X_IC.p.z();
  EXPECT_GT(rise, 0.002);
  settle(grasper, tip_down({0, 0, 0.02}), opening);
  const ContactResult c = settle(grasper, tip_down({0, 0, r - lowest - depth}), opening);
  ASSERT_TRUE(c.contact);
  EXPECT_TRUE(c.tip_contact);
  EXPECT_LT((c.F_I_T.force - Vec3(0, 0, 150 * depth)).norm(), kForceTolerance);
}

TEST_F(ContactTool, OneJawAloneGivesItsMoment) {
  // A ledge under the upper jaw only (y > 0 in I is y < 0 in T for an instrument that points down).
  test::add_sheet(*patch, {-0.02, -0.03, 0}, {0.04, 0, 0}, {0, 0.028, 0}, 6);
  const double opening = 0.02, depth = 0.002;
  const ToolCapsules tool = tool_capsules(kGrasper, opening, {});
  const double height = kGrasper.jaw_radius_m + tool.at[1].X_IC.p.z() - depth;
  settle(grasper, tip_down({0, 0, height + 0.01}), opening);
  const ContactResult c = settle(grasper, tip_down({0, 0, height}), opening);
  EXPECT_LT((c.F_I_T.force - Vec3(0, 0, 150 * depth)).norm(), kForceTolerance);
  const double lever = tool.at[1].X_IC.p.y();  // sideways of the tip
  EXPECT_NEAR(c.F_I_T.moment.x(), -lever * 150 * depth, 0.01 * lever * 150 * depth);
}

TEST_F(ContactTool, OpeningAgainstAWallPushesTheInstrumentAway) {
  test::add_sheet(*patch, {-0.03, 0.006, -0.05}, {0.06, 0, 0}, {0, 0, 0.10}, 8);  // wall at y = 6 mm
  for (PatchTriangle& t : patch->triangle) t.normal = -Vec3::UnitY();
  const Pose X = tip_down({0, 0, 0});
  settle(grasper, X, 0);
  ContactResult c;
  double last = 0;
  for (double opening = 0; opening < 0.012; opening += 2e-5) {  // 20 mm/s
    c = grasper.update(X, Twist{}, *patch, opening);
    const double force = -c.F_I_T.force.y();
    ASSERT_GE(force, last - 1e-6);
    ASSERT_LT(force - last, 0.01) << "no step while the jaws open";
    last = force;
  }
  const Capsule lower = tool_capsules(kGrasper, 0.012, {}).at[2];
  const double depth = -lower.X_IC.p.y() + lower.radius_m - 0.006;
  EXPECT_NEAR(last, 150 * depth, 0.01 * 150 * depth);
  EXPECT_GT(depth, 0.001);
}

TEST_F(ContactTool, TheHeldObjectTouches) {
  test::flat_patch(*patch);
  patch->held = {{0.008, 0, 0.002}, {-0.008, 0, 0.002}, 0.004};
  settle(grasper, tip_down({0, 0, 0.02}), 0.008);
  const ContactResult c = settle(grasper, tip_down({0, 0, 0.002 + 0.004 - 0.003}), 0.008);
  EXPECT_LT((c.F_I_T.force - Vec3(0, 0, 150 * 0.003)).norm(), kForceTolerance);
  patch->held.radius_m = 0;
  EXPECT_FALSE(settle(grasper, tip_down({0, 0, 0.003}), 0.0).contact) << "let go of, it touches no more";
}

TEST_F(ContactTool, ShaftOnTwoRidgesCarriesTheTorqueOfBoth) {
  for (const double x : {0.06, 0.14}) {
    test::add_sheet(*patch, {x, -0.02, 0}, {0, 0.04, 0}, {-0.01, 0, -0.01}, 3);
    test::add_sheet(*patch, {x, -0.02, 0}, {0.01, 0, -0.01}, {0, 0.04, 0}, 3);
  }
  const Mat3 lying = (Mat3() << 0, 0, -1, 0, 1, 0, 1, 0, 0).finished();
  ContactRenderer probe(ContactLaw::kProxy);
  const double r = kGrasper.radius_m, depth = 0.003;
  settle(probe, {lying, Vec3(0, 0, r)});
  const ContactResult c = settle(probe, {lying, Vec3(0, 0, r - depth)});
  EXPECT_NEAR(c.F_I_T.force.z(), 150 * depth, kForceTolerance);
  // Statically indeterminate to the proxy: any split between the ridges is a rest, none may leave their span.
  EXPECT_LE(-c.F_I_T.moment.y(), 150 * depth * 0.14 * 1.01);
  EXPECT_GE(-c.F_I_T.moment.y(), 150 * depth * 0.06 * 0.99);
}

TEST_F(ContactTool, EachMaterialGivesItsOwnStiffnessWithoutAStepAtTheBorder) {
  test::flat_patch(*patch, 0, 0.04, 8);
  patch->material[3] = {450, 0.2};
  for (int i = 0; i < patch->count; ++i) {
    const auto [a, b, c] = patch->corners(i);
    if ((a + b + c).x() > 0) patch->triangle[std::size_t(i)].material = 3;
  }
  ContactRenderer probe(ContactLaw::kProxy);
  const double height = 0.0025 - 0.002;
  settle(probe, tip_down({-0.02, 0, 0.01}));
  ContactResult c = settle(probe, tip_down({-0.02, 0, height}));
  EXPECT_NEAR(c.F_I_T.force.z(), 150 * 0.002, kForceTolerance);
  double last = c.F_I_T.force.z(), step = 0;
  for (double x = -0.02; x < 0.02; x += 1e-5) {
    c = probe.update(tip_down({x, 0.001, height}), Twist{}, *patch);
    step = std::max(step, std::abs(c.F_I_T.force.z() - last));
    last = c.F_I_T.force.z();
  }
  EXPECT_NEAR(last, 450 * 0.002, 0.01 * 450 * 0.002);
  EXPECT_LT(step, 0.6 * 1e-5 / 2e-3 * 1.1) << "0.6 N of difference over 2 mm";
}

}  // namespace
}  // namespace trocar::contact_tool_test
