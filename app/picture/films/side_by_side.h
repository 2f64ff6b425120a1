// Two runs in one picture: scope's pictures side by side, each with its name, its time, how far it is, and its force
// bars.
//
// Force bars are shown whatever the level's feedback mode: the runs are over. Thread: the one that made it.
#pragma once

#include <memory>
#include <string>

#include "app/picture/gl/image.h"
#include "app/picture/scene/preset.h"
#include "app/session/run_moment.h"

namespace trocar {

/// One of the two, at one moment.
struct FilmSide {
  const Scene& scene;
  const RunMoment& moment;
  std::string name;   ///< "T-1", "expert"
  bool over = false;  ///< it had ended by then
};

class SideBySidePainter {
 public:
  static constexpr int kLeastWidth = 720, kLeastHeight = 400;  ///< px

  /// @throws EnvironmentError without EGL, font or shaders; std::invalid_argument for a smaller picture.
  SideBySidePainter(const AssetRoots& assets, int width, int height, Preset preset = Preset::kFull);
  ~SideBySidePainter();
  /// @param seconds on the clock of both, from RUN's beginning.
  Image paint(const FilmSide& left, const FilmSide& right, double seconds);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trocar
