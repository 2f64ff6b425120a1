#include "trainees/desk/server/page_workers.h"

#include "trainees/desk/server/desk_memory.h"

namespace trocar::review {

PageWorkers::PageWorkers(int count, const std::function<Database()>& open, const DeskSources& sources, bool demo) {
  std::exception_ptr failure;
  for (int i = 0; i < count && !failure; ++i) {
    std::promise<void> ready;
    std::future<void> opened = ready.get_future();
    threads_.emplace_back([this, open, sources, demo, ready = std::move(ready)]() mutable {
      work(open, sources, demo, std::move(ready));
    });
    try {
      opened.get();  // one after the other: the first may migrate
    } catch (...) {
      failure = std::current_exception();
    }
  }
  if (!failure) return;
  finish();
  std::rethrow_exception(failure);
}

PageWorkers::~PageWorkers() { finish(); }

void PageWorkers::finish() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
  }
  come_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void PageWorkers::work(const std::function<Database()>& open, const DeskSources& sources, bool demo,
                       std::promise<void> ready) {
  std::optional<Database> database;
  try {
    database.emplace(open());
  } catch (...) {
    ready.set_exception(std::current_exception());
    return;
  }
  Desk desk{*database, sources, demo, std::make_shared<DeskMemory>()};
  ready.set_value();
  while (const Job job = next()) job(&desk);
}

/// Waits for one. @returns none when it ends.
PageWorkers::Job PageWorkers::next() {
  std::unique_lock lock(mutex_);
  come_.wait(lock, [&] { return ends_ || count_ > 0; });
  if (count_ == 0) return {};
  --count_;
  const auto own = waiting_.find(turns_.front());
  Job job = std::move(own->second.front());
  own->second.pop_front();
  if (own->second.empty())
    waiting_.erase(own);
  else
    turns_.push_back(own->first);
  turns_.pop_front();
  return job;
}

void PageWorkers::give(const std::string& turn, Job job) {
  {
    const std::scoped_lock lock(mutex_);
    if (ends_) return;
    if (count_ < kMostWaiting) {
      ++count_;
      std::deque<Job>& own = waiting_[turn];
      if (own.empty()) turns_.push_back(turn);
      own.push_back(std::move(job));
      job = nullptr;
    }
  }
  if (job)
    job(nullptr);
  else
    come_.notify_one();
}

void PageWorkers::run(const std::string& turn, const Job& job) {
  const auto done = std::make_shared<std::promise<void>>();
  std::future<void> called = done->get_future();
  give(turn, [&job, done](Desk* desk) {
    try {
      job(desk);
    } catch (...) {
      return done->set_exception(std::current_exception());
    }
    done->set_value();
  });
  called.get();
}

}  // namespace trocar::review
