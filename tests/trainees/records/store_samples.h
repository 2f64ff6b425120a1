// Attempts to store, and a folder that vanishes with the test.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

#include "haptics/input_error.h"
#include "trainees/records/attempt_store.h"

namespace trocar {

class TemporaryFolder : public testing::Test {
 protected:
  TemporaryFolder();
  ~TemporaryFolder() override;
  std::filesystem::path folder_;
};

AttemptStart sample_start(const std::string& trainee = "T-expert");

/// A completed attempt of that score, with events, metrics, sub-scores and a cap.
AttemptResult sample_result(double score = 81.25);
/// With a cap of every kind.
AttemptResult capped_result();

/// Begins and finishes one attempt.
AttemptId store_attempt(Database& database, const AttemptStart& start, const AttemptResult& result);

/// Runs SQL on the database file from outside, as another program would. @returns the error, empty when none.
std::string run_outside(const std::filesystem::path& database, const std::string& sql);

/// The same with every trigger out of the way and put back as it was: what somebody does who knows the schema.
/// @param before what cannot run inside a transaction.
std::string run_without_triggers(const std::filesystem::path& database, const std::string& sql,
                                 const std::string& before = "");

/// Everything that check() says, a line each.
std::string problems_of(const Database& database);

/// Message of the error of that type which the action throws; empty when it throws none.
template <class Error>
std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace trocar
