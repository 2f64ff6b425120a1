// The proof of a level: shipped levels are sound, every rule can fail, kappa and its share agree; the map picture.
#include "app/session/setup/workspace_proof.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include <nlohmann/json.hpp>

#include "app/cli/attempts/check_command.h"
#include "app/session/setup/placement.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::workspace_proof_test {
namespace {

const Organ& phantom() {
  static const Organ organ = load_organ(find_organ("phantom-liver", find_assets().assets));
  return organ;
}

/// Surface touch, first level, with `from` replaced by `to`.
Exercise touch(const std::string& from = "", const std::string& to = "") {
  std::string text = find_exercise("surface-touch", find_assets().exercises).text;
  if (!from.empty()) text.replace(text.find(from), from.size(), to);
  return parse_exercise(text, "touch.toml");
}

Exercise through_port(const std::string& port = "[30, -60, 120]") {
  return touch("mapping = \"direct\"", "mapping = \"fulcrum\"\nport_mm = " + port);
}

TEST(Proof, SurfaceTouchIsSoundDirectAndThroughThePort) {
  for (const Exercise& exercise : {touch(), through_port()}) {
    const LevelProof proof = prove_level(exercise, "L1", phantom(), 5);
    EXPECT_TRUE(proof.sound) << proof.why;
    EXPECT_EQ(proof.boards.size(), 25u);
    EXPECT_EQ(proof.boards.back().board, 1004) << "unseen boards count from 1000";
    EXPECT_GE(proof.worst.joint_margin_rad, 8 * kDegree);
    EXPECT_GT(proof.worst.clearance_m, 0);
    EXPECT_LE(proof.worst.torque_share, 1);
    EXPECT_GT(proof.kappa, 0.8);
    EXPECT_GE(proof.room_share, 0.95) << "that is what auto means";
  }
}

TEST(Proof, APortFarAsideIsRefusedWithTheBoardAndTheReason) {
  const LevelProof proof = prove_level(through_port("[150, 100, 120]"), "L1", phantom(), 0);
  EXPECT_FALSE(proof.sound);
  EXPECT_NE(proof.why.find("board "), std::string::npos) << proof.why;
}

TEST(Proof, EveryRuleCanBreak) {
  Reach good;
  good.torque_share = 0.5;
  const ReachRules rules;
  EXPECT_EQ(good.broken(rules), "");
  std::vector<std::string> reasons;
  const auto spoiled = [&](auto change) {
    Reach bad = good;
    change(bad);
    EXPECT_FALSE(bad.sound(rules));
    reasons.push_back(bad.broken(rules));
  };
  spoiled([](Reach& r) { r.reachable = false; });
  spoiled([](Reach& r) { r.joint_margin_rad = 7.9 * kDegree; });
  spoiled([](Reach& r) { r.det_a = 0.29; });
  spoiled([](Reach& r) { r.off_axis = 0.09; });
  spoiled([](Reach& r) { r.clearance_m = -1e-6; });
  spoiled([](Reach& r) { r.handle_to_port_m = 0.025; });
  spoiled([](Reach& r) { r.shaft_gap_m = 0.001; });
  spoiled([](Reach& r) { r.torque_share = 1.01; });
  spoiled([](Reach& r) { r.held_s = 1; });
  std::sort(reasons.begin(), reasons.end());
  EXPECT_EQ(std::unique(reasons.begin(), reasons.end()), reasons.end()) << "each says something else";
  Reach both = good;
  both.add({.joint_margin_rad = 0.1, .torque_share = 0.9});
  EXPECT_DOUBLE_EQ(both.joint_margin_rad, 0.1);
  EXPECT_DOUBLE_EQ(both.torque_share, 0.9);
}

TEST(Proof, ForceBeyondTheMotorsIsSeen) {
  const InstrumentMap map = place_theatre(through_port().levels[0]);
  const DeviceModel device;
  const Pose X_TI{map.instrument_pose(home_pose()).R, Vec3::Zero()};
  const double room = renderable_force_n(map, device, Vec3(0, 0, 0));
  const auto share = [&](double n) { return reach_of(device, map, X_TI, {Vec3(0, 0, n), Vec3::Zero()}).torque_share; };
  EXPECT_LE(share(0.99 * room), 1) << "the room is what fits";
  EXPECT_GT(share(1.01 * room), 1);
  EXPECT_LT(reach_of(device, map, X_TI, {Vec3(0, 0, 3 * room), Vec3::Zero()}).held_s, 60) << "it would get hot";
}

TEST(Proof, ShareOfTheRegionFallsWithTheForceAsked) {
  const InstrumentMap map = place_theatre(through_port().levels[0]);
  const DeviceModel device;
  const TargetLayout layout = touch().layout;
  double last = 1;
  for (const double n : {0.1, 0.5, 1.0, 2.0, 4.0}) {
    const double share = room_share(map, device, layout, n);
    EXPECT_LE(share, last);
    last = share;
  }
  EXPECT_LT(last, 0.5);
}

TEST(CheckCommand, PrintsJsonAndDrawsTheMap) {
  const test::TemporaryFolder folder;
  const auto file = folder / "port.toml";
  std::ofstream(file) << through_port().text;
  CheckOptions options;
  options.subjects = {file.string()};
  options.unseen = 0;
  options.json = true;
  options.map = folder / "map.svg";
  std::ostringstream out, err;
  EXPECT_EQ(check_command(options, out, err), 0) << err.str();
  const auto json = nlohmann::json::parse(out.str());
  ASSERT_EQ(json.size(), 4u) << "one a level";
  EXPECT_EQ(json[0]["mapping"], "fulcrum");
  EXPECT_EQ(json[0]["boards"].size(), 20u);
  EXPECT_GT(json[0]["worst"]["handle_to_port_m"].get<double>(), 0.03);
  std::ifstream in(options.map);
  const std::string svg((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_EQ(svg.substr(0, 4), "<svg");
  const auto count = [&](const std::string& what) {
    int n = 0;
    for (auto at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<circle"), 4 * 12) << "the discs of one board, for each level";
  EXPECT_GT(count("<rect"), 1000);
}

TEST(CheckCommand, AnUnknownExerciseAndAnUnreachablePortAreNotSound) {
  std::ostringstream out, err;
  CheckOptions options;
  options.subjects = {"no-such-exercise"};
  EXPECT_EQ(check_command(options, out, err), 2);
  EXPECT_NE(err.str().find("no-such-exercise"), std::string::npos);
  const test::TemporaryFolder folder;
  const auto file = folder / "aside.toml";
  std::ofstream(file) << through_port("[150, 100, 120]").text;
  options.subjects = {file.string()};
  options.unseen = 0;
  EXPECT_EQ(check_command(options, out, err), 2);
  EXPECT_NE(out.str().find("NOT sound"), std::string::npos);
}

}  // namespace
}  // namespace trocar::workspace_proof_test
