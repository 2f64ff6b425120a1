// What the compensation studies draw, how they are called, and device files in `device eval`.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/cli/device/device_command.h"
#include "app/cli/device/numeric_csv.h"
#include "app/studies/device/bar_drawing.h"
#include "app/studies/study_command.h"
#include "haptics/control/gravity.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/files/device_file.h"

namespace trocar::compensation_files_test {
namespace {

namespace fs = std::filesystem;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

StudyCurves two_by_three() {
  return {"f", "A < B & C", "x", "height, mm", {1, 2, 3}, {{"before", {1, 2, 4}}, {"after", {0.5, 0.05, 0}}}};
}

TEST(BarDrawing, HasOneBarForEachValueAndSaysIt) {
  const std::string svg = grouped_bars_svg(two_by_three(), {"one", "two", "three"});
  EXPECT_EQ(svg.rfind("<svg", 0), 0u);
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
  EXPECT_EQ(count(svg, "stroke=\"#303030\"/>"), 6u + 2u) << "bars, and the legend's samples";
  for (const char* words : {">one<", ">two<", ">three<", ">before<", ">after<", ">4.00<", ">0.05<", ">height, mm<"}) {
    EXPECT_EQ(count(svg, words), 1u) << words;
  }
  EXPECT_EQ(count(svg, "A &lt; B &amp; C"), 1u) << "titles are escaped";
}

TEST(BarDrawing, HeightsAreProportionalAndStayInside) {
  const std::string svg = grouped_bars_svg(two_by_three(), {"one", "two", "three"});
  std::vector<double> heights;
  for (std::size_t at = svg.find("stroke=\"#303030\""); at != std::string::npos;
       at = svg.find("stroke=\"#303030\"", at + 1)) {
    const std::size_t begin = svg.rfind("height=\"", at) + 8;
    heights.push_back(std::stod(svg.substr(begin)));
  }
  ASSERT_EQ(heights.size(), 8u);
  // legend, 1, 2, 4, legend, 0.5, 0.05, 0
  EXPECT_NEAR(heights[2] / heights[1], 2, 1e-3);
  EXPECT_NEAR(heights[3] / heights[1], 4, 1e-3);
  EXPECT_NEAR(heights[5] / heights[1], 0.5, 1e-3);
  EXPECT_EQ(heights[7], 0);
  EXPECT_LT(heights[3], 400 - 70 - 56);
}

TEST(BarDrawing, KindsDifferWithoutColour) {
  StudyCurves c = two_by_three();
  c.series.push_back({"third", {1, 1, 1}});
  const std::string svg = grouped_bars_svg(c, {"one", "two", "three"});
  EXPECT_EQ(count(svg, "fill=\"#303030\" stroke"), 4u);
  EXPECT_EQ(count(svg, "fill=\"#b8b8b8\" stroke"), 4u);
  EXPECT_EQ(count(svg, "fill=\"url(#stripes)\" stroke"), 4u);
}

TEST(CompensationStudies, AreKnownByName) {
  const std::vector<std::string> names = study_names();
  for (const char* name : {"gravity", "force", "transparency"}) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  }
}

TEST(CompensationStudies, AreWrittenWithDataPicturesAndSummary) {
  const fs::path folder = fs::path(testing::TempDir()) / "force_study";
  fs::remove_all(folder);
  StudyOptions options;
  options.name = "force";
  options.out = folder;
  options.quick = true;
  std::ostringstream out, err;
  EXPECT_EQ(study_command(options, out, err), 0);
  for (const char* file : {"direction.svg", "direction.csv", "summary.json", "table.md"}) {
    EXPECT_TRUE(fs::exists(folder / file)) << file;
    EXPECT_GT(fs::file_size(folder / file), 100u) << file;
  }
  EXPECT_NE(out.str().find("1 N along -Y6, whole chain: direction"), std::string::npos);
}

class EvalWithDevice : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(table_)
        << "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n0.8,0.7,0.75,-1,-1.3,0.4\n0.6,0.9,0.7,-1.5,-1,2\n";
  }
  NumericCsv evaluated(const fs::path& device) {
    std::ostringstream err;
    EXPECT_EQ(device_eval(table_, out_, err, device), 0);
    return read_numeric_csv(out_);
  }
  fs::path table_ = fs::path(testing::TempDir()) / "poses.csv", out_ = fs::path(testing::TempDir()) / "evaluated.csv",
           file_ = fs::path(testing::TempDir()) / "device.toml";
};

TEST_F(EvalWithDevice, HoldsTheWeightsOfTheFile) {
  DeviceModel twice;
  twice.identified_gravity = gravity_of(2 * gravity_parameters({}));
  std::ofstream(file_, std::ios::binary) << device_toml(twice, "twice the weight");
  const NumericCsv nominal = evaluated({}), heavy = evaluated(file_);
  const std::size_t column = nominal.require("taug1_Nm", out_);
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_NEAR(heavy.rows[row][column + j], 2 * nominal.rows[row][column + j], 1e-12);
    }
    EXPECT_EQ(heavy.rows[row][6], nominal.rows[row][6]) << "poses do not change";
  }
}

TEST_F(EvalWithDevice, RefusesAFileThatIsNoDevice) {
  std::ofstream(file_, std::ios::binary) << "[gravity]\nplatform_n_m = [0, 0]\n";
  std::ostringstream err;
  try {
    device_eval(table_, out_, err, file_);
    FAIL() << "was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("device.toml:2:"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace trocar::compensation_files_test
