// A tool that presses on a duct, by the contacts that the loop has solved.
#include "tissue/thin/rod_contact.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/tissue/thin/rod_rig.h"

namespace trocar::rod_contact_test {
namespace {

constexpr std::int32_t kFirst = 5000;

/// A triangle of the tube on its top, near the middle.
std::int32_t on_top(const RodSurface& tube) {
  std::int32_t best = 0;
  double highest = -1;
  for (std::size_t t = 0; t < tube.surface()->triangles.size(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : tube.surface()->triangles[t])
      middle += tube.surface()->vertices[static_cast<std::size_t>(v)] / 3;
    const double height = middle.z() - std::abs(middle.x() - 0.02);
    if (height > highest) {
      highest = height;
      best = static_cast<std::int32_t>(t);
    }
  }
  return best;
}

SolvedContacts pressed(const RodSurface& tube, double depth, const Vec3& drag = Vec3::Zero()) {
  SolvedContacts contacts;
  contacts.count = 1;
  SolvedContact& contact = contacts.at[0];
  contact.place = {kFirst + on_top(tube), {1.0 / 3, 1.0 / 3, 1.0 / 3}};
  contact.normal_T = Vec3::UnitZ();
  contact.force_T = Vec3(0, 0, 0.1) + drag;
  contact.tool_T = Vec3(0.02, 0, 0.0015 - depth);
  return contacts;
}

TEST(RodContact, PushesTheRodAwayAndComesToTheToolsForce) {
  ElasticRod rod = test::hung_duct();
  RodSurface tube(rod);
  const double k = dent_stiffness(rod.options(), 0.0025);
  std::vector<RodSpring> springs;
  for (int i = 0; i < 200; ++i) {
    springs = rod_contacts(pressed(tube, 0.004), kFirst, tube, k);
    ASSERT_EQ(springs.size(), 1u);
    rod.step(springs);
    tube.follow(rod);
  }
  EXPECT_GT(springs[0].force_n, 0.01);
  EXPECT_LT(rod.place_at(0.02).z(), -0.001);
  const Vec3 held = rod.anchor_load(RodEnd::kStart).force + rod.anchor_load(RodEnd::kFinish).force;
  EXPECT_NEAR(-held.z(), springs[0].force_n, 1e-3 * springs[0].force_n);
  const double loop = loop_stiffness(rod, springs[0].arc_m, Vec3::UnitZ(), k);
  EXPECT_GT(loop, 0);
  EXPECT_LT(loop, k);
}

TEST(RodContact, LoopStiffnessIsTheStepsOwn) {
  ElasticRod rod = test::hung_duct();
  const auto push = [](ElasticRod& of, double way) {
    std::vector<RodSpring> spring{{.arc_m = 0.0205,
                                   .direction = Vec3::UnitZ(),
                                   .stiffness_n_per_m = 100,
                                   .stretch_m = of.place_at(0.0205).z() + way}};
    of.step(spring);
    return spring[0].force_n;
  };
  for (int i = 0; i < 100; ++i) push(rod, 0.003);
  ElasticRod further = rod;
  const double here = push(rod, 0.003), there = push(further, 0.0031);
  const double loop = loop_stiffness(rod, 0.0205, Vec3::UnitZ(), 100);
  EXPECT_NEAR((there - here) / 1e-4 / loop, 1, 0.02);
}

TEST(RodContact, DragsItAlong) {
  ElasticRod rod = test::hung_duct();
  RodSurface tube(rod);
  auto springs = rod_contacts(pressed(tube, 0.001, {0.02, 0, 0}), kFirst, tube, 100);
  ASSERT_EQ(springs.size(), 2u);
  rod.step(springs);
  EXPECT_LT(rod.place_at(0.02).x(), 0.02 - 1e-6) << "the tool feels +x, so the duct is dragged to -x";
}

TEST(RodContact, LeavesOutWhatIsNotItsOwnOrNotSound) {
  ElasticRod rod = test::hung_duct();
  RodSurface tube(rod);
  SolvedContacts contacts = pressed(tube, 0.001);
  contacts.at[0].place.triangle = kFirst - 1;
  EXPECT_TRUE(rod_contacts(contacts, kFirst, tube, 100).empty());
  contacts = pressed(tube, 0.001);
  contacts.at[0].tool_T.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(rod_contacts(contacts, kFirst, tube, 100).empty());
}

TEST(RodContact, ARingGivesAsRoarkSays) {
  RodOptions rod;
  rod.outer_radius_m = 0.00525;
  rod.wall_m = 0.0005;
  rod.young_pa = 1e6;
  rod.poisson = 0;
  // 0.149 P R^3 / (E I): R = 5 mm, I = t^3 / 12 a length.
  EXPECT_NEAR(ring_stiffness(rod), 1e6 * 1.25e-10 / 12 / (0.149 * 1.25e-7), 1);
}

}  // namespace
}  // namespace trocar::rod_contact_test
