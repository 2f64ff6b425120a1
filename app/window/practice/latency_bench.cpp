#include "app/window/practice/latency_bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "app/picture/gl/headless_context.h"
#include "app/window/practice/practice_loop.h"
#include "app/window/run/run_screen.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

double percentile(std::vector<double> sorted, double share) {
  if (sorted.empty()) return 0;
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

/// The pointer on a circle, a step a frame.
InputEvent circling(int frame, int width, int height) {
  InputEvent event;
  event.kind = InputEvent::Kind::kMouseMove;
  event.x = 0.4 * width + 60 * std::cos(0.1 * frame);
  event.y = 0.5 * height + 60 * std::sin(0.1 * frame);
  return event;
}

/// Nothing of a person's own is read or kept.
ModelOptions nobody() {
  ModelOptions options;
  options.database = ":memory:";
  options.settings = "/dev/null/none";
  options.exercise = "surface-touch";
  options.language = "en";
  options.seed = 1;
  return options;
}

}  // namespace

PictureLatency measure_picture_latency(const AssetRoots& assets, double seconds, int width, int height) {
  PracticeModel model(nobody(), assets);
  HeadlessContext context;
  PracticeLoop loop(model, context, false);
  loop.keep_rate();
  if (const std::string hindered = model.begin_attempt(); !hindered.empty())
    throw EnvironmentError("no attempt to measure: " + hindered);
  loop.go(ScreenName::kRun);
  PictureLatency out;
  out.renderer = context.info().renderer;
  out.width = width;
  out.height = height;
  std::vector<double> frames, latencies;
  Clock::time_point last = Clock::now();
  std::optional<Clock::time_point> begin;
  while (!begin || seconds_since(*begin) < seconds) {
    const double dt_s = seconds_since(last);
    last = Clock::now();
    if (!begin && model.running() && model.running()->ready()) begin = last;
    if (!model.running()) throw EnvironmentError("the attempt to measure has ended: " + model.notice);
    if (begin) frames.push_back(dt_s);
    loop.frame(width, height, dt_s, {circling(static_cast<int>(frames.size()), width, height)});
    loop.finish();  // as showing it would
    if (const auto* run = dynamic_cast<const RunScreen*>(loop.screen())) latencies = run->latency().sorted();
  }
  out.frames = static_cast<int>(frames.size());
  out.events = static_cast<int>(latencies.size());
  out.frame_median_s = percentile(frames, 0.5);
  out.frame_p95_s = percentile(frames, 0.95);
  out.median_s = percentile(latencies, 0.5);
  out.p95_s = percentile(latencies, 0.95);
  out.longest_s = percentile(latencies, 1);
  return out;
}

}  // namespace trocar
