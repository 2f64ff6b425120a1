#include "app/desk/demo_cohort.h"

#include <stdlib.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

#include "app/desk/demo_people.h"
#include "app/session/keeping/attempt_keeping.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/make_hand.h"
#include "scenarios/layout/board_numbers.h"
#include "trainees/files/owner_file.h"
#include "trainees/integrity/anchor_file.h"
#include "trainees/integrity/station_key.h"
#include "trainees/progress/calendar.h"
#include "trainees/records/curricula.h"
#include "trainees/records/demo_record.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStories = "demo-cohort";
constexpr const char* kOrgan = "phantom-liver";
constexpr int kSpan_days = 63;

/// One attempt to be made, and what came of it.
struct Planned {
  DemoStint stint;
  std::string trainee;
  int number = 1;  ///< of the hand, from 1
  std::int64_t seed = 1;
  std::string started_utc;
  fs::path recording;
  std::optional<Scene> scene;  // only what attempt_start() needs is kept
  AttemptStart start;
  SessionOutcome outcome;
  std::optional<Recording> record;
};

std::string utc_of(std::chrono::system_clock::time_point time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S.000Z", &parts);
  return text;
}

/// Three attempts a sitting, six minutes apart; sittings spread evenly over the trainee's days.
std::string date_of(const DemoPerson& person, int index, int all) {
  using namespace std::chrono;
  constexpr int kSitting = 3;
  const int sittings = (all + kSitting - 1) / kSitting, sitting = index / kSitting;
  const int last_day = person.last_day, first_day = person.first_day;
  const int day = first_day + (sittings > 1 ? sitting * (last_day - first_day) / (sittings - 1) : 0);
  const auto midnight = floor<days>(system_clock::now()) - days(kSpan_days + 1 - day);
  return utc_of(midnight + hours(person.hour) + minutes(6 * (index % kSitting) + person.hour));
}

std::vector<Planned> plan(const DemoCohortOptions& options, const fs::path& folder) {
  std::vector<Planned> out;
  std::int64_t seed = 1000;
  for (const DemoPerson& person : demo_people()) {
    std::vector<Planned> own;
    for (const DemoStint& stint : person.stints)
      for (int i = 0; i < stint.attempts; ++i) {
        Planned one;
        one.stint = stint;
        one.trainee = person.code;
        one.number = stint.from_attempt + i;
        one.seed = ++seed;
        one.recording = folder / (std::to_string(seed) + ".trec");
        own.push_back(std::move(one));
      }
    if (options.least_attempts > 0 && static_cast<int>(own.size()) > options.least_attempts)
      own.erase(own.begin() + options.least_attempts, own.end());
    for (std::size_t i = 0; i < own.size(); ++i)
      own[i].started_utc = date_of(person, static_cast<int>(i), static_cast<int>(own.size()));
    std::move(own.begin(), own.end(), std::back_inserter(out));
  }
  return out;
}

/// Runs it in lockstep; the recording lies in its file afterwards.
void perform(Planned& one, const AssetRoots& assets) {
  AttemptSetup setup;
  setup.exercise = find_exercise(one.stint.exercise, assets.exercises);
  setup.level = one.stint.level;
  setup.organ = kOrgan;
  setup.hand = "mouse";
  setup.seed = one.seed;
  setup.board = drawn_board(one.seed, false);
  const Scene scene = build_scene(setup, assets, {"simulated", setup.rate_hz, 16});
  SessionHooks hooks;
  hooks.hand = [&] {
    return make_hand((assets.assets / "demo" / (std::string(one.stint.hand) + ".toml")).string(),
                     static_cast<std::uint64_t>(one.seed), assets.hands, one.number);
  };
  auto [outcome, recording] = record_session(scene, assets, hooks, one.recording);
  one.start = attempt_start(scene, one.trainee);
  one.start.hand = "invented";
  one.start.started_utc = one.started_utc;
  one.outcome = std::move(outcome);
  one.record = std::move(recording);
}

/// @return false: stopped.
bool perform_all(std::vector<Planned>& planned, const DemoCohortOptions& options, const AssetRoots& assets) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stopped{false};
  int done = 0;
  std::exception_ptr failure;
  std::mutex mutex;  // guards done, failure and options.going
  const auto work = [&] {
    for (std::size_t i = next++; i < planned.size() && !stopped; i = next++) {
      try {
        perform(planned[i], assets);
        const std::lock_guard lock(mutex);
        ++done;
        if (options.going && !options.going(done, static_cast<int>(planned.size()))) stopped = true;
      } catch (...) {  // Ctrl-C among them
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        stopped = true;
        return;
      }
    }
  };
  const unsigned wanted =
      options.jobs > 0 ? static_cast<unsigned>(options.jobs) : std::max(1u, std::thread::hardware_concurrency());
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < wanted; ++i) threads.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return !stopped;
}

/// By the same invented clock as the beginning: as long afterwards as the loop ran.
std::string ended(const std::string& started_utc, const RunReport& device) {
  const double ran_s = device.rate_hz > 0 ? static_cast<double>(device.ticks) / device.rate_hz : 0;
  const auto started =
      std::chrono::system_clock::from_time_t(static_cast<std::time_t>(seconds_of_utc(started_utc).value_or(0)));
  return utc_of(started + std::chrono::seconds(static_cast<std::int64_t>(std::ceil(ran_s))));
}

/// In order of their dates, as they would have come.
void store_all(std::vector<Planned>& planned, Database& database) {
  std::stable_sort(planned.begin(), planned.end(),
                   [](const Planned& a, const Planned& b) { return a.started_utc < b.started_utc; });
  AttemptStore store(database);
  for (Planned& one : planned) {
    const AttemptId id = store.begin_attempt(one.start);
    make_owner_folders(id.recording.parent_path());
    fs::rename(one.recording, id.recording);
    const AttemptResult result = kept_result(one.start, id, one.outcome, *one.record);
    store.finish_attempt(id, result, ended(id.started_utc, result.device));
    one.record.reset();
  }
}

/// What lies beside a database under its name: each may be there or not.
std::vector<fs::path> parts_of(const fs::path& database) {
  std::vector<fs::path> out{database, database.string() + "-wal", database.string() + "-shm", anchor_path(database),
                            key_path(database)};
  for (const char* beside : {".recordings", ".films", ".live"}) {
    fs::path folder = database;
    out.push_back(folder.replace_extension(beside));
  }
  std::erase_if(out, [](const fs::path& part) { return !fs::exists(fs::symlink_status(part)); });
  const std::string old = database.filename().string() + ".schema";  // what a migration kept
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(fs::absolute(database).parent_path(), none))
    if (entry.path().filename().string().starts_with(old)) out.push_back(entry.path());
  return out;
}

/// Moves all parts of a database into another folder, which is on the same disk.
void move_parts(const fs::path& database, const fs::path& folder) {
  for (const fs::path& part : parts_of(database)) {
    std::error_code error;
    fs::rename(part, folder / part.filename(), error);
    if (error)
      throw EnvironmentError(part.string() + ": cannot be moved to " + folder.string() + ": " + error.message());
  }
}

/// What the curriculum of the demo tells of each.
std::string stories(const std::vector<Planned>& planned) {
  std::string text = "# Invented trainees: hands that learn, on the simulated plant. Dates are invented.\n";
  for (const DemoPerson& person : demo_people()) text += "[" + person.code + "]\nstory = \"" + person.story + "\"\n";
  return text + "\n[all]\nattempts = " + std::to_string(planned.size()) + "\n";
}

void tell_demo(Database& database, const std::vector<Planned>& planned) {
  const Author author{"", "Demo"};
  CurriculumStore curricula(database);
  curricula.add(kStories, stories(planned), author);
  for (const DemoPerson& person : demo_people()) curricula.join(person.code, person.group, author);
  add_demo_assessments(database, author);
  add_demo_programme(database, author);
}

}  // namespace

fs::path demo_database_beside(const fs::path& database) {
  return (database.empty() ? default_database_path() : database).parent_path() / "demo.db";
}

namespace {

/// For what is not whole yet; nothing that is there is touched.
fs::path empty_folder_beside(const fs::path& database) {
  std::error_code error;
  const fs::path whole = fs::absolute(database);
  fs::create_directories(whole.parent_path(), error);
  std::string name = whole.string() + ".part-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr)
    throw EnvironmentError(name + ": cannot be made: " + std::generic_category().message(errno));
  return name;
}

/// Another database whose name differs by its ending alone keeps its recordings in the same folder.
void require_own_folders(const fs::path& database) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(fs::absolute(database).parent_path(), error)) {
    const fs::path& other = entry.path();
    if (other.stem() != database.stem() || other.filename() == database.filename() || !entry.is_regular_file(error))
      continue;
    std::string title(15, '\0');
    std::ifstream(other, std::ios::binary).read(title.data(), static_cast<std::streamsize>(title.size()));
    if (title == "SQLite format 3")
      throw InputError(database.string() + ": shares its folder of recordings with " + other.string() +
                       "; it was left as it is. Rename one of them first, with its recordings");
  }
}

}  // namespace

int make_demo_cohort(const DemoCohortOptions& options, const AssetRoots& assets) {
  if (const auto there = parts_of(options.database); !there.empty())
    throw InputError(there.front().string() + ": exists already");
  const fs::path folder = empty_folder_beside(options.database);
  struct Cleared {
    const fs::path& folder;
    ~Cleared() {
      std::error_code ignored;
      fs::remove_all(folder, ignored);
    }
  } const cleared{folder};
  std::vector<Planned> planned = plan(options, folder);
  if (!perform_all(planned, options, assets)) return 0;
  const fs::path made = folder / options.database.filename();
  {
    Database database(made);
    mark_demo(database);
    store_all(planned, database);
    tell_demo(database, planned);
    mark_demo_whole(database);
  }
  if (const auto there = parts_of(options.database); !there.empty())
    throw InputError(there.front().string() + ": was made in the meantime");
  move_parts(made, fs::absolute(options.database).parent_path());
  return static_cast<int>(planned.size());
}

fs::path remove_demo_cohort(const fs::path& database) {
  {
    const Database opened(database, OpenMode::kExisting);
    if (!is_demo(opened)) throw InputError(database.string() + ": holds no demo cohort; it was left as it is");
    if (const std::string kept = attempt_not_invented(opened); !kept.empty())
      throw InputError(database.string() + ": holds attempts that are not invented (" + kept +
                       "); it was left as it is");
    require_own_folders(database);
  }
  const std::string stem = (database.parent_path() / ("removed-" + database.stem().string())).string();
  fs::path folder = stem;
  std::error_code error;
  for (int number = 2; !fs::create_directory(folder, error) && !error; ++number)
    folder = stem + "-" + std::to_string(number);
  if (error) throw EnvironmentError(folder.string() + ": cannot be made: " + error.message());
  move_parts(database, folder);
  return folder;
}

}  // namespace trocar
