#include "app/window/practice/screen_table.h"

#include "app/window/debrief/debrief_screen.h"
#include "app/window/lessons/notch_screen.h"
#include "app/window/pages/curriculum_screen.h"
#include "app/window/pages/progress_screen.h"
#include "app/window/pages/settings_screen.h"
#include "app/window/pages/start_screen.h"
#include "app/window/replay/replay_screen.h"
#include "app/window/run/briefing_screen.h"
#include "app/window/run/run_screen.h"

namespace trocar {

std::unique_ptr<Screen> make_screen(ScreenName name) {
  switch (name) {
    case ScreenName::kStart:
      return std::make_unique<StartScreen>();
    case ScreenName::kSettings:
      return std::make_unique<SettingsScreen>();
    case ScreenName::kCurriculum:
      return std::make_unique<CurriculumScreen>();
    case ScreenName::kBriefing:
      return std::make_unique<BriefingScreen>();
    case ScreenName::kRun:
      return std::make_unique<RunScreen>();
    case ScreenName::kDebrief:
      return std::make_unique<DebriefScreen>();
    case ScreenName::kProgress:
      return std::make_unique<ProgressScreen>();
    case ScreenName::kReplay:
      return std::make_unique<ReplayScreen>();
    case ScreenName::kNotch:
      return std::make_unique<NotchScreen>();
    case ScreenName::kQuit:
    case ScreenName::kBack:
      return nullptr;
  }
  return nullptr;
}

const char* screen_name(ScreenName name) {
  switch (name) {
    case ScreenName::kStart:
      return "start";
    case ScreenName::kSettings:
      return "settings";
    case ScreenName::kCurriculum:
      return "curriculum";
    case ScreenName::kBriefing:
      return "briefing";
    case ScreenName::kRun:
      return "run";
    case ScreenName::kDebrief:
      return "debrief";
    case ScreenName::kProgress:
      return "progress";
    case ScreenName::kReplay:
      return "replay";
    case ScreenName::kNotch:
      return "notch";
    case ScreenName::kQuit:
      return "quit";
    case ScreenName::kBack:
      return "back";
  }
  return "quit";
}

}  // namespace trocar
