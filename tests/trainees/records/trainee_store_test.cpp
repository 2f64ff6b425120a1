#include "trainees/records/trainee_store.h"

#include "tests/trainees/records/store_samples.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::trainee_store_test {
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

TEST(TraineeStore, KeepsANameAndAnAddressThatCanBeTakenAway) {
  Database database(":memory:");
  TraineeStore store(database);
  const std::string uuid = store.ensure_trainee("T-1").uuid;
  const auto entries = [&] {
    return sql::query_integer(database.connection(), "SELECT count(*) FROM audit WHERE action = 'person changed'");
  };
  EXPECT_EQ(store.edit("t-1", "Anna Zimtstern", std::nullopt, "").name, "Anna Zimtstern");
  EXPECT_EQ(store.edit("T-1", std::nullopt, "anna@example.org", "0192-account").email, "anna@example.org");
  EXPECT_EQ(store.find("T-1")->name, "Anna Zimtstern") << "what is not given stays";
  EXPECT_EQ(entries(), 2);
  store.edit("T-1", "Anna Zimtstern", std::nullopt, "");
  EXPECT_EQ(entries(), 2) << "nothing changed, so nothing to record";
  EXPECT_EQ(sql::query_text(database.connection(), "SELECT actor FROM audit ORDER BY position DESC LIMIT 1"),
            "0192-account");
  EXPECT_EQ(sql::query_text(database.connection(), "SELECT subject FROM audit ORDER BY position DESC LIMIT 1"), uuid)
      << "it names nobody";
  EXPECT_EQ(store.edit("T-1", "", "", "").email, "");
  EXPECT_TRUE(database.check().empty());
}

TEST(TraineeStore, RefusesWhatIsNoNameOrAddress) {
  Database database(":memory:");
  TraineeStore store(database);
  store.ensure_trainee("T-1");
  for (const std::string email : {"anna", "@example.org", "anna@", "an na@example.org", "a@b@c", "a@b c", "a@b\n"}) {
    EXPECT_NE(message_of<InputError>([&] { store.edit("T-1", std::nullopt, email, ""); }).find("e-mail address"),
              std::string::npos)
        << email;
  }
  for (const std::string name : {" ", "a\nb", "\xFF"})
    EXPECT_THROW(store.edit("T-1", name, std::nullopt, ""), InputError) << name;
  EXPECT_THROW(store.edit("T-1", std::string(101, 'x'), std::nullopt, ""), InputError);
  EXPECT_THROW(store.edit("T-1", std::nullopt, std::string(255, 'x') + "@y", ""), InputError);
  EXPECT_NE(
      message_of<InputError>([&] { store.edit("T-1", std::nullopt, std::nullopt, ""); }).find("what is to change"),
      std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { store.edit("T-9", "Anna", std::nullopt, ""); }).find("there is none"),
            std::string::npos);
  EXPECT_EQ(store.find("T-1")->name, "");
}

TEST(TraineeStore, FindsByTheWholeIdentifierToo) {
  Database database(":memory:");
  TraineeStore store(database);
  const std::string uuid = store.ensure_trainee("T-1").uuid;
  EXPECT_EQ(store.find(uuid)->code, "T-1");
  EXPECT_FALSE(store.find(uuid.substr(0, 35))) << "no part of it";
}

}  // namespace
}  // namespace trocar::trainee_store_test
