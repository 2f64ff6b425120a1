#include <set>

#include "app/cli/sweep/sweep_command.h"
#include "app/cli/sweep/sweep_folder.h"
#include "haptics/input_error.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

fs::path real_folder(const fs::path& folder) {
  std::error_code error;
  const fs::path real = fs::canonical(folder, error);
  if (error) throw InputError(folder.string() + ": " + error.message());
  return real;
}

}  // namespace

int sweep_merge(const SweepMergeOptions& options, std::ostream& out, std::ostream& err) {
  if (options.out.empty() && options.from.size() != 1)
    throw InputError("--out DIR: into which of the folders? Only one by itself is merged in its place");
  const fs::path into = options.out.empty() ? options.from.front() : options.out;
  std::set<fs::path> folders;
  for (const fs::path& folder : options.from) folders.insert(real_folder(folder));
  make_folder(into);
  folders.insert(real_folder(into));

  std::vector<std::unique_ptr<PathLock>> locks;
  SweepRows rows;
  for (const fs::path& folder : folders) {
    locks.push_back(
        std::make_unique<PathLock>(folder, PathLock::Kind::kAlone, "a sweep still writes into it, or merges it"));
    rows.read(folder, err);
  }
  std::string lines;
  std::set<std::string> rulesets;
  for (const auto& [key, placed] : rows.all()) {
    const fs::path from = fs::path(placed.where.substr(0, placed.where.rfind(':'))).parent_path();
    const std::string& sha256 = placed.row.rubric_sha256;
    if (rulesets.insert(sha256).second) keep_ruleset(into, sha256, kept_ruleset(from, sha256));
    lines += placed.line + "\n";
  }
  // Beside its place, then there whole: a kill leaves the old file or the new one.
  const fs::path file = into / rows_file(1, 0), pending = into / ".attempts.pending";
  write_file(pending, lines);
  fs::rename(pending, file);
  out << rows.all().size() << " attempts in " << file.string() << '\n';
  return 0;
}

}  // namespace trocar
