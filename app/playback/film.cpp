#include "app/playback/film.h"

#include <algorithm>

#include "app/playback/side_by_side.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kLead_s = 1;  // of film before RUN begins

/// Calls paint(clock) for every picture between two clock times.
int take_pictures(double from_s, double to_s, const FilmOptions& options, const PictureSink& sink, const std::function<Image(double)>& paint) {
  int made = 0;
  for (double clock = from_s; clock <= to_s + 1e-9; clock = from_s + made * options.speed / options.fps) {
    sink(paint(clock));
    ++made;
    if (options.progress && !options.progress(to_s > from_s ? (clock - from_s) / (to_s - from_s) : 1)) break;
  }
  return made;
}

}  // namespace

int make_film(const RecordedRun& run, const AssetRoots& assets, const FilmOptions& options, const PictureSink& sink) {
  AttemptPainter painter(run.scene(), assets, options.name, options.width, options.height);
  return take_pictures(-std::min(kLead_s, run.begin_s()), film_length(run), options, sink, [&](double clock) {
    const RunMoment moment = run.at(loop_time(run, clock));
    return painter.paint(view_of(run.scene(), moment));
  });
}

int make_film(const RecordedRun& run, const RecordedRun& beside, const AssetRoots& assets, const FilmOptions& options, const PictureSink& sink) {
  if (options.width < SideBySidePainter::kLeastWidth || options.height < SideBySidePainter::kLeastHeight) {
    throw InputError("two runs side by side need a picture of at least " + std::to_string(SideBySidePainter::kLeastWidth) + " x " +
                     std::to_string(SideBySidePainter::kLeastHeight) + " px");
  }
  SideBySidePainter painter(run.scene(), beside.scene(), assets, options.width, options.height);
  const double lead_s = std::min({kLead_s, run.begin_s(), beside.begin_s()});
  return take_pictures(-lead_s, std::max(film_length(run), film_length(beside)), options, sink, [&](double clock) {
    const RunMoment left = run.at(loop_time(run, clock)), right = beside.at(loop_time(beside, clock));
    return painter.paint({run.scene(), left, options.name, clock > film_length(run)},
                         {beside.scene(), right, options.name_beside, clock > film_length(beside)}, clock);
  });
}

}  // namespace trocar
