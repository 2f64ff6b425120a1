// Attempts as statements of the Experience API 2.0 (IEEE 9274.1.1-2023), for a learning record store. Fields:
// docs/exports.md.
//
// The actor is an account whose name is the trainee's UUID: neither code nor name leaves the database. The identifier
// of a statement is made of the attempt's UUID and the verb, so that sending twice stores once. Nothing is null: what
// is undefined is left out. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/scoring/attempt_result.h"
#include "trainees/records/verdicts.h"

namespace trocar {

/// A finished attempt and what stands beside its result.
struct XapiAttempt {
  AttemptResult result = {};
  std::string trainee_uuid = {}, finished_utc = {}, row_hash = {};
  std::string title = {};                        ///< of the exercise, may be empty
  std::string program = {};                      ///< its version, may be empty
  std::string session_uuid = {};                 ///< "" without one
  std::string instructor_uuid = {};              ///< account of the newest signature, "" without one
  std::optional<double> pass_at = {};            ///< 0..100, of the ruleset; empty when that cannot be read any more
  std::optional<VerdictOverride> decision = {};  ///< the newest of a person; it holds instead of the score's verdict
};

struct XapiSetting {
  /// Absolute URL of who runs the simulator: account.homePage. ".invalid" (RFC 2606) belongs to nobody.
  std::string home_page = "https://trocar.invalid/";
};

/// What a learning management system says when it launches (cmi5, 8.1 and 10.2): one session, one trainee.
struct Cmi5Launch {
  std::string activity_id = {}, publisher_id = {};  ///< IRIs: of the launch; of the course structure
  std::string registration = {}, session_id = {};   ///< registration: a UUID
  std::string home_page = {}, account = {};         ///< the actor of the launch
  std::optional<double> mastery_score = {};         ///< 0..1; it holds instead of the ruleset's pass mark
};

/// One statement: passed, failed (by decision where there is one, which an extension names); completed without a
/// verdict; attempted when no score was given (aborted, fault, void). A later decision makes another statement, with an
/// identifier of its own.
/// @return JSON in one line. @throws InputError: a UUID or a time that is none.
std::string xapi_statement(const XapiAttempt& attempt, const XapiSetting& setting = {});

/// The statements that cmi5 defines for a session with this attempt: "completed" when all of it was done, then "passed"
/// or "failed" when it was graded. Passed is what reaches the mastery score, or what a person decided. Where the score
/// says otherwise (a cap, a decision) it is left out of the statement. Satisfied, and whether moveOn is met, is the
/// system's to say.
std::vector<std::string> cmi5_statements(const XapiAttempt& attempt, const Cmi5Launch& launch);

struct XapiStatement {
  std::string id = {}, text = {};  ///< text: JSON in one line
};

/// Something of the record that a store keeps by at most one statement at a time: an attempt's outcome, a certificate.
struct XapiSubject {
  std::string about = {};                       ///< the same for as long as the record stands
  std::optional<XapiStatement> statement = {};  ///< what holds now
};

/// Takes a statement back: the store shows it no longer as one that holds. @param author account of who did so; ""
/// this program. @param utc when; "" left to the store.
XapiStatement voiding_statement(const std::string& id, const std::string& author, const std::string& utc,
                                const XapiSetting& setting);

/// What breaks the standard in one statement, "PROPERTY: what" each; empty when it is sound.
std::vector<std::string> xapi_problems(std::string_view statement);

/// "PT41.5S", to 0.01 s. @param seconds finite, not negative.
std::string xapi_duration(double seconds);

}  // namespace trocar
