#include "trainees/exchange/sync/replica_keeper.h"

#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <set>
#include <thread>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/exchange/sync/exchange.h"
#include "trainees/exchange/sync/fetch.h"
#include "trainees/exchange/sync/station.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/replica_facts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

using namespace sync;  // NOLINT(google-build-using-namespace): this file is its public side
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kNotedEvery{60};  ///< the time of the last look, in the copy

/// Written here by people and not there yet; what came from the centre goes back too, but is not waited for.
int waiting_here(const Database& database, const std::string& central) {
  sql::Statement row(database.connection(),
                     "SELECT count(*) FROM audit WHERE position > ? AND actor <> ? AND"
                     " (action LIKE '% added' OR action IN ('group joined', 'group left'))"
                     " AND action <> 'account added'");
  row.bind(cursor_of(database, central)).bind(kFromCentre);
  return row.step() ? static_cast<int>(row.integer(0)) : 0;
}

struct Before {
  std::string central, utc;  ///< UUID; "" never filled
};

/// When this copy last had everything.
Before filled_before(const Database& database) {
  sql::Statement row(database.connection(),
                     "SELECT substr(remote, length(?1) + 1), utc FROM sync_cursor WHERE remote LIKE ?1 || '%'"
                     " ORDER BY utc DESC LIMIT 1");
  if (!row.bind(arrivals_of("")).step()) return {};
  return {row.text(0), row.text(1)};
}

}  // namespace

std::string central_name(const CentralAddress& central) {
  std::string text = central.url.substr(std::min(central.url.size(), central.url.find("://") + 3));
  text = text.substr(text.find('@') == std::string::npos ? 0 : text.find('@') + 1);
  const std::string options = text.find('?') == std::string::npos ? "" : text.substr(text.find('?'));
  text = text.substr(0, text.find('?'));
  if (!text.starts_with("/")) return text;
  const std::size_t host = options.find("host=");
  return host == std::string::npos || options[host + 5] == '/'
             ? "this machine" + text
             : options.substr(host + 5, options.find('&', host) - host - 5) + text;
}

std::filesystem::path default_replica_path(const CentralAddress& central) {
  namespace fs = std::filesystem;
  const std::string name = "central-" + digest::of_bytes(central.url).substr(0, 12) + ".db";
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && fs::path(cache).is_absolute()) return fs::path(cache) / "trocar" / name;
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home == '\0')
    throw EnvironmentError("no place for the copy of the central record: set HOME or give --db FILE");
  return fs::path(home) / ".cache" / "trocar" / name;
}

struct ReplicaKeeper::State {
  explicit State(KeeperOptions given) : options(std::move(given)), database(options.open()) {}

  void run();
  void round();
  void exchange(bool whole);
  void count_waiting();
  void lost(const std::string& why);
  void found(bool changed);
  void tell(const std::vector<std::string>& lines);
  bool pause(std::chrono::milliseconds most);

  KeeperOptions options;
  Database database;
  std::unique_ptr<CentralLink> link;
  std::string central;  ///< UUID
  std::int64_t pushed_head = -1, counted_head = -1, revision = -1;
  Clock::time_point compared = {}, asked = {}, tried = {}, noted = {};
  std::set<std::string> told;  ///< lines that were logged
  mutable std::mutex mutex;
  std::condition_variable come;
  bool ends = false;
  ReplicaStatus status;
  std::thread thread;
};

void ReplicaKeeper::State::tell(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    if (options.log && told.insert(line).second) options.log(line);
  }
}

void ReplicaKeeper::State::lost(const std::string& why) {
  link.reset();
  tried = Clock::now();
  const int waiting = waiting_here(database, central);
  const std::scoped_lock lock(mutex);
  status.waiting = waiting;
  status.why = why;
  if (!status.lost_since_utc.empty()) return;
  status.lost_since_utc = utc_now();
  if (options.log) options.log(why);
}

void ReplicaKeeper::State::found(bool changed) {
  const std::string now = utc_now();
  const int waiting = waiting_here(database, central);
  if (changed || Clock::now() - noted > kNotedEvery) {
    const std::string remote = arrivals_of(central);
    set_cursor(database, remote, cursor_of(database, remote));
    noted = Clock::now();
  }
  const std::scoped_lock lock(mutex);
  if (!status.lost_since_utc.empty() && options.log) options.log("the central database is reached again");
  status = {status.host, now, "", "", waiting};
}

/// What was written here first: then whatever comes back knows of it.
void ReplicaKeeper::State::exchange(bool whole) {
  const std::int64_t head = audit_head(database.connection()).position;
  if (head != pushed_head || whole) {
    const PushReport pushed =
        push_over(*link, database, {.central = options.central, .station_name = options.station_name});
    tell(pushed.told);
    tell(pushed.conflicts);
    tell(pushed.problems);
    pushed_head = pushed.to;
  }
  link->begin_reading();
  const std::int64_t there = link->revision();
  link->commit();
  if (there == revision && !whole) return;
  const PullReport pulled =
      replicate_over(*link, database, {options.central, options.recordings, options.going}, whole);
  tell(pulled.told);
  tell(pulled.problems);
  revision = there;
  if (whole) compared = Clock::now();
}

void ReplicaKeeper::State::count_waiting() {
  const std::int64_t head = audit_head(database.connection()).position;
  if (head == counted_head) return;
  counted_head = head;
  const int waiting = waiting_here(database, central);
  const std::scoped_lock lock(mutex);
  status.waiting = waiting;
}

void ReplicaKeeper::State::round() {
  count_waiting();
  const bool again = !link;
  if (again && Clock::now() - tried < options.retry) return;
  const std::int64_t head = audit_head(database.connection()).position;
  if (!again && head == pushed_head && Clock::now() - asked < options.ask) return;
  try {
    if (again) link = std::make_unique<CentralLink>(options.central);
    central = link->uuid();
    if (again) require_place_of_copy(database, central);
    const std::int64_t before = revision;
    exchange(again || Clock::now() - compared > options.compare_all);
    asked = Clock::now();
    found(before != revision);
  } catch (const EnvironmentError& error) {
    lost(error.what());
  } catch (const InputError& error) {
    lost(error.what());
  }
}

bool ReplicaKeeper::State::pause(std::chrono::milliseconds most) {
  std::unique_lock lock(mutex);
  come.wait_for(lock, most, [&] { return ends; });
  return !ends;
}

void ReplicaKeeper::State::run() {
  do {
    try {
      round();
    } catch (const std::exception& error) {  // a full disk, a database held too long: told, tried again
      if (options.log) options.log(error.what());
      if (!pause(options.retry)) return;
    }
  } while (pause(options.look));
}

ReplicaKeeper::ReplicaKeeper(KeeperOptions options) : state_(std::make_unique<State>(std::move(options))) {
  State& state = *state_;
  const Before before = filled_before(state.database);
  state.central = before.central;
  state.status.host = central_name(state.options.central);
  state.status.as_of_utc = before.utc;
  bool ours = false;
  try {
    state.link = std::make_unique<CentralLink>(state.options.central);
    state.central = state.link->uuid();
    // Nothing is pushed before the file is known to be a copy of that centre: it may be a station's own.
    require_place_of_copy(state.database, state.central);
    ours = true;
    replicate_over(*state.link, state.database, {state.options.central, false, state.options.going},
                   before.central != state.central);
    state.exchange(true);
    state.tell(remarks_on(*state.link, state.options.central));
    state.asked = Clock::now();
    state.found(true);
  } catch (const EnvironmentError& error) {
    if (before.utc.empty()) throw;
    state.lost(error.what());
  } catch (const InputError& error) {  // something there that this program cannot take: what it has is still good
    if (before.utc.empty() || !ours) throw;
    state.lost(error.what());
  }
}

ReplicaKeeper::~ReplicaKeeper() {
  if (!state_->thread.joinable()) return;
  {
    const std::scoped_lock lock(state_->mutex);
    state_->ends = true;
  }
  state_->come.notify_all();
  state_->thread.join();
}

void ReplicaKeeper::start() {
  if (!state_->thread.joinable()) state_->thread = std::thread([this] { state_->run(); });
}

ReplicaStatus ReplicaKeeper::status() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->status;
}

}  // namespace trocar
