// What a password or PIN must be, and what anybody would try first. Pure. Thread: any.
#pragma once

#include <string>

#include "trainees/records/accounts.h"

namespace trocar {

/// 10 to 1024 characters, of a trainee also a PIN of 6 digits; not few characters over and over, no sequence of
/// neighbours (in the alphabet, among digits, on a keyboard), not the login, not one of the most common ones. Of what
/// stays a guesser who may try some 100 a day finds little.
/// @throws InputError: what is wrong with it.
void check_password(const std::string& password, Role role, const std::string& login);

/// Only PINs look so; a password never does. PINs and passwords are held back apart from one another.
bool looks_like_pin(const std::string& given);

}  // namespace trocar
