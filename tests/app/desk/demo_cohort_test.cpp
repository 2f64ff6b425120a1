// The invented cohort: complete, marked, chained, in order of its dates, gone without a trace when removed or stopped.
#include "app/desk/demo_cohort.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "app/desk/demo_people.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/progress/calendar.h"
#include "trainees/records/assessments.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/curricula.h"
#include "trainees/records/demo_record.h"
#include "trainees/records/programmes.h"

namespace trocar::demo_cohort_test {
namespace {

namespace fs = std::filesystem;

/// One attempt of each: the same way as all, in seconds.
int make_short(const fs::path& database) {
  DemoCohortOptions options;
  options.database = database;
  options.least_attempts = 1;
  return make_demo_cohort(options, find_assets());
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> out;
  for (const auto& entry : fs::directory_iterator(folder)) out.insert(entry.path().filename());
  return out;
}

TEST(DemoCohort, IsEightPeopleAndAHundredAttempts) {
  int attempts = 0;
  std::set<std::string> codes;
  for (const DemoPerson& person : demo_people()) {
    codes.insert(person.code);
    EXPECT_TRUE(person.code.starts_with("demo-")) << person.code;
    EXPECT_LE(person.first_day, person.last_day) << person.code;
    for (const DemoStint& stint : person.stints) attempts += stint.attempts;
  }
  EXPECT_EQ(codes.size(), 8u);
  EXPECT_GE(attempts, 100);
}

TEST(DemoCohort, IsMarkedChainedAndInOrderOfItsDates) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "demo.db";
  ASSERT_EQ(make_short(file), 8);
  Database database(file, OpenMode::kExisting);
  EXPECT_TRUE(is_demo(database));
  EXPECT_EQ(database.check(), std::vector<std::string>{});
  EXPECT_EQ(AttemptStore(database).check_recordings(), std::vector<std::string>{});
  std::string later = "9999";
  for (const AttemptSummary& attempt : AttemptStore(database).list()) {
    EXPECT_LE(attempt.started_utc, later);
    EXPECT_EQ(attempt.hand, "invented");
    EXPECT_EQ(attempt.status, "completed") << attempt.trainee;
    later = attempt.started_utc;
    const AttemptDetail detail = attempt_detail(database, attempt.uuid);
    const std::int64_t began = *seconds_of_utc(attempt.started_utc), ended = *seconds_of_utc(detail.finished_utc);
    const double ran_s = static_cast<double>(detail.result.device.ticks) / detail.result.device.rate_hz;
    EXPECT_NEAR(static_cast<double>(ended - began), ran_s, 1.0) << "one invented clock has both";
    const TraineeDetail trainee = trainee_detail(database, attempt.trainee, {}, "2030-01-01T00:00:00Z");
    EXPECT_EQ(trainee.weeks.back().monday, monday_of(ended)) << "the week that it ended in";
  }
  EXPECT_EQ(CurriculumStore(database).members("Demo spring").size(), 4u);
  EXPECT_EQ(ProgrammeStore(database).assignments().size(), 2u);
  ASSERT_EQ(AssessmentStore(database).notes_of("demo-chen").size(), 1u);
}

TEST(DemoCohort, ARealDatabaseIsNoneWhateverIsWrittenIntoIt) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "trocar.db";
  {
    Database database(file);
    CurriculumStore(database).add("demo-cohort", "[all]\nattempts = 1\n", {"", "Ines"});
    EXPECT_FALSE(is_demo(database));
    EXPECT_THROW(mark_demo(database), InputError);
    EXPECT_NO_THROW(require_no_demo(database, "nothing"));
  }
  EXPECT_THROW(remove_demo_cohort(file), InputError);
  EXPECT_TRUE(fs::exists(file));
  EXPECT_THROW(make_short(file), InputError);
}

TEST(DemoCohort, StoppedItLeavesNothingAndRemovedItLiesInAFolderOfItsOwn) {
  const test::TemporaryFolder folder;
  DemoCohortOptions options;
  options.database = folder.path() / "demo.db";
  options.jobs = 1;
  options.going = [](int done, int) { return done < 1; };
  EXPECT_EQ(make_demo_cohort(options, find_assets()), 0);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  options.going = {};
  options.least_attempts = 1;
  ASSERT_EQ(make_demo_cohort(options, find_assets()), 8);
  { const Database real(folder.path() / "demo"); }
  EXPECT_NE(message_of<InputError>([&] { remove_demo_cohort(options.database); }).find("shares its folder"),
            std::string::npos);
  for (const char* part : {"demo", "demo.anchor", "demo.key"}) fs::remove(folder.path() / part);
  EXPECT_EQ(remove_demo_cohort(options.database), folder.path() / "removed-demo");
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"removed-demo"});
  const fs::path moved = folder.path() / "removed-demo" / "demo.db";
  {
    Database database(moved, OpenMode::kExisting);
    EXPECT_EQ(database.check(), std::vector<std::string>{});
    EXPECT_EQ(AttemptStore(database).check_recordings(), std::vector<std::string>{});
  }
  fs::copy(folder.path() / "removed-demo", folder.path(), fs::copy_options::recursive);
  EXPECT_EQ(remove_demo_cohort(options.database), folder.path() / "removed-demo-2");
}

TEST(DemoCohort, WithOneAttemptThatIsNotInventedItStays) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "demo.db";
  std::string real;
  {
    Database database(file);
    mark_demo(database);  // never whole: as if a person had practised while it was made
    real = store_attempt(database, sample_start(), sample_result()).uuid;
  }
  EXPECT_NE(message_of<InputError>([&] { remove_demo_cohort(file); }).find(real), std::string::npos);
  EXPECT_TRUE(fs::exists(file));
}

TEST(DemoCohort, AFolderOfRecordingsThatAnotherDatabaseLeftIsNotMixedIn) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder.path() / "demo.recordings");
  std::ofstream(folder.path() / "demo.recordings" / "old.trec") << "kept";
  EXPECT_THROW(make_short(folder.path() / "demo.db"), InputError);
  EXPECT_TRUE(fs::exists(folder.path() / "demo.recordings" / "old.trec"));
}

}  // namespace
}  // namespace trocar::demo_cohort_test
