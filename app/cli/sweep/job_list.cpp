#include "app/cli/sweep/job_list.h"

#include <algorithm>

namespace trocar {
namespace {

namespace fs = std::filesystem;

/// A file keeps its meaning wherever the job begins.
std::string anywhere(const std::string& name_or_file) {
  return name_or_file.ends_with(".toml") ? fs::absolute(name_or_file).string() : name_or_file;
}

std::string with_commas(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ",") + anywhere(word);
  return all;
}

/// Up to and with "--part".
std::string command_words(const SweepOptions& options, const std::string& program) {
  const SweepPlan& plan = options.plan;
  std::string words = shell_word(program) + " sweep";
  for (const std::string& exercise : plan.exercises) words += " " + shell_word(anywhere(exercise));
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words += std::string(" ") + option + " " + shell_word(value);
  };
  add("--hand", with_commas(plan.hands));
  add("--level", with_commas(plan.levels));
  add("--seeds", plan.seeds);
  add("--boards", plan.boards);
  add("--arm", with_commas(plan.arms));
  add("--organ", anywhere(plan.organ));
  add("--tissue", plan.tissue);
  add("--out", fs::absolute(options.out).string());
  return words + " --jobs 1 --part";
}

}  // namespace

std::string shell_word(const std::string& text) {
  const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./,:=@%+").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string job_lines(const SweepOptions& options, const std::string& program) {
  std::string lines;
  const std::string words = command_words(options, program), of = "/" + std::to_string(options.list_jobs);
  for (int part = 1; part <= options.list_jobs; ++part) lines += words + " " + std::to_string(part) + of + "\n";
  return lines;
}

std::string slurm_script(const SweepOptions& options, const std::string& program) {
  const std::string parts = std::to_string(options.list_jobs);
  return "#!/bin/sh\n#SBATCH --job-name=trocar-sweep\n#SBATCH --array=1-" + parts +
         "\n#SBATCH --ntasks=1\n#SBATCH --cpus-per-task=1\n# Then: " + shell_word(program) + " sweep merge " +
         shell_word(fs::absolute(options.out).string()) + "\nexec " + command_words(options, program) +
         " \"$SLURM_ARRAY_TASK_ID/" + parts + "\"\n";
}

}  // namespace trocar
