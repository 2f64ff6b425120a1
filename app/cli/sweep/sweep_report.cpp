#include <algorithm>
#include <ostream>

#include "app/cli/sweep/sweep_command.h"
#include "app/cli/sweep/sweep_folder.h"
#include "app/cli/sweep/validity_page.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

/// Rulesets of a folder, each read once.
class KeptRulesets {
 public:
  explicit KeptRulesets(fs::path folder) : folder_(std::move(folder)) {}
  const Exercise& of(const SweepRow& row) {
    const auto [found, fresh] = exercises_.try_emplace(row.rubric_sha256);
    if (fresh) found->second = parse_exercise(kept_ruleset(folder_, row.rubric_sha256), row.rubric_sha256 + ".toml");
    return found->second;
  }

 private:
  fs::path folder_;
  std::map<std::string, Exercise> exercises_;
};

ReportedCell cell_of(const SweepRow& row, const Exercise& exercise) {
  ReportedCell cell;
  cell.title = row.number + " " + row.key.exercise + ", " + row.key.level;
  cell.key = row.key;
  cell.exercise_version = row.exercise_version;
  cell.rubric_sha256 = row.rubric_sha256;
  cell.rubric = find_level(exercise, row.key.level).rubric;
  cell.scope = {row.key.level == exercise.levels.front().name, judges_force(cell.rubric)};
  return cell;
}

bool same_cell(const SweepKey& a, const SweepKey& b) {
  return a.exercise == b.exercise && a.level == b.level && a.organ == b.organ && a.tissue == b.tissue;
}

}  // namespace

int sweep_report(const fs::path& folder, std::ostream& out, std::ostream& err) {
  SweepRows rows;
  rows.read(folder, err);
  if (rows.all().empty()) throw InputError(folder.string() + ": holds no attempt of a sweep");
  KeptRulesets rulesets(folder);
  std::vector<SweepRow> checked;
  checked.reserve(rows.all().size());
  for (const auto& [key, placed] : rows.all()) {
    checked.push_back(placed.row);
    check_row(checked.back(), find_level(rulesets.of(placed.row), key.level).rubric, placed.where);
  }

  std::vector<ReportedCell> cells;
  std::vector<const SweepRow*> all;
  for (const SweepRow& row : checked) {
    all.push_back(&row);
    if (row.key.arm != kSweepArms[0].name) continue;
    auto found =
        std::find_if(cells.begin(), cells.end(), [&](const ReportedCell& c) { return same_cell(c.key, row.key); });
    if (found == cells.end()) found = cells.insert(found, cell_of(row, rulesets.of(row)));
    found->attempts.push_back({row.key.hand, row.skill, row.key.board, row.key.seed, row.grade, too_fast(row.fault)});
  }
  std::sort(cells.begin(), cells.end(), [](const ReportedCell& a, const ReportedCell& b) { return a.title < b.title; });
  bool met = true;
  for (ReportedCell& cell : cells) {
    cell.found = cell_validity(cell.attempts, cell.rubric, cell.scope);
    for (const ValidityCheck& check : cell.found.checks) met = met && check.met;
  }
  const std::string program = checked.front().program;
  write_file(folder / "report.html", html_of(validity_report(cells, program)));
  write_file(folder / "table.csv", attempts_csv(all));
  write_file(folder / "validity.json", validity_json(cells, program));
  out << checked.size() << " attempts of " << cells.size()
      << " exercises and levels: " << (folder / "report.html").string() << ", table.csv, validity.json\n";
  return met ? 0 : 1;
}

}  // namespace trocar
