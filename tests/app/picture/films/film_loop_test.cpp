// The expert behind the start page: nothing at first, then an attempt that plays again and again; made once.
#include "app/picture/films/film_loop.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "app/picture/films/film.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::film_loop_test {
namespace {

class FilmLoops : public ::testing::Test {
 protected:
  void SetUp() override { ::setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1); }
  std::vector<std::filesystem::path> cached() const {
    std::vector<std::filesystem::path> out;
    if (!std::filesystem::exists(folder_ / "trocar")) return out;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "trocar")) out.push_back(entry.path());
    return out;
  }
  /// A window's frames until it can be seen; a minute is too long.
  static bool show(FilmLoop& film) {
    for (int i = 0; i < 6000 && !film.ready() && film.refusal().empty(); ++i) {
      film.advance(0.05);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return film.ready();
  }
  test::TemporaryFolder folder_;
};

TEST_F(FilmLoops, NothingBeginsInTheFirstSeconds) {
  FilmLoop film(short_setup(), find_assets());
  for (int i = 0; i < 19; ++i) film.advance(0.1);
  EXPECT_FALSE(film.ready());
  EXPECT_EQ(film.refusal(), "");
  EXPECT_TRUE(cached().empty());
}

TEST_F(FilmLoops, TheAttemptIsMadeOnceAndPlaysAgainAndAgain) {
  AttemptSetup what = short_setup("novice");
  {
    FilmLoop film(what, find_assets());
    ASSERT_TRUE(show(film)) << film.refusal();
    EXPECT_EQ(film.scene().setup.hand, "expert") << "whoever asked";
    EXPECT_EQ(film.scene().setup.board, what.board);
    const SceneView first = film.view();
    ASSERT_TRUE(first.organ);
    EXPECT_EQ(first.targets.size(), 2u);
    double last = 0;
    bool again = false, moved = false;
    for (int i = 0; i < 4000 && !again; ++i) {
      film.advance(0.05);
      again = film.clock_s() < last;
      last = film.clock_s();
      moved = moved || (film.view().X_TI.p - first.X_TI.p).norm() > 0.01;
      EXPECT_EQ(film.view().organ, first.organ) << "uploaded once";
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(again);
    EXPECT_TRUE(moved);
  }
  ASSERT_EQ(cached().size(), 1u) << "and no part is left over";
  const auto made = std::filesystem::last_write_time(cached()[0]);
  FilmLoop second(what, find_assets());
  ASSERT_TRUE(show(second));
  EXPECT_EQ(std::filesystem::last_write_time(cached()[0]), made);
}

TEST_F(FilmLoops, AnExerciseThatChangedGetsANewRecording) {
  const AttemptSetup what = expert_setup(short_setup());
  AttemptSetup changed = what;
  changed.exercise.text += "\n# another\n";
  const auto a = expert_recording(what, find_assets()), b = expert_recording(changed, find_assets());
  EXPECT_NE(a, b);
  EXPECT_EQ(a, expert_recording(what, find_assets()));
  EXPECT_TRUE(std::filesystem::is_regular_file(a));
}

TEST_F(FilmLoops, GivingUpLeavesNothingHalfMade) {
  {
    FilmLoop film(short_setup(), find_assets());
    for (int i = 0; i < 30; ++i) film.advance(0.1);
  }
  EXPECT_TRUE(cached().empty());
  EXPECT_EQ(expert_recording(expert_setup(short_setup()), find_assets(), [] { return true; }), "");
  EXPECT_TRUE(cached().empty());
}

TEST_F(FilmLoops, AFolderThatCannotBeWrittenIsSaidAndNotTriedForEver) {
  folder_.write("trocar", "a file where the folder should be");
  FilmLoop film(short_setup(), find_assets());
  EXPECT_FALSE(show(film));
  EXPECT_CONTAINS(film.refusal(), "trocar");
}

TEST_F(FilmLoops, AnUnknownOrganIsARefusal) {
  AttemptSetup what = short_setup();
  what.organ = "no-such-organ";
  FilmLoop film(what, find_assets());
  EXPECT_FALSE(show(film));
  EXPECT_CONTAINS(film.refusal(), "no-such-organ");
}

}  // namespace
}  // namespace trocar::film_loop_test
