// Bars of the desk: with 10^5 attempts of 500 trainees the cohort's page and a programme's grid take under 200 ms of
// the server's time, an attempt's under 300 ms (a minute's trace included), and an attempt takes some 5 kB of the
// database. "page_": from the request to the last byte of HTML, as the desk does it; the header Server-Timing of
// every answer tells the same. "_new" ones come after a commit of another connection, so that nothing which was kept
// may be used. Makes such a database once and keeps it: some minutes.
//
//   bench_desk [FILE.db]        default: trocar_desk_bench.db in the folder of temporary files
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "tests/trainees/records/cohort_samples.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/queries/programme_query.h"
#include "trainees/desk/routes/route.h"
#include "trainees/desk/server/desk_memory.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

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
  for (auto step : state) benchmark::DoNotOptimize(trainee_detail(database, "P042", {}, kNow));
}
BENCHMARK(trainee)->Unit(benchmark::kMillisecond);

void attempt(benchmark::State& state) {
  Database& database = full_database();
  const std::string uuid = AttemptStore(database).latest()->uuid;
  for (auto step : state) benchmark::DoNotOptimize(attempt_detail(database, uuid));
}
BENCHMARK(attempt)->Unit(benchmark::kMillisecond);

/// Gripping and touching at 1 kHz for a minute.
Trace minute(const std::filesystem::path&) {
  Trace trace;
  for (int k = 0; k < 60000; ++k) {
    TraceSample sample;
    sample.t_s = 0.001 * k;
    sample.tip_T = Vec3(0.05 * std::sin(0.003 * k), 0.04 * std::cos(0.0021 * k), -0.1 + 0.01 * std::sin(0.011 * k));
    sample.contact = k % 3000 < 900;
    sample.force_T = Vec3(0, 0, sample.contact ? 2.5 * std::sin(0.0035 * (k % 3000)) : 0.0);
    sample.commanded_n = sample.rendered_n = sample.force_T.norm();
    trace.samples.push_back(sample);
  }
  return trace;
}

/// What a browser would get, without sockets.
std::size_t page(benchmark::State& state, const std::string& route, const review::Request& request, bool changed) {
  static const std::vector<review::Route> routes = review::desk_routes();
  const auto at = std::find_if(routes.begin(), routes.end(),
                               [&](const review::Route& r) { return r.path == route && r.method == "GET"; });
  review::Desk desk{full_database(), {.trace = minute}, false, std::make_shared<review::DeskMemory>()};
  Database writer(g_file);
  std::size_t bytes = 0;
  for (auto step : state) {
    if (changed) {
      state.PauseTiming();
      sql::execute(writer.connection(),
                   "INSERT INTO sync_cursor VALUES ('bench', 0, '')"
                   " ON CONFLICT (remote) DO UPDATE SET position = position + 1");
      state.ResumeTiming();
    }
    const review::Response answer = at->answer(request, desk);
    if (answer.status != 200) state.SkipWithError(answer.body.c_str());
    bytes = answer.body.size();
  }
  state.counters["kB"] = static_cast<double>(bytes) / 1000;
  return bytes;
}

review::Request as_instructor(std::map<std::string, std::string> arguments = {},
                              std::map<std::string, std::string> query = {}) {
  review::Request request;
  request.arguments = std::move(arguments);
  request.query = std::move(query);
  request.account = Account{};
  request.account->role = Role::kInstructor;
  request.now_utc = kNow;
  return request;
}

/// As the desk gives them, citing every attempt at the skill: to each trainee for each skill with a passed one.
std::size_t give_certificates() {
  static const std::size_t held = [] {
    AssessmentStore store(full_database());
    if (const std::size_t there = store.certificates_of("").size(); there > 0) return there;
    sql::Statement skills(full_database().connection(),
                          "SELECT t.code, a.exercise_id, a.level, max(CASE WHEN s.passed THEN a.uuid END),"
                          " json_group_array(a.uuid) FROM known_trainee t JOIN attempt a ON a.trainee_id = t.id"
                          " JOIN score s ON s.attempt_id = a.id AND s.revision = 0 WHERE a.status = 'completed'"
                          " GROUP BY t.id, a.exercise_id, a.level HAVING max(s.passed) = 1");
    std::vector<std::array<std::string, 4>> given;
    while (skills.step())
      given.push_back(
          {skills.text(0), skills.text(1), skills.text(2),
           R"({"attempt":")" + skills.text(3) + R"(","attempts":)" + skills.text(4) + R"(,"overrides":[]})"});
    const Account signs =
        AccountStore(full_database()).add("bench", "Bench", Role::kInstructor, "", "a bench's password", "");
    for (const auto& [code, exercise, level, evidence] : given)
      store.certify(code, exercise, level, "1", evidence, {signs.uuid, signs.name});
    return given.size();
  }();
  return held;
}

void page_cohort(benchmark::State& state) { page(state, "/", as_instructor(), false); }
BENCHMARK(page_cohort)->Unit(benchmark::kMillisecond);

/// Nine steps over every attempt that there is, for everybody; half of them ask for a row on different boards.
void give_programme() {
  static const bool given = [] {
    const Author author{"", "bench"};
    std::string text;
    for (const char* exercise : {"reach-and-orient", "surface-touch", "limited-grasp"})
      for (const char* level : {"L1", "L2", "L3"})
        text += std::string("[[step]]\nexercise = \"") + exercise + "\"\nlevel = \"" + level +
                "\"\npasses = 3\ndue_days = 30\n" + (level[1] == '2' ? "in_a_row = true\n" : "");
    ProgrammeStore store(full_database());
    store.save("All", text, author);
    if (store.assignments().empty())
      for (const char* group : {"2026 A", "2026 B"}) store.assign("All", "", group, "2026-06-30", author);
    return true;
  }();
  benchmark::DoNotOptimize(given);
}

void grid(benchmark::State& state) {
  give_programme();
  for (auto step : state) benchmark::DoNotOptimize(programme_grid(full_database(), "All", {}, kNow));
}
BENCHMARK(grid)->Unit(benchmark::kMillisecond);

void page_grid(benchmark::State& state) {
  give_programme();
  page(state, "/grid", as_instructor({}, {{"programme", "All"}}), false);
}
BENCHMARK(page_grid)->Unit(benchmark::kMillisecond);

void page_reminders(benchmark::State& state) {
  give_programme();
  page(state, "/reminders", as_instructor(), false);
}
BENCHMARK(page_reminders)->Unit(benchmark::kMillisecond);

void page_roster(benchmark::State& state) { page(state, "/roster", as_instructor(), false); }
BENCHMARK(page_roster)->Unit(benchmark::kMillisecond);

void page_trainee(benchmark::State& state) {
  give_programme();
  page(state, "/trainee/{code}", as_instructor({{"code", "P042"}}), false);
}
BENCHMARK(page_trainee)->Unit(benchmark::kMillisecond);

void page_cohort_new(benchmark::State& state) { page(state, "/", as_instructor(), true); }
BENCHMARK(page_cohort_new)->Unit(benchmark::kMillisecond);

void page_cohort_of_a_group_new(benchmark::State& state) {
  page(state, "/", as_instructor({}, {{"group", "2026 A"}, {"exercise", "surface-touch"}}), true);
}
BENCHMARK(page_cohort_of_a_group_new)->Unit(benchmark::kMillisecond);

void page_why_new(benchmark::State& state) { page(state, "/why", as_instructor(), true); }
BENCHMARK(page_why_new)->Unit(benchmark::kMillisecond);

void page_why_of_an_exercise_new(benchmark::State& state) {
  page(state, "/why", as_instructor({}, {{"exercise", "surface-touch"}, {"level", "L2"}}), true);
}
BENCHMARK(page_why_of_an_exercise_new)->Unit(benchmark::kMillisecond);

void page_trainee_new(benchmark::State& state) {
  page(state, "/trainee/{code}", as_instructor({{"code", "P042"}}), true);
}
BENCHMARK(page_trainee_new)->Unit(benchmark::kMillisecond);

void page_attempt(benchmark::State& state) {
  page(state, "/attempt/{attempt}", as_instructor({{"attempt", AttemptStore(full_database()).latest()->uuid}}), false);
}
BENCHMARK(page_attempt)->Unit(benchmark::kMillisecond);

void page_attempt_new(benchmark::State& state) {
  page(state, "/attempt/{attempt}", as_instructor({{"attempt", AttemptStore(full_database()).latest()->uuid}}), true);
}
BENCHMARK(page_attempt_new)->Unit(benchmark::kMillisecond);

// Last: from here on the database holds certificates.
void page_cohort_certified_new(benchmark::State& state) {
  state.counters["certificates"] = static_cast<double>(give_certificates());
  page(state, "/", as_instructor(), true);
}
BENCHMARK(page_cohort_certified_new)->Unit(benchmark::kMillisecond);

void page_grid_certified_new(benchmark::State& state) {
  give_programme();
  state.counters["certificates"] = static_cast<double>(give_certificates());
  page(state, "/grid", as_instructor({}, {{"programme", "All"}}), true);
}
BENCHMARK(page_grid_certified_new)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc > 1) g_file = argv[1];
  full_database();
  benchmark::RunSpecifiedBenchmarks();
  std::printf("%s: %.0f MB, %d attempts, %d trainees\n", g_file.c_str(),
              static_cast<double>(std::filesystem::file_size(g_file)) / 1e6, kAttempts, kTrainees);
}
