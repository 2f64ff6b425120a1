// How long a person waits for the picture of what the hand did: the whole path, in memory.
//
// The window's loop runs without a window: events of a mouse that moves all the time, a live attempt (E02 L1), pictures
// by the same renderer. What a screen adds (its beat, its own delay) and what lies before the program's poll are not in
// it. Thread: one; starts others.
#pragma once

#include <string>

#include "app/session/setup/scene.h"

namespace trocar {

struct PictureLatency {
  std::string renderer;       ///< OpenGL's name of it
  int width = 0, height = 0;  ///< px
  int frames = 0, events = 0;
  double frame_median_s = 0, frame_p95_s = 0;
  double median_s = 0, p95_s = 0, longest_s = 0;  ///< event handed over -> frame complete that shows it
  /// Bar: two frames, of the slower ones, and one step of the tissue.
  double bar_s() const { return 2 * frame_p95_s + 0.010; }
};

/// @throws EnvironmentError without OpenGL.
PictureLatency measure_picture_latency(const AssetRoots& assets, double seconds, int width = 1280, int height = 720);

}  // namespace trocar
