// A short attempt and a folder of its own for the tests of the attempt runner.
#pragma once

#include <filesystem>
#include <functional>

#include "app/window/attempt/attempt_runner.h"
#include "trainees/records/attempt_store.h"

namespace trocar {

/// A folder that is gone afterwards.
class RunnerFolder {
 public:
  RunnerFolder();
  ~RunnerFolder();
  std::filesystem::path database() const { return path_ / "trocar.db"; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Two discs and the block of E02; a person's by mouse, or a scripted hand's.
AttemptRequest short_request(const std::filesystem::path& database, const std::string& script = "");

/// Waits for something that must come; a test that waits 60 s for it has failed. @return whether it came.
bool wait_for(const std::function<bool()>& what);

/// Newest attempt of the database.
AttemptResult stored_attempt(const std::filesystem::path& database);

/// The recording replays to the hash, the events and the grade that it holds.
bool verified(const std::filesystem::path& recording);

}  // namespace trocar
