// Curricula, benchmarks and groups: versions are added, never changed; the newest of a name holds.
#include "trainees/records/curricula.h"

#include <atomic>
#include <barrier>
#include <thread>

#include "haptics/digest/digest.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::curricula_test {
namespace {

class Curricula : public testing::Test {
 protected:
  Database database_{":memory:"};
  CurriculumStore store_{database_};
  const Author author_{"0192-account", "Ida Adler"};
};

TEST_F(Curricula, ANewTextIsANewVersionAndTheSameTextIsNone) {
  EXPECT_FALSE(store_.newest("course"));
  EXPECT_EQ(store_.add("course", "a = 1\n", author_).version, 1);
  EXPECT_EQ(store_.add("course", "a = 1\n", author_).version, 1);
  EXPECT_EQ(store_.add("course", "a = 2\n", author_).version, 2);
  EXPECT_EQ(store_.add("course", "a = 1\n", author_).version, 3) << "back to an older text is a version too";
  EXPECT_EQ(store_.add("other", "b = 1\n", author_).version, 1);
  const Curriculum newest = store_.newest("course").value();
  EXPECT_EQ(newest.version, 3);
  EXPECT_EQ(newest.toml, "a = 1\n");
  EXPECT_EQ(newest.sha256, digest::of_bytes("a = 1\n"));
  EXPECT_EQ(newest.author, "0192-account");
  const auto all = store_.list();
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all.front().name, "other");
  EXPECT_EQ(all.back().version, 1);
  EXPECT_TRUE(database_.check().empty());
}

TEST_F(Curricula, OfTwoTextsOfOneVersionTheLaterHolds) {
  store_.add("course", "here = 1\n", author_);
  sql::execute(database_.connection(),
               "INSERT INTO curriculum (uuid, name, version, sha256, toml, author, utc)"
               " SELECT 'ffff', name, version, sha256, 'there', author, utc FROM curriculum");
  seal_row(database_.connection(), "curriculum", "ffff", "");
  EXPECT_EQ(store_.newest("course")->toml, "there");
}

/// Else one row with a text that cannot be read would take every page away.
TEST_F(Curricula, ARowThatSomebodyPutInRulesNothing) {
  store_.add("standard", "a = 1\n", author_);
  sql::execute(
      database_.connection(),
      "INSERT INTO curriculum (uuid, name, version, sha256, toml, author, utc) VALUES"
      " ('ffffffff-ffff-7fff-8000-000000000001', 'standard', 99, hex(randomblob(32)), '[[[ not toml', '', '')");
  EXPECT_EQ(store_.newest("standard")->toml, "a = 1\n");
  const Curriculum next = store_.add("standard", "a = 2\n", author_);
  EXPECT_EQ(next.uuid.size(), 36u);
  EXPECT_EQ(store_.newest("standard")->toml, "a = 2\n");
}

TEST_F(Curricula, BadNamesAndEmptyTextsAreRefused) {
  EXPECT_THROW(store_.add("", "a = 1", author_), InputError);
  EXPECT_THROW(store_.add(std::string(65, 'x'), "a = 1", author_), InputError);
  EXPECT_THROW(store_.add("course", "", author_), InputError);
  EXPECT_THROW(store_.add("course", std::string("a\0", 2), author_), InputError);
  EXPECT_THROW(store_.add("course", std::string(1000001, 'a'), author_), InputError);
  EXPECT_TRUE(store_.list().empty());
}

TEST_F(Curricula, BenchmarksSayWhereTheyComeFrom) {
  Benchmark numbers;
  numbers.exercise_id = "surface-touch";
  numbers.level = "L1";
  numbers.metric = "force_max_n";
  numbers.source = "six consultants, March 2026";
  numbers.rule = "median of two runs";
  numbers.full_at = 0.9;
  numbers.zero_at = 4.7;
  numbers.n = 6;
  const Benchmark added = store_.add_benchmark(numbers, author_);
  EXPECT_EQ(added.author, "0192-account");
  numbers.full_at = 1.0;
  store_.add_benchmark(numbers, author_);
  const auto all = store_.benchmarks();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].full_at, 1.0);
  EXPECT_EQ(all[1].uuid, added.uuid);
  EXPECT_EQ(all[1].source, "six consultants, March 2026");
  EXPECT_EQ(all[1].rule, "median of two runs");
  EXPECT_EQ(all[1].n, 6);
  EXPECT_EQ(store_.benchmarks("surface-touch", "L2").size(), 0u);
  EXPECT_EQ(store_.benchmarks("surface-touch", "L1").size(), 2u);
  store_attempt(database_, sample_start(), sample_result());
  EXPECT_TRUE(database_.check().empty()) << "the exercise of a benchmark may be tried later";
}

TEST_F(Curricula, BenchmarksWithoutMeaningAreRefused) {
  Benchmark good;
  good.exercise_id = "e";
  good.level = good.metric = good.source = good.rule = "x";
  good.full_at = 1;
  const auto refused = [&](const std::function<void(Benchmark&)>& spoil) {
    Benchmark bad = good;
    spoil(bad);
    return !message_of<InputError>([&] { store_.add_benchmark(bad, author_); }).empty();
  };
  EXPECT_TRUE(refused([](Benchmark& b) { b.zero_at = 1; })) << "no slope";
  EXPECT_TRUE(refused([](Benchmark& b) { b.n = -1; }));
  EXPECT_TRUE(refused([](Benchmark& b) { b.full_at = 1.0 / 0.0; }));
  EXPECT_TRUE(refused([](Benchmark& b) { b.exercise_id = ""; }));
  EXPECT_TRUE(refused([](Benchmark& b) { b.source = ""; })) << "a benchmark without origin is none";
  EXPECT_TRUE(store_.benchmarks().empty());
  store_.add_benchmark(good, author_);
}

TEST_F(Curricula, GroupsAreJoinedAndLeftOnRecord) {
  for (const char* code : {"T-1", "T-2"}) TraineeStore(database_).ensure_trainee(code);
  store_.join("T-1", "autumn", author_);
  store_.join("t-2", "autumn", author_);
  store_.join("T-1", "autumn", author_);
  store_.join("T-1", "night", author_);
  EXPECT_EQ(store_.groups(), (std::vector<std::string>{"autumn", "night"}));
  EXPECT_EQ(store_.members("autumn"), (std::vector<std::string>{"T-1", "T-2"}));
  EXPECT_EQ(store_.groups_of("T-1"), (std::vector<std::string>{"autumn", "night"}));
  store_.leave("T-1", "autumn", author_);
  store_.leave("T-1", "autumn", author_);
  EXPECT_EQ(store_.members("autumn"), std::vector<std::string>{"T-2"});
  EXPECT_EQ(sql::query_integer(database_.connection(), "SELECT count(*) FROM audit WHERE actor = '0192-account'"), 4)
      << "three joined, one left; what changed nothing is no entry";
  EXPECT_THROW(store_.join("T-9", "autumn", author_), InputError);
  EXPECT_THROW(store_.join("T-1", "", author_), InputError);
  EXPECT_TRUE(database_.check().empty());
}

class CurriculaOnDisk : public TemporaryFolder {};

/// What is asked of the newest version is so yet when the next is written.
TEST_F(CurriculaOnDisk, OfTwoThatSawTheSameVersionOneSaves) {
  const std::filesystem::path file = folder_ / "t.db";
  constexpr int kRounds = 20;
  { const Database made(file); }
  std::atomic<int> saved = 0, refused = 0;
  std::barrier together(2);
  const auto save = [&](const std::string& who) {
    Database database(file);
    for (int round = 0; round < kRounds; ++round) {
      together.arrive_and_wait();
      try {
        CurriculumStore(database).add("course", who + std::to_string(round), {"", who},
                                      [round](const std::optional<Curriculum>& last) {
                                        if ((last ? last->version : 0) != round) throw InputError("saved meanwhile");
                                      });
        ++saved;
      } catch (const InputError&) {
        ++refused;
      }
      together.arrive_and_wait();
    }
  };
  std::thread other(save, "otto");
  save("ines");
  other.join();
  EXPECT_EQ(saved, kRounds);
  EXPECT_EQ(refused, kRounds);
  EXPECT_EQ(sql::query_integer(Database(file).connection(), "SELECT count(*) FROM curriculum"), kRounds);
}

}  // namespace
}  // namespace trocar::curricula_test
