// Tells a desk what runs in this program: the newest moment, in a file that goes when the program ends.
//
// A thread of its own writes: news (who, what, which phase) at once, everything else five times a second, and that only
// while a desk looks. Nobody waits for it, nothing throws; a folder that cannot be written means that nothing is told.
// Threads: tell() and wanted() from one; never the haptic task's.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "trainees/live/live_moment.h"

namespace trocar {

class LivePublisher {
 public:
  static constexpr double kLookedFor_s = 10;  ///< a desk that asked so long ago still looks
  static constexpr double kPictureEvery_s = 0.3;
  static constexpr double kLeftFor_s = 7200;  ///< after which the file of a program that died is taken away

  /// @param database its file; empty or ":memory:": nothing is told.
  explicit LivePublisher(const std::filesystem::path& database);
  /// Takes its file away.
  ~LivePublisher();
  LivePublisher(const LivePublisher&) = delete;
  LivePublisher& operator=(const LivePublisher&) = delete;

  /// A desk looks, and what was told last has been written: a new moment is welcome.
  bool wanted() const;
  /// News is written even when nobody looks; the rest waits until somebody does.
  void tell(const LiveMoment& moment);
  /// A desk looks, and the last picture is kPictureEvery_s old: a new one is welcome. False once it has been asked for.
  bool picture_wanted();
  /// @param jpeg makes the file's bytes; called by the publisher's thread, at most LiveFolder::kLargest bytes.
  void show(std::function<std::string()> jpeg);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
