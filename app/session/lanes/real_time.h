// What the operating system gives a thread that must be on time, asked for and honestly reported.
//
// SCHED_FIFO needs a privilege (rtprio in limits.conf, or root), mlockall a limit (memlock), processors kept awake the
// right to write /dev/cpu_dma_latency. Without them the run goes on as ordinary threads with the timer slack of 1 ns
// that anybody may have, and says so.
#pragma once

#include <string>

namespace trocar {

/// Denormal numbers are flushed to zero in every thread that computes, in every executor: one rule, so that live,
/// lockstep and replay agree to the bit, and no tick is slow because a force fades out. Restores what was before.
class FlushDenormals {
 public:
  FlushDenormals() noexcept;
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned before_ = 0;
};

/// Locks all memory, present and future, while it lives.
class MemoryLock {
 public:
  MemoryLock();
  ~MemoryLock();
  MemoryLock(const MemoryLock&) = delete;
  MemoryLock& operator=(const MemoryLock&) = delete;
  bool held() const { return refusal_.empty(); }
  const std::string& refusal() const { return refusal_; }  ///< empty when locked

 private:
  std::string refusal_;
};

/// While it lives no processor enters an idle state that it would have to wake up from first (the kernel's power
/// management quality of service, latency 0).
class ProcessorsAwake {
 public:
  ProcessorsAwake();
  ~ProcessorsAwake();
  ProcessorsAwake(const ProcessorsAwake&) = delete;
  ProcessorsAwake& operator=(const ProcessorsAwake&) = delete;
  bool held() const { return file_ >= 0; }

 private:
  int file_ = -1;
};

/// Asks SCHED_FIFO for the calling thread (priority 0: none asked), least timer slack, and touches its stack.
/// @return why SCHED_FIFO was refused; empty when it was given or not asked.
std::string become_real_time(int priority);

/// What the calling thread really has: "SCHED_FIFO 80", "SCHED_OTHER", ...
std::string thread_policy();

/// The calling thread runs on that processor and no other. @return why not; empty when it does.
std::string stay_on(int processor);
/// First of a list as the kernel writes it ("2-3,6"); -1: none.
int first_processor(const std::string& list);
/// A processor that was kept free for such threads (isolcpus=); -1: none.
int isolated_processor();

/// "Linux 6.1.0-18-amd64"; empty: it does not say.
std::string kernel_release();
/// Processes that ran or wanted to, mean of the last minute; 0: the kernel does not say.
double load_of_last_minute();

/// Whether the kernel says that it is preemptible throughout (PREEMPT_RT).
bool real_time_kernel();

}  // namespace trocar
