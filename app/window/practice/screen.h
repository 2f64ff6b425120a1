// A screen of the trainee's window: draws one frame with ImGui over the scene's picture and says where to go next.
//
// Screens know the model (practice_model.h: what is chosen, what was done) and the words; they know neither window nor
// OpenGL. The same code draws in a window and headless, for pictures and layout tests. Thread: the window's.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/picture/scene/scene_view.h"
#include "app/window/input/input_event.h"

namespace trocar {

class Ui;             // app/window/ui/ui.h
class PracticeModel;  // app/window/practice/practice_model.h

enum class ScreenName : std::uint8_t {
  kStart,
  kCurriculum,
  kBriefing,
  kRun,
  kDebrief,
  kProgress,
  kReplay,
  kSettings,
  kNotch,
  kQuit,
  kBack  ///< to where one came from
};

class Screen {
 public:
  virtual ~Screen() = default;
  /// Draws one frame. @param dt_s since the last one. @return where to go, nothing to stay.
  virtual std::optional<ScreenName> frame(Ui& ui, PracticeModel& model, double dt_s) = 0;
  /// Events that ImGui did not take. @return as frame().
  virtual std::optional<ScreenName> handle(const InputEvent& /*event*/, PracticeModel& /*model*/) { return {}; }
  /// Waits for what the screen makes in the background: pictures of screens, and tests.
  virtual void settle(PracticeModel& /*model*/, double /*wait_s*/) {}
  /// Esc is this screen's own (it has a button for it), and does not open the menu.
  virtual bool takes_escape() const { return false; }
  /// A dialog of its own stands over the picture: the device panel gives way.
  virtual bool asks() const { return false; }
  /// The pointer is the screen's: hidden, never at an edge, and over no panel.
  virtual bool holds_pointer() const { return false; }
  /// Every event goes to handle() before anything else looks at it: while a key is being chosen.
  virtual bool takes_all() const { return false; }
  /// What the renderer shall draw behind or within this frame, and where (px of the window); nothing: a plain ground.
  struct Stage {
    SceneView view;
    double x = 0, y = 0, width = 0, height = 0;  ///< 0 wide: the whole window
    double dim = 0;                              ///< 0 as it is .. 1 black, behind panels
  };
  virtual std::optional<Stage> stage(PracticeModel& /*model*/, int /*width*/, int /*height*/) { return {}; }
  /// A second picture beside it, for comparing. Asked after stage().
  virtual std::optional<Stage> second_stage(PracticeModel& /*model*/, int /*width*/, int /*height*/) { return {}; }
};

}  // namespace trocar
