// The picture of an exercise on its card: the board as it lies, the instrument moving over it; a recording of the
// expert as soon as there is one.
//
// Scene and film are made in the background, for one exercise at a time. Frame T. Thread: the window's; one more works.
#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <string>

#include "app/picture/scene/scene_view.h"
#include "app/session/setup/scene.h"
#include "app/window/practice/practice_model.h"

namespace trocar {

class RecordedRun;

/// The moving still scene: over board or organ, along a slow round. Pure: same scene and time, same view.
SceneView lesson_view(const Scene& scene, double t_s);

class LessonPicture {
 public:
  LessonPicture();
  ~LessonPicture();
  LessonPicture(const LessonPicture&) = delete;
  LessonPicture& operator=(const LessonPicture&) = delete;

  /// What the model has chosen. Films are asked for when the choice has rested for a second.
  /// @return nothing while there is none.
  std::optional<SceneView> view(PracticeModel& model, double dt_s);
  /// "Expert, 12 s" or "Still scene"; empty without a picture.
  std::string caption(const Translator& words) const;
  /// Waits for the scene of the choice: pictures and tests.
  void settle(PracticeModel& model, double wait_s);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
