// `trocar replay` and `trocar score`: a recording run again, also as a film, and graded again.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

namespace trocar {

struct RecordingOptions {
  std::string subject;               ///< recording file, or attempt ("latest", part of a UUID)
  std::filesystem::path database;    ///< for attempts; empty: the default path
  bool verify = false;               ///< replay: compare the state hash
  std::filesystem::path frames;      ///< replay: pictures
  std::filesystem::path video = {};  ///< replay: film
  std::string beside = {};           ///< replay: second run of the film: recording, attempt, or "expert"
  std::optional<double> fps;         ///< none: 10 of pictures, 25 of a film
  std::string preset = "auto";       ///< replay: of a film's pictures: low, soft, full; auto: as the machine draws
  double speed = 1;                  ///< replay: loop seconds a second of film
  int width = 1280, height = 720;    ///< replay: px
  std::string organ;                 ///< replay: where the organ lies now, when it has moved
  std::string rubric;                ///< score: another exercise file whose rubric to use
  bool json = false;
};

/// @return 0; 2 when --verify finds another hash. @throws InputError: organ missing or changed, a film's name;
/// EnvironmentError: ffmpeg.
int replay_command(const RecordingOptions& options, std::ostream& out, std::ostream& err);

/// @return 0 when the grade passes, 1 when not, 4 for a device fault; 2 when a stored attempt's own recording and
/// rubric no longer give its stored score (to 1e-9).
int score_command(const RecordingOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
