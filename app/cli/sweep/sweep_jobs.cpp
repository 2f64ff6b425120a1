#include "app/cli/sweep/sweep_jobs.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>

#include "app/cli/attempts/run_command.h"
#include "app/session/session.h"
#include "haptics/digest/digest.h"
#include "haptics/fault.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/make_hand.h"
#include "scenarios/hands/population.h"
#include "scenarios/layout/board_numbers.h"
#include "trainees/records/attempt_store.h"

namespace trocar {
namespace {

constexpr std::int64_t kMostSeeds = 10000;
constexpr std::int64_t kLargestSeed = std::int64_t{1} << 60;

const SweepArm& find_arm(const std::string& name) {
  for (const SweepArm& arm : kSweepArms) {
    if (name == arm.name) return arm;
  }
  throw InputError("--arm " + name + ": drawn, friction, saturation, increment or degraded");
}

std::int64_t number_of_range(std::string_view text, const std::string& option, const std::string& whole) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw InputError(option + " " + whole + ": A..B, two whole numbers");
  }
  return value;
}

struct SweptHand {
  std::string given, name, sha256;  ///< name or file, the script's own name, of its scripts
};

/// The persons of NAME#A..B one by one. A wrong name is refused now.
std::vector<SweptHand> list_hands_of(const SweepPlan& plan, const AssetRoots& assets) {
  std::vector<std::string> names;
  for (const std::string& hand : plan.hands) {
    const auto mark = hand.find('#');
    if (mark == std::string::npos || hand.find("..", mark) == std::string::npos) {
      names.push_back(hand);
      continue;
    }
    const auto [first, last] = parse_range("--hand", hand.substr(mark + 1));
    for (std::int64_t person = first; person <= last; ++person)
      names.push_back(hand.substr(0, mark + 1) + std::to_string(person));
  }
  std::vector<SweptHand> hands;
  std::map<std::string, std::string> digests;
  for (const std::string& name : names) {
    make_hand(name, 0, assets.hands);
    std::string& known = digests[split_person(name).first];
    if (known.empty()) known = digest::of_bytes(hand_bytes(name, assets.hands));
    const bool file = name.ends_with(".toml");
    hands.push_back({name, file ? load_hand_script(name).name : name, known});
  }
  return hands;
}

/// An organ wherever its file lies: its file's name and bytes.
std::string organ_key(const std::string& name_or_file) {
  const std::string sha256 = digest::of_readable_file(name_or_file);
  return sha256.empty() ? name_or_file
                        : std::filesystem::path(name_or_file).filename().string() + "@" + sha256.substr(0, 12);
}

/// Boards of one seed: those that were asked for, or the one that it draws.
std::vector<int> boards_of(const SweepPlan& plan, const std::string& level, std::int64_t seed) {
  if (plan.boards.empty()) return {drawn_board(seed, level == kExamLevel)};
  const auto [first, last] = parse_range("--boards", plan.boards);
  const bool practice = first >= 0 && last < kPracticeBoards;
  if (!practice && (first < kUnseenBoards || last >= kUnseenBoards + kDrawnBoards))
    throw InputError("--boards " + plan.boards + ": practice boards are 0 to " + std::to_string(kPracticeBoards - 1) +
                     ", unseen ones begin at " + std::to_string(kUnseenBoards));
  std::vector<int> boards;
  for (std::int64_t board = first; board <= last; ++board) boards.push_back(static_cast<int>(board));
  return boards;
}

/// The levels asked for; all of an exercise, but no exam where boards are named: an exam's are unseen.
std::vector<std::string> levels_of(const SweepPlan& plan, const Exercise& exercise) {
  const bool named = !plan.boards.empty();
  if (named && std::find(plan.levels.begin(), plan.levels.end(), kExamLevel) != plan.levels.end())
    throw InputError("--boards " + plan.boards + ": do not go with an exam, whose board is drawn by the seed");
  if (!plan.levels.empty()) return plan.levels;
  std::vector<std::string> levels;
  for (const ExerciseLevel& level : exercise.levels) {
    if (!named || level.name != kExamLevel) levels.push_back(level.name);
  }
  return levels;
}

/// The arm of the seed with more friction, or with amplifiers that give less current than the loop counts on.
std::shared_ptr<const PlantFile> worse_plant(const SweepArm& arm, std::int64_t seed) {
  PlantFile plant;
  plant.parameters = draw_parameters(static_cast<std::uint64_t>(seed));
  plant.name = arm.name;
  PlantParameters& p = plant.parameters;
  for (ChannelParameters& channel : p.channel) {
    channel.friction.coulomb *= arm.friction;
    channel.friction.viscous *= arm.friction;
  }
  const double largest = p.dac_full_scale * std::abs(p.channel[0].amplifier_gain);
  p.current_limit = std::min(p.current_limit, arm.current * largest);
  return std::make_shared<const PlantFile>(plant);
}

}  // namespace

bool too_fast(const std::string& fault) {
  return fault == fault_name(FaultCode::kOverspeed) || fault == fault_name(FaultCode::kEncoderJump);
}

std::vector<SweepJob> list_jobs(const SweepPlan& plan, const AssetRoots& assets) {
  std::vector<std::string> exercises = plan.exercises;
  if (exercises.empty()) {
    for (const Exercise& exercise : list_exercises(assets.exercises)) exercises.push_back(exercise.id);
  }
  const auto hands = list_hands_of(plan, assets);
  const auto [first, last] = parse_range("--seeds", plan.seeds);
  std::vector<SweepJob> jobs;
  for (const std::string& name : exercises) {
    const Exercise exercise = find_exercise(name, assets.exercises);
    SweepJob job;
    job.given = name;
    job.ruleset = std::make_shared<const std::string>(exercise.text);
    job.row.number = exercise.number;
    job.row.exercise_version = exercise.version;
    job.row.program = TROCAR_VERSION;
    job.row.key.exercise = exercise.id;
    job.given_organ = plan.organ;
    job.row.key.organ = organ_key(plan.organ);
    job.row.key.tissue = plan.tissue.empty() ? exercise.tissue : plan.tissue;
    for (const std::string& level : levels_of(plan, exercise)) {
      const Rubric& rubric = find_level(exercise, level).rubric;
      job.scope = {level == exercise.levels.front().name, judges_force(rubric)};
      job.row.rubric_sha256 = rubric.sha256;
      job.row.key.level = level;
      for (const std::string& arm : plan.arms) {
        job.arm = &find_arm(arm);
        job.row.key.arm = arm;
        for (const SweptHand& hand : hands) {
          const std::optional<int> person = split_person(hand.given).second;
          job.given_hand = hand.given;
          job.row.key.hand = hand.name;
          job.row.hand_sha256 = hand.sha256;
          job.row.skill = person ? std::optional(latent_skill(*person)) : std::nullopt;
          for (job.row.key.seed = first; job.row.key.seed <= last; ++job.row.key.seed) {
            for (const int board : boards_of(plan, level, job.row.key.seed)) {
              job.row.key.board = board;
              jobs.push_back(job);
            }
          }
        }
      }
    }
  }
  return jobs;
}

bool run_job(SweepJob& job, const AssetRoots& assets, const std::function<bool()>& interrupted) {
  const SweepKey& key = job.row.key;
  RunOptions run;
  run.exercise = job.given;
  run.level = key.level;
  run.hand = job.given_hand;
  run.seed = key.seed;
  run.organ = job.given_organ;
  run.tissue = key.tissue;
  run.passivity_law = passivity_law_name(job.arm->law);
  AttemptSetup setup = attempt_setup(run, assets);
  setup.board = key.board;
  if (job.arm->friction != 1 || job.arm->current != 1) setup.plant = worse_plant(*job.arm, key.seed);
  const Scene scene = build_scene(setup, assets, {"simulated", setup.rate_hz, 16});
  bool stopped = false;
  const auto stop = [&] { return stopped = stopped || interrupted(); };
  const auto [outcome, recording] = record_session(scene, assets, {}, {}, stop);
  if (stopped) return false;
  job.row.grade = grade_recording(recording, "recording in memory").grade;
  job.row.fault = outcome.device.fault;
  return true;
}

std::pair<std::int64_t, std::int64_t> parse_range(const std::string& option, const std::string& text) {
  const auto dots = text.find("..");
  const std::string_view view = text;
  const std::int64_t first = number_of_range(view.substr(0, dots), option, text);
  const std::int64_t last = dots == std::string::npos ? first : number_of_range(view.substr(dots + 2), option, text);
  // Far ends first: a difference of them could overflow.
  const bool far = first < -kLargestSeed || last > kLargestSeed;
  if (far || last < first || last - first >= kMostSeeds) {
    throw InputError(option + " " + text + ": A..B with A <= B, at most " + std::to_string(kMostSeeds) + " of them");
  }
  return {first, last};
}

}  // namespace trocar
