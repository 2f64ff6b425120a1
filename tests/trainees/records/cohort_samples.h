// A database full of trainees, with a chain that holds: learners whose scores rise from a novice's towards an expert's,
// rows as many as real attempts have (62 metrics, some 37 events, 5 sub-scores). For tests of the desk's queries and
// their bench.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trainees/records/attempt_store.h"

namespace trocar::test {

struct CohortPlan {
  int trainees = 8;
  int attempts = 100;   ///< over all
  int curves_each = 2;  ///< exercises and levels that one trainee works at, of nine
  int metrics = 62, events = 37;
  unsigned seed = 1;
};

/// Trainees "P001"... in groups "2026 A" and "2026 B"; every 40th attempt of the first curve is one of the hand
/// "expert".
void fill_cohort(Database& database, const CohortPlan& plan);

}  // namespace trocar::test
