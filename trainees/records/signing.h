// Who may sign, decide, certify and withdraw: a word that counts must be somebody's, and signed with the station's key.
// Thread: that of the Database.
#pragma once

#include <string>

#include "trainees/store/database.h"

namespace trocar {

/// Why this account cannot sign now; "" when it can. Without an account only whoever is alone with the record can: no
/// account is there, and no second trainee. An account cannot whose password somebody else's account gave it: until its
/// owner has set another, two people know it. A demo takes every word.
/// @param account_uuid "" without one: the command line, and the desk while nobody signs in.
std::string why_no_signature(const Database& database, const std::string& account_uuid);

/// @throws InputError: that reason.
void require_signature(const Database& database, const std::string& account_uuid);

/// Before whatever counts only where a signed entry holds it. @throws InputError: the station's key is lost.
void require_key(const Database& database);

}  // namespace trocar
