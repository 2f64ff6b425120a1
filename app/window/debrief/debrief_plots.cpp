#include "app/window/debrief/debrief_plots.h"

#include <algorithm>
#include <cmath>

#include "app/window/attempt/debrief_facts.h"
#include "app/window/ui/plot.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/scoring/event_types.h"

namespace trocar {
namespace {

constexpr double kStep_s = 0.5, kWorthShowing_n = 0.03, kNear = 7;  // px at 720 lines

struct PlotShape {
  PlotMark mark;
  Ink ink;
};

PlotShape shape_of(const PlotEvent& event) {
  if (event.own) return {PlotMark::kRing, Ink::kText};
  switch (event.severity) {
    case Severity::kCritical:
    case Severity::kMajor:
      return {PlotMark::kTriangle, Ink::kAlarm};
    case Severity::kMinor:
      return {PlotMark::kDiamond, Ink::kCaution};
    case Severity::kInfo:
      break;
  }
  return {PlotMark::kDisc, Ink::kGood};
}

double peak(const std::vector<float>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

/// One of the two plots: what it shows and how tall it is.
struct Pane {
  const std::vector<float>* values;
  double factor;  // to the unit of the axis
  std::string title;
  const std::vector<WantedForce>* bands;
  double hard;
  Ink ink;
};

std::vector<Pane> panes(const Translator& w, const DebriefPlots& plots) {
  static const std::vector<WantedForce> kNone;
  if (plots.lines.speed) return {{&plots.trace->speed_mps, 1e3, w("Speed of the tip, mm/s"), &kNone, 0, Ink::kHeading}};
  std::vector<Pane> out{
      {&plots.trace->tip_n, 1, w("Force at the tip, N"), &plots.lines.tip, plots.lines.tip_hard_n, Ink::kHeading}};
  if (peak(plots.trace->grip_n) > kWorthShowing_n)
    out.push_back(
        {&plots.trace->grip_n, 1, w("Grip force, N"), &plots.lines.grip, plots.lines.grip_hard_n, Ink::kAccent});
  return out;
}

Axis y_axis(const Ui& ui, const Pane& pane, double height_px) {
  double high = std::max(1.08 * pane.factor * peak(*pane.values), 1.2 * pane.hard);
  for (const WantedForce& band : *pane.bands) high = std::max(high, 1.3 * band.high_n);
  return nice_axis(0, std::max(high, 0.5), y_ticks_for(ui, height_px));
}

Axis x_axis(const Ui& ui, const ForceTrace& trace, double width_px) {
  return nice_axis(0, trace.end_s - trace.begin_s, x_ticks_for(ui, width_px, ui.text_width("000 s")), false);
}

void draw_pane(Ui& ui, Plot& plot, const DebriefPlots& plots, const Pane& pane) {
  const Translator& w = ui.words();
  for (const WantedForce& band : *pane.bands)
    plot.band(band.low_n, band.high_n, w("wanted {0} to {1} N", {w.number(band.low_n, 2), w.number(band.high_n, 2)}));
  if (pane.hard > 0) plot.limit(pane.hard, w("limit {0} N", {w.number(pane.hard, 1)}));
  std::vector<ForceTrace::Column> columns =
      plots.trace->columns(*pane.values, plot.column_count(), plots.trace->begin_s, plots.trace->end_s);
  for (ForceTrace::Column& column : columns) {
    column.low *= pane.factor;
    column.high *= pane.factor;
  }
  plot.columns(columns, pane.ink);
}

const PlotEvent* nearest(const Plot& plot, const DebriefPlots& plots, double x_px, double reach_px) {
  const PlotEvent* best = nullptr;
  for (const PlotEvent& event : plots.events) {
    const double away = std::abs(plot.x_px(event.t_s - plots.trace->begin_s) - x_px);
    if (away <= reach_px && (!best || away < std::abs(plot.x_px(best->t_s - plots.trace->begin_s) - x_px)))
      best = &event;
  }
  return best;
}

/// Shapes with words and counts, worst first; as many lines as they need. @return lines.
int legend(Ui& ui, const DebriefPlots& plots, const Area& area, bool draw) {
  std::vector<std::pair<PlotEvent, int>> kinds;
  for (const PlotEvent& event : plots.events) {
    const auto at = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.first.text == event.text; });
    if (at == kinds.end())
      kinds.emplace_back(event, 1);
    else
      ++at->second;
  }
  std::stable_sort(kinds.begin(), kinds.end(),
                   [](const auto& a, const auto& b) { return a.first.severity > b.first.severity; });
  const double line = ui.line_height(), mark = ui.px(14);
  double x = area.x, y = area.y;
  int lines = 1;
  for (const auto& [event, count] : kinds) {
    const std::string text = event.text + " " + std::to_string(count);
    const double wide = mark + ui.text_width(text) + ui.px(14);
    if (x > area.x && x + wide > area.x + area.width) {
      x = area.x;
      y += line + ui.px(3);
      ++lines;
    }
    if (draw) {
      paint_plot_mark(ui, shape_of(event).mark, x + ui.px(5), y + line / 2, ui.px(5), shape_of(event).ink);
      ui.text_at(x + mark, y, text, Ink::kDim, area.width - mark);
    }
    x += wide;
  }
  return kinds.empty() ? 0 : lines;
}

void draw_events(Ui& ui, const Plot& first, const DebriefPlots& plots, double y) {
  for (const Severity severity : {Severity::kInfo, Severity::kMinor, Severity::kMajor, Severity::kCritical})
    for (const PlotEvent& event : plots.events)
      if (event.severity == severity)
        paint_plot_mark(ui, shape_of(event).mark, first.x_px(event.t_s - plots.trace->begin_s), y, ui.px(5),
                        shape_of(event).ink);
}

/// "12.4 s  0.62 N  Too much force"
std::string cursor_text(const Ui& ui, const DebriefPlots& plots, const Pane& pane, double t_s, const PlotEvent* event) {
  const Translator& w = ui.words();
  const double value = pane.factor * plots.trace->at(*pane.values, t_s);
  std::string text = w.number(t_s - plots.trace->begin_s, 1) + " s  " +
                     (plots.lines.speed ? w.number(value, 0) + " mm/s" : w.number(value, 2) + " N");
  if (event) text += "  " + event->text;
  return text;
}

void move_cursor(const ForceTrace& trace, std::optional<double>& cursor_s, int steps) {
  if (steps == 0) return;
  cursor_s = std::clamp(cursor_s.value_or(trace.begin_s) + kStep_s * steps, trace.begin_s, trace.end_s);
}

}  // namespace

ForceLines force_lines(const Exercise& exercise, const std::string& level_name) {
  ForceLines out;
  const ExerciseLevel* level = level_named(exercise, level_name);
  out.speed = kind_of(exercise).watched == WatchedForce::kNone;
  out.tip_hard_n = exercise.hard_force_n;
  if (kind_of(exercise).watched != WatchedForce::kTip) return out;
  if (level) out.tip = level->bands;
  out.grip = {{exercise.grip.low_n, exercise.grip.high_n}};
  out.grip_hard_n = exercise.grip.excess_n;
  return out;
}

std::vector<PlotEvent> plot_events(const Translator& words, const std::vector<Event>& events, const ForceTrace& trace) {
  std::vector<PlotEvent> out;
  for (const Event& event : events) {
    const std::string text = event_words(words, event);
    if (!text.empty() && event.t_s >= trace.begin_s && event.t_s <= trace.end_s)
      out.push_back({event.t_s, event.severity, text, event.type == event_type::kMarked});
  }
  return out;
}

std::optional<double> worst_moment(const std::vector<PlotEvent>& events) {
  const PlotEvent* worst = nullptr;
  for (const PlotEvent& event : events)
    if (event.severity >= Severity::kMinor && (!worst || event.severity > worst->severity)) worst = &event;
  return worst ? std::optional(worst->t_s) : std::nullopt;
}

std::optional<double> draw_debrief_plots(Ui& ui, const DebriefPlots& plots, std::optional<double>& cursor_s,
                                         double height_at_720) {
  const Area area = ui.drawing("plots", height_at_720);
  const Ui::Pointer pointer = ui.pointer();
  move_cursor(*plots.trace, cursor_s, ui.key_steps());
  const double line = ui.line_height(), strip = plots.events.empty() ? 0 : ui.px(16);
  const double legend_high = legend(ui, plots, area, false) * (line + ui.px(3));
  const std::vector<Pane> all = panes(ui.words(), plots);
  const double each =
      (area.height - legend_high - strip - (all.size() > 1 ? ui.px(8) : 0)) / static_cast<double>(all.size());
  std::vector<PlotScales> scales;
  double left = 0;
  for (const Pane& pane : all) {
    scales.push_back({x_axis(ui, *plots.trace, area.width), y_axis(ui, pane, each - 2.4 * line), "s", pane.title,
                      &pane == &all.back(), false, 0});
    left = std::max(left, Plot::left_room(ui, scales.back().y));
  }
  std::optional<double> clicked;
  double y = area.y;
  for (std::size_t i = 0; i < all.size(); ++i) {
    scales[i].left_px = left;
    Plot plot(ui, {area.x, y, area.width, each}, scales[i]);
    draw_pane(ui, plot, plots, all[i]);
    const double pointed_s = plots.trace->begin_s + plot.x_at(pointer.x);
    if (pointer.clicked) clicked = pointed_s;
    const PlotEvent* by_pointer = pointer.over ? nearest(plot, plots, pointer.x, ui.px(kNear)) : nullptr;
    if (pointer.over)
      plot.cursor(pointed_s - plots.trace->begin_s,
                  cursor_text(ui, plots, all[i], pointed_s, i == 0 ? by_pointer : nullptr));
    if (cursor_s) {
      const PlotEvent* event = nearest(plot, plots, plot.x_px(*cursor_s - plots.trace->begin_s), ui.px(2));
      plot.cursor(*cursor_s - plots.trace->begin_s,
                  pointer.over ? "" : cursor_text(ui, plots, all[i], *cursor_s, i == 0 ? event : nullptr));
    }
    plot.labels();
    y += each + (i == 0 && all.size() > 1 ? ui.px(8) : 0);
    if (i + 1 == all.size() && strip > 0) draw_events(ui, plot, plots, y + strip / 2);
  }
  legend(ui, plots, {area.x, y + strip, area.width, legend_high}, true);
  return clicked;
}

}  // namespace trocar
