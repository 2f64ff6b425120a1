// Charts of the desk as inline SVG: progress of a trainee, one attempt over time and in space.
//
// No style attributes (the content security policy forbids them), no script; what can be clicked is a link. Colours of
// Okabe and Ito, and every difference of colour is one of shape, dash or width too. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "trainees/desk/queries/views.h"

namespace trocar::review {

/// Scores as a small line with the pass line dashed, from 40 (or the lowest score) to 100.
std::string spark_svg(const std::vector<double>& scores, double pass_at);

inline constexpr std::size_t kPointsDrawn = 200;  ///< newest attempts that a curve draws
/// Score by attempt: own points (filled: passed, hollow: not, cross: without a score; a diamond round what a person
/// decided), cohort quartiles shaded, pass mark, benchmark.
std::string curve_svg(const CurveView& curve);
/// A measure by attempt: own points as curve_svg() draws them, cohort quartiles shaded. @param points of the curve, of
/// which MetricCurve::values are the heights; empty for a cohort alone.
std::string metric_svg(const MetricCurve& metric, const std::vector<CurvePoint>& points);
/// Both sequential tests by attempt with their limits.
std::string cusum_svg(const CurveView& curve);
/// Minutes trained a week as bars; the newest 26 weeks.
std::string weeks_svg(const std::vector<std::pair<std::string, double>>& minutes_by_week);

/// One line of a plot over time.
struct TimeLine {
  const Trace* trace = nullptr;
  bool grip = false;  ///< grip force and not the tissue's
  std::string words = {};
  const char* colour = "#1d2630";
  const char* dash = "";
};

struct TimePlot {
  std::vector<TimeLine> lines = {};
  ForceLimits limits = {};
  std::vector<Event> events = {};     ///< numbered from 1 in this order
  double begin_s = 0;                 ///< loop time at which the traces begin; events are put there by it
  double cursor_s = -1;               ///< < 0: none
  std::string moment_href_html = {};  ///< "?...t=" to which seconds are added; "": no links
};
/// Force against time: band, limit, events by shape, cursor; strips that link to their moment. Its geometry stands in
/// data- attributes.
std::string time_plot_svg(const TimePlot& plot);
double length_s(const Trace& trace);
/// Row of the trace at that time after its beginning; the nearest. nullptr when empty.
const TraceSample* sample_at(const Trace& trace, double t_s);

/// Axes of a projection: 0 x, 1 y, 2 z; to the right, upwards.
struct Projection {
  int right = 0, up = 1;
  const char* words = "from above";
};
inline constexpr Projection kFromAbove{0, 1, "from above"}, kFromFront{0, 2, "from the front"},
    kFromSide{1, 2, "from the side"};

/// "from above (x right, y up)".
std::string axes_words(const Projection& projection);
/// Tip path coloured by force class; the place at the cursor marked.
std::string path_svg(const Trace& trace, const Projection& projection, const ForceLimits& limits, double cursor_s);

/// Ticks in square cells over the box of the tip's path.
struct Histogram2 {
  int columns = 0, rows = 0;
  double cell_m = 0, right0_m = 0, up0_m = 0;  ///< lower left corner
  std::vector<int> ticks = {};                 ///< row by row from below
  int most = 0, total = 0;
};
/// @param contacts_only counts ticks that touch. The box is that of the whole path either way. @param cells along the
/// longer side.
Histogram2 tip_histogram(const Trace& trace, const Projection& projection, bool contacts_only, int cells);
std::string heat_svg(const Trace& trace, const Projection& projection, bool contacts_only);

}  // namespace trocar::review
