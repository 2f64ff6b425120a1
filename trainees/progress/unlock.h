// What opens the next level: so many passes in a row, on as many boards; once open it stays so.
//
// Whatever was begun and is no pass breaks the row: also what was left, switched off, or ended by the device, since
// that can be brought about. What ended before its clock started (fault, void) does not count.
// Pure. Thread: any.
#pragma once

#include <vector>

#include "trainees/records/attempt_store.h"

namespace trocar {

inline constexpr int kPassesToUnlock = 3;

/// Different boards among the newest attempts that are all passed. @param newest_first of one level.
int passes_in_a_row(const std::vector<AttemptSummary>& newest_first);
/// Whether at any time there were so many in a row on as many boards.
bool opens_next(const std::vector<AttemptSummary>& newest_first, int passes = kPassesToUnlock);

}  // namespace trocar
