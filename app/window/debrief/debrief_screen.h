// T5: what the attempt was worth, why, and the one thing to try next. The page is drawn at once; the force trace is
// read beside it.
//
// Thread: the window's; the recording is read in one of its own.
#pragma once

#include <future>
#include <map>

#include "app/window/debrief/debrief_page.h"
#include "app/window/practice/practice_desk.h"
#include "app/window/practice/screen.h"

namespace trocar {

class DebriefScreen : public Screen {
 public:
  std::optional<ScreenName> frame(Ui& ui, PracticeDesk& desk, double dt_s) override;
  void settle(PracticeDesk& desk, double wait_s) override;
  bool takes_escape() const override { return true; }

 private:
  void look_at(PracticeDesk& desk);
  void say(PracticeDesk& desk);
  void take_trace(PracticeDesk& desk);
  void take_expert(PracticeDesk& desk);
  std::optional<ScreenName> follow(DebriefChoice choice, PracticeDesk& desk);
  std::optional<ScreenName> retry(PracticeDesk& desk) const;

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
