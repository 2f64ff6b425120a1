// The station's key: an Ed25519 seed in a file beside the database, for its owner's eyes alone. Internal to trainees/
// but for key_path().
//
// trocar.db.key holds a line that says what it is, and the seed. The audit trail names the public key (in its first
// entry, and in one "station key" for each key since), every entry is signed with it (audit.h), and so is every
// recording (app/session/recording/seal.h). Who may write the database but not read this file can change nothing
// unseen. Thread: any.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "haptics/digest/signature.h"

struct sqlite3;

namespace trocar {

inline constexpr const char* kActionKey = "station key";  ///< subject: the same words, detail: the public key

std::filesystem::path key_path(const std::filesystem::path& database);

/// Empty when there is no file, in memory always. @throws EnvironmentError: others than its owner may read it, its
/// owner is neither this user nor root nor the record's, it cannot be read. InputError: it holds no key.
std::optional<SigningKey> station_key(const std::filesystem::path& database);
std::optional<SigningKey> station_key(sqlite3* connection);

/// The one that is there, else a new one. @throws as above; EnvironmentError: cannot be written.
SigningKey make_station_key(const std::filesystem::path& database);

struct AnnouncedKey {
  std::int64_t position = 0;  ///< the entry of the audit trail that names it; later ones are signed with it
  std::string public_key;
};

/// Beside a copy. @throws EnvironmentError.
void write_station_key(const std::filesystem::path& database, const SigningKey& key);

/// Whether it is one of them, so that what it signs now counts.
bool is_named(const SigningKey& key, const std::vector<AnnouncedKey>& named);

/// What to say where the record names a key and its file is gone or holds another, "" when it is there. @throws as
/// station_key().
std::string lost_key(sqlite3* connection);

/// In order; empty where the database never had one (in memory, before schema 2).
std::vector<AnnouncedKey> announced_keys(sqlite3* connection);

}  // namespace trocar
