#include "app/window/input/space_mouse.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace trocar {
namespace {
constexpr int kReadTimeout_ms = 50;
}

struct SpaceMouse::State {
  std::unique_ptr<SpaceMouseSource> source;
  std::chrono::milliseconds look_again;
  mutable std::mutex mutex = {};
  std::condition_variable wake = {};
  bool stop = false, present = false;
  SpaceMouseState now = {}, told = {};
  std::thread thread = {};

  bool stopping() const {
    const std::lock_guard lock(mutex);
    return stop;
  }

  void show(bool is_present, const SpaceMouseState& state) {
    const std::lock_guard lock(mutex);
    present = is_present;
    now = state;
  }

  void read_until_gone() {
    SpaceMouseState state;
    std::array<std::uint8_t, 64> report{};
    show(true, state);
    while (!stopping()) {
      const int got = source->read(report, kReadTimeout_ms);
      if (got < 0) break;
      if (got > 0 && apply_space_mouse_report(std::span(report).first(static_cast<std::size_t>(got)), state))
        show(true, state);
    }
    source->close();
    show(false, {});
  }

  void run() {
    while (!stopping()) {
      if (source->open()) read_until_gone();
      std::unique_lock lock(mutex);
      wake.wait_for(lock, look_again, [&] { return stop; });
    }
  }
};

SpaceMouse::SpaceMouse(std::unique_ptr<SpaceMouseSource> source, int look_again_ms)
    : state_(new State{std::move(source), std::chrono::milliseconds(look_again_ms)}) {
  state_->thread = std::thread([state = state_.get()] { state->run(); });
}

SpaceMouse::~SpaceMouse() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->stop = true;
  }
  state_->wake.notify_all();
  state_->thread.join();
}

bool SpaceMouse::present() const {
  const std::lock_guard lock(state_->mutex);
  return state_->present;
}

std::optional<InputEvent> SpaceMouse::newest() {
  const std::lock_guard lock(state_->mutex);
  if (state_->now == SpaceMouseState{} && state_->told == SpaceMouseState{}) return std::nullopt;
  state_->told = state_->now;
  InputEvent event;
  event.kind = InputEvent::Kind::kSpaceMouse;
  event.axis = state_->now.axis;
  event.buttons = state_->now.buttons;
  return event;
}

}  // namespace trocar
