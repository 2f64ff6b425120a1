// kill -9 at random moments of short attempts, of one and of two at once: the database opens, every attempt is complete
// or aborted, every recording reads to its last whole chunk. KILL_MOMENTS says how many a round (four moments are five
// attempts), KILL_ROUNDS how many rounds: 20 attempts in ./check, 1000 under the label long. The store itself:
// tests/trainees/store/store_kill_test.cpp.
#include <chrono>
#include <random>
#include <thread>

#include "tests/support/repeats.h"
#include "tests/system/system_fixture.h"

namespace trocar::test::kill_test {
namespace {

const int kMoments = repeats("KILL_MOMENTS", 16);
const int kRounds = repeats("KILL_ROUNDS", 1);

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class Kill : public SystemTest, public ::testing::WithParamInterface<int> {
 protected:
  void SetUp() override {
    random_.seed(20260101u + static_cast<unsigned>(GetParam()));
    exercise_of(2, 12);
    dip();
    const auto begin = Clock::now();
    EXPECT_EQ(RunningProgram(launch(words())).wait().exit_code, 1);
    whole_ = Clock::now() - begin;
  }
  static Translator words() { return {"run", "short.toml", "--hand", "dip.toml", "--db", "t.db"}; }

  /// Kills programs that were started together somewhere between the start of the process and beyond its end.
  void kill_at_random(int programs) {
    std::vector<std::unique_ptr<RunningProgram>> running;
    for (int i = 0; i < programs; ++i) running.push_back(std::make_unique<RunningProgram>(launch(words())));
    for (auto& program : running) {
      std::uniform_real_distribution<double> share(0.0, programs == 1 ? 1.1 : 1.5);
      std::this_thread::sleep_for(whole_ * share(random_) / programs);
      program->kill_at_once();
    }
    for (auto& program : running) killed_ += program->wait().signal == SIGKILL;
  }

  /// All that must hold whenever the database is next opened.
  void expect_whole() const {
    const Outcome check = trocar({"db", "check", "--db", "t.db"});
    ASSERT_EQ(check.exit_code, 0) << check.out << check.err;
    const Json history = json_of({"trainee", "show", "guest", "--db", "t.db", "--limit", "0", "--json"}, 0)["history"];
    for (const Json& attempt : history) {
      const bool over = attempt["status"] == "timeout" && attempt["score"].is_number();
      const bool cut = attempt["status"] == "aborted" && attempt["score"].is_null();
      EXPECT_TRUE(over || cut) << attempt;
    }
  }

  void expect_readable_recordings() {
    for (const auto& entry : fs::directory_iterator(folder_ / "t.recordings")) {
      const std::string bytes = file_bytes(entry.path());
      const Outcome scored = trocar({"score", entry.path().string(), "--json"});
      if (header_is_whole(bytes)) {
        EXPECT_LE(scored.exit_code, 1) << entry.path() << ": " << scored.err;
        ++readable_;
      } else {
        EXPECT_EQ(scored.exit_code, 2) << "nothing but a piece of the header was written";
      }
    }
  }
  static bool header_is_whole(const std::string& bytes) {
    if (bytes.size() < 24) return false;  // magic and version, type, length, CRC
    std::uint32_t length = 0;
    for (int i = 3; i >= 0; --i)
      length = length << 8 | static_cast<unsigned char>(bytes[16 + static_cast<std::size_t>(i)]);
    return bytes.size() >= 24 + length;
  }

  std::mt19937 random_;
  Clock::duration whole_{};
  int killed_ = 0, readable_ = 0;
};

TEST_P(Kill, AtRandomMomentsNothingIsLeftHalf) {
  for (int moment = 0; moment < kMoments; ++moment) {
    kill_at_random(moment % 4 == 3 ? 2 : 1);
    expect_whole();
    if (HasFailure()) break;
  }
  expect_readable_recordings();
  EXPECT_GT(killed_, kMoments / 3) << "most must have been killed, not have ended by themselves";
  EXPECT_GT(readable_, kMoments / 4);
  std::printf("%d of %d moments killed a program; %d recordings readable\n", killed_, kMoments, readable_);
}

INSTANTIATE_TEST_SUITE_P(Round, Kill, ::testing::Range(0, kRounds));

}  // namespace
}  // namespace trocar::test::kill_test
