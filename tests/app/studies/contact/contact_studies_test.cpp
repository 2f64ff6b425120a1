// The quick form of the studies of thesis 3.7: what they find in the hands of one person.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/studies/contact/contact_torque_study.h"
#include "app/studies/contact/walls_study.h"
#include "app/studies/study_command.h"
#include "app/studies/study_files.h"

namespace trocar::contact_studies_test {
namespace {

constexpr StudyRequest kQuick{true, 1};

const StudyResult& walls() {
  static const StudyResult result = walls_study(kQuick);
  return result;
}

const StudyResult& torque(char axis) {
  static std::map<char, StudyResult> results;
  const auto found = results.find(axis);
  return found != results.end() ? found->second : results.emplace(axis, torque_study(axis, kQuick)).first->second;
}

const StudyCase& the_case(const StudyResult& study, const std::string& start) {
  for (const StudyCase& c : study.cases) {
    if (c.name.rfind(start, 0) == 0) return c;
  }
  ADD_FAILURE() << study.study << ": no case " << start;
  return study.cases.front();
}

const StudyCurves& the_curves(const StudyResult& study, const std::string& file) {
  for (const StudyCurves& c : study.curves) {
    if (c.file == file) return c;
  }
  ADD_FAILURE() << study.study << ": no curves " << file;
  return study.curves.front();
}

void expect_whole(const StudyResult& study) {
  EXPECT_NE(study.plant.find("simulated"), std::string::npos);
  for (const StudyCase& c : study.cases) {
    EXPECT_TRUE(std::isfinite(c.value)) << c.name;
    EXPECT_FALSE(c.definition.empty()) << c.name;
    EXPECT_FALSE(c.bar.empty()) << c.name;
  }
  for (const StudyCurves& c : study.curves) {
    EXPECT_NE(c.title.find("simulated plant"), std::string::npos) << c.file;
    for (const auto& series : c.series) {
      EXPECT_EQ(series.y.size(), c.x.size()) << c.file;
      for (const double y : series.y) ASSERT_TRUE(std::isfinite(y)) << c.file;
    }
  }
}

TEST(WallsStudy, ThreeContactsAreAskedForAndFeltAtTheThesisTimes) {
  for (const std::string name : {"20 N/m", "150 N/m"}) {
    for (const char* what :
         {": contacts in the desired", ": contacts in the measured", ": first contact", ": second contact"}) {
      const StudyCase& c = the_case(walls(), name + what);
      EXPECT_TRUE(c.met) << c.name << ": " << c.value;
    }
  }
}

TEST(WallsStudy, TheMeasuredForceIsTheDesiredOneButFiveTimesItWithTheGainLeftIn) {
  for (const char* name : {"20 N/m: measured over desired along Y6", "150 N/m: measured over desired along Y6",
                           "20 N/m: measured over desired along Z6", "150 N/m: measured over desired along Z6"}) {
    const StudyCase& c = the_case(walls(), name);
    const bool soft = c.name.starts_with("20");  // 35 mN of half a newton are missing: docs/device_contact.md
    EXPECT_NEAR(c.value, soft ? 0.93 : 1, soft ? 0.03 : 0.05) << c.name;
    ASSERT_TRUE(c.thesis);
    EXPECT_GT(*c.thesis, 4.5);
    EXPECT_LT(*c.thesis, 6.5) << "friction is not compensated there";
  }
}

TEST(WallsStudy, TheLagIsThatOfTheSensorWhereFrictionIsSmallBesideTheForce) {
  EXPECT_NEAR(the_case(walls(), "150 N/m: lag along Y6").value, 0.15, 0.015);
  EXPECT_NEAR(the_case(walls(), "150 N/m: lag along Z6").value, 0.15, 0.015);
  EXPECT_TRUE(the_case(walls(), "20 N/m: lag along Y6").met) << "friction that is carried leads the force no longer";
  EXPECT_TRUE(the_case(walls(), "20 N/m: direction error with the force along X6").met);
}

TEST(WallsStudy, TheFirstWallPushesAlongMinusY6TheBackOneAlongZ6) {
  const StudyCurves& desired = the_curves(walls(), "figure_3_42_20");
  ASSERT_EQ(desired.series.size(), 2u);
  EXPECT_NEAR(desired.x[1] - desired.x[0], 1e-3, 1e-9) << "1 kHz as in the thesis";
  const auto at = [&](double t, std::size_t series) {
    return desired.series[series].y[static_cast<std::size_t>(std::lround((t - desired.x[0]) * 1e3))];
  };
  EXPECT_LT(at(8.2, 0), -0.2);
  EXPECT_GT(at(11.2, 0), 0.2);
  EXPECT_GT(at(14.2, 1), 0.2);
  EXPECT_EQ(at(10.0, 0), 0) << "in the air between two walls";
  EXPECT_EQ(at(7.0, 0), 0);
  const StudyCurves& measured = the_curves(walls(), "figure_3_43_20");
  EXPECT_NEAR(measured.x[1] - measured.x[0], 0.025, 1e-9);
}

TEST(WallsStudy, IsWholeAndTheSameEveryTime) {
  expect_whole(walls());
  const StudyResult again = walls_study(kQuick);
  EXPECT_EQ(summary_json(again), summary_json(walls()));
  for (std::size_t i = 0; i < again.curves.size(); ++i) {
    EXPECT_EQ(curves_csv(again.curves[i]), curves_csv(walls().curves[i]));
  }
}

TEST(TorqueStudies, TheIntendedTorqueDominatesInTheExpectedSense) {
  for (const char axis : {'x', 'y', 'z'}) {
    for (const std::string name : {"20 N/m", "150 N/m"}) {
      for (const char* what : {": contacts in the desired", ": contacts in the measured", ": torque about",
                               ": expected signs in the desired", ": expected signs in the measured"}) {
        const StudyCase& c = the_case(torque(axis), name + what);
        EXPECT_TRUE(c.met) << axis << ", " << c.name << ": " << c.value;
      }
    }
  }
}

TEST(TorqueStudies, TheLeverAsPrintedTurnsEveryTorqueRound) {
  for (const char axis : {'x', 'y', 'z'}) {
    const std::string name =
        std::string("150 N/m: torque about ") + static_cast<char>(axis - 'x' + 'X') + "6 in the expected";
    const StudyCase& c = the_case(torque(axis), name);
    EXPECT_GT(c.value, 0.02);
    ASSERT_TRUE(c.thesis);
    EXPECT_NEAR(*c.thesis / c.value, -1, 0.02) << "but for the sign it is the same lever";
  }
}

TEST(TorqueStudies, TorqueIsDeliveredAsAskedForAndFiveTimesWithTheGainLeftIn) {
  for (const char axis : {'x', 'y', 'z'}) {
    for (const std::string name : {"20 N/m", "150 N/m"}) {
      const StudyCase& c = the_case(torque(axis), name + ": measured over desired torque");
      EXPECT_TRUE(c.met) << axis << ", " << c.name << ": " << c.value;
      ASSERT_TRUE(c.thesis);
      EXPECT_NEAR(*c.thesis, 5, 0.6);
    }
  }
}

TEST(TorqueStudies, TheFixtureHangsAlongMinusX6UntilItIsTakenOff) {
  const StudyCase& c = the_case(torque('y'), "force along X6 before contact");
  EXPECT_TRUE(c.met) << c.value;
  ASSERT_TRUE(c.thesis);
  EXPECT_NEAR(*c.thesis - c.value, -0.98, 0.01) << "0.1 kg";
}

TEST(TorqueStudies, TheSecondContactOfTorqueZTurnsTheOtherWay) {
  const StudyCurves& desired = the_curves(torque('z'), "figure_3_51_desired_20");
  const auto at = [&](double t) {
    return desired.series[0].y[static_cast<std::size_t>(std::lround((t - desired.x[0]) * 1e3))];
  };
  EXPECT_LT(at(7.0), -0.02);
  EXPECT_GT(at(13.0), 0.02);
  EXPECT_EQ(at(10.0), 0);
}

TEST(TorqueStudies, AreWhole) {
  for (const char axis : {'x', 'y', 'z'}) expect_whole(torque(axis));
}

TEST(TorqueStudies, AreKnownToTheCommandLine) {
  const std::vector<std::string> names = study_names();
  for (const char* name : {"walls", "torque-x", "torque-y", "torque-z"}) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  }
}

}  // namespace
}  // namespace trocar::contact_studies_test
