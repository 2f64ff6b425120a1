// A recording of the scripted expert at an exercise, made once in lockstep and kept in the cache folder.
//
// The file's name holds all that it depends on (version of the program, exercise, organ, board), so a changed one makes
// a new file; what lies in the folder may be deleted at any time. Thread: the caller's; the run has its own, at a low
// priority.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <future>
#include <string>

#include "app/session/setup/scene.h"

namespace trocar {

/// The expert's attempt at what somebody else did: same exercise, level, board, organ; no faults, nominal device.
AttemptSetup expert_setup(const AttemptSetup& of);

/// Makes the recording unless it lies there. @return where it lies; empty when it was interrupted. @throws InputError,
/// EnvironmentError.
std::filesystem::path expert_recording(const AttemptSetup& setup, const AssetRoots& assets,
                                       const std::function<bool()>& interrupted = {});

class ExpertRun {
 public:
  ExpertRun() = default;
  /// Gives up what runs.
  ~ExpertRun();
  ExpertRun(const ExpertRun&) = delete;
  ExpertRun& operator=(const ExpertRun&) = delete;

  /// Where the recording lies; empty while it is being made, and when it cannot be (refusal() says why).
  std::filesystem::path ask(const AttemptSetup& setup, const AssetRoots& assets);
  const std::string& refusal() const { return refusal_; }

 private:
  std::future<std::string> making_;  // what went wrong, empty when it lies there
  std::filesystem::path file_;
  std::atomic<bool> stop_ = false;
  std::string refusal_;
};

/// $XDG_CACHE_HOME/trocar, else ~/.cache/trocar; the folder for temporary files without a home.
std::filesystem::path cache_folder();

}  // namespace trocar
