// Put before libc by LD_PRELOAD: the monotonic clock runs at half speed, and whoever waits for it waits twice as long.
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

namespace {

constexpr long long kSecond = 1000000000;

long long of(const timespec& t) { return t.tv_sec * kSecond + t.tv_nsec; }
timespec from(long long ns) { return {ns / kSecond, ns % kSecond}; }

long long kernel_now() {
  timespec now{};
  syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &now);
  return of(now);
}

long long start() {
  static const long long at = kernel_now();
  return at;
}

}  // namespace

extern "C" int clock_gettime(clockid_t id, timespec* to) {
  if (id != CLOCK_MONOTONIC) return static_cast<int>(syscall(SYS_clock_gettime, id, to));
  *to = from(start() + (kernel_now() - start()) / 2);
  return 0;
}

extern "C" int clock_nanosleep(clockid_t id, int flags, const timespec* wish, timespec* left) {
  timespec wanted = *wish;
  if (id == CLOCK_MONOTONIC)
    wanted = (flags & TIMER_ABSTIME) != 0 ? from(start() + 2 * (of(*wish) - start())) : from(2 * of(*wish));
  return syscall(SYS_clock_nanosleep, id, flags, &wanted, left) == 0 ? 0 : 4;  // EINTR
}
