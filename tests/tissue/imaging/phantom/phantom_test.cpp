#include "tissue/imaging/phantom/phantom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/tissue/support/label_files.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/labels/label_mask.h"
#include "tissue/imaging/volumes/nifti_writer.h"

namespace trocar::phantom_test {
namespace {

const CtPhantom& phantom() {
  static const CtPhantom made = make_phantom({});
  return made;
}

double millilitres(int label) {
  return static_cast<double>(phantom().labels.label_counts().at(label)) * phantom().labels.voxel_volume_ml();
}

double mean_hu(int label) {
  double sum = 0, count = 0;
  for (std::size_t n = 0; n < phantom().hounsfield.size(); ++n)
    if (phantom().labels.labels[n] == label) sum += phantom().hounsfield[n], ++count;
  return sum / count;
}

// Adult ranges as radiology textbooks give them.
TEST(Phantom, OrgansHaveAdultVolumes) {
  struct Range {
    int label;
    double least, most;
  };
  for (const Range& range :
       {Range{5, 1200, 1800}, Range{4, 25, 50}, Range{1, 100, 250}, Range{2, 120, 200}, Range{3, 120, 200}}) {
    EXPECT_GT(millilitres(range.label), range.least) << range.label;
    EXPECT_LT(millilitres(range.label), range.most) << range.label;
  }
}

TEST(Phantom, OrgansAreWholeAndWithinTheImage) {
  for (const int label : {1, 2, 3, 4, 5}) {
    const LabelMask mask = cut_out_label(phantom().labels, label, 1);
    EXPECT_TRUE(mask.lost_parts.empty()) << label;
    EXPECT_EQ(mask.border_voxels, 0U) << label;
  }
}

TEST(Phantom, TissuesHaveTheirHounsfieldValues) {
  EXPECT_NEAR(mean_hu(5), 112, 12);  // partial volume at the surface pulls towards fat
  EXPECT_NEAR(mean_hu(4), 8, 20);    // a small sac has more surface for its volume
  EXPECT_LT(*std::min_element(phantom().hounsfield.begin(), phantom().hounsfield.end()), -1000);
}

TEST(Phantom, LiverLiesOnTheRightAndTheSpleenOnTheLeft) {
  const LabelVolume& labels = phantom().labels;
  Eigen::Vector3d liver = Eigen::Vector3d::Zero(), spleen = liver;
  for (int k = 0; k < labels.size[2]; ++k)
    for (int j = 0; j < labels.size[1]; ++j)
      for (int i = 0; i < labels.size[0]; ++i) {
        const int label = labels.labels[labels.offset(i, j, k)];
        if (label == 5) liver += labels.index_to_ras_mm * Eigen::Vector3d(i, j, k);
        if (label == 1) spleen += labels.index_to_ras_mm * Eigen::Vector3d(i, j, k);
      }
  EXPECT_GT(liver.x(), 0);
  EXPECT_LT(spleen.x(), 0);
}

TEST(Phantom, GallbladderLiesInAFossaWithoutCuttingTheLiver) {
  std::size_t near = 0;
  for (int x = 0; x < 80; x += 2)
    for (int y = -20; y < 90; y += 2)
      for (int z = -80; z < 40; z += 2) {
        const Eigen::Vector3d p(x, y, z);
        const double sac = phantom_gallbladder_mm(p), liver = phantom_liver_mm(p);
        EXPECT_FALSE(sac < 0 && liver < 0) << p.transpose();
        near += std::abs(sac) < 4 && liver < 0 ? 1 : 0;
      }
  EXPECT_GT(near, 200U);  // of 8 mm3 each: the bed is broad
}

TEST(Phantom, SeedChangesTheNoiseAndNothingElse) {
  const CtPhantom again = make_phantom({.voxel_mm = 8}), other = make_phantom({.voxel_mm = 8, .seed = 2}),
                  same = make_phantom({.voxel_mm = 8});
  EXPECT_EQ(again.hounsfield, same.hounsfield);
  EXPECT_NE(again.hounsfield, other.hounsfield);
  EXPECT_EQ(again.labels.labels, other.labels.labels);
}

TEST(NiftiWriter, WhatIsWrittenIsReadBack) {
  test::TemporaryFolder folder;
  const CtPhantom small = make_phantom({.voxel_mm = 10});
  const LabelVolume& labels = small.labels;
  const auto map = folder.write("labels.nii.gz", nifti_gz_bytes(labels.size, labels.index_to_ras_mm, labels.labels));
  const auto ct = folder.write("ct.nii.gz", nifti_gz_bytes(labels.size, labels.index_to_ras_mm, small.hounsfield));
  const LabelVolume back = test::read_label_volume(map);
  EXPECT_EQ(back.labels, labels.labels);
  EXPECT_EQ(back.size, labels.size);
  EXPECT_TRUE(back.index_to_ras_mm.isApprox(labels.index_to_ras_mm, 1e-6));
  EXPECT_TRUE(back.notes.empty());
  EXPECT_TRUE(certainly_hounsfield(read_image_volume(ct)));
}

TEST(NiftiWriter, RefusesASizeThatDoesNotFit) {
  EXPECT_THROW(nifti_gz_bytes({2, 2, 2}, Eigen::Affine3d::Identity(), std::vector<std::int16_t>(7)),
               std::invalid_argument);
}

}  // namespace
}  // namespace trocar::phantom_test
