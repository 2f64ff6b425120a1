// Studies: what the contact-law study finds on both laws, what is written down, and the bench's balls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include <nlohmann/json.hpp>

#include "app/cli/machine/bench_contact.h"
#include "app/studies/contact/contact_law_study.h"
#include "app/studies/study_command.h"
#include "app/studies/study_files.h"
#include "haptics/contact/tool_shape.h"
#include "haptics/input_error.h"

namespace trocar::study_test {
namespace {

namespace fs = std::filesystem;

const StudyResult& study() {
  static const StudyResult result = contact_law_study();
  return result;
}

const StudyCase& the_case(const std::string& start) {
  for (const StudyCase& c : study().cases) {
    if (c.name.rfind(start, 0) == 0) return c;
  }
  ADD_FAILURE() << "no case " << start;
  return study().cases.front();
}

TEST(ContactLawStudy, MeetsEveryBar) {
  EXPECT_GE(study().cases.size(), 10u);
  for (const StudyCase& c : study().cases) {
    EXPECT_TRUE(c.met) << c.name << ": " << c.value << " " << c.unit << ", asked for " << c.bar;
    EXPECT_TRUE(std::isfinite(c.value)) << c.name;
    EXPECT_FALSE(c.definition.empty()) << c.name;
  }
}

TEST(ContactLawStudy, ShowsTheFaultsOfTheThesisLaw) {
  EXPECT_NEAR(*the_case("thin part").thesis, 1.0, 0.02) << "pops at half the thickness";
  EXPECT_NEAR(*the_case("wrong side").thesis, 1.0, 1e-9);
  EXPECT_GT(*the_case("force step at an edge").thesis, 0.15) << "0.21 N by hand: 150 N/m, 1 mm, a right angle";
  EXPECT_GT(*the_case("facets").thesis, 1.0);
  EXPECT_EQ(*the_case("torque of the shaft").thesis, 0.0);
  EXPECT_NEAR(*the_case("moment against virtual work").thesis, -1.0, 0.01);
  EXPECT_NEAR(*the_case("friction when sliding").thesis, 0.0, 1e-9);
  EXPECT_NEAR(*the_case("energy lost").thesis, 0.0, 0.01);
}

TEST(ContactLawStudy, CurvesAreWholeAndTheSameEveryTime) {
  const StudyResult again = contact_law_study();
  ASSERT_EQ(again.curves.size(), study().curves.size());
  for (std::size_t i = 0; i < again.curves.size(); ++i) {
    const StudyCurves& c = study().curves[i];
    for (const auto& series : c.series) EXPECT_EQ(series.y.size(), c.x.size()) << c.file << ", " << series.name;
    EXPECT_EQ(curves_csv(c), curves_csv(again.curves[i])) << c.file;
  }
  EXPECT_EQ(summary_json(study()), summary_json(again));
}

StudyCurves small_curves() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {"small", "a < b", "x, mm", "y", {0, 1, 2, 3}, {{"one", {0, 1, nan, 4}}, {"two", {-2, -2, -2, -2}}}};
}

TEST(StudyFiles, CsvHasAColumnForEachSeries) {
  std::istringstream csv(curves_csv(small_curves()));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "\"x, mm\",one,two") << "a comma within a name is quoted";
  std::getline(csv, line);
  EXPECT_EQ(line, "0,0,-2");
  std::getline(csv, line);
  std::getline(csv, line);
  EXPECT_EQ(line, "2,nan,-2");
}

TEST(StudyFiles, SvgLeavesGapsAndEscapesItsText) {
  const std::string svg = curves_svg(small_curves());
  EXPECT_EQ(svg.rfind("<svg ", 0), 0u);
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  const auto path = svg.substr(svg.find(" d=\""), svg.find("\"/>", svg.find(" d=\"")) - svg.find(" d=\""));
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2) << "the pen is lifted over the gap: " << path;
  EXPECT_EQ(std::count(path.begin(), path.end(), 'L'), 1);
}

TEST(StudyFiles, ACurveWithoutRangeStillDraws) {
  const StudyCurves flat{"flat", "flat", "x", "y", {0, 1}, {{"one", {3, 3}}}};
  const std::string svg = curves_svg(flat);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(StudyFiles, TableNamesBothLaws) {
  const StudyResult result{"s", "p", {{"m", "N", 0.5, 2.0, "<= 1", true, "d"}, {"n", "1", 3, {}, "0", false, "d"}}, {}};
  EXPECT_EQ(table_markdown(result),
            "| measure | unit | thesis' law | Trocar | asked for | met |\n|---|---|---|---|---|---|\n"
            "| m | N | 2 | 0.5 | <= 1 | yes |\n| n | 1 | - | 3 | 0 | no |\n");
}

TEST(StudyCommand, WritesDataPlotsAndSummary) {
  const fs::path folder = fs::temp_directory_path() / "trocar_study_test" / "deep";
  fs::remove_all(folder.parent_path());
  std::ostringstream out, err;
  EXPECT_EQ(study_command({"contact-law", folder, true}, out, err), 0);
  const auto json = nlohmann::json::parse(out.str());
  EXPECT_EQ(json.at("study"), "contact-law");
  for (const auto& entry : json.at("cases")) {
    for (const char* key : {"name", "value", "unit", "thesis", "bar", "met", "definition"}) {
      EXPECT_TRUE(entry.contains(key)) << key;
    }
  }
  for (const StudyCurves& curves : study().curves) {
    EXPECT_GT(fs::file_size(folder / (curves.file + ".csv")), 100u);
    EXPECT_GT(fs::file_size(folder / (curves.file + ".svg")), 1000u);
  }
  std::ifstream summary(folder / "summary.json");
  EXPECT_EQ(nlohmann::json::parse(summary), json);
  EXPECT_TRUE(fs::exists(folder / "table.md"));
  fs::remove_all(folder.parent_path());
}

TEST(StudyCommand, RefusesWhatItDoesNotKnowAndCannotWrite) {
  std::ostringstream out, err;
  try {
    study_command({"contact-lore", "nowhere", false}, out, err);
    ADD_FAILURE() << "an unknown study ran";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("contact-law"), std::string::npos) << "names what there is";
  }
  StudyOptions nominal{"walls", "nowhere"};
  nominal.nominal = true;
  try {
    study_command(nominal, out, err);
    ADD_FAILURE() << "--nominal where no arm is drawn";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("passivity, zwidth"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(fs::exists("nowhere"));
  const fs::path file = fs::temp_directory_path() / "trocar_study_file";
  std::ofstream(file) << "in the way";
  EXPECT_ANY_THROW(study_command({"contact-law", file, false}, out, err));
  fs::remove(file);
}

TEST(BenchContact, FeelsTheSurfaceInEveryTickHoweverFineItIs) {
  for (const int triangles : {5000, 50000}) {
    ContactCost cost = contact_cost(triangles, 400, 2);
    EXPECT_NEAR(cost.triangles, triangles, 0.03 * triangles);
    EXPECT_EQ(cost.contact_ticks, 400) << "no true contact is missed";
    EXPECT_GT(cost.reach_m, ToolShape{}.radius_m + 0.0045) << "3 mm and 15 ms at 0.1 m/s";
    EXPECT_EQ(cost.step.us.size(), 400u);
    EXPECT_GT(cost.step.percentile(0.5), 0);
    EXPECT_GE(cost.step.percentile(0.999), cost.step.percentile(0.5));
    EXPECT_EQ(cost.fresh.us.size(), 40u) << "every tenth tick sees a new patch";
    ASSERT_EQ(cost.least.us.size(), 400u);
    EXPECT_LE(cost.least.percentile(0.5), cost.step.percentile(0.5));
    EXPECT_LE(cost.lists, 0.25)
        << "one with each patch, one more before the next, and where the way that the force may turn is sought";
    EXPECT_LT(cost.measured, 20) << "of up to 512 triangles in the patch; a count, the same on every machine";
    EXPECT_GT(cost.measured, 1);
  }
}

TEST(BenchContact, FixedWorkIsTimedAsOftenAsAsked) {
  StageTimes fixed = fixed_work(50);
  EXPECT_EQ(fixed.us.size(), 50u);
  EXPECT_GT(fixed.percentile(0.5), 0);
}

}  // namespace
}  // namespace trocar::study_test
