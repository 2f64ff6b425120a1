// Asks for a new password: unseen and twice at a terminal, else the first line of what comes in. Thread: the one that
// made it.
#pragma once

#include <iosfwd>
#include <string>

namespace trocar {

/// @param in std::cin: a terminal behind it is asked; any other stream is read. @throws InputError: nothing there, or
/// two different ones.
std::string new_password(const std::string& login, std::istream& in, std::ostream& err);

/// The same of the present one, which is asked for once.
std::string present_password(const std::string& login, std::istream& in, std::ostream& err);

}  // namespace trocar
