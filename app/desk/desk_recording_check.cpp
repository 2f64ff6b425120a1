#include "app/desk/desk_recording_check.h"

#include <mutex>
#include <thread>
#include <utility>

#include "app/session/keeping/recording_check.h"
#include "trainees/records/attempt_identity.h"

namespace trocar {

struct DeskRecordingCheck::State {
  void check(const std::stop_token& stop) {
    std::vector<std::string> found;
    try {
      Database database = open();
      const auto going = [&](std::size_t done, std::size_t all) {
        const std::scoped_lock lock(mutex);
        known.done = done;
        known.all = all;
        return !stop.stop_requested();
      };
      found = check_by_recordings(database, {1, going});
      if (!stop.stop_requested())  // missing and exchanged ones; this cannot be stopped, so it comes last
        for (std::string& problem : AttemptStore(database).check_recordings()) found.push_back(std::move(problem));
    } catch (const std::exception& error) {
      found = {std::string("the recordings could not be checked: ") + error.what()};
    }
    const std::scoped_lock lock(mutex);
    known.running = false;
    if (stop.stop_requested()) return;
    known.problems = std::move(found);
    known.finished_utc = utc_now();
  }

  std::function<Database()> open;
  mutable std::mutex mutex;  // guards known
  review::RecordingsChecked known;
  std::jthread thread;  // last: it is joined before what it uses goes
};

DeskRecordingCheck::DeskRecordingCheck(std::function<Database()> open) : state_(std::make_unique<State>()) {
  state_->open = std::move(open);
}

DeskRecordingCheck::~DeskRecordingCheck() = default;

void DeskRecordingCheck::begin() {
  {
    const std::scoped_lock lock(state_->mutex);
    if (state_->known.running) return;
    state_->known.running = true;
    state_->known.done = 0;
  }
  state_->thread = std::jthread([state = state_.get()](const std::stop_token& stop) { state->check(stop); });
}

review::RecordingsChecked DeskRecordingCheck::state() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->known;
}

}  // namespace trocar
