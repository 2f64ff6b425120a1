#include "app/session/lanes/real_time.h"

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <system_error>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace trocar {
namespace {

constexpr std::size_t kStackBytes = 256 * 1024;  // more than any task uses
constexpr std::size_t kPage = 4096;

std::string reason(int error) { return std::generic_category().message(error); }

/// The pages of the stack are there before the first tick needs them.
[[gnu::noinline]] void touch_stack() {
  std::array<volatile char, kStackBytes> stack;
  for (std::size_t i = 0; i < stack.size(); i += kPage) stack[i] = 0;
}

#if defined(__SSE__)
constexpr unsigned kFlushToZero = 1u << 15, kDenormalsAreZero = 1u << 6;
#endif

}  // namespace

#if defined(__SSE__)
FlushDenormals::FlushDenormals() noexcept : before_(_mm_getcsr()) {
  _mm_setcsr(before_ | kFlushToZero | kDenormalsAreZero);
}
FlushDenormals::~FlushDenormals() { _mm_setcsr(before_); }
#else
// Other processors keep their denormals, in every executor alike.
FlushDenormals::FlushDenormals() noexcept = default;
FlushDenormals::~FlushDenormals() { before_ = 0; }
#endif

MemoryLock::MemoryLock() {
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) != 0) refusal_ = reason(errno);
}
MemoryLock::~MemoryLock() {
  if (held()) ::munlockall();
}

ProcessorsAwake::ProcessorsAwake() : file_(::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC)) {
  const std::int32_t microseconds = 0;
  if (file_ < 0 || ::write(file_, &microseconds, sizeof microseconds) == sizeof microseconds) return;
  ::close(file_);
  file_ = -1;
}
ProcessorsAwake::~ProcessorsAwake() {
  if (held()) ::close(file_);
}

std::string become_real_time(int priority) {
  touch_stack();
  ::prctl(PR_SET_TIMERSLACK, 1UL);
  if (priority <= 0) return "";
  sched_param param{};
  param.sched_priority = priority;
  const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &param);
  return error == 0 ? "" : reason(error);
}

std::string thread_policy() {
  int policy = 0;
  sched_param param{};
  if (const int error = ::pthread_getschedparam(::pthread_self(), &policy, &param); error != 0) return reason(error);
  switch (policy & ~SCHED_RESET_ON_FORK) {
    case SCHED_FIFO:
      return "SCHED_FIFO " + std::to_string(param.sched_priority);
    case SCHED_RR:
      return "SCHED_RR " + std::to_string(param.sched_priority);
    case SCHED_OTHER:
      return "SCHED_OTHER";
    default:
      return "policy " + std::to_string(policy);
  }
}

std::string stay_on(int processor) {
  cpu_set_t only;
  CPU_ZERO(&only);
  if (processor < 0 || processor >= CPU_SETSIZE) return reason(EINVAL);
  CPU_SET(static_cast<std::size_t>(processor), &only);
  const int error = ::pthread_setaffinity_np(::pthread_self(), sizeof only, &only);
  return error == 0 ? "" : reason(error);
}

int first_processor(const std::string& list) {
  int first = -1;
  const auto [end, error] = std::from_chars(list.data(), list.data() + list.size(), first);
  return error == std::errc{} && end != list.data() ? first : -1;
}

int isolated_processor() {
  std::ifstream file("/sys/devices/system/cpu/isolated");
  std::string list;
  std::getline(file, list);
  return first_processor(list);
}

std::string kernel_release() {
  utsname name = {};
  return ::uname(&name) == 0 ? std::string(name.sysname) + " " + name.release : "";
}

double load_of_last_minute() {
  double load = 0;
  return ::getloadavg(&load, 1) == 1 ? load : 0;
}

bool real_time_kernel() {
  std::ifstream file("/sys/kernel/realtime");
  int flag = 0;
  return file >> flag && flag == 1;
}

}  // namespace trocar
