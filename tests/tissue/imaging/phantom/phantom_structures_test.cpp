// The parts of one patient: boxes, shortcuts and labels that can be trusted at points, and anatomy where it belongs.
#include "tissue/imaging/phantom/structures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "tissue/imaging/phantom/hilum.h"
#include "tissue/imaging/phantom/phantom_labels.h"

namespace trocar::phantom::phantom_structures_test {
namespace {

namespace label = phantom_label;

const Patient& standard() {
  static const Patient patient = draw_patient(anatomy_of(PhantomVariant::kNormal, 0), 3);
  return patient;
}

std::vector<Vec> points_in(const Box& box, int count, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> even(0, 1);
  std::vector<Vec> points;
  for (int n = 0; n < count; ++n) {
    const Vec share(even(engine), even(engine), even(engine));
    points.push_back(box.min() + share.cwiseProduct(box.sizes()));
  }
  return points;
}

/// The label of a point by asking every structure in turn, with none of the drawing's shortcuts.
int label_at(const Patient& patient, const Vec& p) {
  for (const Structure& each : patient.structures) {
    const double d = each.distance(p);
    if (!(d < 0) || !each.box.contains(p)) continue;
    return each.core_label != 0 && d < -each.core_depth ? each.core_label : each.label;
  }
  return -1;
}

double hounsfield_at(const Patient& patient, const Vec& p) {
  for (const Structure& each : patient.structures)
    if (each.box.contains(p) && each.distance(p) < 0) return each.hounsfield(p, each.distance(p));
  return std::nan("");
}

TEST(PhantomStructures, EveryPointOfTheFieldHasAnOwnerAndAPlausibleValue) {
  std::set<int> known{0};
  for (const LabelName& each : kPhantomLabels) known.insert(each.number);
  std::set<int> met;
  for (const Vec& p : points_in(standard().field, 4000, 1)) {
    const int owner = label_at(standard(), p);
    ASSERT_EQ(known.count(owner), 1U) << owner << " at " << p.transpose();
    met.insert(owner);
    const double hounsfield = hounsfield_at(standard(), p);
    EXPECT_GE(hounsfield, -1000) << p.transpose();
    EXPECT_LE(hounsfield, 1000) << p.transpose();
    EXPECT_EQ(owner == 0, hounsfield == -1000) << p.transpose();
  }
  EXPECT_GT(met.size(), 15U);
}

TEST(PhantomStructures, TheLastOneHoldsEverything) {
  const Structure& last = standard().structures.back();
  for (const Vec& p : points_in(Box(Vec::Constant(-2000), Vec::Constant(2000)), 200, 2)) {
    EXPECT_TRUE(last.box.contains(p));
    EXPECT_LT(last.distance(p), 0);
  }
}

TEST(PhantomStructures, NoOrganReachesOutOfItsBox) {
  const std::vector<Vec> points = points_in(standard().field, 6000, 3);
  for (const Structure& each : standard().structures) {
    if (each.label == label::kHilumFat || each.label == label::kOmentum || each.label == label::kDiaphragm ||
        each.label == label::kVertebrae)
      continue;  // their boxes cut them, as the organs before them would
    for (const Vec& p : points)
      EXPECT_TRUE(each.box.contains(p) || each.distance(p) >= 0) << each.label << " at " << p.transpose();
  }
}

TEST(PhantomStructures, ABoxThatAStructureMissesHoldsNoneOfIt) {
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> even(0, 1);
  std::size_t missed = 0;
  for (const Structure& each : standard().structures) {
    if (!each.misses) continue;
    for (const Vec& low : points_in(standard().field, 60, 5)) {
      const Vec size = Vec::Constant(2 + 14 * even(engine));
      const Box box(low, low + size);
      if (!each.misses(box)) continue;
      ++missed;
      for (const Vec& p : points_in(box, 12, missed))
        EXPECT_TRUE(each.distance(p) >= 0 || !each.box.contains(p)) << each.label << " at " << p.transpose();
    }
  }
  EXPECT_GT(missed, 500U);
}

// Blocks are decided by the distance at their centre: a point at distance d has no border nearer than d / 2.
TEST(PhantomStructures, MeasuredDistancesKeepTheirSignWithinHalfOfWhatTheySay) {
  std::mt19937_64 engine(6);
  std::normal_distribution<double> normal;
  std::size_t measured_ones = 0;
  for (const Structure& each : standard().structures) {
    if (!each.measured || each.label == label::kDiaphragm) continue;
    ++measured_ones;
    for (const Vec& p : points_in(standard().field, 150, 7)) {
      const double d = each.distance(p);
      for (int n = 0; n < 4; ++n) {
        const Vec away = Vec(normal(engine), normal(engine), normal(engine)).normalized();
        const double there = each.distance(p + 0.45 * std::abs(d) * away);
        EXPECT_EQ(there < 0, d < 0) << each.label << " at " << p.transpose() << ": " << d << ", then " << there;
      }
    }
  }
  EXPECT_GE(measured_ones, 6U);
}

TEST(PhantomStructures, OrgansOwnTheirMiddles) {
  const auto owner = [](double x, double y, double z) { return label_at(standard(), Vec(x, y, z)); };
  EXPECT_EQ(owner(80, 0, 10), label::kLiver);
  EXPECT_EQ(owner(45, 48, -41), label::kGallbladder);
  EXPECT_EQ(owner(-125, -26, 32), label::kSpleen);
  EXPECT_EQ(owner(75, -48, -58), label::kKidneyRight);
  EXPECT_EQ(owner(-75, -48, -46), label::kKidneyLeft);
  EXPECT_EQ(owner(0, -62, 0), label::kVertebrae);
  EXPECT_EQ(owner(-14, -32, -20), label::kAorta);
  EXPECT_EQ(owner(24, -36, -20), label::kVenaCava);
  EXPECT_EQ(owner(0, -15, -22), label::kPortalVein);
  EXPECT_EQ(owner(-28, 38, 114), label::kHeart);
  EXPECT_EQ(owner(174, 134, 0), 0);
  EXPECT_EQ(owner(-174, -119, 0), 0);
}

TEST(PhantomStructures, FromOutsideInTheWallComesInItsLayers) {
  const std::vector<int> layers{0, label::kSkin, label::kSubcutaneousFat, label::kMuscle};
  for (const auto& [x, y] : {std::pair(1.0, 0.1), std::pair(-1.0, 0.1), std::pair(0.3, 1.0)}) {
    std::vector<int> met;
    for (double r = 175; r > 80 && met.size() < layers.size(); r -= 0.5) {
      const int owner = label_at(standard(), Vec(r * x, 8 + 0.7 * r * y, -100));
      if (met.empty() || met.back() != owner) met.push_back(owner);
    }
    EXPECT_EQ(met, layers) << x << " " << y;
  }
}

TEST(PhantomStructures, ThickerSheetsOnlyThickenTheSkinAndTheDiaphragm) {
  const Patient thick = draw_patient(anatomy_of(PhantomVariant::kNormal, 0), 9);
  std::size_t more_skin = 0;
  for (const Vec& p : points_in(standard().field, 2500, 8)) {
    const int thin_owner = label_at(standard(), p), thick_owner = label_at(thick, p);
    if (thin_owner == thick_owner) continue;
    EXPECT_TRUE(thick_owner == label::kSkin || thick_owner == label::kDiaphragm || thin_owner == label::kDiaphragm)
        << thin_owner << " became " << thick_owner << " at " << p.transpose();
    more_skin += thick_owner == label::kSkin ? 1 : 0;
  }
  EXPECT_GT(more_skin, 10U);
}

TEST(PhantomStructures, TheOuterFatPushesTheSkinOutwardsAndWidensTheField) {
  const Patient fat = draw_patient(anatomy_of(PhantomVariant::kFat, 0), 3);
  EXPECT_TRUE(fat.field.contains(standard().field));
  EXPECT_GT(fat.field.sizes().x(), standard().field.sizes().x());
  const auto half_width = [](const Patient& patient) {
    double x = 100;
    while (label_at(patient, Vec(x, 8, -100)) != 0) x += 0.5;
    return x;
  };
  EXPECT_NEAR(half_width(fat) - half_width(standard()), 22, 1);
  EXPECT_NEAR(half_width(standard()), 168, 1);
}

TEST(PhantomStructures, ThinCoursesAreTheTubesOfTheHilum) {
  for (const PhantomVariant variant : kPhantomVariants) {
    const Anatomy anatomy = anatomy_of(variant, 7);
    const Patient patient = draw_patient(anatomy, 3);
    const std::vector<NamedTube> tubes = hilum(anatomy);
    ASSERT_EQ(patient.thin.size(), tubes.size());
    for (std::size_t n = 0; n < tubes.size(); ++n) {
      EXPECT_EQ(patient.thin[n].label, tubes[n].label);
      ASSERT_EQ(patient.thin[n].tube.course().size(), tubes[n].tube.course().size());
      for (std::size_t m = 0; m < tubes[n].tube.course().size(); ++m)
        EXPECT_EQ(patient.thin[n].tube.course()[m].at, tubes[n].tube.course()[m].at);
    }
  }
}

TEST(PhantomStructures, CalibresScaleTheTubesAndNothingElse) {
  Anatomy anatomy, wide;
  wide.duct_calibre = 1.1, wide.artery_calibre = 0.9;
  const std::vector<NamedTube> plain = hilum(anatomy), scaled = hilum(wide);
  ASSERT_EQ(plain.size(), scaled.size());
  for (std::size_t n = 0; n < plain.size(); ++n) {
    const double share = plain[n].label <= label::kBileDuct ? 1.1 : 0.9;
    ASSERT_EQ(plain[n].tube.course().size(), scaled[n].tube.course().size());
    for (std::size_t m = 0; m < plain[n].tube.course().size(); ++m)
      EXPECT_NEAR(scaled[n].tube.course()[m].radius, share * plain[n].tube.course()[m].radius, 1e-9) << plain[n].label;
  }
}

TEST(PhantomAnatomy, ScalesMakeOrgansGrowAndNeverShrink) {
  Anatomy small, large;
  small.liver_scale = small.sac_scale = small.spleen_scale = 0.95;
  large.liver_scale = large.sac_scale = large.spleen_scale = 1.05;
  for (const Vec& p : points_in(standard().field, 2000, 9)) {
    EXPECT_TRUE(spleen(p, large) < 0 || spleen(p, small) >= 0) << p.transpose();
    EXPECT_TRUE(liver_lobes(p, large) < 0 || liver_lobes(p, small) >= 0) << p.transpose();
    EXPECT_TRUE(gallbladder(p, large) < 0 || gallbladder(p, small) >= 0) << p.transpose();
  }
}

TEST(PhantomAnatomy, TheLiverIsCutFromItsLobes) {
  for (const std::uint64_t patient : {0, 3, 11})
    for (const PhantomVariant variant : kPhantomVariants) {
      const Anatomy anatomy = anatomy_of(variant, patient);
      for (const Vec& p : points_in(Box(Vec(-110, -90, -90), Vec(150, 105, 100)), 400, patient))
        EXPECT_GE(liver(p, anatomy), liver_lobes(p, anatomy)) << p.transpose();
    }
}

TEST(PhantomAnatomy, OrgansPressIntoTheLiverAndDoNotShareItsRoom) {
  const Anatomy anatomy;
  std::size_t within = 0;
  for (const Vec& p : points_in(Box(Vec(-110, -90, -90), Vec(150, 105, 100)), 6000, 10)) {
    if (liver(p, anatomy) >= 0) continue;
    ++within;
    EXPECT_GT(gallbladder(p, anatomy), 0) << p.transpose();
    EXPECT_GT(kidney(p, 1), 0) << p.transpose();
    EXPECT_GT(vena_cava(p), 0) << p.transpose();
    EXPECT_GT(spine(p), 0) << p.transpose();
    EXPECT_LT(trunk(p, 30), 0) << p.transpose();
  }
  EXPECT_GT(within, 800U);
}

TEST(PhantomAnatomy, TheKidneysAreMirrorImagesAtTheirOwnHeights) {
  for (const Vec& p : points_in(Box(Vec(20, -90, -120), Vec(110, 0, 20)), 500, 11))
    EXPECT_NEAR(kidney(p, 1), kidney(Vec(-p.x(), p.y(), p.z() + 12), -1), 1e-9) << p.transpose();
}

TEST(PhantomAnatomy, ADeeperInsetOfTheTrunkLiesWithin) {
  for (const Vec& p : points_in(standard().field, 500, 12)) {
    double before = trunk(p, -20);
    for (const double inset : {0.0, 10.0, 30.0}) {
      EXPECT_TRUE(trunk(p, inset) >= 0 || before < 0) << p.transpose();
      before = trunk(p, inset);
    }
    EXPECT_EQ(trunk(p, 10), trunk(p + Vec(0, 0, 333), 10));
    EXPECT_NEAR(trunk(p, 10), trunk(Vec(-p.x(), p.y(), p.z()), 10), 1e-9);
  }
}

TEST(PhantomAnatomy, PatientsStayWithinTheirVariantsAndDifferFromEachOther) {
  std::set<double> livers;
  for (std::uint64_t patient = 1; patient <= 200; ++patient) {
    const Anatomy a = anatomy_of(PhantomVariant::kNormal, patient), fat = anatomy_of(PhantomVariant::kFat, patient);
    livers.insert(a.liver_scale);
    for (const double share : {a.liver_scale, a.sac_scale, a.spleen_scale, a.duct_calibre, a.artery_calibre}) {
      EXPECT_GT(share, 0.85);
      EXPECT_LT(share, 1.15);
    }
    EXPECT_GT(a.omentum_mm, 0);
    EXPECT_GT(14 + a.outer_fat_mm, 5);          // some fat is left under every skin
    EXPECT_EQ(fat.liver_scale, a.liver_scale);  // one patient, leaner or fatter
    EXPECT_GT(fat.outer_fat_mm, a.outer_fat_mm);
    EXPECT_GT(fat.omentum_mm, a.omentum_mm);
    EXPECT_GT(fat.hilum_fat_mm, a.hilum_fat_mm);
  }
  EXPECT_EQ(livers.size(), 200U);
}

}  // namespace
}  // namespace trocar::phantom::phantom_structures_test
