#include "app/cli/in_parallel.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace trocar {

void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;  // guards failure
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  const unsigned wanted = jobs > 0 ? static_cast<unsigned>(jobs) : std::thread::hardware_concurrency();
  {
    std::vector<std::jthread> threads;
    try {
      for (unsigned i = 1; i < wanted; ++i) threads.emplace_back(take);
    } catch (const std::system_error&) {  // the system gives no more: those that there are do the work
    }
    take();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace trocar
