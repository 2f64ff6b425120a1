// The job that searches, in a small world of its own: the tip follows the intent, tissue is a spring that is stiffer
// over lumps, what is between the jaws is another, and a pinch for long enough marks.
#include "scenarios/kinds/palpate/palpate_job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace trocar::palpate_job_test {
namespace {

constexpr double kDt = 1e-3, kRegion_m = 0.045, kLump_m = 0.007, kPad_m = 0.010;
constexpr std::size_t kMarks = 2;

HandSkill exact(double settle_share, int corrections) {
  HandSkill skill;
  skill.settle_share = settle_share;
  skill.max_corrections = corrections;
  skill.approach_speed_mps = 0.025;
  return skill;
}

/// A slope that is firmer towards one side, and two lumps in it.
struct Organ {
  explicit Organ(const HandSkill& skill) : job(skill) {
    intent.X_TI.p = middle + Vec3(0, 0, 0.045);
    intent.X_TI.R = Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix();
    intent.jaw_opening_m = 0.005;
  }

  double pressed_n() const {
    const Vec3 off = intent.X_TI.p - middle;
    double n_per_m = 90 * (1 + 4 * off.x());
    for (const Vec3& lump : lumps)
      n_per_m *= 1 + 0.6 * std::exp(-(intent.X_TI.p - lump).head<2>().squaredNorm() / (kLump_m * kLump_m));
    return n_per_m * std::max(0.0, 0.1 * off.x() - off.z());
  }
  double grip_n() const { return 300 * std::max(0.0, kPad_m - intent.jaw_opening_m); }

  Percept look() const {
    Percept seen;
    seen.tip_T = intent.X_TI.p;
    seen.R_TI = intent.X_TI.R;
    seen.jaw_opening_m = intent.jaw_opening_m;
    seen.cue = Cue::kSearch;
    seen.band_low_n = 0.8;
    seen.band_high_n = 1.2;
    seen.shown_force_n = std::numeric_limits<double>::quiet_NaN();
    seen.felt_force_T = Vec3(0, 0, pressed_n());
    seen.felt_grip_n = grip_n();
    seen.object = {.X_TO = {Mat3::Identity(), middle}, .size_m = Vec3(kRegion_m, kRegion_m, 0)};
    seen.shown_share = static_cast<double>(marks.size()) / kMarks;
    return seen;
  }

  void search() {
    job.begin(look(), intent, random);
    double pinched_s = 0, press_n = 0;
    for (int i = 0; i < 400'000 && marks.size() < kMarks; ++i) {
      const Percept seen = look();
      senses.set_used_to_it(!job.touches());
      senses.update(seen, 0, kDt);
      job.update(seen, senses, kDt, intent, random);
      if (job.touches()) press_n = std::max(press_n, pressed_n());
      if (!job.touches() && press_n > 0) presses_n.push_back(std::exchange(press_n, 0));
      pinched_s = grip_n() > 0.5 ? pinched_s + kDt : 0;
      if (pinched_s > 1.5 && intent.jaw_opening_m < kPad_m) marks.push_back(intent.X_TI.p), pinched_s = -1e9;
      if (grip_n() == 0) pinched_s = 0;
      if (marks.empty()) before_mark = presses_n.size();
    }
  }
  double nearest_mark_m(const Vec3& lump) const {
    double nearest = INFINITY;
    for (const Vec3& mark : marks) nearest = std::min(nearest, (mark - lump).head<2>().norm());
    return nearest;
  }

  Vec3 middle{0.02, -0.01, 0.003};
  std::array<Vec3, kMarks> lumps{Vec3(0.028, -0.002, 0), Vec3(0.010, -0.018, 0)};
  std::vector<Vec3> marks;
  std::vector<double> presses_n;  ///< the most of each
  std::size_t before_mark = 0;    ///< presses
  PalpateJob job;
  HandSenses senses{0.2};
  HandRandom random{1};
  HandIntent intent;
};

TEST(PalpateJob, MarksWhatIsFirmerThanWhatLiesAroundIt) {
  Organ organ(exact(0.35, 3));
  organ.search();
  ASSERT_EQ(organ.marks.size(), kMarks);
  for (const Vec3& lump : organ.lumps) EXPECT_LT(organ.nearest_mark_m(lump), 0.003);
  for (const double most_n : organ.presses_n) {
    EXPECT_GT(most_n, 0.7);
    EXPECT_LT(most_n, 2) << "the exercise's hard limit; over a lump the force comes faster than it is felt";
  }
}

TEST(PalpateJob, WhoIsContentWithMoreErrorFeelsFewerPlacesBeforeMarking) {
  Organ fine(exact(0.35, 3)), coarse(exact(0.9, 0));
  fine.search();
  coarse.search();
  EXPECT_EQ(coarse.before_mark, 25U) << "a raster of 9 mm, and straight to the mark";
  EXPECT_EQ(fine.before_mark, 64U + 3 * 4) << "one of 5.6 mm, and beside the three likeliest places";
}

}  // namespace
}  // namespace trocar::palpate_job_test
