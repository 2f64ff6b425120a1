// Bars of the desk: with 10^5 attempts of 500 trainees the cohort's query takes under 150 ms of CPU, an attempt's under 100 ms, and the
// database is under 500 MB without recordings. Makes such a database once and keeps it: some minutes.
//
//   bench_desk [FILE.db]        default: trocar_desk_bench.db in the folder of temporary files
#include <benchmark/benchmark.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "tests/trainees/cohort_samples.h"
#include "trainees/review/desk_queries.h"
#include "trainees/trainee_store.h"

namespace {

using namespace trocar;

constexpr const char* kNow = "2026-07-01T12:00:00Z";
constexpr int kAttempts = 100000, kTrainees = 500;

std::filesystem::path g_file = std::filesystem::temp_directory_path() / "trocar_desk_bench.db";

Database& full_database() {
  static Database database = [] {
    const bool known = std::filesystem::exists(g_file);
    Database opened(g_file);
    test::CohortPlan plan;
    plan.trainees = kTrainees;
    plan.attempts = kAttempts;
    plan.curves_each = 4;
    if (!known) test::fill_cohort(opened, plan);
    return opened;
  }();
  return database;
}

void cohort_all(benchmark::State& state) {
  Database& database = full_database();
  std::size_t lines = 0;
  for (auto step : state) lines = cohort_lines(database, {}, {}, kNow).size();
  state.counters["lines"] = static_cast<double>(lines);
}
BENCHMARK(cohort_all)->Unit(benchmark::kMillisecond);

void cohort_of_an_exercise(benchmark::State& state) {
  Database& database = full_database();
  CohortFilter filter;
  filter.exercise = "surface-touch";
  filter.level = "L2";
  std::size_t lines = 0;
  for (auto step : state) lines = cohort_lines(database, {}, filter, kNow).size();
  state.counters["lines"] = static_cast<double>(lines);
}
BENCHMARK(cohort_of_an_exercise)->Unit(benchmark::kMillisecond);

void cohort_unsafe(benchmark::State& state) {
  Database& database = full_database();
  CohortFilter filter;
  filter.flag = Flag::kUnsafe;
  for (auto step : state) benchmark::DoNotOptimize(cohort_lines(database, {}, filter, kNow));
}
BENCHMARK(cohort_unsafe)->Unit(benchmark::kMillisecond);

void trainee(benchmark::State& state) {
  Database& database = full_database();
  for (auto step : state) benchmark::DoNotOptimize(trainee_picture(database, "P042", {}, kNow));
}
BENCHMARK(trainee)->Unit(benchmark::kMillisecond);

void attempt(benchmark::State& state) {
  Database& database = full_database();
  const std::string uuid = AttemptStore(database).latest()->uuid;
  for (auto step : state) benchmark::DoNotOptimize(attempt_picture_data(database, uuid));
}
BENCHMARK(attempt)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc > 1) g_file = argv[1];
  full_database();
  benchmark::RunSpecifiedBenchmarks();
  std::printf("%s: %.0f MB, %d attempts, %d trainees\n", g_file.c_str(), static_cast<double>(std::filesystem::file_size(g_file)) / 1e6, kAttempts,
              kTrainees);
}
