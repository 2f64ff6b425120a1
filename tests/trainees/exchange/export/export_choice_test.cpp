// What an export sees: one state of the database, people who were erased, choices put together.
#include <sstream>

#include "tests/trainees/exchange/export/export_samples.h"
#include "trainees/exchange/export/table_export.h"
#include "trainees/exchange/export/xapi_export.h"
#include "trainees/records/curricula.h"
#include "trainees/records/erasure.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::export_choice_test {
namespace {

class ExportChoices : public TemporaryFolder {
 protected:
  std::string document(Database& database, const ExportFilter& filter = {}) {
    std::ostringstream out;
    write_json(database, choose_attempts(database, filter), out);
    return out.str();
  }
};

TEST_F(ExportChoices, OneStateWhateverIsWrittenMeanwhile) {
  Database database(folder_ / "t.db");
  store_attempt(database, sample_start("A"), sample_result());
  Database other(folder_ / "t.db");
  {
    const sql::ReadSnapshot snapshot(database.connection());
    const std::string before = document(database);
    store_attempt(other, sample_start("B"), sample_result());
    EXPECT_EQ(document(database), before);
    EXPECT_EQ(choose_attempts(database, {}).attempts.size(), 1u);
  }
  EXPECT_EQ(choose_attempts(database, {}).attempts.size(), 2u) << "afterwards the new one is there";
  store_attempt(database, sample_start("C"), sample_result());
  EXPECT_EQ(choose_attempts(other, {}).attempts.size(), 3u) << "and writing goes on";
}

TEST_F(ExportChoices, ASnapshotEndsWithAnError) {
  Database database(":memory:");
  store_attempt(database, sample_start("A"), sample_result());
  EXPECT_THROW(
      {
        const sql::ReadSnapshot snapshot(database.connection());
        choose_attempts(database, {"nobody", "", ""});
      },
      InputError);
  store_attempt(database, sample_start("A"), sample_result());  // a transaction left open would refuse this
  EXPECT_EQ(choose_attempts(database, {}).attempts.size(), 2u);
}

TEST_F(ExportChoices, WhoeverWasErasedHasNoCode) {
  Database database(":memory:");
  const AttemptId id = store_attempt(database, sample_start("Miller"), sample_result());
  sql::execute(database.connection(), "DELETE FROM person");
  const std::string text = document(database);
  EXPECT_EQ(text.find("Miller"), std::string::npos);
  EXPECT_NE(text.find("\"trainee\":\"erased-"), std::string::npos);
  EXPECT_NE(text.find(id.uuid), std::string::npos) << "the attempt is still there";
  EXPECT_THROW(choose_attempts(database, {"Miller", "", ""}), InputError);
  const XapiAttempt attempt = read_xapi_attempt(database, id.row, {});
  EXPECT_EQ(xapi_problems(xapi_statement(attempt)), std::vector<std::string>{});
}

TEST_F(ExportChoices, FieldsNarrowTogetherAndKeepTheOrder) {
  Database database(":memory:");
  std::vector<std::int64_t> of_group;
  for (const char* code : {"A", "B", "A", "C", "B", "A"}) {
    const AttemptId id = store_attempt(database, sample_start(code), sample_result());
    if (*code != 'C') of_group.push_back(id.row);
  }
  CurriculumStore groups(database);
  for (const char* code : {"A", "B"}) groups.join(code, "morning", {"", "desk"});
  groups.join("A", "evening", {"", "desk"});
  EXPECT_EQ(choose_attempts(database, {"", "morning", ""}).attempts, of_group) << "each once, oldest first";
  EXPECT_EQ(choose_attempts(database, {"B", "morning", ""}).attempts.size(), 2u);
  EXPECT_EQ(choose_attempts(database, {"", "evening", "surface-touch"}).attempts.size(), 3u);
  EXPECT_THROW(choose_attempts(database, {"C", "morning", ""}), InputError) << "in no group";
  const ExportChoice choice = choose_attempts(database, {"", "morning", ""});
  EXPECT_EQ(choice.trainees.size(), 2u) << "each once";
  EXPECT_EQ(choice.filter.group, "morning");
}

TEST_F(ExportChoices, WhoseTrainingDataWereErasedIsLeftOut) {
  Database database(":memory:");
  store_attempt(database, sample_start("Miller"), sample_result());
  const AttemptId other = store_attempt(database, sample_start("T-2"), sample_result());
  const std::string uuid =
      erase_trainee(database, "Miller", ErasureKind::kTraining, "request of the person", {"", "desk"}).trainee_uuid;
  EXPECT_EQ(choose_attempts(database, {}).attempts, std::vector<std::int64_t>{other.row})
      << "what is left would read as failed";
  EXPECT_NE(message_of<InputError>([&] {
              choose_attempts(database, {"erased-" + uuid.substr(28), "", ""});
            }).find("nothing to export"),
            std::string::npos);
}

}  // namespace
}  // namespace trocar::export_choice_test
