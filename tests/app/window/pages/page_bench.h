// Pages in memory for tests, with results to show; a picture of each when TROCAR_PAGE_PICTURES names a folder.
#pragma once

#include <cstdlib>

#include "app/picture/gl/image.h"
#include "app/window/attempt/advice.h"
#include "app/window/debrief/debrief_page.h"
#include "tests/app/window/attempt/attempt_samples.h"
#include "tests/app/window/pages/layout_check.h"
#include "tests/app/window/pages/ui_bench.h"
#include "trainees/records/attempt_store.h"

namespace trocar::testing_support {

class PageBench : public UiBench {
 protected:
  void expect_clear(const std::string& where) const { expect_laid_out(texts_, width_, height_, where); }
  bool says(const std::string& part) const {
    return std::any_of(texts_.begin(), texts_.end(),
                       [&](const DrawnText& t) { return t.text.find(part) != std::string::npos; });
  }
  void picture(const std::string& name) const {
    const char* folder = std::getenv("TROCAR_PAGE_PICTURES");
    if (folder && *folder) write_png(std::filesystem::path(folder) / (name + ".png"), target_->read());
  }

  /// As the screen makes it.
  DebriefContent content_of(const AttemptResult& result, const Exercise& exercise, const DebriefPast& past = {}) {
    DebriefContent c;
    c.heading = exercise.number + " " + exercise.title + ", " + result.level + ", board 4, by mouse";
    c.facts = debrief_facts(words_, result, exercise, past);
    c.advice = advice(words_, result, c.facts, exercise);
    for (const DebriefRow& row : c.facts.rows) c.explained.push_back(explained(words_, row, result, exercise));
    c.plots.lines = force_lines(exercise, result.level);
    trace_ = force_trace(pressing_trace(), pressing_events());
    c.plots.trace = &trace_;
    c.plots.events = plot_events(words_, result.events, trace_);
    c.can_watch = c.can_compare = true;
    c.next_name = "E02 L2";
    return c;
  }
  ForceTrace trace_;
};

/// Kept as if it had been done now. @param recording empty: none. @return its uuid.
inline std::string stored(const std::filesystem::path& database, AttemptResult result, const Exercise& exercise,
                          const std::string& trainee, int board, const std::filesystem::path& recording = {}) {
  Database opened(database);
  AttemptStart start;
  start.trainee = trainee;
  start.exercise_id = result.exercise_id;
  start.exercise_version = result.exercise_version;
  start.exercise_number = exercise.number;
  start.exercise_title = exercise.title;
  start.exercise_text = exercise.text;
  start.level = result.level;
  start.hand = result.hand;
  start.board = board;
  start.program = "0";
  start.recording = recording;
  const AttemptId id = AttemptStore(opened).begin_attempt(start);
  result.recording_path = recording.string();
  AttemptStore(opened).finish_attempt(id, result);
  return id.uuid;
}

/// A run of somebody who pressed too hard and too long, with a past to compare with.
inline AttemptResult heavy_run(const Exercise& exercise) {
  AttemptResult result = graded(exercise, "L1",
                                {{"excess_events", 4},
                                 {"object_in_band_share", 0.72},
                                 {"time_s", 61.5},
                                 {"path_ratio", 1.52},
                                 {"wrong_places", 1}});
  result.events = pressing_events();
  put_caps(result, exercise);
  return result;
}

inline AttemptResult good_run(const Exercise& exercise) {
  AttemptResult result =
      graded(exercise, "L1", {{"object_in_band_share", 0.91}, {"time_s", 44.2}, {"path_ratio", 1.31}});
  result.events = pressing_events();
  return result;
}

inline DebriefPast some_past(const AttemptResult& result) {
  DebriefPast past;
  for (int n = 0; n < 6; ++n)
    past.own.push_back(past_run(result, n, 60 + 4 * n, n > 3,
                                {{"time_s", 70.0 - 3 * n},
                                 {"object_in_band_share", 0.6 + 0.03 * n},
                                 {"excess_events", 5.0 - n},
                                 {"path_ratio", 1.7 - 0.05 * n},
                                 {"wrong_places", n % 3}}));
  past.expert = {{"time_s", 37.1},
                 {"object_in_band_share", 0.97},
                 {"excess_events", 0},
                 {"path_ratio", 1.12},
                 {"wrong_places", 0}};
  return past;
}

}  // namespace trocar::testing_support
