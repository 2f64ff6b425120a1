// The invented trainees of the demo cohort: who practises what, with which hand, over which days. Plain table.
#pragma once

#include <string>
#include <vector>

#include "trainees/records/assessments.h"

namespace trocar {

/// Attempts in a row at one exercise with one hand of assets/demo/.
struct DemoStint {
  const char* exercise = "";
  const char* level = "L1";
  int attempts = 0;
  const char* hand = "";
  int from_attempt = 1;  ///< of the learning hand
};

struct DemoPerson {
  std::string code, group, story;
  int first_day = 0, last_day = 0;  ///< of the nine weeks, 0 to 62
  int hour = 9;
  std::vector<DemoStint> stints;
};

const std::vector<DemoPerson>& demo_people();

/// A note to the one who is stuck, a signature and a certificate for the one who came experienced.
void add_demo_assessments(Database& database, const Author& author);

/// A programme of three steps for both groups: one is late with it, the other has a month left.
void add_demo_programme(Database& database, const Author& author);

}  // namespace trocar
