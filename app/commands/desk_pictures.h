// Pictures of stored attempts for the desk's pages: the run is replayed once, in the background, and painted where a page asks.
//
// One run and one picture at a time: who comes while that works is told to come again. The last pictures are kept. All graphics stay in
// one thread. Thread: any may ask.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "app/scene.h"
#include "trainees/database.h"

namespace trocar {

class DeskPictures {
 public:
  static constexpr std::size_t kKept = 64;
  static constexpr int kWidest = 1920, kNarrowest = 480;
  /// @param open a database to look attempts up in; called by the thread of the graphics.
  DeskPictures(AssetRoots assets, std::function<Database()> open);
  ~DeskPictures();
  DeskPictures(const DeskPictures&) = delete;
  DeskPictures& operator=(const DeskPictures&) = delete;

  /// PNG of a moment. @param t_s since RUN began, clamped to the run. @param width px, clamped; 16:9.
  /// @throws InputError: no such attempt, or no recording. EnvironmentError: no graphics, or not ready yet (says how far it is).
  std::string png(const std::string& attempt_uuid, double t_s, int width);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
