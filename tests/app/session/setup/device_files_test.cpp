// What a run learns of its device from files: the model, the doubts, the way into a recording and out, the forces it
// saves.
#include "app/session/setup/device_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include <nlohmann/json.hpp>

#include "app/cli/attempts/recording_command.h"
#include "app/cli/attempts/run_command.h"
#include "app/cli/device/device_calibrate.h"
#include "app/cli/device/identify_command.h"
#include "app/device_bench/plant_bench.h"
#include "app/session/calibration/calibration_file.h"
#include "app/session/session.h"
#include "app/session/setup/true_plant.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"
#include "scenarios/files/device_file.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/scenarios/support/bad_exercise.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::device_files_test {
namespace {

using test::message_of;

constexpr std::uint64_t kSeed = 5;
constexpr double kPayload_kg = 0.05;

std::string calibration_text(double gain, double offset_v, const std::string& plant = "") {
  AmplifierCalibration found;
  for (ChannelCalibration& c : found) c = {0.431 * gain, 0, offset_v, 0, 0, 0};
  return calibration_json(found, {}, plant);
}

/// What `trocar device identify` writes of the seed's device with a weight on its stylus; here it names the device
/// alone.
const std::string& identified_text() {
  static const std::string text = [] {
    test::TemporaryFolder folder;
    IdentifyOptions options;
    options.seed = kSeed;
    options.payload_kg = kPayload_kg;
    options.quick = true;
    options.out = folder / "found.toml";
    std::ostringstream out, err;
    identify_command(options, out, err);
    std::string written = read_device_files("", options.out).identified->text;
    const auto at = written.find(", payload 0.05 kg\"");
    if (at == std::string::npos) throw std::runtime_error("the file does not name the payload: " + written);
    return written.erase(at, std::string(", payload 0.05 kg").size());
  }();
  return text;
}

/// The same device: the weight hangs 30 mm down the roll axis.
PlantParameters weighted_plant() {
  PlantParameters p = draw_parameters(kSeed);
  const double whole = p.stylus_mass + kPayload_kg;
  p.stylus_com = (p.stylus_mass * p.stylus_com + kPayload_kg * Vec3(0, 0, 0.030)) / whole;
  p.stylus_mass = whole;
  return p;
}

DeviceFiles identified() { return {std::nullopt, DeviceFile{identified_text(), "found.toml"}}; }

/// Mean force on a hand that holds the stylus still in free air, N.
double holding_force(const DeviceFiles& files) {
  SimulatedDaqConfig device;
  device.seed = kSeed;
  device.plant = weighted_plant();
  device.hand.tremor_m = 0;
  HapticLoopConfig loop;
  loop.device = device_model(files);
  PlantBench bench(device, loop);
  bench.start();
  JointVector q;  // at home the weight hangs under the centre of rotation, where no joint feels it
  q << 45, 45, 45, -60, -75, 0;
  bench.move(arm_state(q * std::numbers::pi / 180).X_WS, 2);
  bench.run(0.5);
  double sum = 0;
  constexpr int kTicks = 1000;
  for (int k = 0; k < kTicks; ++k) {
    bench.tick();
    sum += bench.daq().sense().force_on_hand.norm();
  }
  return sum / kTicks;
}

TEST(DeviceModelOfFiles, IsNominalWithoutAny) {
  const DeviceModel nominal, model = device_model({});
  EXPECT_FALSE(model.identified_gravity);
  EXPECT_EQ(model.coulomb, nominal.coulomb);
  EXPECT_EQ(model.transmission[0].amps_per_volt, nominal.transmission[0].amps_per_volt);
}

DeviceFiles homed_by(const std::string& homing) {
  return {std::nullopt, DeviceFile{"[homing]\n" + homing + "\n", "jig.toml"}};
}

TEST(DeviceModelOfFiles, OfARealDeviceNeverTakesALampThatIsStuckForTheJig) {
  for (const char* real : {kHostmot2Backend, kMc4000Backend}) {
    for (const DeviceFiles& files : {DeviceFiles{}, homed_by("method = \"light\"\nsee_dark = false")}) {
      const HomingModel homing = device_model(files, real).homing;
      EXPECT_TRUE(homing.see_dark) << real;
      EXPECT_EQ(homing.method, HomingMethod::kEdges) << real;
    }
    EXPECT_TRUE(device_model({}, real, HomingMethod::kLight).homing.see_dark) << real;
  }
  for (const char* simulated : {kSimulatedBackend, kFakeHostmot2Backend, kEmulatedMc4000Backend}) {
    const HomingModel homing = device_model({}, simulated).homing;
    EXPECT_FALSE(homing.see_dark) << simulated;
    EXPECT_EQ(homing.method, HomingMethod::kLight) << simulated;
  }
}

TEST(DeviceModelOfFiles, ByTheIndexIsRefusedWhereTheBoardsTellOfNone) {
  const DeviceFiles files = homed_by("method = \"index\"\nmarks_123_counts = [1, 2, 3]\nmarks_456_counts = [4, 5, 6]");
  for (const char* without : {kMc4000Backend, kEmulatedMc4000Backend})
    EXPECT_CONTAINS(message_of<InputError>([&] { device_model(files, without); }), "tell of no index pulse");
  EXPECT_EQ(device_model(files, kHostmot2Backend).homing.method, HomingMethod::kIndex);
  EXPECT_EQ(device_model(files, kSimulatedBackend).homing.index_counts[5], 6);
}

/// Its recording must be replayed by a loop that homes as that one did.
TEST(DeviceModelOfFiles, OfARealDeviceIsThatOfItsReplayToo) {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = find_exercise("reach-and-orient", assets.exercises);
  setup.hand = "device";
  setup.backend = kHostmot2Backend;
  const Scene scene = build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
  EXPECT_TRUE(scene.loop.device.homing.see_dark);
  const RecordedSetup recorded = parse_scene_json(scene_json(scene), "recorded");
  const Scene replayed = build_scene(recorded.setup, assets, recorded.daq);
  EXPECT_TRUE(replayed.loop.device.homing.see_dark);
  EXPECT_EQ(replayed.loop.device.homing.method, HomingMethod::kEdges);
  EXPECT_THROW(parse_scene_json(test::edited(scene_json(scene), "\"hostmot2\"", "4"), "edited"), InputError);
}

TEST(DeviceModelOfFiles, TakesBothTogether) {
  DeviceFiles files = identified();
  files.calibration = DeviceFile{calibration_text(5, 0.004), "c.json"};
  const DeviceModel model = device_model(files);
  EXPECT_TRUE(model.identified_gravity);
  for (const Transmission& t : model.transmission) {
    EXPECT_DOUBLE_EQ(t.amps_per_volt, 5 * 0.431);
    EXPECT_DOUBLE_EQ(t.offset_v, 0.004);
  }
}

TEST(DeviceModelOfFiles, TheIdentifiedOneCarriesAWeightThatTheNominalOneLeavesToTheHand) {
  const double nominal = holding_force({}), found = holding_force(identified());
  RecordProperty("nominal_n", std::to_string(nominal));
  RecordProperty("identified_n", std::to_string(found));
  EXPECT_GT(nominal, 0.3) << "half a newton hangs on the stylus";
  EXPECT_LT(found, 0.5 * nominal);
}

TEST(DeviceFiles, SayWhatIsWrongAndWhere) {
  EXPECT_NE(message_of<InputError>([] { read_device_files("/nowhere/c.json", ""); }).find("/nowhere/c.json"),
            std::string::npos);
  const test::TemporaryFolder folder;
  const std::filesystem::path nothing = folder.write("nothing.toml", "");
  EXPECT_CONTAINS(message_of<InputError>([&] { read_device_files("", nothing); }), "nothing.toml: is empty");
  const auto refusal = [](const DeviceFiles& files) { return message_of<InputError>([&] { device_model(files); }); };
  const DeviceFile toml{identified_text(), "found.toml"}, json{calibration_text(1, 0), "c.json"};
  EXPECT_NE(refusal({toml, std::nullopt}).find("found.toml: no JSON object"), std::string::npos)
      << "given to the wrong option";
  EXPECT_NE(refusal({std::nullopt, json}).find("c.json:"), std::string::npos);
  EXPECT_NE(refusal({DeviceFile{calibration_text(-1, 0), "c.json"}, std::nullopt}).find("must be positive"),
            std::string::npos);
  EXPECT_NE(refusal({DeviceFile{"{\"plant\": 3, \"channels\": []}", "c.json"}, std::nullopt}).find("plant"),
            std::string::npos);
}

TEST(DeviceFiles, AreDoubtedOnAnotherDevice) {
  EXPECT_TRUE(device_doubts(identified(), simulated_plant_words(kSeed)).empty());
  const auto doubts = device_doubts(identified(), simulated_plant_words(6));
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_NE(doubts[0].find("simulated, seed 5"), std::string::npos) << doubts[0];
  EXPECT_NE(doubts[0].find("simulated, seed 6"), std::string::npos) << doubts[0];
  const DeviceFile silent{calibration_text(1, 0), "c.json"},
      other{calibration_text(1, 0, "the one in room 3"), "c.json"};
  EXPECT_TRUE(device_doubts({silent, std::nullopt}, simulated_plant_words(6)).empty()) << "it does not say";
  EXPECT_EQ(device_doubts({other, std::nullopt}, simulated_plant_words(6)).size(), 1u);
}

TEST(DeviceFiles, TheirDeviceTravelsAndMayBeMissing) {
  DeviceModel model;
  model.identified_gravity.emplace();
  std::string plant = "before";
  parse_device(device_toml(model, "a comment", "the one in room 3"), "d.toml", &plant);
  EXPECT_EQ(plant, "the one in room 3");
  parse_device(device_toml(model, "a comment"), "d.toml", &plant);
  EXPECT_EQ(plant, "") << "files from before say nothing";
  parse_calibration(calibration_text(1, 0, "the one in room 4"), "c.json", &plant);
  EXPECT_EQ(plant, "the one in room 4");
  parse_calibration(calibration_text(1, 0), "c.json", &plant);
  EXPECT_EQ(plant, "");
  const std::string number = "plant = 3\n" + device_toml(model, "a comment");
  EXPECT_NE(message_of<InputError>([&] { parse_device(number, "d.toml"); }).find("d.toml:1"), std::string::npos);
}

TEST(DeviceFiles, OfTheCommandsNameTheirDevice) {
  test::TemporaryFolder folder;
  CalibrateOptions calibrate;
  calibrate.seed = 3;
  calibrate.out = folder / "c.json";
  std::ostringstream out, err;
  ASSERT_EQ(device_calibrate(calibrate, out, err), 0);
  const DeviceFiles files = read_device_files(calibrate.out, "");
  EXPECT_TRUE(device_doubts(files, simulated_plant_words(3)).empty());
  EXPECT_EQ(device_doubts(files, simulated_plant_words(4)).size(), 1u);
}

/// The shipped exercise cut to one disc.
std::string short_exercise(const test::TemporaryFolder& folder) {
  std::string text = find_exercise("surface-touch", find_assets().exercises).text;
  text.replace(text.find("count = 12"), 10, "count = 2");
  text.replace(text.find("time_limit_s = 120"), 18, "time_limit_s = 30");
  std::ofstream(folder / "short.toml") << text;
  return (folder / "short.toml").string();
}

TEST(RunWithDeviceFiles, IsVerifiedWithoutTheFiles) {
  const std::string identified = identified_text();  // in this folder's place, which it clears away
  test::TemporaryFolder folder;
  RunOptions run;
  run.exercise = short_exercise(folder);
  run.hand = "expert";
  run.seed = static_cast<std::int64_t>(kSeed);
  run.board = 1;
  run.database = ":memory:";
  run.calibration = folder / "c.json";
  run.device = folder / "found.toml";
  std::ofstream(run.calibration) << calibration_text(1.01, 0.002, simulated_plant_words(9));
  std::ofstream(run.device) << identified;
  std::ostringstream out, err, plain_out;
  run.record = folder / "with.trec";
  run_command(run, out, err);
  EXPECT_NE(err.str().find("c.json: was calibrated on another device"), std::string::npos) << err.str();
  EXPECT_EQ(err.str().find("found.toml: was identified"), std::string::npos) << err.str();

  std::filesystem::remove(run.calibration);
  std::filesystem::remove(run.device);
  RecordingOptions replay;
  replay.subject = run.record.string();
  replay.verify = true;
  std::ostringstream words;
  EXPECT_EQ(replay_command(replay, words, err), 0) << words.str();

  const Recording with = read_recording(run.record);
  run.calibration = run.device = "";
  run.record = folder / "without.trec";
  run_command(run, plain_out, err);
  const Recording without = read_recording(run.record);
  EXPECT_NE(with.end->state_hash, without.end->state_hash) << "the files matter";
  const RecordedSetup setup = parse_scene_json(with.session, "with");
  ASSERT_TRUE(setup.setup.device.calibration && setup.setup.device.identified);
  EXPECT_EQ(setup.setup.device.identified->text, identified_text());
  EXPECT_FALSE(parse_scene_json(without.session, "without").setup.device.calibration);
}

TEST(PlantJson, NamesTheArmAndTheFilesThatTheLoopKnewItBy) {
  EXPECT_EQ(plant_json(nullptr, 7, {}), R"({"seed":7,"calibration":null,"identification":null})");
  PlantFile plant;
  plant.name = "arm.toml";
  plant.sha256 = "0123";
  const auto json = nlohmann::json::parse(plant_json(&plant, 7, {DeviceFile{"{}", "c.json"}, std::nullopt}));
  EXPECT_EQ(json["file"], "arm.toml");
  EXPECT_FALSE(json.contains("seed"));
  EXPECT_EQ(json["calibration"]["file"], "c.json");
  EXPECT_EQ(json["calibration"]["sha256"], "44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a");
}

}  // namespace
}  // namespace trocar::device_files_test
