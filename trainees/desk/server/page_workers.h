// The few threads that make pages, each with a Database of its own (one Database belongs to one thread).
//
// Threads that read and send hand their request over, so that a slow visitor never holds a database. Who waits takes
// turns: one request of each in a round, however many somebody sends.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "trainees/desk/server/desk_gate.h"

namespace trocar::review {

class PageWorkers {
 public:
  /// As many as the waiting room has places.
  static constexpr std::size_t kMostWaiting = 256;
  /// Called once: by one of the threads with its desk, by who gives it with nullptr when too many wait. Must not throw.
  using Job = std::function<void(Desk*)>;

  /// Returns when every thread has its database. @throws what open() throws.
  PageWorkers(int count, const std::function<Database()>& open, const DeskSources& sources, bool demo);
  /// Finishes.
  ~PageWorkers();
  PageWorkers(const PageWorkers&) = delete;
  PageWorkers& operator=(const PageWorkers&) = delete;

  /// Does not wait. @param turn whose it is (DeskGate::turn()).
  void give(const std::string& turn, Job job);
  /// Waits until the job was called, which may throw here. @throws what it throws; std::future_error when it has
  /// finished.
  void run(const std::string& turn, const Job& job);
  /// Waits for all that was given; what is given later is dropped without a call.
  void finish();

 private:
  void work(const std::function<Database()>& open, const DeskSources& sources, bool demo, std::promise<void> ready);
  Job next();

  std::mutex mutex_;
  std::condition_variable come_;
  std::map<std::string, std::deque<Job>> waiting_;  ///< by whose turn it is, none empty
  std::deque<std::string> turns_;                   ///< of those who wait, once each
  std::size_t count_ = 0;
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace trocar::review
