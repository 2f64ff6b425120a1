// Plant files on the command line: the printed template, the check, what takes --plant, what the run report says of it.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "app/cli/attempts/attempt_json.h"
#include "app/cli/attempts/run_command.h"
#include "app/cli/device/device_calibrate.h"
#include "app/cli/device/device_plant.h"
#include "app/session/calibration/calibration_file.h"
#include "app/session/grading/recorded_result.h"
#include "app/session/setup/true_plant.h"
#include "app/studies/study.h"
#include "app/studies/study_command.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::plant_command_test {
namespace {

using test::message_of;

std::filesystem::path write(const test::TemporaryFolder& folder, const std::string& text) {
  const std::filesystem::path file = folder.path() / "arm.toml";
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

struct Said {
  std::string out, err;
};
Said said(const PlantOptionsGiven& options) {
  std::ostringstream out, err;
  EXPECT_EQ(device_plant(options, out, err), 0);
  return {out.str(), err.str()};
}

TEST(DevicePlantCommand, PrintsTheNominalDeviceAsAFileThatReads) {
  const Said nominal = said({});
  const PlantFile back = parse_plant(nominal.out, "printed");
  EXPECT_EQ(back.parameters.stylus_mass, nominal_parameters().stylus_mass);
  EXPECT_NE(nominal.out.find("# [T] Table 4.1, 3.21 N"), std::string::npos) << "each value has its source";
  EXPECT_NE(nominal.err.find("weight of what moves 5.78 N"), std::string::npos) << nominal.err;
  // The reference works out .079, .127 and, radially with the elbow nearly straight, 3.6 kg.
  EXPECT_NE(nominal.err.find("mass felt at the stylus there 0.0796, 0.121 and 3.39 kg"), std::string::npos)
      << nominal.err;
}

TEST(DevicePlantCommand, PrintsWhatASeedDraws) {
  PlantOptionsGiven options;
  options.seed = 7;
  EXPECT_EQ(parse_plant(said(options).out, "printed").parameters.jig_error, draw_parameters(7).jig_error);
  options.all = true;
  EXPECT_EQ(parse_plant(said(options).out, "printed").parameters.leg_stop, draw_everything(7).leg_stop);
}

TEST(DevicePlantCommand, ChecksAFileAndPrintsItComplete) {
  const test::TemporaryFolder folder;
  PlantOptionsGiven options;
  options.plant = write(folder, "[stylus]\nmass_kg = 0.15\n[cable]\nstiffness_n_m_per_rad = 100\n[heat]\n");
  const Said whole = said(options);
  EXPECT_EQ(parse_plant(whole.out, "printed").parameters.stylus_mass, 0.15);
  EXPECT_NE(whole.err.find("th1 at 361 Hz"), std::string::npos) << whole.err;  // sqrt(100 / 1.95e-5) / 2 pi
  EXPECT_NE(whole.err.find("motors that warm up"), std::string::npos);
  options.plant = write(folder, "[stylus]\nmass_kg = 4.5\n");
  EXPECT_NE(said(options).err.find("cannot hold this arm up"), std::string::npos);
}

TEST(DevicePlantCommand, RefusesWhatCannotBe) {
  const test::TemporaryFolder folder;
  const auto refusal = [](const PlantOptionsGiven& options) {
    std::ostringstream sink;
    return message_of<InputError>([&] { device_plant(options, sink, sink); });
  };
  PlantOptionsGiven options;
  options.plant = write(folder, "[stylus]\ninertia_kg_m2 = [1e-5, 1e-5, -1e-5]\n");
  EXPECT_NE(refusal(options).find("arm.toml:2:17: [stylus] inertia_kg_m2: is not positive definite"), std::string::npos)
      << refusal(options);
  options.seed = 3;
  EXPECT_NE(refusal(options).find("takes its seed from the file"), std::string::npos);
  PlantOptionsGiven all;
  all.all = true;
  EXPECT_NE(refusal(all).find("--seed"), std::string::npos);
  PlantOptionsGiven nowhere;
  nowhere.out = folder.path() / "no" / "such" / "folder.toml";
  std::ostringstream sink;
  EXPECT_THROW(device_plant(nowhere, sink, sink), EnvironmentError);
}

TEST(TruePlant, IsTheFilesOrTheSeeds) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(true_plant({}, 4).words, "seed 4");
  EXPECT_EQ(true_plant({}, 4).parameters.jig_error, draw_parameters(4).jig_error);
  const std::string text = "[jaw]\nmass_kg = 0.03\n";
  const TruePlant given = true_plant(write(folder, text), 4);
  EXPECT_EQ(given.parameters.jaw_mass, 0.03);
  EXPECT_EQ(given.words, "plant file arm.toml, sha256 " + digest::of_bytes(text).substr(0, 8));
}

TEST(TruePlant, CalibrationFindsTheAmplifiersOfTheFile) {
  const test::TemporaryFolder folder;
  CalibrateOptions options;
  options.plant = write(folder, "[joints]\namplifier_a_per_v = 0.5\ndac_offset_v = 0.02\n");
  options.out = folder.path() / "found.json";
  std::ostringstream out, err;
  EXPECT_EQ(device_calibrate(options, out, err), 0);
  const AmplifierCalibration found = read_calibration(options.out);
  for (std::size_t i = 0; i < kArmJoints; ++i) {
    EXPECT_NEAR(found[i].amps_per_volt, 0.5, 5 * found[i].amps_per_volt_sd);
    EXPECT_NEAR(found[i].offset_v, 0.02, 5 * found[i].offset_sd_v);
  }
  EXPECT_NEAR(found[kPinchChannel].offset_v, 0, 5 * found[kPinchChannel].offset_sd_v) << "[joints] are the six";
  EXPECT_NE(err.str().find("arm.toml"), std::string::npos);
}

TEST(StudyPlant, OnlyStudiesOfTheDrawnDeviceTakeOne) {
  const test::TemporaryFolder folder;
  StudyOptions options;
  options.name = "motor";
  options.out = folder.path() / "out";
  options.plant = write(folder, "seed = 2\n");
  std::ostringstream sink;
  const std::string refused = message_of<InputError>([&] { study_command(options, sink, sink); });
  EXPECT_NE(refused.find("--plant is for gravity, transparency, plant"), std::string::npos) << refused;
  options.name = "gravity";
  options.plant = folder.path() / "none.toml";
  EXPECT_NE(message_of<InputError>([&] { study_command(options, sink, sink); }).find("none.toml"), std::string::npos);
}

TEST(StudyPlant, ARequestSaysWhoseDeviceItIs) {
  StudyRequest request{true, 6};
  EXPECT_EQ(request.device_words(), "seed 6");
  EXPECT_EQ(request.true_device().jig_error, draw_parameters(6).jig_error);
  request.plant = nominal_parameters();
  request.plant_words = "plant file arm.toml";
  EXPECT_EQ(request.device_words(), "plant file arm.toml");
  EXPECT_EQ(request.true_device().jig_error, nominal_parameters().jig_error);
}

/// The shipped exercise cut to two discs.
AttemptSetup short_setup() {
  std::string text = find_exercise("surface-touch", find_assets().exercises).text;
  text.replace(text.find("count = 12"), 10, "count = 2");
  AttemptSetup setup;
  setup.exercise = parse_exercise(text, "short.toml");
  setup.organ = "phantom-liver";
  setup.hand = "expert";
  setup.seed = 5;
  setup.board = 1;
  return setup;
}

TEST(RunPlant, TheAttemptHappensOnTheFilesDeviceAndItsRunReportSaysSo) {
  AttemptSetup setup = short_setup();
  const std::string text = "seed = 5\n[hand]\ngrip = \"firm\"\n[sensor]\nrate_hz = 50\n[cable]\n[heat]\n";
  setup.plant = std::make_shared<const PlantFile>(parse_plant(text, "folder/arm.toml"));
  EXPECT_EQ(simulated_device(setup).hand.grip_stiffness, hand_parameters(GripPreset::kFirm).grip_stiffness);
  EXPECT_TRUE(simulated_device(setup).plant->options.heat.on);
  const Scene scene = build_scene(setup, find_assets(), {"simulated", 1000, 16});
  const auto [outcome, recording] = record_session(scene, find_assets(), {});
  EXPECT_EQ(outcome.status, AttemptStatus::kCompleted);
  const AttemptResult result = recorded_result(recording, {});
  const std::string run_report = "\"plant\":{\"file\":\"arm.toml\",\"sha256\":\"" + digest::of_bytes(text) + "\",";
  EXPECT_NE(recording.run_report_json.find(run_report), std::string::npos) << recording.run_report_json;
  EXPECT_NE(recording.run_report_json.find("\"rate_hz\":50"), std::string::npos) << "the file's sensor";
  EXPECT_NE(attempt_json(result).find(digest::of_bytes(text)), std::string::npos);
  EXPECT_EQ(replay_session(scene, recording).state_hash, outcome.state_hash) << "a replay needs no plant";
}

TEST(RunPlant, AFileThatOnlyNamesTheSeedIsTheDefaultToTheBit) {
  AttemptSetup setup = short_setup();
  const auto hash = [&] {
    const Scene scene = build_scene(setup, find_assets(), {"simulated", 1000, 16});
    return record_session(scene, find_assets(), {}).first;
  };
  const SessionOutcome plain = hash();
  EXPECT_EQ(plain.device.plant, R"({"seed":5,"calibration":null,"identification":null})");
  setup.plant = std::make_shared<const PlantFile>(parse_plant("seed = 5\n", "a"));
  EXPECT_EQ(hash().state_hash, plain.state_hash);
  setup.plant = std::make_shared<const PlantFile>(parse_plant("seed = 5\n[stylus]\nmass_kg = 0.1\n", "a"));
  EXPECT_NE(hash().state_hash, plain.state_hash);
}

TEST(RunPlant, ABadFileIsRefusedBeforeAnythingIsStored) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.exercise = "surface-touch";
  options.hand = "expert";
  options.plant = write(folder, "[th1]\nratio = 0\n");
  const std::string refused = message_of<InputError>([&] { attempt_setup(options, find_assets()); });
  EXPECT_NE(refused.find("arm.toml:2:9: 'ratio' = 0 is out of range"), std::string::npos) << refused;
}

}  // namespace
}  // namespace trocar::plant_command_test
