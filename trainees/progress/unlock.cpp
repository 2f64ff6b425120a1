#include "trainees/progress/unlock.h"

#include <set>

namespace trocar {
namespace {

bool counts(const AttemptSummary& attempt) {
  return attempt.status != "running" && attempt.status != status_name(AttemptStatus::kFault) &&
         attempt.status != status_name(AttemptStatus::kVoid);
}

}  // namespace

int passes_in_a_row(const std::vector<AttemptSummary>& newest_first) {
  std::set<int> boards;
  for (const AttemptSummary& attempt : newest_first) {
    if (!counts(attempt)) continue;
    if (!attempt.passed) break;
    boards.insert(attempt.board);
  }
  return static_cast<int>(boards.size());
}

bool opens_next(const std::vector<AttemptSummary>& newest_first, int passes) {
  std::set<int> boards;
  for (const AttemptSummary& attempt : newest_first) {
    if (!counts(attempt)) continue;
    if (attempt.passed)
      boards.insert(attempt.board);
    else
      boards.clear();
    if (static_cast<int>(boards.size()) >= passes) return true;
  }
  return false;
}

}  // namespace trocar
