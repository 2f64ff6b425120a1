// The proxy contact in motion: edges, corners, saddle and sphere without steps, thin sheets without pop-through; and
// the thesis' nearest-point law beside it, with its faults.
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "haptics/contact/contact_renderer.h"
#include "tests/haptics/contact/surfaces.h"

namespace trocar::contact_sweep_test {
namespace {

using test::tip_down;

constexpr double kRadius = ToolShape{}.radius_m;
constexpr double kStep = 10e-6;  // 10 mm/s for a millisecond

/// Top and side of a block that ends at x = 0; top at z = 0.
void block_edge(ContactPatch& patch) {
  test::add_sheet(patch, {-0.03, -0.02, 0}, {0.03, 0, 0}, {0, 0.04, 0}, 6);
  test::add_sheet(patch, {0, -0.02, 0}, {0, 0, -0.02}, {0, 0.04, 0}, 6);
}

/// Floor z = 0 and wall x = 0 that face the first quadrant.
void inner_corner(ContactPatch& patch) {
  test::add_sheet(patch, {0, -0.02, 0}, {0.03, 0, 0}, {0, 0.04, 0}, 6);
  test::add_sheet(patch, {0, -0.02, 0}, {0, 0.04, 0}, {0, 0, 0.03}, 6);
}

/// z = (x^2 - y^2) / (2 R), R = 30 mm, in squares of 2 mm.
void saddle(ContactPatch& patch) {
  constexpr int n = 15;
  const auto at = [](int i, int j) {
    const double x = (i - n / 2.0) * 0.002, y = (j - n / 2.0) * 0.002;
    return Vec3(x, y, (x * x - y * y) / 0.06);
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      test::add_triangle(patch, at(i, j), at(i + 1, j), at(i + 1, j + 1));
      test::add_triangle(patch, at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
}

struct Steps {
  double force_n = 0, turn_deg = 0, least_n = 1e9, largest_n = 0;
};

/// Largest change of force from tick to tick along a path; turns are counted while the force exceeds 0.1 N.
Steps sweep(
    ContactPatch& patch, int ticks, const std::function<Pose(int)>& path,
    const std::function<void(int)>& refresh = [](int) {}) {
  ContactRenderer renderer(ContactLaw::kProxy);
  Pose start = path(0);
  for (int lift = 400; lift >= 0; --lift) {  // lowered onto the surface
    Pose X = start;
    X.p -= X.R.col(2) * (lift * kStep);
    renderer.update(X, Twist{}, patch);
  }
  Steps steps;
  Vec3 last = renderer.update(start, Twist{}, patch).F_I_T.force;
  for (int k = 0; k < ticks; ++k) {
    refresh(k);
    const Vec3 force = renderer.update(path(k), Twist{}, patch).F_I_T.force;
    steps.force_n = std::max(steps.force_n, (force - last).norm());
    if (force.norm() > 0.1 && last.norm() > 0.1) {
      steps.turn_deg = std::max(steps.turn_deg, test::angle_between(force, last) / kDegree);
    }
    steps.least_n = std::min(steps.least_n, force.norm());
    steps.largest_n = std::max(steps.largest_n, force.norm());
    last = force;
  }
  return steps;
}

class ContactSweep : public ::testing::Test {
 protected:
  ContactSweep() { patch->material[0].stiffness_n_per_m = 300; }  // 0.6 N at 2 mm
  void expect_smooth(const Steps& steps) {
    EXPECT_LT(steps.force_n, 0.02) << "N per tick at 0.6 N";
    EXPECT_LT(steps.turn_deg, 2.0) << "degrees per tick";
    EXPECT_GT(steps.largest_n, 0.5) << "nothing was pressed";
  }
  std::unique_ptr<ContactPatch> patch = std::make_unique<ContactPatch>();
};

TEST_F(ContactSweep, OverTheEdgeOfABlock) {
  block_edge(*patch);
  const Steps steps = sweep(*patch, 1200, [](int k) {
    return tip_down({-0.006 + k * kStep, 0.0003, kRadius - 0.002});
  });
  expect_smooth(steps);
  EXPECT_EQ(steps.least_n, 0) << "leaves the block";
}

TEST_F(ContactSweep, IntoAnInnerCornerAndBack) {
  inner_corner(*patch);
  expect_smooth(sweep(*patch, 1000, [](int k) {
    const double x = 0.004 - kStep * (k < 500 ? k : 1000 - k);
    return tip_down({x, 0.0002, kRadius - 0.002});
  }));
}

TEST_F(ContactSweep, AcrossASaddle) {
  saddle(*patch);
  for (const double slant : {0.0, 0.3, 0.7, 1.0}) {
    const Steps steps = sweep(*patch, 1000, [slant](int k) {
      const double s = -0.005 + k * kStep, x = s * std::cos(slant), y = s * std::sin(slant) + 2e-4;
      return tip_down({x, y, (x * x - y * y) / 0.06 + kRadius - 0.002});
    });
    expect_smooth(steps);
    EXPECT_GT(steps.least_n, 0.3);
  }
}

TEST_F(ContactSweep, AlongASphereOfEightThousandTriangles) {
  const TriangleSurface ball = test::sphere(5, 0.04);
  ASSERT_EQ(ball.triangles.size(), 8192u);
  const auto place = [](int k) {
    const double angle = 0.3 + k * kStep / 0.04, turn = 0.4;
    const Vec3 n(std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle));
    return tip_down(n * (0.04 + kRadius - 0.002));
  };
  test::patch_near(ball, place(0).p, 0.014, *patch);
  const Steps steps = sweep(*patch, 1500, place, [&](int k) {
    if (k % 100 == 0) test::patch_near(ball, place(k).p, 0.014, *patch);
  });
  expect_smooth(steps);
  EXPECT_GT(steps.least_n, 0.5) << "the facets lie a little under the sphere, never lost";
}

TEST_F(ContactSweep, DeeperThanTheTipFacetsAreNoSteps) {
  // The proxy would go from facet to facet, 11 deg apart, at once, however slowly the tool moves.
  const TriangleSurface ball = test::sphere(3, 0.04);
  for (const int speed : {1, 5}) {  // 10 and 50 mm/s
    const auto place = [speed](int k) {
      const double angle = -0.3 + k * speed * kStep / 0.04;
      return tip_down(Vec3(std::sin(angle), 0.1, std::cos(angle)).normalized() * (0.04 + kRadius - 0.004));
    };
    test::patch_near(ball, {0, 0, 0.04}, 0.025, *patch);
    const Steps steps = sweep(*patch, 2000 / speed, place);
    EXPECT_LT(steps.turn_deg, 2.0) << speed;
    EXPECT_GT(steps.least_n, 0.9) << "never lost";
  }
}

/// Both faces of a sheet 2 mm thick about z = 0.
void thin_sheet(ContactPatch& patch) {
  test::add_sheet(patch, {-0.03, -0.03, 0.001}, {0.06, 0, 0}, {0, 0.06, 0}, 6);
  test::add_sheet(patch, {-0.03, -0.03, -0.001}, {0, 0.06, 0}, {0.06, 0, 0}, 6);
}

TEST_F(ContactSweep, ThinSheetNeverPops) {
  thin_sheet(*patch);
  for (const double speed : {0.01, 0.03, 0.1, 0.3, 1.0, 1.25}) {
    ContactRenderer renderer(ContactLaw::kProxy);
    double z = 0.008;
    for (; z > -0.02; z -= speed * 1e-3) {
      const ContactResult r =
          renderer.update(tip_down({0.001, 0.0007, z}), Twist{Vec3(0, 0, -speed), Vec3::Zero()}, *patch);
      const double depth = 0.001 + kRadius - z;
      if (depth > 1e-6) {
        ASSERT_NEAR(r.F_I_T.force.z() / r.damping_factor, 300 * depth, 2e-3) << speed << " m/s, z " << z;
      }
    }
    for (; z < 0.008; z += speed * 1e-3) {  // and out the way it came
      const ContactResult r = renderer.update(tip_down({0.001, 0.0007, z}), Twist{}, *patch);
      ASSERT_GE(r.F_I_T.force.z(), 0);
    }
    EXPECT_FALSE(renderer.update(tip_down({0.001, 0.0007, 0.02}), Twist{}, *patch).contact);
  }
}

TEST_F(ContactSweep, ThesisLawIsStiffnessTimesDistanceToTheNearestPoint) {
  test::flat_patch(*patch);
  ContactRenderer thesis(ContactLaw::kThesis);
  const ContactResult r = thesis.update(tip_down({0.001, 0, -0.003}), Twist{Vec3(0, 0, -1), Vec3::Zero()}, *patch);
  EXPECT_LT((r.F_I_T.force - Vec3(0, 0, 0.9)).norm(), 1e-12);
  EXPECT_FALSE(thesis.update(tip_down({0.001, 0, 0.0001}), Twist{}, *patch).contact);
}

TEST_F(ContactSweep, ThesisLawPopsThroughAThinSheet) {
  thin_sheet(*patch);
  ContactRenderer thesis(ContactLaw::kThesis);
  const double before = thesis.update(tip_down({0, 0, 1e-5}), Twist{}, *patch).F_I_T.force.z();
  const double after = thesis.update(tip_down({0, 0, -1e-5}), Twist{}, *patch).F_I_T.force.z();
  EXPECT_NEAR(before, 300 * 0.00099, 1e-9);
  EXPECT_NEAR(after, -300 * 0.00099, 1e-9) << "past half the thickness it is pushed out on the far side";
}

TEST_F(ContactSweep, ThesisLawJumpsNearAnEdge) {
  block_edge(*patch);
  ContactRenderer thesis(ContactLaw::kThesis);
  Vec3 last = Vec3::Zero();
  double jump = 0;
  for (int k = 0; k < 400; ++k) {  // 2 mm under the top, towards the side: the medial axis lies 2 mm before it
    const Vec3 force = thesis.update(tip_down({-0.004 + k * kStep, 0.0003, -0.002}), Twist{}, *patch).F_I_T.force;
    if (k > 0) jump = std::max(jump, test::angle_between(force, last) / kDegree);
    last = force;
  }
  EXPECT_GT(jump, 80);
}

}  // namespace
}  // namespace trocar::contact_sweep_test
