// The few threads that make pages, each with a Database of its own (one Database belongs to one thread).
//
// Threads that serve connections hand their request over and wait, so that a slow visitor never holds a database.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

#include "trainees/desk/server/desk_gate.h"

namespace trocar::review {

class PageWorkers {
 public:
  static constexpr std::size_t kMostWaiting = 64;

  /// Returns when every thread has its database. @throws what open() throws.
  PageWorkers(int count, const std::function<Database()>& open, const DeskSources& sources, bool demo);
  /// Waits for what runs; what still waits is not answered.
  ~PageWorkers();
  PageWorkers(const PageWorkers&) = delete;
  PageWorkers& operator=(const PageWorkers&) = delete;

  /// Runs `make` on one of the threads and waits. @returns nothing when too many wait, or it ends.
  std::optional<Answer> run(const std::function<Answer(Desk&)>& make);

 private:
  using Job = std::packaged_task<Answer(Desk&)>;
  void work(const std::function<Database()>& open, const DeskSources& sources, bool demo, std::promise<void> ready);

  std::mutex mutex_;
  std::condition_variable come_;
  std::deque<Job> jobs_;
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace trocar::review
