// What a certificate stands on, and whether that still holds: the one place that says so.
//
// It stands on the attempts of one learning curve (trainee, exercise, level, input, rules) as they counted when it was
// given. Its evidence names them and every decision that was known then, so that a later one is told from an earlier
// one without a clock and in every database alike. A certificate that is in question still stands: a person looks, and
// withdraws it or not. Thread: that of the Database.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "trainees/records/assessments.h"

namespace trocar {

struct CertifiedBy {
  std::int64_t row = 0;  ///< of the attempt
  std::string uuid = {};
  bool passed_then = false, passed_now = false;
  std::string decided_then = {};  ///< who had decided, when it was given; "" nobody
  std::string decided_now = {};   ///< who has decided otherwise since; "" nobody
};

struct CertificateStanding {
  std::string cited = {};                  ///< UUID of the attempt that it cites; "" where the evidence names none
  std::vector<CertifiedBy> attempts = {};  ///< that it stands on and that are here, oldest first
  std::string in_question = {};            ///< why, a clause: "the attempt that it cites was ..."; "" while all holds
};

/// @param certificate as it is stored. Of one that was withdrawn the standing is told likewise.
CertificateStanding standing_of(const Database& database, const Certificate& certificate);

/// UUIDs of certificates of which standing_of() could not say a word: signed, of whose attempts all are the person's
/// and nobody has decided on one, and the one that they cite is as it was. For lists, which cannot ask of thousands one
/// by one; of any other certificate standing_of() tells. All is read anew each time: who may write the file can change
/// any row, and only the rows tell which.
std::set<std::string> certificates_beyond_doubt(const Database& database);

/// UUIDs of the attempts that count on the curve of this one, oldest first: what a certificate given now stands on.
std::vector<std::string> attempts_of_curve(const Database& database, const std::string& attempt_uuid);

}  // namespace trocar
