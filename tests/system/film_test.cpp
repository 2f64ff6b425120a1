// Films from outside: what is left when they are interrupted, and what becomes of recordings that are not whole.
#include <chrono>
#include <cstdlib>
#include <functional>
#include <thread>

#include "tests/system/system_fixture.h"

namespace trocar::test::film_test {
namespace {

namespace fs = std::filesystem;

bool ffmpeg_is_there() { return std::system("command -v ffmpeg > /dev/null 2>&1") == 0; }

class FilmsFromOutside : public SystemTest {
 protected:
  void SetUp() override {
    if (!ffmpeg_is_there()) GTEST_SKIP() << "NO FILM IS TESTED HERE: ffmpeg is not installed";
    ASSERT_EQ(trocar(short_run({"--db", ":memory:", "--record", "a.trec"})).exit_code, 1);
  }
  /// So slow a motion that nobody waits for its end.
  static Translator endless(const std::string& flag, const std::string& target) {
    return {"replay", "a.trec",   flag,  target,  "--width", "320",     "--height",
            "240",    "--preset", "low", "--fps", "60",      "--speed", "0.05"};
  }
  static bool wait_for(const std::function<bool()>& what) {
    for (int i = 0; i < 3000 && !what(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return what();
  }
};

TEST_F(FilmsFromOutside, CtrlCLeavesNoHalfFilm) {
  RunningProgram program(launch(endless("--video", "a.mp4")));
  ASSERT_TRUE(wait_for([&] { return fs::exists(folder_ / "a.mp4.part"); }));
  program.interrupt();
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("interrupted; nothing was written"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "a.mp4"));
  EXPECT_FALSE(fs::exists(folder_ / "a.mp4.part"));
}

TEST_F(FilmsFromOutside, CtrlCKeepsNumberedPicturesAndSaysHowMany) {
  RunningProgram program(launch(endless("--frames", "frames")));
  ASSERT_TRUE(wait_for([&] { return fs::exists(folder_ / "frames" / "frame_00002.png"); }));
  program.interrupt();
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("frames holds the first "), std::string::npos) << outcome.err;
}

TEST_F(FilmsFromOutside, ARecordingThatWasCutOffIsFilmedToWhereItEnds) {
  const std::string whole = file_bytes(folder_ / "a.trec");
  folder_.write("half.trec", whole.substr(0, whole.size() - 2000));
  const Outcome film = trocar({"replay", "half.trec", "--video", "half.mkv", "--width", "320", "--height", "240",
                               "--fps", "1", "--preset", "low"});
  EXPECT_EQ(film.exit_code, 0) << film.err;
  EXPECT_NE(film.err.find("cut off"), std::string::npos) << film.err;
  EXPECT_TRUE(fs::exists(folder_ / "half.mkv"));
  folder_.write("stub.trec", whole.substr(0, 300));
  expect_refusal({"replay", "stub.trec", "--video", "stub.mkv"}, 2, "stub.trec: its header");
  EXPECT_FALSE(fs::exists(folder_ / "stub.mkv"));
}

TEST_F(FilmsFromOutside, TheProgramSaysThatItTakesTheQuickerPreset) {
  const Outcome automatic =
      trocar({"replay", "a.trec", "--video", "a.mkv", "--width", "320", "--height", "240", "--fps", "0.5"});
  EXPECT_EQ(automatic.exit_code, 0) << automatic.err;
  const bool software = trocar({"doctor", "--db", "d.db"}).out.find("drawn by the processor") != std::string::npos;
  EXPECT_EQ(automatic.err.find("preset soft") != std::string::npos, software) << automatic.err;
  const Outcome asked = trocar(
      {"replay", "a.trec", "--video", "b.mkv", "--width", "320", "--height", "240", "--fps", "0.5", "--preset", "low"});
  EXPECT_EQ(asked.exit_code, 0) << asked.err;
  EXPECT_EQ(asked.err.find("preset"), std::string::npos) << asked.err;
}

}  // namespace
}  // namespace trocar::test::film_test
