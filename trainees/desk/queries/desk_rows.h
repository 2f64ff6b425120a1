// Small sets of rows that several of the desk's queries want. Internal to trainees/desk.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "trainees/progress/judgement.h"
#include "trainees/progress/learning_curve.h"
#include "trainees/store/database.h"

struct sqlite3;

namespace trocar::desk {

struct Person {
  std::int64_t id = 0;
  std::string code, name, created_utc;
  std::vector<std::string> groups = {};
};
/// Everybody, by id.
std::map<std::int64_t, Person> people(sqlite3* connection);

/// What a certificate is for.
struct CertifiedSkill {
  std::int64_t trainee = 0;
  std::string exercise_id, level;
  auto operator<=>(const CertifiedSkill&) const = default;
};
struct HeldCertificate {
  std::string utc = {};          ///< "": none is held, but one lies there that nobody signed
  std::string in_question = {};  ///< why it may not stand (trainees/records/certificate_standing.h)
};
/// Newest signed certificate of each that was not withdrawn; where there is none, that one lies there unsigned.
std::map<CertifiedSkill, HeldCertificate> certificates_held(Database& database);

/// Whose training data were erased: of them nothing is judged, drawn or counted.
std::set<std::int64_t> training_erased(sqlite3* connection);
/// The attempt is one of theirs.
bool of_erased(sqlite3* connection, const std::string& attempt_uuid);

/// Share of the contact time without room in the device above which the force was not rendered.
inline constexpr double kNotRendered = 0.05;
/// Whether the device loop was late or could not give the force; shares as the database has them, NaN where it has
/// none.
bool doubtful(double ticks, double overruns, double saturated_share, double late_share);

/// Exercise, level and input of all attempts, each combination once, in order. Of 10^5 attempts it reads some fifty.
struct Combination {
  std::string exercise_id, level, hand;
};
std::vector<Combination> combinations(sqlite3* connection);

/// What attempt_by_curve has of a rubric. As in its SQL: substr(ruleset_sha256, 1, 16).
std::string rubric_start(const std::string& sha256);

/// Scores of one curve over all trainees, each trainee's oldest first.
std::map<std::int64_t, std::vector<double>> cohort_scores(sqlite3* connection, const CurveKey& key);

}  // namespace trocar::desk
