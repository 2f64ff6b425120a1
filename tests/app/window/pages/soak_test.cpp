// A long evening at the trainer, without a display: attempt after attempt through the screens by a scripted hand.
// Memory stays flat, no thread and no file stays open.
//
// A few attempts (SOAK_ATTEMPTS) in every run; under the ctest label long attempts for TROCAR_SOAK_MINUTES (30 when not
// set).
#include <dirent.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <thread>

#include "app/window/practice/screen_table.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/app/window/pages/loop_bench.h"
#include "tests/support/repeats.h"

namespace trocar::testing_support::soak_test {
namespace {

const int kAttempts = test::repeats("SOAK_ATTEMPTS", 4);

using Clock = std::chrono::steady_clock;

constexpr int kWarmUp = 3;  // attempts, until caches, arenas and shaders are there
// Growth of all attempts after them together: of what is allocated and not freed, and of the whole process, whose
// allocator and rasteriser keep pages in steps that have nothing to do with the number of attempts (13 MiB once in 27
// attempts, flat before and after).
constexpr double kMostHeld_mib = 4, kMostResident_mib = 24;
constexpr double kPatience_s = 120;

struct Footprint {
  double resident_mib = 0, held_mib = 0;  // of the process; of it what has been allocated and not been freed
  int threads = 0, files = 0;
};

int entries(const char* folder) {
  int count = 0;
  if (DIR* list = ::opendir(folder)) {
    while (const dirent* entry = ::readdir(list)) count += entry->d_name[0] != '.' ? 1 : 0;
    ::closedir(list);
  }
  return count;
}

Footprint footprint() {
  long total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  const struct mallinfo2 heap = ::mallinfo2();
  constexpr double kMib = 1024.0 * 1024.0;
  return {static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / kMib,
          static_cast<double>(heap.uordblks + heap.hblkhd) / kMib, entries("/proc/self/task"),
          entries("/proc/self/fd") - 1};  // less the one that lists them
}

class SoakBench : public LoopBench {
 protected:
  void SetUp() override {
    ::mallopt(M_ARENA_MAX, 2);  // as the program does
    LoopBench::SetUp();
    if (IsSkipped()) return;
    width_ = 480;  // a smaller window has no pages
    height_ = 270;
    std::string text = find_exercise("surface-touch", source_assets().exercises).text;
    text.replace(text.find("count = 12"), 10, "count = 2");
    text.replace(text.find("time_limit_s = 120"), 18, kAttempts > 0 ? "time_limit_s = 3" : "time_limit_s = 30");
    ModelOptions options = bench_.options();
    options.exercise = bench_.folder.write("short.toml", text).string();
    options.hand = "expert";
    open(options);
  }

  bool until(ScreenName name) {
    for (const auto begin = Clock::now(); Clock::now() - begin < std::chrono::duration<double>(kPatience_s);) {
      if (loop_->here() == name) return true;
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(15));
    }
    return loop_->here() == name;
  }
  void look_for(double seconds) {
    for (const auto begin = Clock::now(); Clock::now() - begin < std::chrono::duration<double>(seconds);) {
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(15));
    }
  }

  /// From the briefing to the debrief and on: once again with R, a look at the replay, at the progress, and the way
  /// round by the start page.
  void attempt(int number) {
    if (number % 2 == 0) {
      loop_->go(ScreenName::kBriefing);
      frame();
      tap(kKeyEnter);
    } else {
      tap('R');
    }
    ASSERT_TRUE(until(ScreenName::kRun)) << "attempt " << number << " stands at " << screen_name(loop_->here()) << ": "
                                         << model_->notice;
    ASSERT_TRUE(until(ScreenName::kDebrief))
        << "attempt " << number << " stands at " << screen_name(loop_->here()) << ": " << model_->notice;
    look_for(0.3);
    if (number % 3 == 2) {
      tap('W');
      ASSERT_TRUE(until(ScreenName::kReplay));
      look_for(1);
    }
    for (const ScreenName page : {ScreenName::kProgress, ScreenName::kStart, ScreenName::kDebrief}) {
      loop_->go(page);
      frame();
      frame();
    }
  }

  /// The numbers at rest: what a screen made in the background is done, and what the allocator keeps for later is given
  /// back (it swings by 30 MiB with the threads that come and go, and says nothing of what the program holds).
  Footprint at_rest() {
    loop_->settle(30);
    look_for(0.2);
    ::malloc_trim(0);
    return footprint();
  }
};

bool enough(int done, Clock::time_point begin) {
  if (kAttempts > 0) return done >= kAttempts;
  const char* given = std::getenv("TROCAR_SOAK_MINUTES");
  const double minutes = given ? std::atof(given) : 30;
  return done > kWarmUp && Clock::now() - begin >= std::chrono::duration<double>(60 * minutes);
}

TEST_F(SoakBench, AttemptsLeaveNothingBehind) {
  const auto begin = Clock::now();
  Footprint warm, last;
  int done = 0;
  for (; !enough(done, begin); ++done) {
    attempt(done);
    if (HasFatalFailure()) return;
    last = at_rest();
    if (done < kWarmUp) {
      warm.resident_mib = std::max(warm.resident_mib, last.resident_mib);
      warm.held_mib = std::max(warm.held_mib, last.held_mib);
      warm.threads = std::max(warm.threads, last.threads);
      warm.files = std::max(warm.files, last.files);
    }
    std::cout << "attempt " << done + 1 << ": " << last.resident_mib << " MiB, held " << last.held_mib << " MiB, "
              << last.threads << " threads, " << last.files << " files" << std::endl;
  }
  EXPECT_EQ(model_->past().size(), static_cast<std::size_t>(done)) << "every attempt is kept";
  EXPECT_LT(last.held_mib - warm.held_mib, kMostHeld_mib);
  EXPECT_LT(last.resident_mib - warm.resident_mib, kMostResident_mib);
  EXPECT_LE(last.threads, warm.threads);
  EXPECT_LE(last.files, warm.files);
}

}  // namespace
}  // namespace trocar::testing_support::soak_test
