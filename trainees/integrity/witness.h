// Heads of the audit trail that are kept elsewhere, and the key that they are signed with: what shows a record that was
// rewritten as a whole, every hash, anchor and key of it. Thread: that of the Database.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "trainees/integrity/station_key.h"
#include "trainees/store/database.h"

namespace trocar {

/// An entry of a trail, as it can be kept elsewhere; key and signature are "" where the station has no key.
struct SignedHead {
  std::int64_t position = 0;
  std::string row_hash = {}, utc = {}, key = {}, signature = {};
};
/// @param position of an entry that is there.
SignedHead head_at(const Database& database, std::int64_t position);

/// Whether the head is what its key signed; true where there is none.
bool head_holds(const SignedHead& head);

/// Why the trail is not the one that the head was taken of; "" when it is. @param from where the head was kept.
std::string check_head(const Database& database, const SignedHead& head, const std::string& from);

/// The newest entry as JSON: {"format", "position", "row_hash", "utc", "key", "signature"}; the last two are "" where
/// the station has no key.
std::string exported_head(const Database& database);

/// Where the trail is not the one that an exported head was taken of, a line each. @throws InputError: the file is no
/// exported head, or not as it was written.
std::vector<std::string> check_witness(const Database& database, const std::filesystem::path& file);

/// Public keys that the trail names, in order.
std::vector<AnnouncedKey> station_keys(const Database& database);

/// A new key, named in the trail; the old file stays beside it under its public key. @throws EnvironmentError.
void renew_station_key(Database& database);

/// First digits of a hash or a public key, as pages and prints show them.
std::string key_words(const std::string& digits);

}  // namespace trocar
