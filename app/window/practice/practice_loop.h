// The frames of the trainee's program: events to the screen that is up, its scene by the renderer, the interface over
// it.
//
//   PracticeLoop loop(model, context, true);
//   while (loop.frame(width, height, dt_s, events)) present();
//
// The same in a window and headless. Menu, help, notices, pictures and the screen's size are dealt with here, so no
// screen has to. Thread: the one on which the context is current.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/picture/gl/graphics_context.h"
#include "app/picture/gl/image.h"
#include "app/picture/scene/preset.h"
#include "app/window/input/input_event.h"
#include "app/window/practice/practice_model.h"
#include "app/window/practice/screen.h"
#include "app/window/ui/ui.h"

namespace trocar {

class PracticeLoop {
 public:
  /// Start page, or the briefing when the model was given an exercise.
  /// @param to_window frames go to the window's framebuffer. @throws EnvironmentError: font or shaders missing.
  PracticeLoop(PracticeModel& model, GraphicsContext& context, bool to_window);
  /// Ends an attempt that runs: aborted, and stored so.
  ~PracticeLoop();

  /// One frame. Smaller than 64 x 48 px: nothing is drawn. @return false when the program shall end.
  bool frame(int width, int height, double dt_s, const std::vector<InputEvent>& events);
  /// Somebody closes the window. @return whether it may close now: while an exam runs it asks first.
  bool close();
  /// The context is lost (a driver was reset): lets go of all that lived in it while it is still there; an attempt
  /// pauses. Until take_up() frames draw nothing. The attempt itself and the screens know nothing of it.
  void lose_pictures();
  void take_up(GraphicsContext& context);
  /// Whether from now on scopes are drawn: not while nobody looks. All else goes on.
  void draw_scopes(bool wanted);
  /// Waits for what the screen that is up makes in the background; wait_s at most.
  void settle(double wait_s);
  /// Draws less when pictures come too slowly, as in a window: in memory only when asked, so that pictures do not
  /// depend on how busy the machine is.
  void keep_rate();
  /// To another screen, as from the next frame.
  void go(ScreenName name);
  ScreenName here() const;
  const Screen* screen() const;  ///< that is up; nullptr: none
  bool menu_open() const;
  Preset preset() const;       ///< that the pictures are drawn with
  bool fullscreen() const;     ///< wanted
  bool holds_pointer() const;  ///< the screen that is up has the pointer for itself: nothing lies over it
  void finish() const;         ///< waits until the last frame is complete: for timing
  /// The last frame. @throws EnvironmentError.
  Image picture() const;
  const std::vector<DrawnText>& texts() const;  ///< of the last frame
  const std::vector<std::string>& scrolling() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// $XDG_PICTURES_DIR, else the pictures folder beside the program's data.
std::filesystem::path pictures_folder();

}  // namespace trocar
