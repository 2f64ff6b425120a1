// Pictures of stored attempts for the desk's pages: a run is replayed once, in the background, and painted where a page
// asks; maps of where the tip was and how hard it pressed, painted on the same scene.
//
// Two runs are held, so that two attempts can be compared. One picture at a time, few wait; who comes beyond that is
// told to come again. The last pictures are kept. All graphics stay in one thread. Thread: any may ask.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "app/picture/maps/heat_field.h"
#include "app/session/setup/scene.h"
#include "trainees/store/database.h"

namespace trocar {

class DeskPictures {
 public:
  static constexpr std::size_t kKept = 64;
  static constexpr std::size_t kRuns = 2, kMostWaiting = 3;
  static constexpr int kWidest = 1920, kNarrowest = 480;
  /// @param open a database to look attempts up in; called by the thread of the graphics.
  DeskPictures(AssetRoots assets, std::function<Database()> open);
  ~DeskPictures();
  DeskPictures(const DeskPictures&) = delete;
  DeskPictures& operator=(const DeskPictures&) = delete;

  /// PNG of a moment. @param t_s since the recording began, as its trace counts, clamped to the run. @param width px,
  /// clamped; 16:9.
  /// @throws InputError: no such attempt, or no recording. EnvironmentError: no graphics, or not ready yet (says how
  /// far it is).
  std::string png(const std::string& attempt_uuid, double t_s, int width);
  /// PNG of a map of the whole attempt on its scene. @param overview else as the scope saw it. @throws as png().
  std::string heat(const std::string& attempt_uuid, HeatOf of, bool overview, int width);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
