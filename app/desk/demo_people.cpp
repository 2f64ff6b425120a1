#include "app/desk/demo_people.h"

#include "trainees/progress/calendar.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/programmes.h"

namespace trocar {

const std::vector<DemoPerson>& demo_people() {
  static const std::vector<DemoPerson> kPeople{
      {"demo-amara", "Demo autumn", "learns fast and is ready", 20, 62, 8, {{"surface-touch", "L1", 22, "quick", 4}}},
      {"demo-bruno",
       "Demo autumn",
       "learns at the usual pace",
       24,
       60,
       17,
       {{"reach-and-orient", "L1", 7, "steady", 1}, {"surface-touch", "L1", 6, "steady", 5}}},
      {"demo-chen",
       "Demo autumn",
       "is stuck at the wanted force",
       30,
       61,
       12,
       {{"surface-touch", "L1", 9, "stuck", 1}}},
      {"demo-dalia",
       "Demo autumn",
       "is fast and presses too hard",
       33,
       62,
       19,
       {{"surface-touch", "L1", 9, "hasty", 1}}},
      {"demo-emil",
       "Demo spring",
       "was able and has relapsed after a break",
       0,
       62,
       7,
       {{"reach-and-orient", "L1", 17, "able", 6}, {"reach-and-orient", "L1", 6, "rusty", 1}}},
      {"demo-farah",
       "Demo spring",
       "works on grasping",
       40,
       62,
       14,
       {{"limited-grasp", "L1", 8, "steady", 6}, {"reach-and-orient", "L1", 4, "steady", 9}}},
      {"demo-goran", "Demo spring", "came with experience", 6, 34, 16, {{"reach-and-orient", "L1", 16, "able", 8}}},
      {"demo-hana", "Demo spring", "has just begun", 61, 62, 10, {{"reach-and-orient", "L1", 2, "steady", 1}}},
  };
  return kPeople;
}

void add_demo_assessments(Database& database, const Author& author) {
  AssessmentStore assessments(database);
  AttemptStore attempts(database);
  assessments.add_note("demo-chen", "",
                       "Stop above the disc, look, then lower the tip slowly until the bar turns green.", author);
  if (const auto latest = attempts.latest("demo-goran")) {
    assessments.add_note("demo-goran", latest->uuid,
                         "Steady and gentle. Come back in two weeks for the attempt that shows it lasts.", author);
    assessments.sign(latest->uuid, "review", "Seen from beginning to end.", author);
  }
}

void add_demo_programme(Database& database, const Author& author) {
  constexpr const char* kName = "Demo basics";
  constexpr const char* kSteps = R"([[step]]
exercise = "surface-touch"
level = "L1"
passes = 3
in_a_row = true

[[step]]
exercise = "reach-and-orient"
level = "L1"
passes = 3
days = 2

[[step]]
exercise = "limited-grasp"
level = "L1"
sign_off = true
)";
  ProgrammeStore programmes(database);
  programmes.save(kName, kSteps, author);
  const auto in_days = [now = seconds_of_utc(utc_now()).value_or(0)](int days) {
    return utc_of_seconds(now + days * kSecondsADay).substr(0, 10);
  };
  programmes.assign(kName, "", "Demo autumn", in_days(-7), author);
  programmes.assign(kName, "", "Demo spring", in_days(30), author);
}

}  // namespace trocar
