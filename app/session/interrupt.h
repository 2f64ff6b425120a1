// Ctrl-C and SIGTERM as a question instead of a death: the run ends in order, recorded as aborted.
//
// The two signals are blocked while it lives, in the calling thread and all that it starts, and fetched when asked for;
// no handler, no global. Make it before anything that starts threads. A second signal within one run changes nothing;
// SIGKILL still works. Thread: the one that made it.
#pragma once

#include <signal.h>

namespace trocar {

class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// Whether one of the signals has come. @post once true, always true.
  bool seen();

 private:
  sigset_t watched_, before_;
  bool seen_ = false;
};

}  // namespace trocar
