#include "tissue/organ/lost_form.h"

#include <gtest/gtest.h>

#include "tests/tissue/support/shapes.h"

namespace trocar::lost_form_test {
namespace {

/// 60 x 60 mm, about z = 0.
TriangleSurface plate(double thickness_m, double side_m = 0.06) {
  return test::box({0, 0, -thickness_m / 2}, {side_m, side_m, thickness_m / 2});
}

/// What a mesh loses of a plate of 3 mm, volumes aside.
std::optional<LostForm> lost(const TriangleSurface& mesh, double voxel_m, double error_pct = 0) {
  MeshFacts facts;
  facts.voxel_m = voxel_m, facts.kept_error_pct = error_pct;
  facts.distance_back = distance_from_to(plate(0.003), mesh);
  return lost_form(mesh, plate(0.003), facts, 200);
}

TEST(LostForm, ThePlateItselfHasIt) { EXPECT_FALSE(lost(plate(0.003), 0.001)); }

TEST(LostForm, AVolumeMoreThanATwentiethOff) {
  EXPECT_FALSE(lost(plate(0.003), 0.001, -4.9));
  for (const double percent : {-5.1, 5.1}) {
    const auto form = lost(plate(0.003), 0.001, percent);
    ASSERT_TRUE(form);
    EXPECT_TRUE(form->volume_lost);
    EXPECT_FALSE(form->extent_lost);
    EXPECT_EQ(form->triangles, 200);
    // 2 V / A of the plate, and A over the area of an equilateral triangle of 1.5 thicknesses, up to the next hundred.
    const double area = 2 * 0.06 * 0.06 + 4 * 0.06 * 0.003, thickness = 2 * 0.06 * 0.06 * 0.003 / area;
    EXPECT_NEAR(form->thickness_m, thickness, 1e-12);
    EXPECT_EQ(form->enough, 1100) << area / (0.433 * 2.25 * thickness * thickness);
  }
}

TEST(LostForm, ASwollenPlateByVoxels) {
  const auto form = lost(plate(0.012), 0.001);
  ASSERT_TRUE(form && form->extent_lost);
  EXPECT_NEAR(form->extent_m, 0.012, 1e-12);
  EXPECT_NEAR(form->wanted_m, 0.003, 1e-12);
  EXPECT_TRUE(lost(plate(0.0052), 0.001));
  EXPECT_FALSE(lost(plate(0.0052), 0.003)) << "less than two voxels, and on average less than one";
}

/// A tenth of the side and five voxels are gone.
TEST(LostForm, AnEndCutOff) {
  EXPECT_TRUE(lost(plate(0.003, 0.05), 0.001));
  EXPECT_FALSE(lost(plate(0.003, 0.0585), 0.001));
}

TEST(LostForm, OnlyANumberThatHelpsIsTold) {
  const TriangleSurface cut_off = plate(0.003, 0.05);
  MeshFacts facts;
  facts.distance_back = distance_from_to(plate(0.003), cut_off);
  const auto told = [&](int triangles) { return lost_form(cut_off, plate(0.003), facts, triangles).value().enough; };
  EXPECT_EQ(told(200), 1100);
  EXPECT_EQ(told(2000), 0) << "a surface of another program, with edges as short as it takes";
  facts.voxel_m = 0.001;
  EXPECT_EQ(told(2000), 4000) << "of voxels, which have no sharp ends";
}

/// Distances to the voxels' stairs alone are none of the triangles' doing.
TEST(LostForm, WhatSmoothingTookIsNotLost) {
  MeshFacts facts;
  facts.voxel_m = 0.001, facts.distance_back.p99_m = 0.02;
  EXPECT_FALSE(lost_form(plate(0.003), plate(0.003), facts, 200));
}

}  // namespace
}  // namespace trocar::lost_form_test
