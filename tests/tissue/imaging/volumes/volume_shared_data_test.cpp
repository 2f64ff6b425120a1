// Real volumes in their real containers; skipped, loudly, where the shared data folder is missing.
#include <cstdlib>
#include <iostream>

#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tests/tissue/support/label_files.h"
#include "tissue/imaging/labels/label_choice.h"
#include "tissue/imaging/labels/label_grid.h"
#include "tissue/imaging/labels/label_mask.h"
#include "tissue/imaging/labels/segmentation.h"

namespace trocar::volume_shared_data_test {
namespace {

class SharedVolumes : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* elsewhere = std::getenv("TROCAR_SHARED");
    data_ = std::filesystem::path(elsewhere != nullptr ? elsewhere : TROCAR_SOURCE_DIR "/../shared") / "data";
    if (std::filesystem::is_directory(data_)) return;
    std::cerr << "SKIPPED: no shared data in " << data_ << "; real volumes were NOT tested\n";
    GTEST_SKIP() << "no shared data in " << data_;
  }

  std::filesystem::path abdomen(const std::string& name) const { return data_ / "ct_abdomen_totalseg" / name; }
  std::filesystem::path other(const std::string& name) const { return data_ / "volumes_other" / name; }

  std::filesystem::path data_;
};

std::vector<std::uint16_t> only(const LabelVolume& volume, int label) {
  std::vector<std::uint16_t> mask;
  for (const std::uint16_t value : volume.labels) mask.push_back(value == label ? 1 : 0);
  return mask;
}

TEST_F(SharedVolumes, OneLiverInSixContainersIsOneArrayInOnePlace) {
  const LabelMap wanted = read_label_map(abdomen("masks_v1/liver.nii.gz"));
  EXPECT_EQ(wanted.layers.front().label_counts().at(1), 41602U);
  for (const char* file :
       {"liver_u8_plain.nii", "liver_u8_LAS.nii.gz", "liver_u8_lps.nrrd", "liver_u8.mha", "abdomen.seg.nrrd"}) {
    const LabelMap map = read_label_map(abdomen("derived_same_liver") / file);
    ASSERT_EQ(map.layers.size(), 1U) << file;
    const LabelVolume& layer = map.layers.front();
    const bool segments = std::string(file) == "abdomen.seg.nrrd";
    const Segment liver = choose_segment(map, segments ? "liver" : "1", nullptr, file);
    EXPECT_EQ(only(layer, liver.number), wanted.layers.front().labels) << file;
    EXPECT_TRUE(same_grid(grid_of(layer), grid_of(wanted.layers.front()), 1e-3)) << file;  // 1e-6 m
    EXPECT_EQ(layer.index_to_ras_mm.matrix(), wanted.layers.front().index_to_ras_mm.matrix()) << file;
  }
  const LabelMap segments = read_label_map(abdomen("derived_same_liver/abdomen.seg.nrrd"));
  ASSERT_EQ(segments.segments.size(), 3U);
  for (const char* name : {"liver", "gallbladder", "spleen"})
    EXPECT_NO_THROW(choose_segment(segments, name, nullptr, "abdomen"));
}

TEST_F(SharedVolumes, LiverCentroidIsWhereItWasMeasured) {
  const LabelVolume liver = read_label_map(abdomen("derived_same_liver/liver_u8.mha")).layers.front();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t voxel = 0, count = 0;
  for (int k = 0; k < liver.size[2]; ++k)
    for (int j = 0; j < liver.size[1]; ++j)
      for (int i = 0; i < liver.size[0]; ++i, ++voxel)
        if (liver.labels[voxel] == 1) sum += liver.index_to_ras_mm * Eigen::Vector3d(i, j, k), ++count;
  EXPECT_LT((sum / static_cast<double>(count) - Eigen::Vector3d(66.062, 185.459, 392.340)).norm(), 2e-3);
}

TEST_F(SharedVolumes, NamedTablesAgreeWithTheMasks) {
  const LabelMap v1 = read_label_map(abdomen("example_seg.nii.gz"));
  const LabelTable& table = label_table("totalsegmentator-v1");
  for (const char* name : {"liver", "spleen", "kidney_right", "urinary_bladder", "hip_left", "vertebrae_L3",
                           "heart_myocardium", "colon"}) {
    const Segment segment = choose_segment(v1, name, &table, "example_seg");
    const LabelVolume mask = test::read_label_volume(abdomen("masks_v1/" + std::string(name) + ".nii.gz"));
    EXPECT_EQ(only(v1.layers.front(), segment.number), mask.labels) << name;
  }
  LabelMap v2 = read_label_map(abdomen("example_seg_fast_force_split.nii.gz"));
  EXPECT_EQ(v2.segments.size(), 61U);
  for (Segment& segment : v2.segments) {  // the file names its labels itself, as the table does
    EXPECT_EQ(segment.name, label_table("totalsegmentator-v2").name_of(segment.number));
    segment.name.clear();
  }
  const Segment liver = choose_segment(v2, "liver", &label_table("totalsegmentator-v2"), "v2");
  EXPECT_GT(dice(v2.layers.front(), liver.number, v1.layers.front(), 5), 0.9);  // two models, one liver
  const Segment aorta = choose_segment(v2, "aorta", &label_table("totalsegmentator-v2"), "v2");
  EXPECT_GT(dice(v2.layers.front(), aorta.number, v1.layers.front(), 7), 0.8);
  EXPECT_EQ(guess_label_table(v2), (std::vector<std::string>{"totalsegmentator-v2"}));
  const LabelMap mr = read_label_map(data_ / "mr_abdomen_totalseg" / "example_seg_mr.nii.gz");
  EXPECT_EQ(mr.segments.size(), 23U);
  EXPECT_EQ(choose_segment(mr, "colon", &label_table("totalsegmentator-mr"), "mr").number, 15);
}

TEST_F(SharedVolumes, ImagesHaveTheirPublishedRange) {
  const auto range = [](const ImageVolume& image) {
    const auto [low, high] = std::minmax_element(image.values.begin(), image.values.end());
    return std::pair<float, float>(*low, *high);
  };
  const ImageVolume ct = read_image_volume(abdomen("example_ct.nii.gz"));
  EXPECT_EQ(range(ct), (std::pair<float, float>(-1207, 3382)));
  EXPECT_TRUE(certainly_hounsfield(ct));
  EXPECT_EQ(range(read_image_volume(data_ / "mr_abdomen_totalseg" / "example_mr_sm.nii.gz")),
            (std::pair<float, float>(-47, 833)));
  const ImageVolume lung = read_image_volume(other("3DCT_lung_baseline_small.mha"));
  EXPECT_EQ(range(lung), (std::pair<float, float>(-1130, 1379)));
  EXPECT_EQ(lung.size, (std::array<int, 3>{57, 78, 64}));
}

TEST_F(SharedVolumes, LungMaskGoesToTheGridOfItsVolume) {
  const ImageVolume image = read_image_volume(other("3DCT_lung_baseline_small.mha"));
  const LabelMap map = read_label_map(other("3DCT_lung_baseline_mask.mha"));
  const LabelVolume& mask = map.layers.front();
  EXPECT_FALSE(same_grid(grid_of(image), grid_of(mask)));
  const LabelVolume moved = on_grid_of(image, mask, "lung");
  const double before = static_cast<double>(mask.label_counts().at(1)) * mask.voxel_volume_ml();
  const double after = static_cast<double>(moved.label_counts().at(1)) * moved.voxel_volume_ml();
  EXPECT_NEAR(after / before, 1, 0.03);
  double inside = 0, outside = 0;
  std::size_t count = 0;
  for (std::size_t voxel = 0; voxel < image.values.size(); ++voxel) {
    (moved.labels[voxel] == 1 ? inside : outside) += image.values[voxel];
    count += moved.labels[voxel];
  }
  EXPECT_LT(inside / static_cast<double>(count), -600);  // the mask holds lung: air
  const LabelVolume liver = test::read_label_volume(abdomen("masks_v1/liver.nii.gz"));
  EXPECT_CONTAINS(test::message_of<InputError>([&] { on_grid_of(image, liver, "liver.nii.gz"); }),
                  "mm outside the image");
}

TEST_F(SharedVolumes, ImagesAndUnitlessVolumesAreRefusedWithAHint) {
  EXPECT_CONTAINS(test::map_refusal(abdomen("example_ct.nii.gz")), "--threshold");
  const std::string message = test::image_refusal(other("pelvis_f.mhd"));
  EXPECT_CONTAINS(message, "voxel size 0.0078125 mm");
  EXPECT_CONTAINS(message, "--unit");
  const ImageVolume pelvis = read_image_volume(other("pelvis_f.mhd"), {}, {.unit = "dm", .space = ""});
  EXPECT_EQ(pelvis.size, (std::array<int, 3>{221, 271, 69}));
  EXPECT_EQ(*std::max_element(pelvis.values.begin(), pelvis.values.end()), 226);
}

// What a window and a seed can do without anatomy: measured, not wished.
TEST_F(SharedVolumes, SeededOrgansOfTheAbdomenAgainstTheirMasks) {
  const ImageVolume ct = read_image_volume(abdomen("example_ct.nii.gz"));
  const auto score = [&](const std::string& organ, double low, double high, double opening, double reach) {
    const LabelVolume mask = test::read_label_volume(abdomen("masks_v1/" + organ + ".nii.gz"));
    std::vector<Eigen::Vector3d> inside;
    std::size_t voxel = 0;
    for (int k = 0; k < mask.size[2]; ++k)
      for (int j = 0; j < mask.size[1]; ++j)
        for (int i = 0; i < mask.size[0]; ++i)
          if (mask.labels[voxel++] != 0) inside.push_back(mask.index_to_ras_mm * Eigen::Vector3d(i, j, k));
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& place : inside) middle += place / static_cast<double>(inside.size());
    SegmentationOptions options;
    options.low = low, options.high = high, options.opening_mm = opening, options.closing_mm = 4,
    options.reach_mm = reach;
    options.smooth = true, options.seed_ras_mm = middle;
    const LabelVolume result = segment(ct, options);
    const double value = dice(result, 1, mask, 1);
    std::cout << organ << ": Dice " << value << "\n";
    for (const std::string& note : result.notes) std::cout << "  " << note << "\n";
    return value;
  };
  EXPECT_GT(score("liver", 25, 80, 6, 140), 0.8);
  EXPECT_GT(score("spleen", 15, 70, 6, 70), 0.7);
}

}  // namespace
}  // namespace trocar::volume_shared_data_test
