// The study of the plant itself: its numbers are measured, and it can miss its bars.
#include "app/studies/device/plant_study.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/studies/study_files.h"

namespace trocar::plant_study_test {
namespace {

const StudyCase& named(const StudyResult& study, const std::string& part) {
  return *std::find_if(study.cases.begin(), study.cases.end(),
                       [&](const StudyCase& c) { return c.name.find(part) != std::string::npos; });
}

StudyRequest quick() {
  StudyRequest request;
  request.quick = true;
  return request;
}

TEST(PlantStudy, MeetsItsBarsOnTheDeviceOfASeed) {
  const StudyResult study = plant_study(quick());
  for (const StudyCase& c : study.cases) EXPECT_TRUE(c.met) << c.name << ' ' << c.value << ' ' << c.bar;
  EXPECT_EQ(study.plant, "simulated plant of seed 1");
  EXPECT_NEAR(named(study, "rotor").value, 361, 4);
  EXPECT_NEAR(named(study, "4.31 A").value, 11, 0.5);
  ASSERT_EQ(study.curves.size(), 2u);
  for (const StudyCurves& c : study.curves) {
    for (const StudyCurves::Series& s : c.series) EXPECT_EQ(s.y.size(), c.x.size()) << c.file << ' ' << s.name;
  }
  EXPECT_EQ(summary_json(study), summary_json(plant_study(quick()))) << "same seed, same bytes";
}

TEST(PlantStudy, AWorseDeviceShows) {
  StudyRequest request = quick();
  request.plant = nominal_parameters();
  request.plant_words = "plant file sluggish.toml";
  request.plant->amplifier_time_constant = 0.06;  // current 60 ms late: hunts at the wall
  for (ChannelParameters& c : request.plant->channel) c.friction.coulomb = c.friction.viscous = 0;
  const StudyResult study = plant_study(request);
  EXPECT_EQ(study.plant, "simulated plant of plant file sluggish.toml");
  EXPECT_GT(named(study, "options as given").value, named(plant_study(quick()), "options as given").value);
}

}  // namespace
}  // namespace trocar::plant_study_test
