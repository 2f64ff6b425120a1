// Force over time of an attempt: tip and grip with band, limit and events by shape, and a cursor that chooses a moment.
//
// Times on the axis are the exercise's clock, 0 at START; chosen moments are loop time. Thread: the window's, within a
// frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/window/attempt/force_trace.h"
#include "app/window/ui/ui.h"
#include "scenarios/exercise.h"

namespace trocar {

/// What is wanted and what is too much, N.
struct ForceLines {
  std::vector<WantedForce> tip = {}, grip = {};
  double tip_hard_n = 0, grip_hard_n = 0;  ///< 0: none
  bool speed = false;                      ///< nothing is touched in this exercise: the tip's speed is shown
};
ForceLines force_lines(const Exercise& exercise, const std::string& level);

/// An event that a plot shows.
struct PlotEvent {
  double t_s = 0;  ///< loop time
  Severity severity = Severity::kInfo;
  std::string text;
  bool own = false;  ///< the trainee marked it
};
/// Those within the trace that a trainee should see (event_words).
std::vector<PlotEvent> plot_events(const Translator& words, const std::vector<Event>& events, const ForceTrace& trace);
/// The first of the worst: where to look first. Nothing without an event worth it.
std::optional<double> worst_moment(const std::vector<PlotEvent>& events);

struct DebriefPlots {
  const ForceTrace* trace = nullptr;
  ForceLines lines = {};
  std::vector<PlotEvent> events = {};
};

/// Draws into the room that is left of the panel, `height_at_720` high. @param cursor_s loop time, moved by keys.
/// @return a moment that was clicked.
std::optional<double> draw_debrief_plots(Ui& ui, const DebriefPlots& plots, std::optional<double>& cursor_s,
                                         double height_at_720);

}  // namespace trocar
