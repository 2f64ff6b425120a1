// A demo is one since it was made and by nothing else; what it holds stays out of every record.
#include "trainees/records/demo_record.h"

#include "tests/trainees/records/store_samples.h"
#include "trainees/records/curricula.h"
#include "trainees/records/trainee_store.h"

namespace trocar::demo_record_test {
namespace {

class DemoRecord : public TemporaryFolder {
 protected:
  Database database_{folder_ / "trocar.db"};
};

TEST_F(DemoRecord, NoNameAndNoLaterEntryMakesARecordADemo) {
  TraineeStore(database_).ensure_trainee("T-anna");
  CurriculumStore(database_).add("demo-cohort", "[all]\nattempts = 1\n", {"", "Ines"});
  EXPECT_FALSE(is_demo(database_));
  EXPECT_THROW(mark_demo(database_), InputError);
  mark_demo_whole(database_);
  EXPECT_FALSE(is_demo(database_));
  require_no_demo(database_, "nothing");
  store_attempt(database_, sample_start(), sample_result());
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(DemoRecord, OnceWholeItTakesNoAttemptAndTellsTheInventedFromOthers) {
  mark_demo(database_);
  EXPECT_TRUE(is_demo(database_));
  store_attempt(database_, sample_start(), sample_result());
  EXPECT_NE(attempt_not_invented(database_), "") << "not said yet";
  mark_demo_whole(database_);
  EXPECT_EQ(attempt_not_invented(database_), "");
  const std::string refused =
      message_of<InputError>([&] { store_attempt(database_, sample_start(), sample_result()); });
  EXPECT_NE(refused.find("invented"), std::string::npos) << refused;
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(DemoRecord, AnAttemptThatBeganBeforeAndEndedAfterIsNotInvented) {
  mark_demo(database_);
  AttemptStore store(database_);
  const AttemptId open = store.begin_attempt(sample_start());
  mark_demo_whole(database_);
  EXPECT_EQ(attempt_not_invented(database_), open.uuid);
  store.finish_attempt(open, sample_result());
  EXPECT_EQ(attempt_not_invented(database_), open.uuid);
}

}  // namespace
}  // namespace trocar::demo_record_test
