#include "trainees/live/live_publisher.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "haptics/input_error.h"
#include "trainees/live/live_clock.h"
#include "trainees/live/live_folder.h"
#include "trainees/records/attempt_identity.h"

namespace trocar {
namespace {

constexpr std::chrono::milliseconds kBetween{200}, kAsleep{1000};

/// Files of programs that died long ago.
void sweep(LiveFolder& folder) {
  for (const std::string& name : folder.names()) {
    if (folder.age_s(name).value_or(0) < LivePublisher::kLeftFor_s) continue;
    const std::optional<std::string> text = folder.read(name);
    const std::optional<StatusSnapshot> told = text ? parse_live_text(*text) : std::nullopt;
    if (told && !process_lives(told->process)) folder.remove(name);
  }
}

}  // namespace

struct LivePublisher::State {
  explicit State(const std::filesystem::path& database) : folder(database, LiveFolder::Open::kMake) {
    if (!folder.open()) return;
    told.process = this_process();
    told.machine = machine_name();
    told.began_utc = utc_now();
    name = make_uuid() + ".json";
    sweep(folder);
    thread = std::thread([this] { work(); });
  }

  void work() noexcept;
  bool looked() const {
    const std::optional<double> look = folder.last_look_s();
    return look && *look < kLookedFor_s;
  }

  LiveFolder folder;    // the thread's, once it runs
  StatusSnapshot told;  // likewise
  std::string name;
  std::mutex mutex;
  std::condition_variable come;
  std::optional<LiveMoment> pending;  // guarded; so is ends
  bool ends = false;
  std::optional<LiveMoment> last;  // of tell() alone: what it said before
  std::atomic<bool> welcome{false};
  bool news = false;  // guarded
  std::thread thread;
};

void LivePublisher::State::work() noexcept {
  for (;;) {
    const bool seen = looked();
    std::unique_lock lock(mutex);
    come.wait_for(lock, seen ? kBetween : kAsleep, [this] { return ends || news; });
    if (ends) break;
    const bool due = news || seen;
    news = false;
    std::optional<LiveMoment> now;
    if (due) now = std::exchange(pending, std::nullopt);
    lock.unlock();
    if (now) {
      told.moment = std::move(*now);
      told.told_utc = utc_now();
      told.told_s = since_boot_s();
      folder.write(name, live_text(told));
    }
    welcome.store(seen || looked(), std::memory_order_relaxed);
  }
  folder.remove(name);
}

LivePublisher::LivePublisher(const std::filesystem::path& database) {
  try {
    state_ = std::make_unique<State>(database);
  } catch (const std::exception&) {
    // Without /proc or threads nothing is told.
  }
}

LivePublisher::~LivePublisher() {
  if (!state_ || !state_->thread.joinable()) return;
  {
    const std::scoped_lock lock(state_->mutex);
    state_->ends = true;
  }
  state_->come.notify_all();
  state_->thread.join();
}

bool LivePublisher::wanted() const { return state_ && state_->welcome.load(std::memory_order_relaxed); }

void LivePublisher::tell(const LiveMoment& moment) {
  if (!state_ || !state_->thread.joinable()) return;
  State& s = *state_;
  const bool news = !s.last || !same_news(*s.last, moment);
  s.last = moment;
  s.welcome.store(false, std::memory_order_relaxed);
  {
    const std::scoped_lock lock(s.mutex);
    s.pending = moment;
    s.news = s.news || news;
  }
  if (news) s.come.notify_all();
}

}  // namespace trocar
