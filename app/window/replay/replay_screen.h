// The film of a run: scope's picture, forces, and a time line to scrub; the expert beside it when wanted.
//
// Shows model.replay_file (empty: the last attempt's recording) from model.replay_at_s on; beside it
// model.replay_beside (empty: the expert on the same board, made when first asked for). Thread: the window's; the runs
// have their own.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/playback/expert_run.h"
#include "app/session/playback/recorded_run.h"
#include "app/window/practice/screen.h"
#include "app/window/replay/replay_clock.h"
#include "app/window/replay/replay_events.h"
#include "app/window/ui/button_row.h"

namespace trocar {

class ReplayScreen final : public Screen {
 public:
  std::optional<ScreenName> frame(Ui& ui, PracticeModel& model, double dt_s) override;
  std::optional<Stage> stage(PracticeModel& model, int width, int height) override;
  std::optional<Stage> second_stage(PracticeModel& model, int width, int height) override;
  void settle(PracticeModel& model, double wait_s) override;
  bool takes_escape() const override { return true; }

  const ReplayClock& clock() const { return clock_; }
  bool beside() const { return beside_wanted_; }

 private:
  /// One of the two runs.
  struct Side {
    std::filesystem::path file;
    std::optional<RecordedRun> run;
    std::string name;  ///< once it is shown
    bool shown() const { return seen; }
    void look_after(const PracticeModel& model);
    bool seen = false;  ///< there has been something to show
  };
  void open(PracticeModel& model);
  void look_after(PracticeModel& model, double dt_s);
  void ask_beside(PracticeModel& model);
  Stage stage_of(const Side& side, double x, double width) const;
  void keys(Ui& ui);
  std::optional<ScreenName> panel(Ui& ui);
  void heading(Ui& ui) const;
  void forces(Ui& ui) const;
  void force_of(Ui& ui, const Side& side, const Area& area) const;
  void time_line(Ui& ui, double height_px);
  std::vector<RowButton> buttons(const Translator& w) const;
  std::optional<ScreenName> act(const std::string& chosen);
  std::string state_words(const Translator& w) const;
  bool two() const { return beside_wanted_ && beside_.shown(); }

  bool opened_ = false, beside_wanted_ = false;
  std::string nothing_;  ///< why there is nothing to see
  Side own_, beside_;
  std::filesystem::path beside_file_;
  ExpertRun expert_;
  ReplayClock clock_;
  std::optional<double> begin_at_s_;  ///< loop time
  std::vector<ReplayEvent> events_;
  double picture_height_ = 0;
};

}  // namespace trocar
