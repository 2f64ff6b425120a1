// What the server asks the database before a page is called, and pages may ask of what a query names: may anybody sign
// in, does a sign-in still hold, whose is what. Thread: that of the Database.
#pragma once

#include <optional>
#include <string>

#include "trainees/records/accounts.h"
#include "trainees/store/database.h"

namespace trocar::review {

/// There is an account that is not disabled (accounts.h).
bool somebody_can_sign_in(const Database& database);

/// Changes when the account's password, role, trainee or state does; "" when it may not sign in, or is gone.
std::string sign_in_stamp(const Database& database, const std::string& account_uuid);

/// Staff sees everybody, a trainee only the own code (as the account has it).
bool may_see_trainee(const Account& account, const std::string& code);
/// The UUID of the attempt of that name (number, UUID or a part of it), where it is this trainee's own. Empty for
/// anybody else's, for one that is not there, and for a name that fits several.
std::optional<std::string> own_attempt(const Account& account, Database& database, const std::string& attempt);

/// By its whole number; as above.
bool may_see_certificate(const Account& account, const Database& database, const std::string& certificate_uuid);

/// `text` is the code of a trainee other than `code`, or the UUID of another trainee, of their account, of an attempt
/// or a certificate of theirs.
bool names_another(const Database& database, const std::string& text, const std::string& code);

/// The station's own instructor, who need not sign in at 127.0.0.1 while nobody has an account.
Account local_instructor();

}  // namespace trocar::review
