// T2: the course. Left the exercises by level and how the trainee stands to each, right a card of the chosen one.
//
// Arrows choose, Enter opens the briefing. Thread: the window's.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/window/lessons/lesson_picture.h"
#include "app/window/practice/practice_model.h"
#include "app/window/practice/screen.h"
#include "app/window/ui/ui.h"

namespace trocar {

/// How progress at a level is shown: a shape with words, colour only beside them.
Mark progress_mark(const LevelProgress& progress);
/// "L1: passed 2 x", "L2: needs L1 passed 3 x in a row".
std::string progress_words(const Translator& words, const Exercise& exercise, const std::string& level,
                           const LevelProgress& progress);
/// What the newest attempt of all was of; none before the first.
struct LastTried {
  std::string exercise_id, level, started_utc;
};

class CurriculumScreen final : public Screen {
 public:
  std::optional<ScreenName> frame(Ui& ui, PracticeModel& model, double dt_s) override;
  std::optional<Stage> stage(PracticeModel& model, int width, int height) override;
  void settle(PracticeModel& model, double wait_s) override { picture_.settle(model, wait_s); }
  bool takes_escape() const override { return true; }

 private:
  struct Row {
    const Exercise* exercise;
    std::string level;
    LevelProgress progress;
  };
  void load(PracticeModel& model);
  void keys(const Ui& ui, PracticeModel& model);
  void choose(PracticeModel& model, std::size_t row);
  void tree(Ui& ui, PracticeModel& model, const Area& area);
  void card(Ui& ui, PracticeModel& model, const Area& area);
  void wide_card(Ui& ui, PracticeModel& model, const Area& area);
  void head(Ui& ui, PracticeModel& model) const;
  void facts(Ui& ui, PracticeModel& model, double sparkline_at_720) const;
  void advice(Ui& ui, PracticeModel& model) const;
  void programme(Ui& ui, const PracticeModel& model) const;
  void caption(Ui& ui, const PracticeModel& model) const;
  std::optional<ScreenName> act(const std::string& chosen, PracticeModel& model);

  std::vector<Row> rows_;
  std::size_t chosen_ = 0;
  std::optional<std::size_t> revealed_;  // the chosen row that the list has been scrolled to
  PracticeModel::Advice next_;
  std::optional<LastTried> last_;
  std::string wrong_;
  LessonPicture picture_;
  Area picture_area_;
  double dt_s_ = 0;
};

}  // namespace trocar
