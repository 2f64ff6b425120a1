#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/imaging/phantom/phantom_probe.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/phantom/anatomy.h"
#include "tissue/imaging/phantom/phantom_labels.h"

namespace trocar::variants_test {
namespace {

TEST(PhantomVariantNames, GoBothWays) {
  std::set<std::string_view> names;
  for (const PhantomVariant variant : kPhantomVariants) {
    EXPECT_EQ(phantom_variant(phantom_variant_name(variant)), variant);
    names.insert(phantom_variant_name(variant));
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"normal", "short-duct", "low-insertion", "fat", "artery-anterior"}));
  EXPECT_CONTAINS(test::message_of<InputError>([] { phantom_variant("Normal"); }),
                  "no phantom variant \"Normal\"; known: normal, short-duct");
}

TEST(PhantomVariantNames, SeedsGoThroughTheFive) {
  EXPECT_EQ(phantom_variant_of_seed(0), PhantomVariant::kNormal);
  std::set<PhantomVariant> met;
  for (std::uint64_t seed = 10; seed < 15; ++seed) met.insert(phantom_variant_of_seed(seed));
  EXPECT_EQ(met.size(), 5U);
  EXPECT_EQ(phantom_variant_of_seed(~std::uint64_t{0}), phantom_variant_of_seed(~std::uint64_t{0} % 5));
}

TEST(PhantomPatients, VaryWithinAFewPerCentAndAreAlwaysTheSame) {
  std::set<double> sizes;
  for (std::uint64_t patient = 1; patient <= 200; ++patient) {
    const phantom::Anatomy a = phantom::anatomy_of(PhantomVariant::kNormal, patient),
                           again = phantom::anatomy_of(PhantomVariant::kNormal, patient);
    EXPECT_NEAR(a.liver_scale, 1, 0.03);
    EXPECT_NEAR(a.sac_scale, 0.99, 0.07);
    EXPECT_NEAR(a.duct_calibre, 1, 0.12);
    EXPECT_NEAR(a.artery_calibre, 1, 0.12);
    EXPECT_NEAR(a.junction_mm, 0, 5);
    EXPECT_NEAR(a.omentum_mm, 8, 1.6);
    EXPECT_EQ(a.liver_scale, again.liver_scale);
    EXPECT_EQ(a.hilum_fat_mm, again.hilum_fat_mm);
    sizes.insert(a.liver_scale);
  }
  EXPECT_EQ(sizes.size(), 200U);
}

TEST(PhantomPatients, TheStandardOneIsTheShapeThatExercisesStandOn) {
  const phantom::Anatomy standard = phantom::anatomy_of(PhantomVariant::kNormal, 0);
  for (double x = -100; x < 150; x += 13)
    for (double y = -80; y < 100; y += 11)
      for (double z = -80; z < 100; z += 7) {
        const Eigen::Vector3d p(x, y, z);
        EXPECT_EQ(phantom::liver(p, standard), phantom_liver_mm(p));
        EXPECT_EQ(phantom::gallbladder(p, standard), phantom_gallbladder_mm(p));
      }
  // Measured from the first phantom: a change here changes every exercise on the liver.
  EXPECT_NEAR(phantom_liver_mm({60, 10, -16}), 0, 5);
  EXPECT_NEAR(phantom_gallbladder_mm({41, 39, -34}), -15, 0.05);
}

TEST(PhantomPatients, DifferInTheirVoxels) {
  const auto liver_ml = [](std::uint64_t patient) {
    const LabelVolume labels = make_phantom({.voxel_mm = 5, .noise_hu = 0, .patient = patient}).labels;
    return static_cast<double>(labels.label_counts().at(phantom_label::kLiver)) * labels.voxel_volume_ml();
  };
  const double standard = liver_ml(0);
  EXPECT_NEAR(liver_ml(3) / standard, 1, 0.1);
  EXPECT_NE(liver_ml(3), standard);
  EXPECT_EQ(liver_ml(3), liver_ml(3));
}

TEST(PhantomLabels, AgreeWithTheTableWhoseNumbersTheyBorrow) {
  const LabelTable &ours = label_table(kPhantomTable), &borrowed = label_table("totalsegmentator-v1");
  std::set<int> numbers;
  std::set<std::string_view> names;
  for (const LabelName& entry : ours.labels) {
    EXPECT_TRUE(numbers.insert(entry.number).second) << entry.number;
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_LT(entry.number, 256);  // fits one byte
    EXPECT_EQ(borrowed.number_of(entry.name).value_or(entry.number), entry.number) << entry.name;
    EXPECT_EQ(borrowed.name_of(entry.number).value_or(entry.name), entry.name);
    EXPECT_EQ(entry.number < 200, borrowed.number_of(entry.name).has_value()) << entry.name;
  }
}

}  // namespace
}  // namespace trocar::variants_test
