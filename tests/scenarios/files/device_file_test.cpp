// Device files: they read back as they were written, and anything else is refused at its place.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "haptics/control/gravity.h"
#include "haptics/input_error.h"
#include "scenarios/files/device_file.h"

namespace trocar::device_file_test {
namespace {

DeviceModel sample() {
  DeviceModel model;
  model.identified_gravity = gravity_of(gravity_parameters({}) * 1.0123456789);
  model.coulomb << 0.0101, 0.0065, 0.0073, 0.0054, 0.0073, 0.0046;
  model.viscous << 0.0042, 1e-17, 0, 0.0066, 0.0049, 0.0059;
  return model;
}

std::filesystem::path written(const std::string& text) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "trocar_device_file_test.toml";
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

std::string refusal(const std::string& text) {
  try {
    load_device(written(text));
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = device_toml(sample(), "of a test");
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(DeviceFile, ReadsBackBitForBit) {
  const DeviceModel model = sample(), again = load_device(written(device_toml(model, "two\nlines")));
  EXPECT_EQ(gravity_parameters(again), gravity_parameters(model));
  EXPECT_EQ(again.coulomb, model.coulomb);
  EXPECT_EQ(again.viscous, model.viscous);
  EXPECT_EQ(device_toml(again, "x"), device_toml(model, "x"));
}

TEST(DeviceFile, CommentIsOneAndKeepsItsLines) {
  EXPECT_EQ(device_toml(sample(), "two\nlines").substr(0, 14), "# two\n# lines\n");
}

TEST(DeviceFile, RefusesWhatIsWrongAtItsPlace) {
  EXPECT_NE(refusal(with("coulomb_n_m = 0.0065", "coulomb_n_m = -0.0065")).find("coulomb_n_m"), std::string::npos);
  EXPECT_NE(refusal(with("coulomb_n_m = 0.0065", "coulomb_n_m = nan")).find("coulomb_n_m"), std::string::npos);
  EXPECT_NE(refusal(with("link2_n_m = [", "link2_n_m = [1.0, ")).find("link2_n_m"), std::string::npos);
  EXPECT_NE(refusal(with("platform_n_m", "platfrom_n_m")).find("platform_n_m"), std::string::npos);
  EXPECT_NE(refusal(with("[gravity]", "[weight]")).find("gravity"), std::string::npos);
  std::string five = device_toml(sample(), "");
  five.erase(five.find("[[joint]]  # th6"));
  EXPECT_NE(refusal(five).find("six joints, not 5"), std::string::npos) << refusal(five);
  EXPECT_NE(refusal("x = ["), "accepted");
}

TEST(DeviceFile, NamesTheFileThatIsNotThere) {
  try {
    load_device("/nowhere/device.toml");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("/nowhere/device.toml"), std::string::npos);
  }
}

TEST(DeviceFile, OnlyIdentifiedModelsAreWritten) { EXPECT_THROW(device_toml({}, ""), InputError); }

}  // namespace
}  // namespace trocar::device_file_test
