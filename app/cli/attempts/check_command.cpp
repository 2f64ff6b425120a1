#include "app/cli/attempts/check_command.h"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/attempts/board_play.h"
#include "app/cli/command.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/scoring/trace.h"
#include "tissue/organ/organ_set.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

using Json = nlohmann::ordered_json;

Json reach_json(const Reach& reach) {
  Json json = {{"reachable", reach.reachable},
               {"joint_margin_deg", reach.joint_margin_rad / kDegree},
               {"det_a", reach.det_a},
               {"off_axis", reach.off_axis},
               {"link_clearance_m", reach.clearance_m},
               {"torque_share", reach.torque_share},
               {"held_s", reach.held_s}};
  if (reach.handle_to_port_m < 1) json["handle_to_port_m"] = reach.handle_to_port_m;
  if (reach.shaft_gap_m < 1) json["shaft_gap_m"] = reach.shaft_gap_m;
  return json;
}

Json played_json(const PlayedLevel& played) {
  Json boards = Json::array();
  for (const PlayedBoard& board : played.boards) {
    Json one = {{"board", board.board}, {"status", status_name(board.status)}, {"score", board.score}};
    if (!board.why.empty()) one["why"] = board.why;
    boards.push_back(std::move(one));
  }
  return {{"sound", played.why().empty()}, {"why", played.why()}, {"boards", std::move(boards)}};
}

Json proof_json(const LevelProof& proof) {
  Json boards = Json::array();
  for (const BoardReach& board : proof.boards) {
    boards.push_back({{"board", board.board}, {"worst", reach_json(board.worst)}});
  }
  return {{"exercise", proof.exercise},
          {"level", proof.level},
          {"mapping", proof.fulcrum ? "fulcrum" : "direct"},
          {"sound", proof.sound},
          {"why", proof.why},
          {"kappa", proof.kappa},
          {"room_share", proof.room_share},
          {"room_n", proof.room_n},
          {"organ_roll_deg", proof.placement.roll_rad / kDegree},
          {"organ_turn_deg", proof.placement.turn_rad / kDegree},
          {"hottest_winding_c", proof.hottest_c},
          {"worst", reach_json(proof.worst)},
          {"boards", std::move(boards)}};
}

void print(const PlayedLevel& played, std::ostream& out) {
  const auto [worst, best] = std::minmax_element(played.boards.begin(), played.boards.end(),
                                                 [](const auto& a, const auto& b) { return a.score < b.score; });
  out << "  played by the expert on the simulated plant: " << played.boards.size() << " boards, "
      << std::setprecision(1) << worst->score << " to " << best->score << " points"
      << (played.why().empty() ? "" : "; NOT sound: " + played.why()) << '\n';
}

void print(const LevelProof& proof, std::ostream& out) {
  const Reach& w = proof.worst;
  out << proof.exercise << ' ' << proof.level << " (" << (proof.fulcrum ? "fulcrum" : "direct")
      << "): " << (proof.sound ? "sound" : "NOT sound: " + proof.why) << '\n'
      << std::fixed << std::setprecision(1) << "  " << proof.boards.size() << " boards; worst joint margin "
      << w.joint_margin_rad / kDegree << " deg, det A " << std::setprecision(2) << w.det_a << ", |AO x Z6| "
      << w.off_axis << ", link clearance " << std::setprecision(1) << 1e3 * w.clearance_m << " mm";
  if (proof.fulcrum) out << ", handle to port " << 1e3 * w.handle_to_port_m << " mm";
  if (w.shaft_gap_m < 1) out << ", shaft to organ " << 1e3 * w.shaft_gap_m << " mm";
  const std::string turned = turned_words(proof.placement);
  if (!turned.empty()) out << "\n  " << turned;
  out << "\n  gravity and hard limit take " << std::setprecision(0) << 100 * w.torque_share
      << " % of a motor's torque, held " << w.held_s << " s from cold; winding " << proof.hottest_c
      << " C after the time limit\n  kappa " << std::setprecision(2) << proof.kappa << ", soft limit given in "
      << std::setprecision(1) << 100 * proof.room_share << " % of the region, " << std::setprecision(2) << proof.room_n
      << " N at its 5th percentile\n";
}

struct Checked {
  std::vector<LevelProof> proofs;
  std::vector<PlayedLevel> played;  ///< one a proof; without boards when none were played
  std::vector<Scene> scenes;        ///< one a proof, of its first board
};

std::vector<std::string> checked_levels(const Exercise& exercise, const CheckOptions& options) {
  std::vector<std::string> names = options.levels;
  for (const std::string& name : names) find_level(exercise, name);
  if (!names.empty()) return names;
  for (const ExerciseLevel& level : exercise.levels) names.push_back(level.name);
  return names;
}

void check_exercise(const Exercise& exercise, const Organ& organ, const CheckOptions& options, const AssetRoots& assets,
                    std::ostream& err, Checked& checked) {
  if (kind_of(exercise).on_organ) require_sound(organ);
  for (const std::string& level : checked_levels(exercise, options)) {
    LevelProof proof = prove_level(exercise, level, organ, options.unseen);
    PlayedLevel played = options.play ? play_level(exercise, level, options.organ, assets, err) : PlayedLevel{};
    AttemptSetup setup;
    setup.exercise = exercise;
    setup.level = level;
    setup.weak_too = true;
    checked.scenes.push_back(build_scene(setup, organ, {"simulated", 1000, 16}));
    checked.played.push_back(std::move(played));
    checked.proofs.push_back(std::move(proof));
  }
}

}  // namespace

int check_command(const CheckOptions& options, std::ostream& out, std::ostream& err) {
  const AssetRoots assets = find_assets();
  const Organ organ = load_organ(find_organ(options.organ, assets.assets));
  Checked checked;
  bool sound = true;
  for (const std::string& subject : options.subjects) {
    try {
      const Exercise exercise = find_exercise(subject, assets.exercises);
      check_exercise(exercise, organ, options, assets, err, checked);
      if (!options.inversion.empty()) paint_inversion(exercise, organ, assets, options.inversion);
    } catch (const InputError& error) {
      err << "trocar: " << error.what() << '\n';
      sound = false;
    }
  }
  Json json = Json::array();
  for (std::size_t i = 0; i < checked.proofs.size(); ++i) {
    const LevelProof& proof = checked.proofs[i];
    const PlayedLevel& played = checked.played[i];
    sound = sound && proof.sound && played.why().empty();
    if (options.json) {
      json.push_back(proof_json(proof));
      if (options.play) json.back()["played"] = played_json(played);
    } else {
      print(proof, out);
      if (options.play) print(played, out);
    }
  }
  if (options.json) out << json.dump(2) << '\n';
  if (!options.map.empty()) write_file(options.map, room_map_svg(checked.proofs, checked.scenes));
  return sound ? 0 : 2;
}

void add_check(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<CheckOptions>();
  CheckOptions& o = *given;
  CLI::App* check = add_command(parent, "check", "Prove that the device can do what exercises ask for", chosen,
                                [given] { return check_command(*given, std::cout, std::cerr); });
  check->add_option("exercise", o.subjects, "Exercise ids or files")->required();
  check->add_option("--organ", o.organ, "Organ to lay the boards on")->capture_default_str();
  check->add_option("--unseen", o.unseen, "Boards of graded runs to prove besides the practice boards 0 to 19")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  check->add_option("--map", o.map, "SVG of the force that the device can give over the board")->check(writable_path());
  check->add_option("--inversion", o.inversion, "Folder for two pictures of one hand motion, direct and through a port")
      ->check(writable_path());
  check->add_option("--level", o.levels, "Levels to prove (default: all)")->delimiter(',');
  check->add_flag("--play", o.play,
                  "Also let the expert play each practice board, in lockstep: minutes, kept in the cache folder");
  check->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
