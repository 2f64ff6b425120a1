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
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
  }
  come_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  std::rethrow_exception(failure);
}

PageWorkers::~PageWorkers() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
    jobs_.clear();  // whoever waits for them gets a broken promise
  }
  come_.notify_all();
  for (std::thread& thread : threads_) thread.join();
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
  while (true) {
    std::unique_lock lock(mutex_);
    come_.wait(lock, [&] { return ends_ || !jobs_.empty(); });
    if (ends_) return;
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    job(desk);
  }
}

std::optional<Answer> PageWorkers::run(const std::function<Answer(Desk&)>& make) {
  Job job(make);
  std::future<Answer> made = job.get_future();
  {
    const std::scoped_lock lock(mutex_);
    if (ends_ || jobs_.size() >= kMostWaiting) return {};
    jobs_.push_back(std::move(job));
  }
  come_.notify_one();
  try {
    return made.get();
  } catch (const std::future_error&) {
    return {};
  }
}

}  // namespace trocar::review
