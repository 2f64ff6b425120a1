// What exercise files say of their levels, each read once for a page. Thread: that of the Database.
#pragma once

#include <map>
#include <string>

#include "haptics/input_error.h"
#include "trainees/desk/routes/route.h"
#include "trainees/records/attempt_store.h"

namespace trocar::review {

/// Limits and pass mark by rubric and level, each read once for a page.
class LevelReader {
 public:
  explicit LevelReader(Desk& desk) : desk_(&desk) {}
  LevelFacts of(const std::string& rubric, const std::string& level) {
    const auto [it, added] = known_.try_emplace(rubric + "/" + level);
    if (added && desk_->sources.level_facts) {
      try {
        it->second = desk_->sources.level_facts(AttemptStore(desk_->database).exercise_text(rubric), level);
      } catch (const InputError&) {
        it->second = {};  // an exercise of another version of the program: drawn without its limits
      }
    }
    return it->second;
  }

 private:
  Desk* desk_;
  std::map<std::string, LevelFacts> known_;
};

}  // namespace trocar::review
