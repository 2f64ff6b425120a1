// T5: what the attempt was worth, why, and the one thing to try next. The page is drawn at once; the force trace is
// read beside it.
//
// Thread: the window's; the recording is read in one of its own.
#pragma once

#include <future>
#include <map>

#include "app/window/debrief/debrief_page.h"
#include "app/window/practice/practice_model.h"
#include "app/window/practice/screen.h"

namespace trocar {

class DebriefScreen : public Screen {
 public:
  std::optional<ScreenName> frame(Ui& ui, PracticeModel& model, double dt_s) override;
  void settle(PracticeModel& model, double wait_s) override;
  bool takes_escape() const override { return true; }

 private:
  void look_at(PracticeModel& model);
  void say(PracticeModel& model);
  void take_trace(PracticeModel& model);
  void take_expert(PracticeModel& model);
  std::optional<ScreenName> follow(DebriefChoice choice, PracticeModel& model);
  std::optional<ScreenName> retry(PracticeModel& model) const;

  struct Loaded {
    std::optional<ForceTrace> trace;
    std::string wrong;
  };
  std::optional<AttemptResult> result_;  // what the content was made of
  std::string language_;
  DebriefContent content_;
  DebriefPage page_;
  DebriefPast past_;
  std::future<Loaded> loading_;
  std::optional<ForceTrace> trace_;
  std::future<std::map<std::string, double>> expert_numbers_;
  std::filesystem::path expert_;
  bool expert_wanted_ = false;
};

}  // namespace trocar
