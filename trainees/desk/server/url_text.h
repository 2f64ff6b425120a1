// Text of addresses and posted forms: decoding (RFC 3986, the HTML form encoding), and what may stand in a redirection.
//
// Everything is decoded once. What is not UTF-8, or has control characters, is refused and never repaired. Pure.
// Thread: any.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace trocar::review {

/// "%41" becomes "A". @returns nothing for a broken escape, text that is not UTF-8, and control characters but tab and
/// line ends.
std::optional<std::string> percent_decoded(std::string_view text, bool plus_is_space);

/// Letters, digits and -._~ stay; the rest becomes %XX.
std::string percent_encoded(std::string_view text);

/// "a=1&b=2" as map; the last of a name stands; CR LF and CR become LF. @returns nothing when a part cannot be decoded,
/// or there are more than `most`.
std::optional<std::map<std::string, std::string>> form_fields(std::string_view text, std::size_t most = 1000);

/// A path of this desk: one '/' at its beginning, visible ASCII without backslash, at most 1000 bytes. What leads
/// elsewhere is none.
bool local_path(std::string_view text);

/// What stands behind "Location:": `path` if it is of this desk, with what must not stand there encoded; else "/".
std::string redirection_to(std::string_view path);

/// A file name for "Content-Disposition": letters, digits and ._- (others become _), no dot at its beginning, at most
/// 100.
std::string download_name(std::string_view name);

}  // namespace trocar::review
