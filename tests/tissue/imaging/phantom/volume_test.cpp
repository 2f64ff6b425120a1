// The phantom as voxels: what is drawn is whole, lies where it must, and looks like a portal venous CT.
#include <gtest/gtest.h>

#include <algorithm>

#include "haptics/input_error.h"
#include "tests/tissue/imaging/phantom/phantom_probe.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/phantom/phantom_labels.h"

namespace trocar::volume_test {
namespace {

namespace label = phantom_label;

const std::set<int> kWholeOrgans{label::kSpleen,
                                 label::kKidneyRight,
                                 label::kKidneyLeft,
                                 label::kGallbladder,
                                 label::kLiver,
                                 label::kStomach,
                                 label::kAorta,
                                 label::kVenaCava,
                                 label::kPortalVein,
                                 label::kPancreas,
                                 label::kAdrenalRight,
                                 label::kAdrenalLeft,
                                 label::kOesophagus,
                                 label::kSmallBowel,
                                 label::kDuodenum,
                                 label::kColon,
                                 label::kCysticDuct,
                                 label::kHepaticDuct,
                                 label::kBileDuct,
                                 label::kHepaticArtery,
                                 label::kRightHepaticArtery,
                                 label::kLeftHepaticArtery,
                                 label::kCysticArtery,
                                 label::kSkin,
                                 label::kSubcutaneousFat,
                                 label::kHilumFat,
                                 label::kOmentum,
                                 label::kDiaphragm,
                                 label::kVertebrae,
                                 label::kHeart};

/// The liver and the gallbladder of the first phantom, voxel by voxel: exercises, recordings and shipped organs stand
/// on them.
TEST(PhantomVolume, StandardLiverAndGallbladderAreThoseThatShip) {
  const LabelVolume labels = make_phantom({}).labels;
  auto counts = labels.label_counts();
  EXPECT_EQ(counts.at(label::kLiver), 101906U);
  EXPECT_EQ(counts.at(label::kGallbladder), 2433U);
  EXPECT_EQ(test::mask_hash(labels, label::kLiver, -120), 0xc80943f22f74a1cfULL);
  EXPECT_EQ(test::mask_hash(labels, label::kGallbladder, -120), 0x7e5f8e9cf5fbe80cULL);
  EXPECT_EQ(labels.index_to_ras_mm.translation(), Eigen::Vector3d(-175, -120, -150));
}

class PhantomVariants : public ::testing::TestWithParam<PhantomVariant> {};

std::string name_of(const ::testing::TestParamInfo<PhantomVariant>& parameter) {
  std::string name(phantom_variant_name(parameter.param));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(All, PhantomVariants, ::testing::ValuesIn(kPhantomVariants), name_of);

struct Range {
  int label;
  double least, most;
};

void expect_volumes(const LabelVolume& labels, std::initializer_list<Range> ranges) {
  const auto counts = labels.label_counts();
  for (const Range& range : ranges) {
    const double volume = static_cast<double>(counts.at(range.label)) * labels.voxel_volume_ml();
    EXPECT_GT(volume, range.least) << range.label;
    EXPECT_LT(volume, range.most) << range.label;
  }
}

void expect_whole(const LabelVolume& labels) {
  const test::Count parts = test::parts_of(labels);
  for (const LabelName& entry : kPhantomLabels) {
    ASSERT_TRUE(parts.count(entry.number) > 0) << entry.name << " marks no voxel";
    EXPECT_TRUE(kWholeOrgans.count(entry.number) == 0 || parts.at(entry.number) == 1)
        << entry.name << ": " << parts.at(entry.number) << " parts";
  }
}

void expect_contacts(const LabelVolume& labels, bool anterior) {
  const auto contacts = test::contacts_of(labels);
  const auto touch = [&](int a, int b) { return contacts.at(a).count(b) > 0; };
  EXPECT_TRUE(touch(label::kCysticDuct, label::kGallbladder));
  EXPECT_TRUE(touch(label::kCysticDuct, label::kBileDuct) || touch(label::kCysticDuct, label::kHepaticDuct));
  EXPECT_TRUE(touch(label::kHepaticDuct, label::kBileDuct));
  EXPECT_TRUE(touch(label::kHepaticDuct, label::kLiver));
  EXPECT_TRUE(touch(label::kBileDuct, label::kDuodenum));
  EXPECT_TRUE(touch(label::kCysticArtery, label::kGallbladder));
  EXPECT_TRUE(touch(label::kCysticArtery, anterior ? label::kHepaticArtery : label::kRightHepaticArtery));
  EXPECT_TRUE(touch(label::kRightHepaticArtery, label::kHepaticArtery));
  EXPECT_TRUE(touch(label::kHepaticArtery, label::kAorta));
  EXPECT_TRUE(touch(label::kPortalVein, label::kLiver));
  EXPECT_TRUE(touch(label::kStomach, label::kDuodenum));
  EXPECT_TRUE(touch(label::kStomach, label::kOesophagus));
  EXPECT_TRUE(touch(label::kDuodenum, label::kSmallBowel));
  // The critical view can be reached: two structures enter the gallbladder, and fat lies between it and its bed.
  std::size_t all = 0, bed = 0;
  for (const auto& [neighbour, faces] : contacts.at(label::kGallbladder)) {
    const bool tube = (neighbour >= label::kCysticDuct && neighbour <= label::kLeftHepaticArtery) ||
                      (neighbour >= label::kAorta && neighbour <= label::kPortalVein);
    EXPECT_TRUE(!tube || neighbour == label::kCysticDuct || neighbour == label::kCysticArtery)
        << "the gallbladder touches " << neighbour;
    all += faces, bed += neighbour == label::kLiver ? faces : 0;
  }
  EXPECT_LT(static_cast<double>(bed), 0.03 * static_cast<double>(all));
}

/// Adult ranges as anatomy and radiology give them; tubes of the gut as far as the field shows them.
TEST_P(PhantomVariants, OrgansAreWholeInPlaceAndOfAdultSize) {
  for (const std::uint64_t patient : {0, 5}) {
    const LabelVolume labels = make_phantom({.noise_hu = 0, .variant = GetParam(), .patient = patient}).labels;
    expect_whole(labels);
    expect_contacts(labels, GetParam() == PhantomVariant::kArteryAnterior);
    expect_volumes(labels, {{label::kLiver, 1000, 1800},
                            {label::kGallbladder, 20, 60},
                            {label::kSpleen, 100, 250},
                            {label::kKidneyRight, 120, 200},
                            {label::kKidneyLeft, 120, 200},
                            {label::kStomach, 150, 600},
                            {label::kPancreas, 25, 110},
                            {label::kDuodenum, 50, 130},
                            {label::kPortalVein, 8, 40},
                            {label::kAdrenalRight, 0.5, 6},
                            {label::kAdrenalLeft, 0.5, 6},
                            {label::kSmallBowel, 250, 900},
                            {label::kColon, 200, 900},
                            {label::kVertebrae, 300, 700},
                            {label::kBileDuct, 0.3, 4}});
  }
}

TEST_P(PhantomVariants, OrgansEndWithinTheFieldUnlessTheyLeaveIt) {
  const LabelVolume labels = make_phantom({.voxel_mm = 4, .noise_hu = 0, .variant = GetParam()}).labels;
  const std::set<int> leave{0,
                            label::kAorta,
                            label::kVenaCava,
                            label::kOesophagus,
                            label::kColon,
                            label::kSmallBowel,
                            label::kSkin,
                            label::kSubcutaneousFat,
                            label::kMuscle,
                            label::kVisceralFat,
                            label::kOmentum,
                            label::kVertebrae,
                            label::kRibs,
                            label::kLungs,
                            label::kHeart,
                            label::kDiaphragm};
  for (int k = 0; k < labels.size[2]; ++k)
    for (int j = 0; j < labels.size[1]; ++j)
      for (int i = 0; i < labels.size[0]; ++i) {
        const bool side = i == 0 || j == 0 || i + 1 == labels.size[0] || j + 1 == labels.size[1];
        const bool end = k == 0 || k + 1 == labels.size[2];
        const int found = labels.labels[labels.offset(i, j, k)];
        ASSERT_TRUE(!side || found == 0) << "the body is cut at its side";
        ASSERT_TRUE(!end || leave.count(found) > 0) << found;
      }
}

TEST(PhantomVolume, FinerVoxelsDrawTheSameOrgans) {
  const LabelVolume coarse = make_phantom({.voxel_mm = 4, .noise_hu = 0}).labels,
                    fine = make_phantom({.voxel_mm = 2, .noise_hu = 0}).labels;
  const auto few = coarse.label_counts(), many = fine.label_counts();
  for (const int number :
       {label::kLiver, label::kSpleen, label::kStomach, label::kColon, label::kSmallBowel, label::kDuodenum})
    EXPECT_NEAR(static_cast<double>(many.at(number)) / static_cast<double>(few.at(number)), 8, 0.16) << number;
  const PhantomTube duct = test::tube_of(phantom_hilum(PhantomVariant::kNormal), label::kBileDuct);
  const double drawn = duct.length_mm() * 3.14159 * duct.radii_mm[0] * duct.radii_mm[0] / 1000;
  EXPECT_NEAR(static_cast<double>(many.at(label::kBileDuct)) * fine.voxel_volume_ml() / drawn, 1, 0.15);
}

TEST(PhantomVolume, HounsfieldValuesAreThoseOfThePortalVenousPhase) {
  const CtPhantom phantom = make_phantom({.voxel_mm = 2});
  struct Value {
    int label;
    double hounsfield, within;
  };
  for (const Value& value :
       {Value{label::kLiver, 113, 4}, Value{label::kSpleen, 122, 4}, Value{label::kKidneyRight, 180, 14},
        Value{label::kGallbladder, 10, 8}, Value{label::kAorta, 152, 12}, Value{label::kVenaCava, 140, 4},
        Value{label::kPortalVein, 170, 5}, Value{label::kPancreas, 92, 12}, Value{label::kMuscle, 57, 6},
        Value{label::kSubcutaneousFat, -105, 4}, Value{label::kVisceralFat, -100, 4}, Value{label::kLungs, -850, 12},
        Value{0, -1000, 4}})
    EXPECT_NEAR(test::core_hounsfield(phantom, value.label), value.hounsfield, value.within) << value.label;
  EXPECT_GT(test::core_hounsfield(phantom, label::kVertebrae), 150);
  EXPECT_GE(*std::min_element(phantom.hounsfield.begin(), phantom.hounsfield.end()), -1024);
}

/// A tube thinner than a voxel is seen as the share of the voxel that it fills, not as all or nothing.
TEST(PhantomVolume, ThinArteriesShowByPartialVolume) {
  const CtPhantom phantom = make_phantom({.noise_hu = 0});
  const double artery = test::mean_hounsfield(phantom, label::kCysticArtery);
  EXPECT_GT(artery, -85);
  EXPECT_LT(artery, 120);
  EXPECT_GT(test::mean_hounsfield(phantom, label::kHepaticArtery), artery + 40);
}

TEST(PhantomVolume, NoiseHasTheStatedDeviationAndLeavesTheLabels) {
  const CtPhantom quiet = make_phantom({.voxel_mm = 4, .noise_hu = 0}),
                  noisy = make_phantom({.voxel_mm = 4, .noise_hu = 12, .seed = 9}),
                  again = make_phantom({.voxel_mm = 4, .noise_hu = 12, .seed = 9}),
                  other = make_phantom({.voxel_mm = 4, .noise_hu = 12, .seed = 10});
  double sum = 0, square = 0, count = 0;
  for (std::size_t n = 0; n < quiet.hounsfield.size(); ++n) {
    if (quiet.hounsfield[n] < -900) continue;  // clamped below
    const double noise = noisy.hounsfield[n] - quiet.hounsfield[n];
    sum += noise, square += noise * noise, ++count;
  }
  EXPECT_NEAR(sum / count, 0, 0.2);
  EXPECT_NEAR(std::sqrt(square / count), 12, 0.3);
  EXPECT_EQ(noisy.hounsfield, again.hounsfield);
  EXPECT_NE(noisy.hounsfield, other.hounsfield);
  EXPECT_EQ(quiet.labels.labels, other.labels.labels);
}

/// A tube that touched itself would close a ring: an Euler number of one says one part, no tunnel, no cavity.
TEST(PhantomVolume, BowelAndVesselsNeitherCrossNorTouchThemselves) {
  const LabelVolume labels = make_phantom({.voxel_mm = 1.5, .noise_hu = 0}).labels;
  expect_whole(labels);
  for (const int number :
       {label::kSmallBowel, label::kColon, label::kDuodenum, label::kStomach, label::kSpleen, label::kPortalVein,
        label::kCysticDuct, label::kHepaticDuct, label::kBileDuct, label::kHepaticArtery, label::kRightHepaticArtery,
        label::kCysticArtery, label::kLiver, label::kGallbladder})
    EXPECT_EQ(test::euler_number(labels, number), 1) << number;
  const auto contacts = test::contacts_of(labels);
  for (const int other : {label::kColon, label::kLiver, label::kGallbladder})
    EXPECT_EQ(contacts.at(label::kSmallBowel).count(other), 0U) << other;
}

TEST(PhantomVolume, RefusesSizesThatMakeNoSense) {
  for (const double voxel : {0.0, -1.0, 0.5, 100.0, std::nan("")})
    EXPECT_CONTAINS(test::message_of<InputError>([&] { make_phantom({.voxel_mm = voxel}); }), "voxel");
  for (const double noise : {-1.0, 1e4, std::nan("")})
    EXPECT_CONTAINS(test::message_of<InputError>([&] { make_phantom({.noise_hu = noise}); }), "noise");
}

TEST(PhantomVolume, TellsHowFarItIsAndCanBeStopped) {
  std::set<std::string> stages;
  double last = 0;
  make_phantom({.voxel_mm = 10}, [&](std::string_view stage, double share) {
    stages.emplace(stage);
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
    last = share;
  });
  EXPECT_EQ(stages, (std::set<std::string>{"drawing organs", "noise and point spread", "partial volume"}));
  struct Stop {};
  EXPECT_THROW(make_phantom({.voxel_mm = 10}, [](std::string_view, double) { throw Stop(); }), Stop);
}

}  // namespace
}  // namespace trocar::volume_test
