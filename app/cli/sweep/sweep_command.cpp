#include "app/cli/sweep/sweep_command.h"

#include <atomic>
#include <charconv>
#include <chrono>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/in_parallel.h"
#include "app/cli/progress_display.h"
#include "app/cli/sweep/job_list.h"
#include "app/cli/sweep/sweep_folder.h"
#include "app/cli/sweep/sweep_table.h"
#include "haptics/input_error.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

constexpr int kMostParts = 10000;
constexpr const char* kThisCommand = "this command";

struct Part {
  int number = 1, of = 0;  ///< of 0: not in parts
};

Part part_of(const std::string& text) {
  Part part;
  if (text.empty()) return part;
  const char* const last = text.data() + text.size();
  const auto [slash, number_error] = std::from_chars(text.data(), last, part.number);
  const bool slashed = number_error == std::errc() && slash != last && *slash == '/';
  const auto [end, of_error] = std::from_chars(slashed ? slash + 1 : last, last, part.of);
  if (!slashed || of_error != std::errc() || end != last || part.number < 1 || part.number > part.of ||
      part.of > kMostParts)
    throw InputError("--part " + text + ": K/N, the part K of N, at most " + std::to_string(kMostParts));
  return part;
}

/// Every N-th, so that each part has some of every exercise and hand.
std::vector<SweepJob> jobs_of_part(std::vector<SweepJob> jobs, const Part& part) {
  if (part.of == 0) return jobs;
  std::vector<SweepJob> mine;
  for (std::size_t i = static_cast<std::size_t>(part.number - 1); i < jobs.size();
       i += static_cast<std::size_t>(part.of))
    mine.push_back(std::move(jobs[i]));
  return mine;
}

/// Runs jobs on some threads, and keeps each as soon as it is over.
class SweepRun {
 public:
  SweepRun(const SweepOptions& options, std::vector<SweepJob>& jobs, std::ostream& err)
      : options_(options), assets_(find_assets()), jobs_(jobs), progress_(err, error_is_terminal()) {}

  /// Takes over what a folder holds already. @returns how many are left to be run.
  std::size_t take_kept(SweepRows& kept) {
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (kept.has(jobs_[i].row, kThisCommand))
        jobs_[i].row = kept.all().at(jobs_[i].row.key).row;
      else
        left_.push_back(i);
    }
    return left_.size();
  }

  /// @param writer nullptr: nothing is kept. @throws EnvironmentError: interrupted.
  void run(RowWriter* writer) {
    in_parallel(left_.size(), options_.jobs, [&](std::size_t i) { run_one(jobs_[left_[i]], writer); });
    progress_.clear();
    if (!stop_) return;
    if (!writer) throw Interrupted();
    throw EnvironmentError("interrupted; " + std::to_string(jobs_.size() - left_.size() + done_) + " of " +
                           std::to_string(jobs_.size()) + " attempts are in " + options_.out.string() +
                           "; the same command makes the others");
  }

 private:
  void run_one(SweepJob& job, RowWriter* writer) {
    if (stop_) return;
    const bool over = run_job(job, assets_, [&] {
      const std::lock_guard lock(mutex_);
      if (watch_.seen()) stop_ = true;
      return stop_.load();
    });
    if (!over) return;
    const std::lock_guard lock(mutex_);
    if (writer) {
      keep_ruleset(options_.out, job.row.rubric_sha256, *job.ruleset);
      writer->add(row_line(job.row));
    }
    tell(++done_);
  }

  void tell(std::size_t done) {
    const auto now = std::chrono::steady_clock::now();
    if (done == 1) first_ = now;
    const double seconds = std::chrono::duration<double>(now - first_).count();
    const double share = static_cast<double>(done) / static_cast<double>(left_.size());
    try {
      progress_.show("attempts", share, pace_words(static_cast<int>(done), static_cast<int>(left_.size()), seconds));
    } catch (const Interrupted&) {
      stop_ = true;
    }
  }

  const SweepOptions& options_;
  const AssetRoots assets_;
  std::vector<SweepJob>& jobs_;
  std::vector<std::size_t> left_;  ///< places in jobs_
  InterruptWatch watch_;
  std::mutex mutex_;  ///< guards all that follows, the watch and the writer
  ProgressDisplay progress_;
  std::size_t done_ = 0;
  std::chrono::steady_clock::time_point first_;
  std::atomic<bool> stop_ = false;
};

std::string this_program() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

int write_job_list(const SweepOptions& options, std::ostream& out, std::ostream& err) {
  if (options.out.empty()) throw InputError("--list-jobs needs --out: the folder into which the jobs write");
  if (!options.part.empty()) throw InputError("--list-jobs makes the parts; --part does not go with it");
  make_folder(options.out);
  const std::string lines = job_lines(options, this_program());
  write_file(options.out / "jobs.txt", lines);
  write_file(options.out / "jobs.slurm", slurm_script(options, this_program()));
  out << lines;
  err << "trocar: " << options.list_jobs << " jobs in " << (options.out / "jobs.txt").string()
      << " (parallel < jobs.txt) and " << (options.out / "jobs.slurm").string() << " (sbatch jobs.slurm)\n";
  return 0;
}

void add_plan_options(CLI::App& sweep, SweepPlan& plan) {
  sweep.add_option("exercise", plan.exercises, "Exercise ids, numbers or files (default: all)");
  sweep.add_option("--hand", plan.hands, "Hands, separated by commas; population#1..100 are a hundred persons")
      ->delimiter(',')
      ->capture_default_str();
  sweep.add_option("--level", plan.levels, "Levels, separated by commas (default: all)")->delimiter(',');
  sweep
      .add_option("--arm", plan.arms,
                  "Simulated arms, separated by commas: drawn, friction, saturation, increment, degraded")
      ->delimiter(',')
      ->capture_default_str();
  sweep.add_option("--seeds", plan.seeds, "First and last seed, A..B")->capture_default_str();
  sweep.add_option("--boards", plan.boards,
                   "Boards A..B, each with each seed: 0 to 19 of practice, or unseen ones from 1000 (default: one that "
                   "the seed draws)");
  sweep.add_option("--organ", plan.organ, kOrganForms)->capture_default_str();
  add_tissue_option(sweep, plan.tissue);
}

void add_merge(CLI::App& sweep, CommandAction& chosen) {
  const auto given = std::make_shared<SweepMergeOptions>();
  CLI::App* merge = add_command(sweep, "merge", "Rows of parts or of several folders into one file", chosen,
                                [given] { return sweep_merge(*given, std::cout, std::cerr); });
  merge->add_option("folder", given->from, "Folders of sweeps")->required();
  merge->add_option("--out", given->out, "Folder of the merged rows (default: the only one named)")
      ->check(writable_path());
}

void add_report(CLI::App& sweep, CommandAction& chosen) {
  const auto given = std::make_shared<std::filesystem::path>();
  CLI::App* report = add_command(sweep, "report", "report.html, table.csv and validity.json of a folder of rows",
                                 chosen, [given] { return sweep_report(*given, std::cout, std::cerr); });
  report->add_option("folder", *given, "Folder of a sweep")->required();
}

}  // namespace

int sweep_command(const SweepOptions& options, std::ostream& out, std::ostream& err) {
  const Part part = part_of(options.part);
  if (part.of > 0 && options.out.empty()) throw InputError("--part needs --out: the folder that keeps the part");
  std::vector<SweepJob> jobs = list_jobs(options.plan, find_assets());
  if (jobs.empty()) throw InputError("nothing to run: name at least one hand");
  if (options.list_jobs > 0) return write_job_list(options, out, err);
  jobs = jobs_of_part(std::move(jobs), part);

  std::optional<RowWriter> writer;
  SweepRows kept;
  if (!options.out.empty()) {
    writer.emplace(options.out, rows_file(part.number, part.of), err);
    kept.read(options.out, err);
  }
  SweepRun run(options, jobs, err);
  const std::size_t left = run.take_kept(kept);
  err << "trocar: " << jobs.size() << " attempts on the simulated plant, ";
  if (writer)
    err << jobs.size() - left << " of them are in " << options.out.string() << " already\n";
  else
    err << "nothing is stored\n";
  run.run(writer ? &*writer : nullptr);

  if (part.of > 0) {
    out << "part " << part.number << " of " << part.of << ": " << jobs.size() << " attempts in "
        << (options.out / rows_file(part.number, part.of)).string() << '\n';
    return 0;
  }
  const std::vector<SweepCell> cells = collect_cells(jobs);
  if (options.json)
    out << cells_json(cells, options.plan.seeds);
  else
    print_cells(cells, out);
  return all_met(cells) ? 0 : 1;
}

void add_sweep(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<SweepOptions>();
  SweepOptions& o = *given;
  CLI::App* sweep = add_command(parent, "sweep", "Many scripted attempts: does the score tell skill apart?", chosen,
                                [given] { return sweep_command(*given, std::cout, std::cerr); });
  add_plan_options(*sweep, o.plan);
  sweep->add_option("--out", o.out, "Folder that keeps every attempt; the same command again goes on")
      ->check(writable_path());
  sweep->add_option("--part", o.part, "K/N: the part K of N of the attempts, into a file of its own");
  sweep->add_option("--list-jobs", o.list_jobs, "Run nothing: list N jobs for GNU parallel, and an array for Slurm")
      ->check(CLI::Range(1, kMostParts));
  sweep->add_option("--jobs", o.jobs, "Attempts at once (0: one a processor)")
      ->capture_default_str()
      ->check(CLI::Range(0, 256));
  sweep->add_flag("--json", o.json, "As JSON");
  add_merge(*sweep, chosen);
  add_report(*sweep, chosen);
  // A command's own callback comes after those of its subcommands.
  sweep->callback([sweep, given, &chosen] {
    if (sweep->get_subcommands().empty()) chosen = [given] { return sweep_command(*given, std::cout, std::cerr); };
  });
}

}  // namespace trocar
