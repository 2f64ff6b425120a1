// What people say of attempts and trainees: notes, ratings, signatures, overrides, certificates. Sealed rows: added,
// never changed.
//
// Who signs, decides, certifies or withdraws must be somebody (signing.h): each of these throws an InputError
// otherwise. A signature and an override are bound to the bytes of the attempt by its row_hash. An override stands
// beside the score and never replaces it. Thread: that of the Database.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trainees/store/database.h"

namespace trocar {

/// Who says it: account's UUID ("" from the command line) and the name as it is printed.
struct Author {
  std::string account_uuid, printed;
};

struct Note {
  std::string uuid, trainee, attempt_uuid, author, printed, text, utc;
  std::string seen_utc = {};  ///< "" until the trainee met it
  bool is_signed = true;      ///< as a signed entry says; of a stored one
};

struct Rating {
  std::string uuid, account_uuid, rater, scale, item, utc;
  double value = 0;
};

struct Signature {
  std::string uuid, row_hash, account_uuid, signer, meaning, note, utc;
};

struct VerdictOverride {
  std::string uuid, author, printed, reason, utc;
  bool passed = false;
};

struct Certificate {
  std::string uuid, trainee, exercise_id, level, rule_version, evidence, author, printed, utc;
  std::string revoked_utc = {}, revoked_reason = {};  ///< "" while it holds
};

class AssessmentStore {
 public:
  explicit AssessmentStore(Database& database) : database_(&database) {}

  /// @param trainee code (here and below). @param attempt_uuid "" for a note on the trainee.
  /// @throws InputError: empty, longer than 4000 characters, no such trainee, no such attempt of theirs.
  Note add_note(const std::string& trainee, const std::string& attempt_uuid, const std::string& text,
                const Author& author);
  /// Newest first.
  std::vector<Note> notes_of(const std::string& trainee) const;
  std::optional<Note> newest_unseen(const std::string& trainee) const;
  /// A note on the trainee that is shown at once where they practise; that it is one stands in the audit trail.
  /// @throws InputError: as add_note(), longer than kLongestMessage, a line break.
  static constexpr std::size_t kLongestMessage = 200;  ///< bytes
  Note add_message(const std::string& trainee, const std::string& text, const Author& author);
  /// The oldest one that the trainee has not met.
  std::optional<Note> unseen_message(const std::string& trainee) const;
  /// The first time counts. @throws InputError: no such note.
  void mark_seen(const std::string& note_uuid);

  /// @throws InputError: attempt unknown or running, scale or item empty, value not finite.
  void add_rating(const std::string& attempt_uuid, const std::string& scale, const std::string& item, double value,
                  const Author& author);
  /// All values or none. @param values by item of the scale, whole numbers within it.
  /// @throws InputError: as above; unknown scale or item, no value, one outside the scale.
  void rate(const std::string& attempt_uuid, const std::string& scale, const std::map<std::string, double>& values,
            const Author& author);
  std::vector<Rating> ratings_of(const std::string& attempt_uuid) const;  ///< oldest first

  /// @param note may be empty. @param meaning review, approval, responsibility or authorship.
  /// One of a meaning is enough: by account, from the command line by name.
  /// @throws InputError: unknown meaning, attempt running or changed since it was finished, already signed by this
  /// person with this meaning.
  Signature sign(const std::string& attempt_uuid, const std::string& meaning, const std::string& note,
                 const Author& author);
  std::vector<Signature> signatures_of(const std::string& attempt_uuid) const;

  /// The newest holds wherever passes count (verdicts.h). @throws InputError: a reason under 10 characters, attempt
  /// unknown or running, ended by the device (it counts for nothing).
  VerdictOverride override_verdict(const std::string& attempt_uuid, bool passed, const std::string& reason,
                                   const Author& author);
  std::vector<VerdictOverride> overrides_of(const std::string& attempt_uuid) const;  ///< newest first; the first holds

  /// @param evidence JSON: what the decision rested on; "attempt" is the one that it cites.
  /// @throws InputError: no such trainee, exercise never tried in this database, level, rule or evidence empty; the
  /// cited attempt is not here, another trainee's, or not passed as it counts; a certificate is held already.
  Certificate certify(const std::string& trainee, const std::string& exercise_id, const std::string& level,
                      const std::string& rule_version, const std::string& evidence, const Author& author);
  /// @throws InputError: no such certificate, revoked already, a reason under 10 characters.
  void revoke(const std::string& certificate_uuid, const std::string& reason, const Author& author);
  std::vector<Certificate> certificates_of(const std::string& trainee) const;  ///< newest first; "" for everybody's

 private:
  Database* database_;
};

}  // namespace trocar
