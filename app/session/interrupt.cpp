#include "app/session/interrupt.h"

#include <time.h>

namespace trocar {

InterruptWatch::InterruptWatch() {
  ::sigemptyset(&watched_);
  ::sigaddset(&watched_, SIGINT);
  ::sigaddset(&watched_, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &watched_, &before_);
}

InterruptWatch::~InterruptWatch() {
  seen();  // one that came too late to end anything must not kill the program now
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

bool InterruptWatch::seen() {
  const timespec now{0, 0};
  while (::sigtimedwait(&watched_, nullptr, &now) > 0) seen_ = true;
  return seen_;
}

}  // namespace trocar
