#include "app/picture/films/film.h"

#include <algorithm>
#include <cmath>

#include "app/picture/films/side_by_side.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kLead_s = 1;  // of film before RUN begins

/// Calls paint(clock) for every picture between two clock times.
int take_pictures(double from_s, double to_s, const FilmOptions& options, const PictureSink& sink,
                  const std::function<Image(double)>& paint) {
  const int count = 1 + static_cast<int>(std::floor((to_s - from_s + 1e-9) * options.fps / options.speed));
  for (int made = 0; made < count; ++made) {
    sink(paint(from_s + made * options.speed / options.fps));
    if (options.progress && !options.progress(made + 1, count)) return made + 1;
  }
  return count;
}

}  // namespace

void check_size_for_two(int width, int height) {
  if (width >= SideBySidePainter::kLeastWidth && height >= SideBySidePainter::kLeastHeight) return;
  throw InputError("--beside: two runs need a picture of at least " + std::to_string(SideBySidePainter::kLeastWidth) +
                   " x " + std::to_string(SideBySidePainter::kLeastHeight) + " px, not " + std::to_string(width) +
                   " x " + std::to_string(height));
}

int make_film(const RecordedRun& run, const AssetRoots& assets, const FilmOptions& options, const PictureSink& sink) {
  AttemptPainter painter(assets, options.name, options.width, options.height, options.preset);
  return take_pictures(-std::min(kLead_s, run.begin_s()), film_length(run), options, sink, [&](double clock) {
    const RunMoment moment = run.at(loop_time(run, clock));
    return painter.paint(view_of(run.scene(), moment));
  });
}

int make_film(const RecordedRun& run, const RecordedRun& beside, const AssetRoots& assets, const FilmOptions& options,
              const PictureSink& sink) {
  check_size_for_two(options.width, options.height);
  SideBySidePainter painter(assets, options.width, options.height, options.preset);
  const double lead_s = std::min({kLead_s, run.begin_s(), beside.begin_s()});
  return take_pictures(-lead_s, std::max(film_length(run), film_length(beside)), options, sink, [&](double clock) {
    const RunMoment left = run.at(loop_time(run, clock)), right = beside.at(loop_time(beside, clock));
    return painter.paint({run.scene(), left, options.name, clock > film_length(run)},
                         {beside.scene(), right, options.name_beside, clock > film_length(beside)}, clock);
  });
}

}  // namespace trocar
