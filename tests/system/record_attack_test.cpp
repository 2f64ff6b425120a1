// What somebody with a shell at a station may try with recordings, and what it earns: nothing, with the reason told.
#include <chrono>
#include <thread>

#include "tests/system/system_fixture.h"

namespace trocar::test::record_attack_test {
namespace {

namespace fs = std::filesystem;

class RecordAttack : public SystemTest {
 protected:
  Json newest(const std::string& trainee) const {
    return json_of({"trainee", "show", trainee, "--db", "t.db", "--json"}, 0)["history"][0];
  }
  fs::path recording_of(const Json& attempt) const {
    return folder_ / "t.recordings" / (attempt["uuid"].get<std::string>() + ".trec");
  }
  void replace(const fs::path& file, const fs::path& by) const {
    fs::remove(file);
    fs::copy_file(by, file);
  }
};

TEST_F(RecordAttack, AnIdleExamThatIsKilledAndGivenAnExpertsRecordingIsAborted) {
  const Translator expert{"run", "E01",    "--level", "L1",        "--hand",   "expert", "--board",
                          "3",   "--seed", "3",       "--trainee", "T-expert", "--db",   "t.db"};
  ASSERT_EQ(trocar(expert).exit_code, 0);
  const fs::path kept = recording_of(newest("T-expert"));  // now: whoever opens the database ends what has died
  RunningProgram exam(launch({"run", "E01", "--level", "exam", "--hand", "idle", "--seed", "3", "--trainee", "T-idle",
                              "--db", "t.db", "--realtime"}));
  while (exam.running() &&
         std::distance(fs::directory_iterator(folder_ / "t.recordings"), fs::directory_iterator()) < 2)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  exam.kill_at_once();
  ASSERT_EQ(exam.wait().signal, SIGKILL);
  fs::path left;
  for (const auto& entry : fs::directory_iterator(folder_ / "t.recordings"))
    if (entry.path() != kept) left = entry.path();
  replace(left, kept);
  const Json attempt = newest("T-idle");
  EXPECT_EQ(attempt["status"], "aborted");
  EXPECT_TRUE(attempt["score"].is_null());
  EXPECT_EQ(attempt["passed"], false);
  const std::string uuid = attempt["uuid"];
  EXPECT_NE(attempt["integrity"].get<std::string>().find("in the place of its recording lies that of attempt "),
            std::string::npos)
      << attempt;
  expect_refusal({"score", uuid, "--db", "t.db"}, 2, "was not recorded");
  expect_refusal({"replay", uuid, "--verify", "--db", "t.db"}, 2, "was not recorded");
  const Outcome check = trocar({"db", "check", "--db", "t.db"});
  EXPECT_EQ(check.exit_code, 2);
  EXPECT_NE(check.out.find(left.filename().string() + " bears the name of an attempt that was kept without one"),
            std::string::npos)
      << check.out;
}

TEST_F(RecordAttack, NoScriptIsCalledAsAPersonsInput) {
  const fs::path assets = folder_ / "mine";
  fs::create_directories(assets / "assets");
  for (const char* part : {"exercises", "hands"})
    fs::copy(fs::path(TROCAR_SOURCE_DIR) / "scenarios" / part, assets / part, fs::copy_options::recursive);
  fs::create_directory_symlink(fs::path(TROCAR_SOURCE_DIR) / "assets" / "shaders", assets / "assets" / "shaders");
  for (const auto& entry : fs::directory_iterator(fs::path(TROCAR_SOURCE_DIR) / "assets"))
    if (!fs::exists(assets / "assets" / entry.path().filename()))
      fs::create_symlink(entry.path(), assets / "assets" / entry.path().filename());
  fs::copy_file(assets / "hands" / "expert.toml", assets / "hands" / "mouse.toml");
  Launch other = launch({"run", "E01", "--level", "L1", "--hand", "mouse", "--board", "3", "--db", "t.db"});
  other.environment["TROCAR_ASSETS"] = assets.string();
  const Outcome refused = run_program(other);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("a person's input"), std::string::npos) << refused.err;
  other.arguments[5] = "expert";
  ASSERT_EQ(run_program(other).exit_code, 0);
  ASSERT_EQ(trocar({"export", "csv", "--db", "t.db", "--out", "out"}).exit_code, 0);
  EXPECT_NE(file_bytes(folder_ / "out" / "attempts.csv").find("assets of " + assets.string()), std::string::npos)
      << file_bytes(folder_ / "out" / "attempts.csv");
}

}  // namespace
}  // namespace trocar::test::record_attack_test
