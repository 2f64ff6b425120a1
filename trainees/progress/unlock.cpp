#include "trainees/progress/unlock.h"

#include <set>

namespace trocar {
namespace {

/// One that runs is not over yet; but one that was begun before others, and still runs, was left standing.
bool counts(const std::vector<AttemptSummary>& newest_first, std::size_t i) {
  return newest_first[i].begun && (newest_first[i].status != "running" || i > 0);
}

}  // namespace

int passes_in_a_row(const std::vector<AttemptSummary>& newest_first) {
  std::set<int> boards;
  for (std::size_t i = 0; i < newest_first.size(); ++i) {
    if (!counts(newest_first, i)) continue;
    if (!newest_first[i].passed) break;
    boards.insert(newest_first[i].board);
  }
  return static_cast<int>(boards.size());
}

bool opens_next(const std::vector<AttemptSummary>& newest_first, int passes) {
  std::set<int> boards;
  for (std::size_t i = 0; i < newest_first.size(); ++i) {
    if (!counts(newest_first, i)) continue;
    if (newest_first[i].passed)
      boards.insert(newest_first[i].board);
    else
      boards.clear();
    if (static_cast<int>(boards.size()) >= passes) return true;
  }
  return false;
}

}  // namespace trocar
