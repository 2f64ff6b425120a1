// What libpq is given for a central database's address, and what its refusals mean. Internal to
// trainees/exchange/sync.
#pragma once

#include <string>

#include "trainees/exchange/sync/synchronise.h"

namespace trocar::sync {

/// The address with password, time-outs, and what proves who answers: beyond this machine sslmode=verify-full, whatever
/// PGSSLMODE says. This machine is a socket, localhost, 127.0.0.0/8 or ::1. @throws InputError: not an address, holds a
/// password, file unfit, a weaker sslmode without `weak_tls`.
std::string connection_text(const CentralAddress& address);

/// What is to be said about a connection that checks less than it could; "" when there is nothing.
std::string weak_tls_remark(const CentralAddress& address);

/// What libpq says when it cannot connect, with what is missing where TLS is refused.
std::string connecting_words(const std::string& libpq);

/// What the server keeps of a role's password, so that the password itself goes into no log of it. @throws
/// EnvironmentError: not reached.
std::string encrypted_password(const CentralAddress& address, const std::string& role, const std::string& password);

}  // namespace trocar::sync
