// Recordings to the centre and back: by the SHA-256 that the attempt's hash covers, in pieces of 1 MiB, each a
// transaction of its own, so that memory stays small and a cut connection costs one piece.
#include <algorithm>
#include <fstream>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/exchange/sync/exchange.h"
#include "trainees/records/replica_facts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::sync {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPiece = 1 << 20;

struct Recorded {
  std::string uuid, sha256;
  fs::path file;
};

std::string hex(const std::string& bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  text.reserve(2 * bytes.size());
  for (const char c : bytes) {
    text += kDigits[static_cast<unsigned char>(c) >> 4];
    text += kDigits[static_cast<unsigned char>(c) & 15];
  }
  return text;
}

std::string unhex(const std::string& text) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  std::string bytes;
  bytes.reserve(text.size() / 2);
  for (std::size_t i = 0; i + 1 < text.size(); i += 2)
    bytes += static_cast<char>(digit(text[i]) * 16 + digit(text[i + 1]));
  return bytes;
}

std::size_t pieces_of(std::uintmax_t bytes) { return static_cast<std::size_t>((bytes + kPiece - 1) / kPiece); }

/// Attempts with a recording. @param others of other stations, else of this one.
std::vector<Recorded> recorded(const Database& database, bool others) {
  std::vector<Recorded> all;
  sql::Statement rows(
      database.connection(),
      std::string("SELECT uuid, recording_sha256, recording_path FROM attempt a"
                  " WHERE status <> 'running' AND recording_sha256 <> '' AND id ") +
          (others ? "" : "NOT ") +
          "IN (SELECT attempt_id FROM replica) AND trainee_id NOT IN"
          " (SELECT trainee_id FROM erasure WHERE kind = 'training' AND row_holds('erasure', id)) ORDER BY id");
  while (rows.step())
    all.push_back({rows.text(0), rows.text(1), recording_here(database.file(), rows.text(2), rows.text(0))});
  return all;
}

/// An erasure that has come meanwhile takes the attempt's recording, and what has arrived of it, away.
bool may_come(CentralLink& link, const Recorded& one) {
  return !link.run(
                  "SELECT 1 FROM attempt a WHERE uuid = $1 AND recording_sha256 = $2 AND NOT EXISTS (SELECT 1 FROM "
                  "erased_trainee e WHERE"
                  " e.trainee_uuid = a.trainee_uuid AND e.kind = 'training')",
                  {one.uuid, one.sha256})
              .empty();
}

bool send_piece(CentralLink& link, const Recorded& one, std::size_t position, const std::string& bytes) {
  link.begin();
  const bool may = may_come(link, one);
  if (may) {
    link.run("INSERT INTO recording_chunk VALUES ($1, $2::bigint, decode($3, 'hex')) ON CONFLICT DO NOTHING",
             {one.sha256, std::to_string(position), hex(bytes)});
  }
  link.commit();
  return may;
}

/// @returns whether it was completed by this call.
bool send_recording(CentralLink& link, const Recorded& one, const std::string& station) {
  const std::uintmax_t bytes = fs::file_size(one.file);
  link.begin();
  const bool may = may_come(link, one);
  if (may) {
    link.run(
        "INSERT INTO recording (sha256, attempt_uuid, bytes, chunks, station) VALUES ($1, $2, $3::bigint, $4::bigint, "
        "$5)"
        " ON CONFLICT DO NOTHING",
        {one.sha256, one.uuid, std::to_string(bytes), std::to_string(pieces_of(bytes)), station});
  }
  const auto there = link.run("SELECT count(*)::text FROM recording_chunk WHERE sha256 = $1", {one.sha256});
  link.commit();
  if (!may) return false;
  std::ifstream in(one.file, std::ios::binary);
  std::size_t position = static_cast<std::size_t>(std::stoull(*there.front()[0]));  // pieces come in order
  in.seekg(static_cast<std::streamoff>(position * kPiece));
  for (std::string piece(kPiece, '\0'); position < pieces_of(bytes); ++position) {
    in.read(piece.data(), static_cast<std::streamsize>(kPiece));
    if (!send_piece(link, one, position, piece.substr(0, static_cast<std::size_t>(in.gcount())))) return false;
  }
  link.begin();
  const bool completed = link.run("SELECT complete_recording($1)", {one.sha256}).front().front() == "t";
  link.touch();
  link.commit();
  return completed;
}

std::vector<std::string> complete_there(CentralLink& link) {
  std::vector<std::string> all;
  link.begin_reading();
  for (const Values& row : link.run("SELECT sha256 FROM recording WHERE complete ORDER BY 1")) all.push_back(*row[0]);
  link.commit();
  return all;
}

/// Goes on where an earlier one broke off. @returns whether it is whole and what was recorded.
bool fetch_recording(CentralLink& link, const Recorded& one, const fs::path& to) {
  link.begin_reading();
  const auto about = link.run("SELECT chunks::text FROM recording WHERE sha256 = $1 AND complete", {one.sha256});
  link.commit();
  if (about.empty()) return true;  // taken away meanwhile
  fs::create_directories(to.parent_path());
  fs::permissions(to.parent_path(), fs::perms::owner_all);
  const fs::path part = to.string() + ".part";
  std::error_code none;
  const std::uintmax_t size = fs::exists(part, none) ? fs::file_size(part) : 0;
  std::size_t position = static_cast<std::size_t>(size / kPiece);
  {
    std::ofstream(part, std::ios::app | std::ios::binary);
    fs::permissions(part, fs::perms::owner_read | fs::perms::owner_write);
    fs::resize_file(part, position * kPiece);
    std::ofstream out(part, std::ios::app | std::ios::binary);
    for (; position < std::stoull(*about.front()[0]); ++position) {
      link.begin_reading();
      const auto piece =
          link.run("SELECT encode(data, 'hex') FROM recording_chunk WHERE sha256 = $1 AND position = $2::bigint",
                   {one.sha256, std::to_string(position)});
      link.commit();
      if (piece.empty()) break;
      const std::string bytes = unhex(*piece.front()[0]);
      if (!out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush()) {
        throw EnvironmentError(part.string() + ": cannot be written: is the disk full?");
      }
    }
  }
  if (digest::of_readable_file(part) != one.sha256) {
    fs::remove(part, none);
    return false;
  }
  fs::rename(part, to);
  return true;
}

}  // namespace

int push_recordings(CentralLink& link, Database& database, const std::string& station,
                    std::vector<std::string>& problems) {
  const std::vector<std::string> there = complete_there(link);
  int pushed = 0;
  for (const Recorded& one : recorded(database, false)) {
    std::error_code none;
    if (std::binary_search(there.begin(), there.end(), one.sha256) || !fs::is_regular_file(one.file, none)) continue;
    if (digest::of_readable_file(one.file) != one.sha256) {
      problems.push_back("recording " + one.file.string() + ": is not what attempt " + one.uuid +
                         " recorded; not pushed");
      continue;
    }
    pushed += send_recording(link, one, station);
  }
  return pushed;
}

int fetch_recordings(CentralLink& link, Database& database, std::vector<std::string>& problems) {
  const std::vector<std::string> there = complete_there(link);
  int fetched = 0;
  for (const Recorded& one : recorded(database, true)) {
    std::error_code none;
    if (!std::binary_search(there.begin(), there.end(), one.sha256) || fs::is_regular_file(one.file, none)) continue;
    const fs::path to = fetched_recording(database.file(), one.uuid);
    if (!fetch_recording(link, one, to)) {
      problems.push_back("recording of attempt " + one.uuid +
                         ": what the centre has is not what was recorded; left out");
    } else {
      fetched += fs::is_regular_file(to, none);
    }
  }
  return fetched;
}

void drop_erased_recordings(Database& database) {
  sql::Statement rows(database.connection(),
                      "SELECT a.uuid FROM attempt a JOIN replica r ON r.attempt_id = a.id WHERE a.trainee_id IN"
                      " (SELECT trainee_id FROM erasure WHERE kind = 'training' AND row_holds('erasure', id))");
  while (rows.step()) {
    const fs::path file = fetched_recording(database.file(), rows.text(0));
    std::error_code none;
    fs::remove(file, none);
    fs::remove(file.string() + ".part", none);
  }
}

}  // namespace trocar::sync
