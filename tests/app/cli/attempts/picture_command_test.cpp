// `trocar picture`: writes what it says, refuses what it does not know.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <unistd.h>

#include "app/cli/attempts/picture_command.h"
#include "app/cli/machine/bench_pictures.h"
#include "app/session/setup/scene.h"
#include "haptics/input_error.h"

namespace trocar::picture_command_test {
namespace {

class PictureCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("trocar-picture-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    options_.output = folder_ / "picture.png";
    options_.scene = "board";
    options_.preset = "soft";
    options_.width = 320;
    options_.height = 240;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  int run() { return picture_command(options_, find_assets().assets, out_, err_); }
  std::string refusal() {
    try {
      run();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
  PictureOptions options_;
  std::ostringstream out_, err_;
};

TEST_F(PictureCommand, WritesThePictureAndSaysWhere) {
  EXPECT_EQ(run(), 0);
  EXPECT_GT(std::filesystem::file_size(options_.output), 2000U);
  EXPECT_EQ(out_.str(), options_.output.string() + "\n");
  EXPECT_NE(err_.str().find("preset soft"), std::string::npos);
}

TEST_F(PictureCommand, WithoutGrainTheFileIsSmaller) {
  run();
  const auto grainy = std::filesystem::file_size(options_.output);
  options_.no_grain = true;
  run();
  EXPECT_LT(static_cast<double>(std::filesystem::file_size(options_.output)), 0.95 * static_cast<double>(grainy));
}

TEST_F(PictureCommand, RefusesUnknownScenesAndNamesTheKnown) {
  options_.scene = "theatre";
  const std::string said = refusal();
  EXPECT_NE(said.find("theatre"), std::string::npos);
  for (const char* known : {"abdomen", "blood", "char", "smoke", "fog", "whitening", "board", "thirty-degree", "marks"})
    EXPECT_NE(said.find(known), std::string::npos) << known;
}

TEST_F(PictureCommand, RefusesUnknownPresets) {
  options_.preset = "ultra";
  EXPECT_NE(refusal().find("low, soft, full and auto"), std::string::npos);
}

TEST_F(PictureCommand, RefusesSizesThatNobodyCanSee) {
  options_.width = 319;
  EXPECT_NE(refusal().find("319 x 240"), std::string::npos);
  options_.width = 8000;
  EXPECT_NE(refusal(), "");
  options_.width = 400;
  options_.scene = "marks";  // twelve tiles need room
  EXPECT_NE(refusal().find("640 x 360"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(options_.output));
}

TEST_F(PictureCommand, AFileInPlaceOfTheFolderIsTheMachinesFault) {
  std::ofstream(folder_ / "none") << "in the way";
  options_.output = folder_ / "none" / "picture.png";
  EXPECT_THROW(run(), EnvironmentError);
}

TEST(PictureCosts, EveryPresetOfBothScenesIsTimedAndPrinted) {
  std::ostringstream err, out;
  const std::vector<PictureCost> costs = picture_costs(find_assets().assets, err);
  if (costs.empty()) GTEST_SKIP() << err.str();
  ASSERT_EQ(costs.size(), 6U);
  for (const PictureCost& cost : costs) {
    EXPECT_GT(cost.cpu_ms, 0);
    EXPECT_GT(cost.per_s, 0);
  }
  EXPECT_LT(costs[4].cpu_ms, costs[5].cpu_ms);  // soft against full, by a factor of three
  print_pictures(costs, out);
  for (const char* word : {"board", "abdomen", "low", "soft", "full"})
    EXPECT_NE(out.str().find(word), std::string::npos) << word;
}

TEST(PictureCosts, WhereNothingCanBeDrawnItIsSaidAndNothingIsPrinted) {
  std::ostringstream err, out;
  EXPECT_TRUE(picture_costs("/nowhere", err).empty());
  EXPECT_NE(err.str().find("no picture is timed"), std::string::npos);
  print_pictures({}, out);
  EXPECT_EQ(out.str(), "");
}

TEST_F(PictureCommand, TheLightPostOfAThirtyDegreeScopeTurnsTheView) {
  options_.scene = "board";
  options_.width = 320;
  options_.height = 240;
  const auto bytes = [this] {
    run();
    std::ifstream in(options_.output, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string straight = bytes();
  options_.scope = "30";
  options_.post_deg = 60;
  EXPECT_NE(bytes(), straight);
  options_.scope = "45";
  EXPECT_THROW(run(), InputError);
  options_.scope = "30";
  options_.post_deg = 900;
  EXPECT_THROW(run(), InputError);
  options_.post_deg = 10;
  options_.scene = "marks";
  options_.width = 640;
  options_.height = 360;
  EXPECT_THROW(run(), InputError);
}

}  // namespace
}  // namespace trocar::picture_command_test
