// What a page thread keeps is what the database says, whoever wrote last.
#include "trainees/desk/server/desk_memory.h"

#include <sqlite3.h>

#include <algorithm>
#include <tuple>

#include "tests/trainees/records/cohort_samples.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/routes/route.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/curricula.h"
#include "trainees/records/erasure.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review::desk_memory_test {
namespace {

constexpr const char* kNow = "2026-07-01T12:00:00Z";

/// What a line says, for comparing.
std::string said(const CohortLine& line) {
  std::string out =
      line.trainee + line.name + line.key.exercise_id + line.key.level + line.key.hand + line.key.rubric_sha256;
  out += line.last_uuid + line.certified_utc;
  for (const int number : {line.tries, line.graded, line.passes, line.over_force}) out += " " + std::to_string(number);
  for (const auto& number : {line.best, line.last, line.mean_peak_n, line.reliability})
    out += " " + std::to_string(number.value_or(-1));
  for (const Judgement& judgement : line.judgements) out += judgement.evidence;
  return out;
}

std::vector<std::string> said(const std::vector<CohortLine>& lines) {
  std::vector<std::string> out;
  for (const CohortLine& line : lines) out.push_back(said(line));
  return out;
}

class DeskMemoryTest : public TemporaryFolder {
 protected:
  DeskMemoryTest() : database_(folder_ / "t.db"), other_(folder_ / "t.db") {
    test::CohortPlan plan;
    plan.metrics = 6;
    plan.events = 2;
    fill_cohort(database_, plan);
  }
  const std::vector<CohortLine>& lines(const char* now = kNow) { return memory_.lines(database_, now); }
  void expect_fresh(const std::string& after) {
    EXPECT_EQ(said(lines()), said(cohort_lines(database_, rules_in_force(database_), {}, kNow))) << after;
  }
  Desk desk() {
    return {database_, {}, false, std::shared_ptr<DeskMemory>(&memory_, [](DeskMemory*) {})};
  }
  std::string page() {
    Desk desk = this->desk();
    static const std::vector<Route> routes = desk_routes();
    Request request;
    request.account = Account{};
    request.account->role = Role::kInstructor;
    request.now_utc = kNow;
    for (const Route& route : routes)
      if (route.path == "/" && route.method == "GET") return route.answer(request, desk).body;
    return "";
  }
  /// Of a page that is kept.
  int steps() {
    page();
    int count = 0;
    sqlite3_progress_handler(
        database_.connection(), 1, [](void* n) { return 0 * ++*static_cast<int*>(n); }, &count);
    page();
    sqlite3_progress_handler(database_.connection(), 0, nullptr, nullptr);
    return count;
  }
  void lengthen_trail(int entries) {
    AnchoredTransaction transaction(database_);
    for (int i = 0; i < entries; ++i) append_audit(database_.connection(), "recording read", "attempt", "");
    transaction.commit();
  }

  Database database_, other_;  ///< the same file
  DeskMemory memory_;
};

TEST_F(DeskMemoryTest, AsksOnceWhileNothingIsWritten) {
  EXPECT_FALSE(lines().empty());
  lines();
  page();
  EXPECT_EQ(memory_.made(), 1);
  expect_fresh("nothing");
}

TEST_F(DeskMemoryTest, SeesWhatAnotherConnectionCommits) {
  lines();
  const std::string trainee = AttemptStore(other_).latest()->trainee;
  AttemptStart start = sample_start("T-new");
  const std::string uuid = store_attempt(other_, start, sample_result(88)).uuid;
  expect_fresh("an attempt");
  EXPECT_TRUE(
      std::any_of(lines().begin(), lines().end(), [&](const CohortLine& line) { return line.last_uuid == uuid; }));
  AssessmentStore(other_).override_verdict(uuid, false, "The camera was knocked", {"0192-i", "Ida Adler"});
  expect_fresh("a decision");
  CurriculumStore(other_).join("T-new", "autumn", {"", "Ida Adler"});
  expect_fresh("a group");
  erase_trainee(other_, trainee, ErasureKind::kIdentity, "request", {"", "Ida Adler"});
  expect_fresh("an erasure");
  for (const CohortLine& line : lines()) EXPECT_NE(line.trainee, trainee);
}

TEST_F(DeskMemoryTest, ThePageShowsWhatAnotherConnectionWrote) {
  EXPECT_EQ(page().find("T-new"), std::string::npos);
  store_attempt(other_, sample_start("T-new"), sample_result(88));
  EXPECT_NE(page().find("T-new"), std::string::npos);
}

TEST_F(DeskMemoryTest, SeesWhatItsOwnConnectionWrites) {
  lines();
  store_attempt(database_, sample_start("T-own"), sample_result(88));
  expect_fresh("an attempt of its own");
  EXPECT_EQ(memory_.made(), 2);
}

TEST_F(DeskMemoryTest, AnotherConnectionsRollbackChangesNothing) {
  lines();
  {
    sql::Transaction transaction(other_.connection());
    sql::execute(other_.connection(), "UPDATE person SET name = 'X'");
  }
  lines();
  EXPECT_EQ(memory_.made(), 1);
}

TEST_F(DeskMemoryTest, OnePersonAtOneExerciseDoesNotWaitForTheCohort) {
  CohortFilter one;
  one.trainee = lines().front().trainee;
  one.exercise = lines().front().key.exercise_id;
  store_attempt(other_, sample_start("T-new"), sample_result(88));
  Desk asked = desk();
  const auto narrow = lines_of(asked, rules_in_force(database_), one, kNow);
  EXPECT_EQ(memory_.made(), 1);
  ASSERT_FALSE(narrow.empty());
  lines();
  EXPECT_EQ(said(narrow), said(lines_of(asked, rules_in_force(database_), one, kNow)));
  EXPECT_EQ(memory_.made(), 2);
}

// A question that reads the trail from its beginning is asked by every page, and costs what years have written.
TEST_F(DeskMemoryTest, AKeptPageCostsTheSameHoweverLongTheTrailIs) {
  const int before = steps();
  lengthen_trail(1000);
  EXPECT_LT(steps(), before + 100);
}

TEST_F(DeskMemoryTest, NorIsTheTrailReadUpToTheFirstAccount) {
  lengthen_trail(2000);
  AccountStore(database_).add("ida", "Ida Adler", Role::kInstructor, "", "a long password", "");
  EXPECT_LT(steps(), 2000);
}

TEST_F(DeskMemoryTest, NewRulesJudgeAnew) {
  lines();
  CurriculumStore(other_).add(kRulesName, "version = \"99\"\n", {"", "Ida Adler"});
  expect_fresh("rules");
  EXPECT_EQ(lines().front().judgements.front().rule_version, "99");
}

TEST_F(DeskMemoryTest, AMinuteLaterWhatIsDueIsJudgedAnew) {
  lines("2026-07-01T12:00:10Z");
  lines("2026-07-01T12:00:50Z");
  EXPECT_EQ(memory_.made(), 1);
  lines("2026-07-01T12:01:00Z");
  EXPECT_EQ(memory_.made(), 2);
}

TEST_F(DeskMemoryTest, FiltersAsTheQueryDoes) {
  CohortFilter none, group, exercise, level, trainee, flag, two;
  group.group = "2026 A";
  exercise.exercise = "surface-touch";
  level.level = "L2";
  trainee.trainee = "p003";
  flag.flag = lines().front().judgements.front().flag;
  two.group = "2026 B";
  two.exercise = "reach-and-orient";
  for (const CohortFilter& filter : {none, group, exercise, level, trainee, flag, two}) {
    EXPECT_EQ(said(filtered(lines(), filter)), said(cohort_lines(database_, rules_in_force(database_), filter, kNow)));
  }
  EXPECT_LT(filtered(lines(), group).size(), lines().size());
  EXPECT_FALSE(filtered(lines(), trainee).empty()) << "the code's case is ignored";
}

}  // namespace
}  // namespace trocar::review::desk_memory_test
