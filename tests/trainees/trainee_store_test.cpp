#include "trainees/trainee_store.h"

#include "tests/trainees/store_samples.h"

namespace trocar {
namespace {

TEST(TraineeStore, CreatesOnceAndFindsAgain) {
  Database database(":memory:");
  TraineeStore store(database);
  const Trainee first = store.ensure_trainee("T-expert");
  const Trainee again = store.ensure_trainee("T-expert");
  EXPECT_EQ(again.uuid, first.uuid);
  EXPECT_EQ(first.uuid.size(), 36u);
  EXPECT_EQ(store.list().size(), 1u);
  EXPECT_FALSE(store.find("T-other"));
}

TEST(TraineeStore, CodesThatDifferByCaseAreOneTrainee) {
  Database database(":memory:");
  TraineeStore store(database);
  store.ensure_trainee("T-Expert");
  EXPECT_EQ(store.ensure_trainee("t-expert").code, "T-Expert");
}

TEST(TraineeStore, RefusesCodesThatAreNotPlain) {
  Database database(":memory:");
  TraineeStore store(database);
  for (const std::string code : {"", " ", "-x", ".x", "a b", "a/b", "a'b", "\xC3\xA4", "a\n"}) {
    EXPECT_NE(message_of<InputError>([&] { store.ensure_trainee(code); }).find("trainee code"), std::string::npos)
        << code;
  }
  EXPECT_THROW(store.ensure_trainee(std::string(33, 'a')), InputError);
  EXPECT_EQ(store.ensure_trainee(std::string(32, 'a')).code.size(), 32u);
  EXPECT_EQ(store.ensure_trainee("0.A_b-9").code, "0.A_b-9");
  EXPECT_EQ(store.list().size(), 2u);
}

TEST(TraineeStore, CountsFinishedAttemptsAndPasses) {
  Database database(":memory:");
  store_attempt(database, sample_start("A"), sample_result(90));
  store_attempt(database, sample_start("A"), sample_result(40));
  AttemptStore(database).begin_attempt(sample_start("A"));
  TraineeStore(database).ensure_trainee("B");
  const auto trainees = TraineeStore(database).list();
  ASSERT_EQ(trainees.size(), 2u);
  EXPECT_EQ(trainees[0].attempts, 2);
  EXPECT_EQ(trainees[0].passes, 1);
  EXPECT_NE(trainees[0].last_utc, "");
  EXPECT_EQ(trainees[1].attempts, 0);
  EXPECT_EQ(trainees[1].last_utc, "");
}

}  // namespace
}  // namespace trocar
