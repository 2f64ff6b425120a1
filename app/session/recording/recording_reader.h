// Reads a recording back: whole chunks only, with every damage named by its byte offset.
//
// A file that stops in the middle (crash, kill -9, full disk) is readable up to its last whole chunk in both modes and
// says so in `torn`. Damage inside the file is an InputError in strict mode; tolerant mode goes on at the next whole
// chunk and lists in `damage` what is missing. A row is never guessed: it comes from a chunk whose CRC agrees.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/recording/recorded_tick.h"
#include "app/session/recording/recording_writer.h"
#include "app/session/recording/schedule.h"
#include "app/session/recording/tissue_track.h"

namespace trocar {

struct Recording {
  std::string session;    ///< the opaque text given to the writer
  std::string attempt;    ///< whose it is (seal.h); "" of no attempt, and before format 5
  std::string signed_by;  ///< public key that its last link is signed with, the one that `attempt` names; "" none
  double rate_hz = 0;
  std::uint32_t version = 0;        ///< of the format
  std::vector<RecordedTick> ticks;  ///< ticks increase; they may skip only where `damage` or the device says so
  std::vector<Event> events;
  std::string run_report_json;      ///< opaque text given to close(), empty when cut off
  Schedule schedule;                ///< empty in format 1
  TissueTrack tissue;               ///< keyframes; empty where nothing deforms and before format 4
  std::optional<RecordingEnd> end;  ///< absent when the attempt was cut off
  std::string torn;                 ///< why there is no END, empty when the recording is complete
  std::vector<std::string> damage;  ///< tolerant mode: what could not be read
  std::string sha256;               ///< of the whole file as it is
};

enum class Reading : std::uint8_t { kStrict, kTolerant };

/// Bytes that a recording may take in memory when its file has so many.
std::uint64_t most_decoded(std::uint64_t file_bytes);

/// @throws InputError naming file and offset: no such file, not a recording, newer format, damaged header, more than
/// most_decoded(); in strict mode any damage.
Recording read_recording(const std::filesystem::path& file, Reading reading = Reading::kStrict);

/// The same from bytes; `name` stands for the file in messages. @param most instead of most_decoded().
Recording parse_recording(std::string_view bytes, const std::string& name, Reading reading = Reading::kStrict,
                          std::optional<std::uint64_t> most = std::nullopt);

/// False of a file that ends before its header does: its program was killed as it began, and it says nothing.
/// @throws as read_recording().
bool recording_begins(const std::filesystem::path& file);

}  // namespace trocar
