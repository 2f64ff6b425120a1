// What may lie over any screen: the menu (Esc), help (F1), and one notice at the upper edge.
//
// Overlays take keys and pointer while they are open. Thread: the window's.
#pragma once

#include <optional>
#include <string>

#include "app/window/pages/sound_page.h"
#include "app/window/practice/practice_model.h"
#include "app/window/practice/screen.h"
#include "app/window/ui/ui.h"

namespace trocar {

/// What a person chose in the menu.
enum class MenuChoice : std::uint8_t { kNone, kBack, kLeaveAttempt, kStart, kSettings, kFullscreen, kQuit };
MenuChoice menu_overlay(Ui& ui, const PracticeModel& model, bool attempt_runs);

/// Whoever leaves an exam is asked: it cannot be taken up again. @return true to leave, false to stay, nothing yet.
std::optional<bool> leave_exam_overlay(Ui& ui, const Translator& words);

/// Keys as they are now, what every metric means, and every sound; page and sounds are kept by the caller. @return true
/// what a person chose.
enum class HelpPage : std::uint8_t { kKeys, kMetrics, kSounds };
enum class HelpChoice : std::uint8_t { kNone, kClose, kTutorial };
HelpChoice help_overlay(Ui& ui, PracticeModel& model, HelpPage& page, SoundPage& sounds);

/// In place of a page that has no room.
void small_window(Ui& ui);

/// A notice near the upper edge for some seconds; empties model.notice. @param age_s how long this one has been seen,
/// kept by the caller.
void notice_overlay(Ui& ui, PracticeModel& model, double dt_s, double& age_s, std::string& shown);

}  // namespace trocar
