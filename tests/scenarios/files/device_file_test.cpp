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

TEST(DeviceFile, ASensorReadsBackWithItsAxesFixtureAndCounts) {
  const DeviceModel read =
      load_device(written("[sensor]\nrpy_deg = [180, 0, 90]\nbody = \"device\"\nfixture_kg = 0.08\n"
                          "fixture_com_mm = [0, 1, -20]\nlag_ms = 4\ncounts_per_n = 1000\ncounts_per_nm = 2e5\n"));
  ASSERT_TRUE(read.sensor);
  // Rolled over first, then turned by the yaw: x of the sensor along y of the stylus, y along its x, z against its z.
  Mat3 turned;
  turned << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  EXPECT_LT((read.sensor->R_SF() - turned).norm(), 1e-12);
  EXPECT_TRUE(read.sensor->body_on_device);
  EXPECT_EQ(read.sensor->fixture_kg, 0.08);
  EXPECT_LT((read.sensor->fixture_com_F - Vec3(0, 1e-3, -20e-3)).norm(), 1e-15);
  const DeviceModel again = load_device(written(device_toml(read, "of a test")));
  ASSERT_TRUE(again.sensor);
  EXPECT_LT((again.sensor->R_SF() - turned).norm(), 1e-12);
  EXPECT_LT((again.sensor->fixture_com_F - read.sensor->fixture_com_F).norm(), 1e-15);
  EXPECT_EQ(again.sensor->body_on_device, true);
  EXPECT_EQ(again.sensor->lag_s, 0.004);
  EXPECT_EQ(again.sensor->counts_per_n, 1000);
  EXPECT_EQ(again.sensor->counts_per_nm, 2e5);
  const DeviceModel counts_only = load_device(written("[sensor]\ncounts_per_n = 1000\n"));
  EXPECT_FALSE(counts_only.sensor->rpy_rad) << "its axes are not known then";
  EXPECT_FALSE(counts_only.sensor->counts_per_nm);
}

TEST(DeviceFile, ASensorThatMakesNoSenseIsRefusedAtItsPlace) {
  EXPECT_NE(refusal("[sensor]\nfixture_kg = 0.08\n").find("trocar_device_file_test.toml:2"), std::string::npos);
  EXPECT_NE(refusal("[sensor]\nfixture_kg = 0.08\n").find("rpy_deg"), std::string::npos);
  EXPECT_NE(refusal("[sensor]\nrpy_deg = [0, 0, 0]\nfixture_com_mm = [0, 0, 1]\n").find("fixture_kg"),
            std::string::npos);
  EXPECT_NE(refusal("[sensor]\nrpy_deg = [0, 0]\n").find("rpy_deg"), std::string::npos);
  EXPECT_NE(refusal("[sensor]\nrpy_deg = [0, 0, 400]\n").find("rpy_deg"), std::string::npos);
  EXPECT_NE(refusal("[sensor]\nlag_ms = 1500\n").find("lag_ms"), std::string::npos);
  EXPECT_NE(refusal("[sensor]\ncounts_per_n = 0\n").find("counts_per_n"), std::string::npos);
  EXPECT_NE(refusal("[sensor]\nbody = \"foot\"\n").find("body"), std::string::npos);
  EXPECT_NE(refusal("[sensor]\nfixture_g = 80\n").find("fixture_g"), std::string::npos);
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
