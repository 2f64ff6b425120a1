// Progress of long work on standard error, and Ctrl-C as an orderly stop.
//
// On a terminal one line that is drawn over, with a bar; otherwise, once work takes longer than a moment, a line when a
// stage begins and one each quarter of it, so that a log stays short. The shown times and shares are for people: no
// result depends on them. Thread: the one that does the work.
#pragma once

#include <chrono>
#include <iosfwd>
#include <string>
#include <string_view>

#include "app/session/interrupt.h"
#include "haptics/input_error.h"
#include "tissue/progress.h"

namespace trocar {

/// Somebody pressed Ctrl-C (or SIGTERM came): whatever was not finished is gone, nothing half-written stays. Exit
/// code 3.
class Interrupted : public EnvironmentError {
 public:
  Interrupted() : EnvironmentError("interrupted; nothing was written") {}
};

class ProgressDisplay {
 public:
  /// @param terminal draw over one line; otherwise print lines
  /// @param moment without a terminal: between two lines, and before the first
  ProgressDisplay(std::ostream& err, bool terminal, std::chrono::milliseconds moment = std::chrono::seconds(2));
  /// Leaves the cursor on a clean line.
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// As tissue/progress.h has it. @throws Interrupted
  /// @param detail behind the stage, changing as it goes on ("12 of 900, ...").
  void show(std::string_view stage, double share, std::string_view detail = {});
  /// Wipes the bar, for another message.
  void clear();
  Progress function();

 private:
  void draw(double share);
  void line(double share);

  std::ostream& err_;
  bool terminal_;
  InterruptWatch watch_;
  std::string stage_, detail_;
  int quarter_ = -1;       ///< of the stage, printed last
  std::size_t drawn_ = 0;  ///< characters of the bar on the terminal
  std::chrono::milliseconds moment_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// How far, how fast and how long still, of things that take about the same time each: "120 of 900, 25 a second, 31 s
/// left".
/// @param seconds since the first of them was done, which takes longer than the others.
std::string pace_words(int done, int of, double seconds);

/// Whether standard error is a terminal.
bool error_is_terminal();

}  // namespace trocar
