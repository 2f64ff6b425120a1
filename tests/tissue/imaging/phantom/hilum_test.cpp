// The five anatomies of E14: courses and calibres of ducts and arteries, and the triangle in which the surgeon works.
#include "tissue/imaging/phantom/hilum.h"

#include <gtest/gtest.h>

#include "tests/tissue/imaging/phantom/phantom_probe.h"
#include "tissue/imaging/phantom/phantom_labels.h"

namespace trocar::hilum_test {
namespace {

namespace label = phantom_label;
using test::gap_between;
using test::tube_of;
using Vec = Eigen::Vector3d;

constexpr std::array<std::uint64_t, 5> kPatients{0, 1, 2, 3, 1000003};

class Hilum : public ::testing::TestWithParam<PhantomVariant> {
 protected:
  static PhantomVariant variant() { return GetParam(); }
};

std::string name_of(const ::testing::TestParamInfo<PhantomVariant>& info) {
  std::string name(phantom_variant_name(info.param));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Variants, Hilum, ::testing::ValuesIn(kPhantomVariants), name_of);

TEST_P(Hilum, TubesHaveTheCalibresOfAdults) {
  struct Range {
    int label;
    double least, most;  // outer diameter, mm
  };
  for (const std::uint64_t patient : kPatients)
    for (const Range& range :
         {Range{label::kCysticDuct, 2, 4}, Range{label::kHepaticDuct, 4, 6}, Range{label::kBileDuct, 4, 7},
          Range{label::kHepaticArtery, 4, 6}, Range{label::kRightHepaticArtery, 2.5, 4.5},
          Range{label::kLeftHepaticArtery, 2.5, 4}, Range{label::kCysticArtery, 1.5, 2.5}}) {
      const PhantomTube tube = tube_of(phantom_hilum(variant(), patient), range.label);
      ASSERT_FALSE(tube.points_mm.empty()) << range.label;
      EXPECT_EQ(tube.points_mm.size(), tube.radii_mm.size());
      for (const double radius : tube.radii_mm) {
        EXPECT_GT(2 * radius, range.least) << tube.name;
        EXPECT_LT(2 * radius, range.most) << tube.name;
      }
    }
}

TEST_P(Hilum, CysticDuctHasTheLengthOfItsVariant) {
  for (const std::uint64_t patient : kPatients) {
    const double length = tube_of(phantom_hilum(variant(), patient), label::kCysticDuct).length_mm();
    const bool is_short = variant() == PhantomVariant::kShortDuct, is_low = variant() == PhantomVariant::kLowInsertion;
    EXPECT_GT(length, is_short ? 8 : is_low ? 55 : 29) << patient;
    EXPECT_LT(length, is_short ? 20 : is_low ? 85 : 45) << patient;
  }
}

TEST_P(Hilum, DuctsMeetInOnePointAndTheBileDuctEndsInTheDuodenum) {
  for (const std::uint64_t patient : kPatients) {
    const auto tubes = phantom_hilum(variant(), patient);
    const Vec junction = tube_of(tubes, label::kCysticDuct).points_mm.back();
    EXPECT_EQ(tube_of(tubes, label::kHepaticDuct).points_mm.back(), junction);
    EXPECT_EQ(tube_of(tubes, label::kBileDuct).points_mm.front(), junction);
    EXPECT_LT((tube_of(tubes, label::kBileDuct).points_mm.back() - Vec(35, -5, -75)).norm(),
              12.5);  // wall of the descending part
  }
}

TEST_P(Hilum, TwoStructuresAndNoMoreEnterTheGallbladder) {
  for (const std::uint64_t patient : kPatients) {
    const phantom::Anatomy anatomy = phantom::anatomy_of(variant(), patient);
    for (const PhantomTube& tube : phantom_hilum(variant(), patient)) {
      double nearest = 1e9;
      for (std::size_t n = 0; n < tube.points_mm.size(); ++n)
        nearest = std::min(nearest, phantom::gallbladder(tube.points_mm[n], anatomy) - tube.radii_mm[n]);
      const bool enters = tube.label == label::kCysticDuct || tube.label == label::kCysticArtery;
      EXPECT_TRUE(enters ? nearest < 0 : nearest > 3) << tube.name << " " << nearest;
    }
  }
}

TEST_P(Hilum, OnlyWhatBelongsThereEntersTheLiver) {
  for (const std::uint64_t patient : kPatients) {
    const phantom::Anatomy anatomy = phantom::anatomy_of(variant(), patient);
    for (const PhantomTube& tube : phantom_hilum(variant(), patient)) {
      const bool enters = tube.label == label::kHepaticDuct || tube.label == label::kRightHepaticArtery ||
                          tube.label == label::kLeftHepaticArtery;
      std::size_t crossings = 0;
      double nearest = 1e9;
      for (std::size_t n = 0; n < tube.points_mm.size(); ++n) {
        const double d = phantom::liver(tube.points_mm[n], anatomy);
        nearest = std::min(nearest, d - tube.radii_mm[n]);
        if (n > 0 && (d < 0) != (phantom::liver(tube.points_mm[n - 1], anatomy) < 0)) ++crossings;
      }
      EXPECT_EQ(crossings, enters ? 1U : 0U) << tube.name;
      EXPECT_TRUE(enters || nearest > 1) << tube.name << " " << nearest;
    }
  }
}

TEST_P(Hilum, TubesThatDoNotMeetKeepApart) {
  const std::set<std::pair<int, int>> meet{{label::kBileDuct, label::kHepaticDuct},
                                           {label::kBileDuct, label::kCysticDuct},
                                           {label::kHepaticDuct, label::kCysticDuct},
                                           {label::kHepaticArtery, label::kRightHepaticArtery},
                                           {label::kHepaticArtery, label::kLeftHepaticArtery},
                                           {label::kRightHepaticArtery, label::kLeftHepaticArtery}};
  for (const std::uint64_t patient : kPatients) {
    const auto tubes = phantom_hilum(variant(), patient);
    for (std::size_t a = 0; a < tubes.size(); ++a)
      for (std::size_t b = a + 1; b < tubes.size(); ++b) {
        if (meet.count({tubes[a].label, tubes[b].label}) > 0) continue;
        const bool anterior = variant() == PhantomVariant::kArteryAnterior;
        const bool gives_the_cystic =
            tubes[b].label == label::kCysticArtery &&
            (anterior ? tubes[a].label != label::kHepaticDuct && tubes[a].label <= label::kLeftHepaticArtery &&
                            tubes[a].label >= label::kHepaticArtery
                      : tubes[a].label == label::kRightHepaticArtery);
        double gap = 1e9;  // outside the gallbladder, in whose neck duct and artery end
        for (std::size_t n = 0; n < tubes[a].points_mm.size(); ++n)
          for (std::size_t m = 0; m < tubes[b].points_mm.size(); ++m)
            if (phantom_gallbladder_mm(tubes[a].points_mm[n]) > 0.5 &&
                phantom_gallbladder_mm(tubes[b].points_mm[m]) > 0)
              gap = std::min(gap, (tubes[a].points_mm[n] - tubes[b].points_mm[m]).norm() - tubes[a].radii_mm[n] -
                                      tubes[b].radii_mm[m]);
        EXPECT_TRUE(gives_the_cystic || gap > 0.4)
            << tubes[a].name << " " << tubes[b].name << " " << patient << ": " << gap;
      }
  }
}

TEST_P(Hilum, TheCysticArteryArisesFromAnArtery) {
  for (const std::uint64_t patient : kPatients) {
    const auto tubes = phantom_hilum(variant(), patient);
    const int origin =
        variant() == PhantomVariant::kArteryAnterior ? label::kHepaticArtery : label::kRightHepaticArtery;
    const PhantomTube artery = tube_of(tubes, label::kCysticArtery), parent = tube_of(tubes, origin);
    double nearest = 1e9;
    for (std::size_t n = 0; n < parent.points_mm.size(); ++n)
      nearest = std::min(nearest, (parent.points_mm[n] - artery.points_mm.front()).norm() - parent.radii_mm[n]);
    EXPECT_LT(nearest, 0);
  }
}

TEST_P(Hilum, ArteriesPassBehindOrBeforeTheHepaticDuctAsTheVariantSays) {
  for (const std::uint64_t patient : kPatients) {
    const auto tubes = phantom_hilum(variant(), patient);
    const PhantomTube duct = tube_of(tubes, label::kHepaticDuct);
    const test::Gap behind = gap_between(tube_of(tubes, label::kRightHepaticArtery), duct);
    EXPECT_LT(behind.at_first.y(), behind.at_second.y() - 3);
    const test::Gap cystic = gap_between(tube_of(tubes, label::kCysticArtery), duct);
    const Vec from_duct = cystic.at_first - cystic.at_second;  // in front of it, or on the gallbladder's side
    EXPECT_GT(variant() == PhantomVariant::kArteryAnterior ? from_duct.y() : from_duct.x(), 2);
  }
}

TEST_P(Hilum, TheTriangleIsARealOneAndTheCysticArteryCrossesIt) {
  for (const std::uint64_t patient : kPatients) {
    const auto [neck, liver_edge, junction] = phantom::hepatocystic_triangle(phantom::anatomy_of(variant(), patient));
    const Vec across = (liver_edge - neck).cross(junction - neck);
    const double area = across.norm() / 2;
    EXPECT_GT(area, variant() == PhantomVariant::kShortDuct ? 70 : 200);
    EXPECT_LT(area, 900);
    EXPECT_LT(std::abs(phantom_liver_mm(liver_edge)), 4);  // the corner lies at the liver
    double inside = 0, far = 0;
    const PhantomTube artery = tube_of(phantom_hilum(variant(), patient), label::kCysticArtery);
    for (const Vec& p : artery.points_mm) {
      const double u = (p - neck).cross(junction - neck).dot(across) / across.squaredNorm();
      const double v = (liver_edge - neck).cross(p - neck).dot(across) / across.squaredNorm();
      inside += u > -0.02 && v > -0.02 && u + v < 1.02 ? 1 : 0;
      far = std::max(far, std::abs((p - neck).dot(across.normalized())));
    }
    EXPECT_GT(inside, 4) << "mm of the artery in the triangle, patient " << patient;
    EXPECT_LT(far, 11);
  }
}

TEST(HilumVariants, FatIsTheNormalCourseHidden) {
  const auto normal = phantom_hilum(PhantomVariant::kNormal), fat = phantom_hilum(PhantomVariant::kFat);
  ASSERT_EQ(normal.size(), 7U);
  for (std::size_t n = 0; n < normal.size(); ++n) {
    EXPECT_EQ(normal[n].points_mm, fat[n].points_mm);
    EXPECT_EQ(normal[n].name, std::string(label_table(kPhantomTable).name_of(normal[n].label).value_or("")));
  }
  const phantom::Anatomy thin = phantom::anatomy_of(PhantomVariant::kNormal, 0),
                         thick = phantom::anatomy_of(PhantomVariant::kFat, 0);
  EXPECT_GE(thick.hilum_fat_mm, 2 * thin.hilum_fat_mm);
  EXPECT_GE(thick.omentum_mm, 2 * thin.omentum_mm);
  EXPECT_GT(thick.outer_fat_mm, thin.outer_fat_mm + 15);
}

TEST(HilumVariants, LowInsertionRunsBesideTheHepaticDuct) {
  const auto tubes = phantom_hilum(PhantomVariant::kLowInsertion);
  const PhantomTube cystic = tube_of(tubes, label::kCysticDuct), hepatic = tube_of(tubes, label::kHepaticDuct);
  double beside = 0;
  for (const Vec& p : cystic.points_mm) {
    double nearest = 1e9;
    for (const Vec& q : hepatic.points_mm) nearest = std::min(nearest, (p - q).norm());
    beside += p.z() < -5 && nearest < 12 ? 1 : 0;
  }
  EXPECT_GT(beside, 35);  // mm
  EXPECT_LT(cystic.points_mm.back().z(),
            tube_of(phantom_hilum(PhantomVariant::kNormal), label::kCysticDuct).points_mm.back().z() - 25);
}

}  // namespace
}  // namespace trocar::hilum_test
