#include "app/cli/attempts/sweep_command.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/attempts/run_command.h"
#include "app/cli/command.h"
#include "app/cli/in_parallel.h"
#include "app/cli/text_table.h"
#include "app/session/session.h"
#include "haptics/fault.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/make_hand.h"
#include "scenarios/scoring/construct_validity.h"

namespace trocar {
namespace {

constexpr std::int64_t kMostSeeds = 10000;
constexpr double kWorseBy = 5;  ///< points that an expert must lose on the degraded arm where force is judged
constexpr std::int64_t kLargestSeed = std::int64_t{1} << 60;

/// What an attempt's simulated arm is made of: the one that its seed draws, or worse.
struct Arm {
  const char* name;
  double friction = 1;  ///< times the drawn one, Coulomb and viscous
  double current = 1;   ///< of what the motors' largest torque needs
  PassivityLaw law = PassivityLaw::kBudgeted;
};
constexpr std::array<Arm, 5> kArms{{{"drawn"},
                                    {"friction", 2},
                                    {"saturation", 1, 0.5},
                                    {"increment", 1, 1, PassivityLaw::kIncrement},
                                    {"degraded", 2, 0.5, PassivityLaw::kIncrement}}};

const Arm& find_arm(const std::string& name) {
  for (const Arm& arm : kArms) {
    if (name == arm.name) return arm;
  }
  throw InputError("--arm " + name + ": drawn, friction, saturation, increment or degraded");
}

/// One attempt of the sweep and, later, what became of it.
struct Job {
  const Arm* arm = &kArms[0];
  std::string exercise, level, hand;
  std::int64_t seed = 0;
  ValidityScope scope;
  Grade grade;
  std::string fault;  ///< of the device, empty when none
};

/// Did the device stop because the arm went too fast?
bool too_fast(const std::string& fault) {
  return fault == fault_name(FaultCode::kOverspeed) || fault == fault_name(FaultCode::kEncoderJump);
}

std::int64_t seed_in(std::string_view text, const std::string& whole) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw InputError("--seeds " + whole + ": A..B, two whole numbers");
  }
  return value;
}

std::vector<Job> list_jobs(const SweepOptions& options, const AssetRoots& assets) {
  std::vector<std::string> exercises = options.exercises;
  if (exercises.empty()) {
    for (const Exercise& exercise : list_exercises(assets.exercises)) exercises.push_back(exercise.id);
  }
  for (const std::string& hand : options.hands) make_hand(hand, 0, assets.hands);  // a wrong name is refused now
  const auto [first, last] = parse_seeds(options.seeds);
  std::vector<Job> jobs;
  for (const std::string& name : exercises) {
    const Exercise exercise = find_exercise(name, assets.exercises);
    std::vector<std::string> levels = options.levels;
    if (levels.empty()) {
      for (const ExerciseLevel& level : exercise.levels) levels.push_back(level.name);
    }
    for (const std::string& level : levels) {
      const ValidityScope scope{level == exercise.levels.front().name,
                                judges_force(find_level(exercise, level).rubric)};
      for (const std::string& arm : options.arms) {
        for (const std::string& hand : options.hands) {
          for (std::int64_t seed = first; seed <= last; ++seed)
            jobs.push_back({&find_arm(arm), name, level, hand, seed, scope, {}, ""});
        }
      }
    }
  }
  return jobs;
}

/// The arm of the seed with more friction, or with amplifiers that give less current than the loop counts on.
std::shared_ptr<const PlantFile> worse_plant(const Arm& arm, std::int64_t seed) {
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

void run_job(Job& job, const SweepOptions& options, const AssetRoots& assets) {
  RunOptions run;
  run.exercise = job.exercise;
  run.level = job.level;
  run.hand = job.hand;
  run.seed = job.seed;
  run.organ = options.organ;
  run.tissue = options.tissue;
  run.passivity_law = passivity_law_name(job.arm->law);
  AttemptSetup setup = attempt_setup(run, assets);
  if (job.arm->friction != 1 || job.arm->current != 1) setup.plant = worse_plant(*job.arm, job.seed);
  const Scene scene = build_scene(setup, assets, {"simulated", setup.rate_hz, 16});
  const auto [outcome, recording] = record_session(scene, assets, {});
  job.grade = grade_recording(recording, "recording in memory");
  job.fault = outcome.device.fault;
}

/// Runs all jobs on some threads. @throws the first failure, after all threads have ended.
void run_jobs(std::vector<Job>& jobs, const SweepOptions& options, const AssetRoots& assets, std::ostream& err) {
  std::size_t done = 0;
  std::mutex mutex;  // guards done and err
  in_parallel(jobs.size(), options.jobs, [&](std::size_t i) {
    run_job(jobs[i], options, assets);
    const std::lock_guard lock(mutex);
    if (++done % 50 == 0) err << "trocar: " << done << " of " << jobs.size() << " attempts\n";
  });
}

/// One exercise at one level on one kind of arm: outcomes by hand, and the checks over them.
struct Cell {
  const Arm* arm = nullptr;
  std::string exercise, level;
  ValidityScope scope;
  std::map<std::string, HandOutcomes> outcomes;
  std::map<std::string, std::map<std::string, int>> caps;  ///< by hand: sentence and how often
  std::vector<Job> without_number;
  std::vector<ValidityCheck> checks;
};

/// Does the same hand earn less on a worse arm? An attempt without a number earned nothing.
std::vector<ValidityCheck> check_worse_arm(const Cell& worse, const Cell& drawn) {
  std::vector<ValidityCheck> checks;
  const auto earned = [](const HandOutcomes& of) {
    const GroupSummary s = summarise(of.scores);
    const int count = s.count + of.without_score;
    return count > 0 ? s.mean * s.count / count : 0;
  };
  for (const auto& [hand, outcome] : worse.outcomes) {
    ValidityCheck check;
    check.name = hand + ": drawn arm - " + worse.arm->name;
    check.value = earned(drawn.outcomes.at(hand)) - earned(outcome);
    check.bar = ">= " + cell(kWorseBy, 0);
    const bool asked = worse.scope.judges_force && hand == "expert" && worse.arm == &kArms.back();
    check.met = !asked || check.value >= kWorseBy;
    if (!asked) check.not_asked = cell(check.value, 1) + " points";
    checks.push_back(check);
  }
  return checks;
}

/// "fault (overspeed)": what became of an attempt without a number.
std::string end_of(const Job& job) {
  const std::string status = status_name(job.grade.status);
  if (!job.fault.empty()) return status + " (" + job.fault + ")";
  return job.grade.caps.empty() ? status : status + " (" + cap_sentence(job.grade.caps.front()) + ")";
}

std::vector<Cell> collect(const std::vector<Job>& jobs) {
  std::vector<Cell> cells;
  for (const Job& job : jobs) {
    if (cells.empty() || cells.back().exercise != job.exercise || cells.back().level != job.level ||
        cells.back().arm != job.arm) {
      cells.push_back({job.arm, job.exercise, job.level, job.scope, {}, {}, {}, {}});
    }
    HandOutcomes& outcome = cells.back().outcomes[job.hand];
    if (job.grade.score) {
      outcome.scores.push_back(*job.grade.score);
    } else {
      ++outcome.without_score;
      outcome.too_fast += too_fast(job.fault) ? 1 : 0;
      cells.back().without_number.push_back(job);
    }
    outcome.passes += job.grade.passed ? 1 : 0;
    for (const Cap& cap : job.grade.caps) ++cells.back().caps[job.hand][cap_sentence(cap)];
  }
  for (Cell& at : cells) {
    const auto drawn = std::find_if(cells.begin(), cells.end(), [&](const Cell& other) {
      return other.arm == &kArms[0] && other.exercise == at.exercise && other.level == at.level;
    });
    if (at.arm == &kArms[0])
      at.checks = check_validity(at.outcomes, at.scope);
    else if (drawn != cells.end())
      at.checks = check_worse_arm(at, *drawn);
  }
  return cells;
}

void print_check(const ValidityCheck& check, std::ostream& out) {
  if (!check.not_asked.empty()) {
    out << "  n/a      " << check.name << ": " << check.not_asked << '\n';
    return;
  }
  char line[128];
  std::snprintf(line, sizeof line, "  %-8s %s: %.2f (%s)\n", check.met ? "met" : "NOT MET", check.name.c_str(),
                check.value, check.bar.c_str());
  out << line;
}

void print_cell(const Cell& at, const SweepOptions& options, std::ostream& out) {
  using Align = TextTable::Align;
  out << at.exercise << "  " << at.level << (at.arm == &kArms[0] ? "" : std::string("  arm: ") + at.arm->name) << '\n';
  TextTable table({{"  hand"},
                   {"attempts", Align::kRight},
                   {"mean", Align::kRight},
                   {"SD", Align::kRight},
                   {"lowest", Align::kRight},
                   {"highest", Align::kRight},
                   {"passed", Align::kRight},
                   {"share", Align::kRight}});
  for (const std::string& hand : options.hands) {
    const HandOutcomes& outcome = at.outcomes.at(hand);
    const GroupSummary s = summarise(outcome.scores);
    table.add({"  " + hand, std::to_string(s.count + outcome.without_score), cell(s.mean, 1), cell(s.sd, 1),
               cell(s.lowest, 1), cell(s.highest, 1), std::to_string(outcome.passes), cell(pass_share(outcome), 2)});
  }
  table.print(out);
  for (const Job& job : at.without_number) {
    out << "  no number: not passed: " << job.hand << ", seed " << job.seed << ": " << end_of(job) << '\n';
  }
  for (const ValidityCheck& check : at.checks) print_check(check, out);
}

nlohmann::ordered_json check_json(const ValidityCheck& check) {
  if (!check.not_asked.empty()) {
    return {{"name", check.name}, {"value", nullptr}, {"bar", nullptr}, {"met", true}, {"not_asked", check.not_asked}};
  }
  return {{"name", check.name}, {"value", check.value}, {"bar", check.bar}, {"met", check.met}};
}

nlohmann::ordered_json cell_json(const Cell& at, const SweepOptions& options) {
  nlohmann::ordered_json hands = nlohmann::ordered_json::array(), checks = hands, without = hands;
  for (const std::string& hand : options.hands) {
    const HandOutcomes& outcome = at.outcomes.at(hand);
    const GroupSummary s = summarise(outcome.scores);
    nlohmann::ordered_json caps = nlohmann::ordered_json::object();
    if (const auto found = at.caps.find(hand); found != at.caps.end()) caps = found->second;
    hands.push_back({{"hand", hand},
                     {"mean", s.mean},
                     {"sd", s.sd},
                     {"passes", outcome.passes},
                     {"pass_share", pass_share(outcome)},
                     {"without_score", outcome.without_score},
                     {"scores", outcome.scores},
                     {"caps", caps}});
  }
  for (const Job& job : at.without_number) {
    without.push_back({{"hand", job.hand}, {"seed", job.seed}, {"end", end_of(job)}});
  }
  for (const ValidityCheck& check : at.checks) checks.push_back(check_json(check));
  return {{"exercise", at.exercise}, {"level", at.level},         {"arm", at.arm->name},
          {"hands", hands},          {"without_number", without}, {"checks", checks}};
}

}  // namespace

std::pair<std::int64_t, std::int64_t> parse_seeds(const std::string& text) {
  const auto dots = text.find("..");
  const std::string_view view = text;
  const std::int64_t first = seed_in(view.substr(0, dots), text);
  const std::int64_t last = dots == std::string::npos ? first : seed_in(view.substr(dots + 2), text);
  // Far ends first: a difference of them could overflow.
  const bool far = first < -kLargestSeed || last > kLargestSeed;
  if (far || last < first || last - first >= kMostSeeds) {
    throw InputError("--seeds " + text + ": A..B with A <= B, at most " + std::to_string(kMostSeeds) + " of them");
  }
  return {first, last};
}

int sweep_command(const SweepOptions& options, std::ostream& out, std::ostream& err) {
  const AssetRoots assets = find_assets();
  std::vector<Job> jobs = list_jobs(options, assets);
  if (jobs.empty()) throw InputError("nothing to run: name at least one hand");
  err << "trocar: " << jobs.size() << " attempts on the simulated plant, nothing is stored\n";
  run_jobs(jobs, options, assets, err);
  const std::vector<Cell> cells = collect(jobs);
  bool met = true;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Cell& cell : cells) {
    for (const ValidityCheck& check : cell.checks) met = met && check.met;
    if (options.json)
      list.push_back(cell_json(cell, options));
    else
      print_cell(cell, options, out);
  }
  if (options.json)
    out << nlohmann::ordered_json{{"seeds", options.seeds}, {"met", met}, {"cells", list}}.dump(2) << '\n';
  return met ? 0 : 1;
}

void add_sweep(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<SweepOptions>();
  SweepOptions& o = *given;
  CLI::App* sweep = add_command(parent, "sweep", "Many scripted attempts: does the score tell skill apart?", chosen,
                                [given] { return sweep_command(*given, std::cout, std::cerr); });
  sweep->add_option("exercise", o.exercises, "Exercise ids, numbers or files (default: all)");
  sweep->add_option("--hand", o.hands, "Hands, separated by commas")->delimiter(',')->capture_default_str();
  sweep->add_option("--level", o.levels, "Levels, separated by commas (default: all)")->delimiter(',');
  sweep
      ->add_option("--arm", o.arms,
                   "Simulated arms, separated by commas: drawn, friction, saturation, increment, degraded")
      ->delimiter(',')
      ->capture_default_str();
  sweep->add_option("--seeds", o.seeds, "First and last seed, A..B")->capture_default_str();
  sweep->add_option("--organ", o.organ, kOrganForms)->capture_default_str();
  add_tissue_option(*sweep, o.tissue);
  sweep->add_option("--jobs", o.jobs, "Attempts at once (0: one a processor)")
      ->capture_default_str()
      ->check(CLI::Range(0, 256));
  sweep->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
