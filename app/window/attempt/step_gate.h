// Lets whoever draws an attempt say how far it may run, in place of the clock: then the same events at the same steps
// give the same attempt, however slowly its pictures are made. For players that see pictures only, and their films.
//
//   gate.advance(0.05);                      // the window's thread: returns when the attempt is there
//   loop.frame(width, height, 0.05, events);
//
// Threads: advance() the window's; the rest the attempt's runner.
#pragma once

#include <condition_variable>
#include <mutex>

namespace trocar {

class StepGate {
 public:
  /// Lets the attempt go on by so much. @return at once when none runs.
  void advance(double dt_s) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!open_) return;
    allowed_s_ += dt_s;
    moved_.notify_all();
    moved_.wait(lock, [this] { return !open_ || reached_s_ >= allowed_s_; });
  }

  void open() {
    const std::lock_guard<std::mutex> lock(mutex_);
    open_ = true;
    allowed_s_ = reached_s_ = 0;
  }
  /// From now on nobody waits.
  void close() {
    const std::lock_guard<std::mutex> lock(mutex_);
    open_ = false;
    moved_.notify_all();
  }
  /// Waits until the attempt may go beyond a time of its own.
  void reach(double t_s) {
    std::unique_lock<std::mutex> lock(mutex_);
    reached_s_ = t_s;
    moved_.notify_all();
    moved_.wait(lock, [this] { return !open_ || allowed_s_ > reached_s_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable moved_;
  bool open_ = false;
  double allowed_s_ = 0, reached_s_ = 0;
};

}  // namespace trocar
