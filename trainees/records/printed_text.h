// What people write into the record: the bounds that hold for every such text. Internal to trainees/.
#pragma once

#include <cstddef>
#include <string>

namespace trocar {

/// A name or another line that is printed: 1 to `most` bytes of UTF-8, no control characters, not only spaces.
/// @param what "name", "scale", ... for the message. @throws InputError.
void check_printed(const std::string& what, const std::string& text, std::size_t most = 100);

/// Text of several lines: 1 to `most` characters of UTF-8, no control characters but line ends and tabs, not only
/// spaces.
void check_prose(const std::string& what, const std::string& text, std::size_t most = 4000);

/// A reason that says something: prose of at least 10 characters.
void check_reason(const std::string& reason);

}  // namespace trocar
