// T3: what will be done and measured, on one page; beside it the device is checked, or without one it says what moves
// what. Enter starts.
//
// At 720 lines and scale 1 everything stands on the page; with larger text the page keys move it. Thread: the window's.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/device/device_check.h"
#include "app/window/lessons/lesson_words.h"
#include "app/window/practice/practice_model.h"
#include "app/window/practice/screen.h"
#include "app/window/ui/ui.h"

namespace trocar {

/// A line of the device check as a trainee reads it: "Weight left over 0.04 N (limit 0.20 N)".
std::string check_words(const Translator& words, const DeviceCheck::Line& line);

class BriefingScreen final : public Screen {
 public:
  /// @param limits of the device check; tests make them fail.
  explicit BriefingScreen(const CheckLimits& limits = {}) : limits_(limits) {}
  std::optional<ScreenName> frame(Ui& ui, PracticeModel& model, double dt_s) override;
  void settle(PracticeModel& model, double wait_s) override;
  bool takes_escape() const override { return true; }

 private:
  void load(PracticeModel& model);
  void head(Ui& ui, PracticeModel& model) const;
  void column(Ui& ui, PracticeModel& model, const Area& area);
  void sheet(Ui& ui, PracticeModel& model, const Area& area);
  std::string page(Ui& ui, PracticeModel& model);
  std::string explanation(Ui& ui, PracticeModel& model);
  void steps(Ui& ui) const;
  void stage_words(Ui& ui, PracticeModel& model) const;
  void limits(Ui& ui, PracticeModel& model) const;
  void measures(Ui& ui, PracticeModel& model) const;
  void hand(Ui& ui, PracticeModel& model) const;
  std::optional<ScreenName> start(PracticeModel& model);

  CheckLimits limits_;
  std::unique_ptr<DeviceCheck> check_;  ///< null: no device, or a real one
  std::string shown_;                   ///< exercise and level that the texts below are of
  std::vector<LessonStep> steps_;
  std::vector<LessonLimit> rows_;
  std::vector<LessonMeasure> measures_;
  std::shared_future<std::string> organ_;  ///< its credit
  std::string credit_;
  bool explaining_ = false;
  std::size_t measure_ = 0;
  std::string locked_;  ///< why the level cannot be started; empty: it can
  std::string wrong_;
};

}  // namespace trocar
