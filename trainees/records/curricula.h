// Courses, progress rules and benchmarks as versioned text: added, never changed; groups of trainees. Thread: that of
// the Database.
//
// What the text says is the reader's business (trainees/progress/rules.h); here it is bytes with a digest, an author
// and a date.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "trainees/records/assessments.h"

namespace trocar {

struct Curriculum {
  std::string uuid, name, sha256, toml, author, utc;  ///< author: account's UUID, or the printed name of who has none
  int version = 0;
};

struct Benchmark {
  /// source: who the n were; rule: how the numbers came from them
  /// author: account's UUID, or the printed name of who has none
  std::string uuid, exercise_id, level, metric, source, rule, author, utc;
  double full_at = 0, zero_at = 0;
  int n = 0;
};

class CurriculumStore {
 public:
  explicit CurriculumStore(Database& database) : database_(&database) {}

  /// What may be thrown of the newest version of the name, if there is one, before the next is written: nobody else
  /// writes in between.
  using Check = std::function<void(const std::optional<Curriculum>& last)>;

  /// The next version of that name. The same text again adds nothing. @throws InputError: name not 1 to 64 characters,
  /// empty text, the station's key is lost.
  Curriculum add(const std::string& name, const std::string& toml, const Author& author, const Check& check = {});
  /// @param fits leaves out versions that are not, all without.
  std::optional<Curriculum> newest(const std::string& name,
                                   const std::function<bool(const Curriculum&)>& fits = {}) const;
  /// Every version, newest first. @param held leaves out rows that no signed entry holds.
  std::vector<Curriculum> list(bool held = false) const;

  Benchmark add_benchmark(const Benchmark& numbers, const Author& author);  ///< uuid, author and utc are set here
  std::vector<Benchmark> benchmarks(const std::string& exercise_id = "",
                                    const std::string& level = "") const;  ///< newest first

  /// All or none; who is a member already, or is none, is left. @throws InputError: nobody of one of the codes, a name
  /// of a group that is not 1 to 64 bytes on one line.
  void join(const std::vector<std::string>& trainees, const std::string& group, const Author& author);
  void leave(const std::vector<std::string>& trainees, const std::string& group, const Author& author);
  void join(const std::string& trainee, const std::string& group, const Author& author) {
    join(std::vector{trainee}, group, author);
  }
  void leave(const std::string& trainee, const std::string& group, const Author& author) {
    leave(std::vector{trainee}, group, author);
  }
  std::vector<std::string> groups() const;
  std::vector<std::string> groups_of(const std::string& trainee) const;
  std::vector<std::string> members(const std::string& group) const;  ///< codes

 private:
  Database* database_;
};

}  // namespace trocar
