// What binds a recording: whose attempt it is, from its first chunk, and a chain over all its bytes that the station
// signs.
//
// Every piece that is written ends with a LINK chunk: hash_n = SHA-256(hash_(n-1) + the bytes since the link before, or
// since the file's beginning), and the signature of link_text(hash_n) where the station has a key. So nothing can be
// exchanged, left out, added or moved to another attempt without the key. A recording that is of no attempt (run
// --record without a database, a sweep) has links and no signature. Thread: any.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "haptics/digest/signature.h"

namespace trocar {

/// What a recording is given when it begins.
struct RecordingSeal {
  std::string attempt = {};  ///< what the store says of the attempt (attempt_store.h), JSON; "" of none
  std::optional<SigningKey> key = {};
};

/// What the station's key signs of a link.
std::string link_text(std::string_view hash);

/// Payload of the LINK behind these bytes; the hash is its first 64 characters. @param before the hash of the link
/// before, "" for the first.
std::string make_link(std::string_view before, std::string_view bytes, const std::optional<SigningKey>& key);

inline constexpr std::size_t kLinkHashSize = 64;

/// A field of what the store says of the attempt, "" where it is not there.
std::string attempt_field(const std::string& attempt, const std::string& name);

}  // namespace trocar
