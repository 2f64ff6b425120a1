// The folder of a sweep: files of rows that only grow, and the rulesets that graded them.
//
//   attempts.jsonl           one row a line (sweep_row.h), from a sweep or merged
//   attempts.3-of-8.jsonl    the same from one of several jobs
//   rulesets/SHA256.toml     exercise files, byte by byte
//
// Survives a kill: a row is one write behind the last one, and what a kill has cut off has no end of line and is
// dropped. One process writes a file at a time, and none while the folder is merged (flock(2) on file and folder).
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>

#include "app/cli/sweep/sweep_row.h"

namespace trocar {

/// Where it is missing, with what is missing on the way. @throws EnvironmentError
void make_folder(const std::filesystem::path& folder);

/// Rows by their attempt. Refuses what cannot be of one sweep.
class SweepRows {
 public:
  struct Placed {
    SweepRow row;
    std::string line, where;  ///< as it stands, and "FILE:LINE"
  };

  /// A row that is there already changes nothing. @throws InputError naming both places: another outcome of the same
  /// attempt; another ruleset of the exercise, script of the hand or version of the program.
  void take(SweepRow row, const std::string& line, const std::string& where);
  /// The same, of an attempt that has not been made yet. @returns whether it is there already.
  bool has(const SweepRow& planned, const std::string& where);

  /// Every file of rows of a folder. @param err learns of a line that was cut off. @throws InputError "FILE:LINE: ..."
  void read(const std::filesystem::path& folder, std::ostream& err);

  const std::map<SweepKey, Placed>& all() const { return rows_; }

 private:
  void take_edition(const std::string& what, const std::string& of, const std::string& edition,
                    const std::string& where);
  void take_editions(const SweepRow& row, const std::string& where);

  std::map<SweepKey, Placed> rows_;
  std::map<std::string, std::pair<std::string, std::string>> editions_;  ///< of what: which, and where first seen
};

/// A lock on a file or folder until it goes. Not of a file system without flock(2): there the user sees to it.
class PathLock {
 public:
  enum class Kind : std::uint8_t { kShared, kAlone };
  /// @throws InputError: somebody else has it. EnvironmentError: cannot be opened.
  PathLock(const std::filesystem::path& path, Kind kind, const std::string& held_words);
  ~PathLock();
  PathLock(const PathLock&) = delete;
  PathLock& operator=(const PathLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// One of the folder's files, open for more rows.
class RowWriter {
 public:
  /// Makes the folder where it is missing; drops a line that a kill has cut off, and says so.
  /// @param name "attempts.jsonl". @throws InputError, EnvironmentError.
  RowWriter(const std::filesystem::path& folder, const std::string& name, std::ostream& err);
  ~RowWriter();
  RowWriter(const RowWriter&) = delete;
  RowWriter& operator=(const RowWriter&) = delete;

  /// On the disk when it returns. @throws EnvironmentError.
  void add(const std::string& line);

 private:
  std::filesystem::path file_;
  std::unique_ptr<PathLock> folder_lock_, file_lock_;
  int descriptor_ = -1;
};

/// "attempts.jsonl", or "attempts.3-of-8.jsonl" of part 3 of 8. @param parts 0: not in parts.
std::string rows_file(int part, int parts);

/// Keeps the exercise's file beside the rows that it graded.
void keep_ruleset(const std::filesystem::path& folder, const std::string& sha256, const std::string& text);
/// @throws InputError: missing, or not the bytes that its name says.
std::string kept_ruleset(const std::filesystem::path& folder, const std::string& sha256);

}  // namespace trocar
