// A recording of the scripted expert at an exercise, made once in the background and kept in the cache folder.
//
// The file's name holds all that it depends on, so a changed exercise or organ makes a new one. Thread: the window's; the run has its own.
#pragma once

#include <atomic>
#include <filesystem>
#include <future>
#include <string>

#include "app/scene.h"

namespace trocar {

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
  std::future<std::string> making_;   // what went wrong, empty when it lies there
  std::filesystem::path file_;
  std::atomic<bool> stop_ = false;
  std::string refusal_;
};

/// $XDG_CACHE_HOME/trocar, else ~/.cache/trocar; the folder for temporary files without a home.
std::filesystem::path cache_folder();

}  // namespace trocar
