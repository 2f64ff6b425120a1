// From a run, or two, to the pictures of a film, in order.
//
// The film begins 1 s before RUN and ends with the longer run; two runs are aligned at RUN's beginning. A picture
// stands for speed/fps s of loop time. Same runs, same options, same driver: same pictures. Thread: the caller's.
#pragma once

#include <functional>
#include <string>

#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/scene/preset.h"
#include "app/session/playback/recorded_run.h"

namespace trocar {

struct FilmOptions {
  double fps = 25, speed = 1;      ///< pictures a second of film; loop seconds a second of film
  int width = 1280, height = 720;  ///< px
  std::string name = {};           ///< of the run: trainee's code
  std::string name_beside = {};
  Preset preset = Preset::kFull;
  std::function<bool(int, int)> progress =
      {};  ///< pictures made, and how many there will be; false: the film ends here
};

/// One run with its head-up display. @return pictures made.
int make_film(const RecordedRun& run, const AssetRoots& assets, const FilmOptions& options, const PictureSink& sink);
/// Two runs side by side. @throws InputError for a picture that is too small for two.
int make_film(const RecordedRun& run, const RecordedRun& beside, const AssetRoots& assets, const FilmOptions& options,
              const PictureSink& sink);

/// What that would refuse, before any work.
void check_size_for_two(int width, int height);

/// A moment of a run on the common clock. @param clock_s seconds since RUN began, may be negative.
inline double loop_time(const RecordedRun& run, double clock_s) { return run.begin_s() + clock_s; }
/// Seconds from RUN's beginning to the end.
inline double film_length(const RecordedRun& run) { return run.end_s() - run.begin_s(); }

}  // namespace trocar
