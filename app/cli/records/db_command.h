// `trocar db check|backup|migrate|anchor|rubric`. InputError and EnvironmentError leave as they are.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace trocar {

struct DbOptions {
  std::filesystem::path database;         ///< empty: the default path
  std::filesystem::path output;           ///< of backup; empty: DATABASE.TIME.backup beside it
  bool json = false;                      ///< of check
  std::string rubric{};                   ///< of rubric: beginning of its sha256
  bool leave_recordings = false;          ///< of backup
  bool quick = false;                     ///< of check: recordings by their digests alone
  std::string witness{};                  ///< of check: file of a head that was exported before, or address of a centre
  std::filesystem::path password_file{};  ///< of check: for the centre
  bool weak_tls = false;                  ///< of check: likewise
  bool renew = false;                     ///< of key
};

/// File, schema with its triggers, references, hash chain, audit trail and its signatures, anchor, rubrics; each
/// recording's bytes, whose it is, and the score that it gives.
/// @return exit code 0 when sound, 2 when anything is not; the problems are the result.
int db_check(const DbOptions& options, std::ostream& out, std::ostream& err);
/// @return exit code 0; the copy's path is the result, its recordings' folder and size stand on `err`. Never overwrites
/// (InputError).
int db_backup(const DbOptions& options, std::ostream& out, std::ostream& err);
/// Brings the database to this program's schema, which every command does by itself, and says so.
/// @return exit code 0
int db_migrate(const DbOptions& options, std::ostream& out, std::ostream& err);
/// Begins a new anchor file. @return exit code 0; the head of the audit trail is the result.
int db_anchor(const DbOptions& options, std::ostream& out, std::ostream& err);
/// The public key of the station; with `renew` a new one, which the audit trail tells. @return exit code 0
int db_key(const DbOptions& options, std::ostream& out, std::ostream& err);
/// Head of the audit trail, signed by the station's key, as JSON: to `output`, else it is the result. @return exit code
/// 0
int db_head(const DbOptions& options, std::ostream& out, std::ostream& err);
/// The exercise file that attempts were graded by, whether or not it still exists elsewhere. @return exit code 0
int db_rubric(const DbOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
