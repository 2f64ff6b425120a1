// Budget: an attempt's commit, p99 within 1 ms (WAL). Prints median, p99 and the longest of begin and finish: CPU of
// the thread, and wall time, which on a busy machine is mostly waiting. As the store runs (synchronous = NORMAL) a
// commit waits for no disk but when the log is copied back, once in some hundred; the last lines say what waiting at
// every commit (FULL) would cost here.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <vector>

#include "tests/trainees/records/store_samples.h"
#include "trainees/store/sqlite_handle.h"

namespace {

struct Times {
  std::vector<double> wall_us, cpu_us;

  void add(const std::function<void()>& action) {
    const double cpu = clock_us(CLOCK_THREAD_CPUTIME_ID), wall = clock_us(CLOCK_MONOTONIC);
    action();
    wall_us.push_back(clock_us(CLOCK_MONOTONIC) - wall);
    cpu_us.push_back(clock_us(CLOCK_THREAD_CPUTIME_ID) - cpu);
  }

  static double clock_us(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
  }
};

void report(const char* name, std::vector<double> times) {
  std::sort(times.begin(), times.end());
  std::printf("%-24s median %.0f us, p99 %.0f us, max %.0f us over %zu\n", name, times[times.size() / 2],
              times[times.size() * 99 / 100], times.back(), times.size());
}

}  // namespace

int main() {
  constexpr int kAttempts = 5000, kWaiting = 300, kEvents = 40, kMetrics = 60;
  const auto folder = std::filesystem::temp_directory_path() / "trocar_commit_bench";
  std::filesystem::remove_all(folder);
  trocar::AttemptResult result = trocar::sample_result();
  for (int i = 0; i < kEvents; ++i) result.events.push_back(result.events.front());
  for (int i = 0; i < kMetrics; ++i) result.grade.metrics.push_back({"m" + std::to_string(i), 0.1 * i, "N"});
  Times begins, finishes, waiting;
  {
    trocar::Database database(folder / "t.db");
    trocar::AttemptStore store(database);
    for (int i = 0; i < kAttempts; ++i) {
      trocar::AttemptId id;
      begins.add([&] { id = store.begin_attempt(trocar::sample_start()); });
      finishes.add([&] { store.finish_attempt(id, result); });
    }
    trocar::sql::execute(database.connection(), "PRAGMA synchronous = FULL");
    for (int i = 0; i < kWaiting; ++i) {
      const trocar::AttemptId id = store.begin_attempt(trocar::sample_start());
      waiting.add([&] { store.finish_attempt(id, result); });
    }
  }
  report("begin_attempt, CPU", begins.cpu_us);
  report("begin_attempt, wall", begins.wall_us);
  report("finish_attempt, CPU", finishes.cpu_us);
  report("finish_attempt, wall", finishes.wall_us);
  report("with FULL, CPU", waiting.cpu_us);
  report("with FULL, wall", waiting.wall_us);
  std::filesystem::remove_all(folder);
}
