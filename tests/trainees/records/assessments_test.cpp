// Notes, ratings, signatures, overrides, certificates: what can be said of whom, in which order it is read, and that it
// stays as it was.
#include "trainees/records/assessments.h"

#include <atomic>
#include <barrier>
#include <cmath>
#include <thread>

#include "tests/trainees/records/store_samples.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::assessments_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReason = "The camera was knocked at 12 s";

class Assessments : public testing::Test {
 protected:
  Assessments() {
    TraineeStore(database_).ensure_trainee("T-1");
    attempt_ = store_attempt(database_, sample_start("T-1"), sample_result()).uuid;
    hash_ = sql::query_text(database_.connection(), "SELECT row_hash FROM attempt WHERE id = 1");
  }
  std::string begun() { return AttemptStore(database_).begin_attempt(sample_start("T-1")).uuid; }
  void refuses(const std::function<void()>& action, const std::string& why) {
    const std::string message = message_of<InputError>(action);
    EXPECT_NE(message.find(why), std::string::npos) << message;
  }
  void outside(const char* sql) { sql::execute(database_.connection(), sql); }

  Database database_{":memory:"};
  AssessmentStore store_{database_};
  const Author author_{"0192-account", "Ida Adler"};
  std::string attempt_, hash_;
};

TEST_F(Assessments, NotesAreReadNewestFirstAndMetOnce) {
  const Note first = store_.add_note("T-1", "", "Keep the left hand still.", author_);
  const Note second = store_.add_note("t-1", attempt_, "Look at 12 s:\nthe tip\tslips.", {"", "Otto"});
  const auto notes = store_.notes_of("T-1");
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0].uuid, second.uuid);
  EXPECT_EQ(notes[0].attempt_uuid, attempt_);
  EXPECT_EQ(notes[0].printed, "Otto");
  EXPECT_EQ(notes[0].text, "Look at 12 s:\nthe tip\tslips.");
  EXPECT_EQ(notes[1].author, "0192-account");
  EXPECT_EQ(notes[1].attempt_uuid, "");
  EXPECT_EQ(store_.newest_unseen("T-1")->uuid, second.uuid);
  store_.mark_seen(second.uuid);
  const std::string seen = store_.notes_of("T-1")[0].seen_utc;
  EXPECT_NE(seen, "");
  store_.mark_seen(second.uuid);
  EXPECT_EQ(store_.notes_of("T-1")[0].seen_utc, seen) << "the first time counts";
  EXPECT_EQ(store_.newest_unseen("T-1")->uuid, first.uuid);
  store_.mark_seen(first.uuid);
  EXPECT_FALSE(store_.newest_unseen("T-1"));
  EXPECT_TRUE(database_.check().empty());
}

TEST_F(Assessments, NotesThatSayNothingOrOfNobodyAreRefused) {
  refuses([&] { store_.add_note("T-2", "", "x", author_); }, "trainee \"T-2\"");
  refuses([&] { store_.add_note("T-1", "", " \n ", author_); }, "note: is empty");
  refuses([&] { store_.add_note("T-1", "", std::string(4001, 'x'), author_); }, "no more than 4000");
  refuses([&] { store_.add_note("T-1", "", "a\x01", author_); }, "control characters");
  refuses([&] { store_.add_note("T-1", "", std::string("a\0b", 3), author_); }, "control characters");
  refuses([&] { store_.add_note("T-1", "", "\xC0\x80", author_); }, "UTF-8");
  refuses([&] { store_.add_note("T-1", "", "x", {"", ""}); }, "author");
  refuses([&] { store_.add_note("T-1", "0192-none", "x", author_); }, "is none of this trainee's");
  TraineeStore(database_).ensure_trainee("T-2");
  refuses([&] { store_.add_note("T-2", attempt_, "x", author_); }, "is none of this trainee's");
  refuses([&] { store_.mark_seen("0192-none"); }, "not in this database");
  std::string umlauts;
  for (int i = 0; i < 4000; ++i) umlauts += "\xC3\xA4";
  EXPECT_EQ(store_.add_note("T-1", "", umlauts, author_).text.size(), 8000u) << "characters count, not bytes";
  EXPECT_EQ(store_.notes_of("T-1").size(), 1u);
}

TEST_F(Assessments, RatingsAreKeptItemByItem) {
  store_.add_rating(attempt_, "GOALS", "depth perception", 4, author_);
  store_.add_rating(attempt_, "GOALS", "efficiency", 3.5, author_);
  const auto ratings = store_.ratings_of(attempt_);
  ASSERT_EQ(ratings.size(), 2u);
  EXPECT_EQ(ratings[1].item, "efficiency");
  EXPECT_EQ(ratings[1].value, 3.5);
  EXPECT_EQ(ratings[0].rater, "Ida Adler");
  EXPECT_EQ(ratings[0].account_uuid, "0192-account");
  refuses([&] { store_.add_rating(attempt_, "GOALS", "", 1, author_); }, "item");
  refuses([&] { store_.add_rating(attempt_, "", "x", 1, author_); }, "scale");
  refuses([&] { store_.add_rating(attempt_, "GOALS", "x", NAN, author_); }, "is not a number");
  refuses([&] { store_.add_rating(begun(), "GOALS", "x", 1, author_); }, "still running");
  refuses([&] { store_.add_rating("0192-none", "GOALS", "x", 1, author_); }, "not in this database");
}

TEST_F(Assessments, ASignatureIsBoundToTheBytesOfTheAttempt) {
  const Signature signature = store_.sign(attempt_, "approval", "", author_);
  EXPECT_EQ(signature.row_hash, hash_);
  const auto signatures = store_.signatures_of(attempt_);
  ASSERT_EQ(signatures.size(), 1u);
  EXPECT_EQ(signatures[0].uuid, signature.uuid);
  EXPECT_EQ(signatures[0].signer, "Ida Adler");
  EXPECT_EQ(signatures[0].meaning, "approval");
  refuses([&] { store_.sign(attempt_, "likes", "", author_); }, "not \"likes\"");
  refuses([&] { store_.sign(begun(), "review", "", author_); }, "still running");
  refuses([&] { store_.sign(attempt_, "review", "", {"", " "}); }, "signer");
  outside("DROP TRIGGER score_no_update; UPDATE score SET value = 99");
  refuses([&] { store_.sign(attempt_, "review", "", author_); },
          "was changed after it was finished and cannot be signed");
}

TEST_F(Assessments, TheNewestOverrideStandsFirstAndTheScoreStays) {
  const double before = AttemptStore(database_).load(attempt_).grade.score.value();
  store_.override_verdict(attempt_, false, kReason, author_);
  store_.override_verdict(attempt_, true, "Looked at the film again: it was not", author_);
  const auto verdicts = store_.overrides_of(attempt_);
  ASSERT_EQ(verdicts.size(), 2u);
  EXPECT_TRUE(verdicts[0].passed);
  EXPECT_EQ(verdicts[1].reason, kReason);
  EXPECT_EQ(AttemptStore(database_).load(attempt_).grade.score, before);
  refuses([&] { store_.override_verdict(attempt_, true, "   ok      ", author_); }, "at least 10");
  refuses([&] { store_.override_verdict(attempt_, true, "\t\t\t\t\t\t\t\t\t\t\tx", author_); }, "at least 10");
  refuses([&] { store_.override_verdict(begun(), true, kReason, author_); }, "still running");
}

TEST_F(Assessments, ACertificateHoldsUntilItIsRevoked) {
  const Certificate first = store_.certify("T-1", "surface-touch", "L1", "2026-1", "{\"n\":14}", author_);
  const Certificate second = store_.certify("T-1", "surface-touch", "L2", "2026-1", "{\"n\":20}", author_);
  ASSERT_EQ(store_.certificates_of("t-1").size(), 2u);
  EXPECT_EQ(store_.certificates_of("")[0].uuid, second.uuid);
  EXPECT_EQ(store_.certificates_of("T-1")[1].evidence, "{\"n\":14}");
  EXPECT_EQ(store_.certificates_of("T-1")[1].revoked_utc, "");
  store_.revoke(first.uuid, kReason, author_);
  EXPECT_EQ(store_.certificates_of("T-1")[1].revoked_reason, kReason);
  EXPECT_NE(store_.certificates_of("T-1")[1].revoked_utc, "");
  EXPECT_EQ(store_.certificates_of("T-1")[0].revoked_utc, "");
  refuses([&] { store_.revoke(first.uuid, kReason, author_); }, "was revoked on");
  refuses([&] { store_.revoke("0192-none", kReason, author_); }, "not in this database");
  refuses([&] { store_.revoke(second.uuid, "no", author_); }, "at least 10");
  refuses([&] { store_.certify("T-1", "never-tried", "L1", "1", "{}", author_); }, "nobody has tried it");
  refuses([&] { store_.certify("T-9", "surface-touch", "L1", "1", "{}", author_); }, "there is none");
  refuses([&] { store_.certify("T-1", "surface-touch", "", "1", "{}", author_); }, "level");
  refuses([&] { store_.certify("T-1", "surface-touch", "L1", "1", "", author_); }, "evidence");
  EXPECT_TRUE(database_.check().empty());
}

TEST_F(Assessments, TheTablesRefuseChangeDeletionAndReplacement) {
  store_.add_note("T-1", attempt_, "a note", author_);
  store_.add_rating(attempt_, "GOALS", "efficiency", 3, author_);
  store_.sign(attempt_, "review", "", author_);
  store_.override_verdict(attempt_, true, kReason, author_);
  store_.revoke(store_.certify("T-1", "surface-touch", "L1", "1", "{}", author_).uuid, kReason, author_);
  for (const std::string table : {"note", "rating", "signature", "verdict_override", "certificate", "revocation"}) {
    for (const std::string& change : {"UPDATE " + table + " SET utc = 'x'", "DELETE FROM " + table,
                                      "INSERT OR REPLACE INTO " + table + " SELECT * FROM " + table}) {
      const std::string message = message_of<InputError>([&] { sql::execute(database_.connection(), change.c_str()); });
      EXPECT_NE(message.find(table), std::string::npos) << change << ": " << message;
    }
  }
  outside("CREATE TEMP TABLE other AS SELECT * FROM note; UPDATE other SET id = 99, text = 'another'");
  EXPECT_THROW(outside("INSERT OR REPLACE INTO note SELECT * FROM other"), InputError)
      << "the identifier is taken, whatever the number";
  EXPECT_TRUE(database_.check().empty());
}

TEST_F(Assessments, OnePersonSignsAnAttemptOnceWithAMeaning) {
  store_.sign(attempt_, "review", "Seen.", author_);
  const auto entries = [&] { return sql::query_integer(database_.connection(), "SELECT count(*) FROM audit"); };
  const auto before = entries();
  refuses([&] { store_.sign(attempt_, "review", "", author_); }, "already signed: Ida Adler gave \"review\" on ");
  refuses([&] { store_.sign(attempt_, "review", "", {author_.account_uuid, "Under another name"}); }, "already signed");
  EXPECT_EQ(store_.signatures_of(attempt_).size(), 1u);
  EXPECT_EQ(entries(), before) << "nothing was written";
  store_.sign(attempt_, "approval", "", author_);
  store_.sign(attempt_, "review", "", {"0193-account", "Ida Adler"});  // of the same name, another person
  store_.sign(attempt_, "review", "", {"", "Otto"});                   // at the command line names tell
  store_.sign(attempt_, "review", "", {"", "Emil"});
  refuses([&] { store_.sign(attempt_, "review", "", {"", "Otto"}); }, "already signed");
  EXPECT_EQ(store_.signatures_of(attempt_).size(), 5u);
}

TEST_F(Assessments, ACertificateIsHeldOnceUntilItIsRevoked) {
  const auto certify = [&](const std::string& level) {
    return store_.certify("T-1", "surface-touch", level, "1", "{}", author_).uuid;
  };
  const std::string first = certify("L1");
  refuses([&] { certify("L1"); }, "holds a certificate for surface-touch at level L1 already, by Ida Adler on ");
  certify("L2");
  EXPECT_EQ(store_.certificates_of("T-1").size(), 2u);
  store_.revoke(first, kReason, author_);
  certify("L1");
  refuses([&] { certify("L1"); }, "already");
  EXPECT_EQ(store_.certificates_of("T-1").size(), 3u);
  EXPECT_TRUE(database_.check().empty());
}

using TwoDesks = TemporaryFolder;

/// Both look, both find nothing, both write: only inside the writing transaction one of them is second.
TEST_F(TwoDesks, GiveOneCertificateAndOneSignatureBetweenThem) {
  const fs::path file = folder_ / "t.db";
  std::string attempt;
  {
    Database database(file);
    attempt = store_attempt(database, sample_start("T-1"), sample_result()).uuid;
  }
  constexpr int kRounds = 20;
  std::atomic<int> certified{0}, signed_ones{0}, refused{0};
  std::barrier together(2);
  const auto desk = [&](const std::string& name) {
    Database database(file, OpenMode::kExisting, 20000);
    AssessmentStore store(database);
    const auto once = [&](std::atomic<int>& done, const std::function<void()>& action) {
      together.arrive_and_wait();
      try {
        action();
        ++done;
      } catch (const InputError&) {
        ++refused;
      }
    };
    for (int i = 0; i < kRounds; ++i) {
      const std::string level = "L" + std::to_string(i);
      once(certified, [&] { store.certify("T-1", "surface-touch", level, "1", "{}", {"", name}); });
      once(signed_ones, [&] { store.sign(attempt, "review", "", {"account-" + std::to_string(i), "Ida"}); });
    }
  };
  std::thread other(desk, "two");
  desk("one");
  other.join();
  EXPECT_EQ(certified, kRounds);
  EXPECT_EQ(signed_ones, kRounds);
  EXPECT_EQ(refused, 2 * kRounds);
  Database database(file);
  EXPECT_EQ(AssessmentStore(database).certificates_of("T-1").size(), static_cast<std::size_t>(kRounds));
  EXPECT_EQ(problems_of(database), "");
}

}  // namespace
}  // namespace trocar::assessments_test
