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
    if (!told || process_lives(told->process)) continue;
    folder.remove(name);
    folder.remove(LiveFolder::picture_of(name));
  }
}

}  // namespace

struct LivePublisher::State {
  explicit State(const std::filesystem::path& database) : folder(database, LiveFolder::Open::kMake) {
    if (!folder.open()) return;
    told.process = this_process();
    told.machine = machine_name();
    told.began_utc = utc_now();
    const std::string own = make_uuid();
    name = own + LiveFolder::kMoment;
    picture_name = own + LiveFolder::kPicture;
    sweep(folder);
    thread = std::thread([this] { work(); });
  }

  void work() noexcept;
  void write_picture(const std::function<std::string()>& jpeg) noexcept;
  bool looked() const {
    const std::optional<double> look = folder.last_look_s();
    return look && *look < kLookedFor_s;
  }

  LiveFolder folder;    // the thread's, once it runs
  StatusSnapshot told;  // likewise
  std::string name, picture_name;
  std::mutex mutex;
  std::condition_variable come;
  std::optional<LiveMoment> pending;     // guarded; so is ends
  std::function<std::string()> picture;  // guarded; not written yet
  bool ends = false;
  std::optional<LiveMoment> last;  // of tell() alone: what it said before
  std::atomic<bool> welcome{false}, watched{false};
  bool news = false;                                    // guarded
  std::chrono::steady_clock::time_point pictured = {};  // of picture_wanted() alone
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
    const std::function<std::string()> jpeg = std::exchange(picture, nullptr);
    lock.unlock();
    if (jpeg) write_picture(jpeg);
    if (now) {
      told.moment = std::move(*now);
      told.told_utc = utc_now();
      told.told_s = since_boot_s();
      folder.write(name, live_text(told));
    }
    const bool looks = seen || looked();
    welcome.store(looks, std::memory_order_relaxed);
    watched.store(looks, std::memory_order_relaxed);
  }
  folder.remove(name);
  folder.remove(picture_name);
}

void LivePublisher::State::write_picture(const std::function<std::string()>& jpeg) noexcept {
  try {
    const std::string bytes = jpeg();
    if (bytes.size() <= LiveFolder::kLargest) folder.write(picture_name, bytes);
  } catch (const std::exception&) {  // then there is no picture
  }
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

bool LivePublisher::picture_wanted() {
  if (!state_ || !state_->watched.load(std::memory_order_relaxed)) return false;
  const auto now = std::chrono::steady_clock::now();
  if (std::chrono::duration<double>(now - state_->pictured).count() < kPictureEvery_s) return false;
  state_->pictured = now;
  return true;
}

void LivePublisher::show(std::function<std::string()> jpeg) {
  if (!state_ || !state_->thread.joinable()) return;
  const std::scoped_lock lock(state_->mutex);
  state_->picture = std::move(jpeg);
}

}  // namespace trocar
