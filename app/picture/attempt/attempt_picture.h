// From a moment of a session to a picture: camera, target marks, instrument and head-up display.
//
// Knows the scene and the director; the renderer knows neither. Thread: that of the renderer.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/picture/gl/image.h"
#include "app/picture/scene/preset.h"
#include "app/picture/scene/scene_view.h"
#include "app/session/session.h"

namespace trocar {

/// What one picture of the running attempt shows. @param trainee code, shown in the top bar. @param seen through which
/// it is seen, when that is not the exercise's own camera: the display's directions follow it.
SceneView attempt_view(const SessionView& view, const std::string& trainee, const std::optional<Camera>& seen = {});

/// Renders an attempt as it runs: every 1/fps s of loop time into DIR/frame_00001.png, or single pictures on demand.
class AttemptPainter {
 public:
  /// @throws EnvironmentError without EGL, font or shaders.
  AttemptPainter(const AssetRoots& assets, std::string trainee, int width = 1280, int height = 720,
                 Preset preset = Preset::kFull);
  ~AttemptPainter();

  Image paint(const SessionView& view);
  /// The same in two steps, for what is changed in between.
  SceneView scene(const SessionView& view) const;
  Image paint(const SceneView& view);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Takes pictures one by one: a folder of numbered files, a film.
using PictureSink = std::function<void(const Image&)>;

/// DIR/frame_00001.png and on. @param directory made when missing. @throws EnvironmentError.
PictureSink numbered_pictures(const std::filesystem::path& directory);

/// A picture every 1/fps s of loop time. Call observe() at the tissue rate; what comes later shows the same picture
/// again, so that a film keeps its time.
class FrameWriter {
 public:
  FrameWriter(AttemptPainter& painter, PictureSink sink, double fps);
  /// Numbered files. @throws EnvironmentError.
  FrameWriter(AttemptPainter& painter, const std::filesystem::path& directory, double fps);
  void observe(const SessionView& view);
  int written() const { return written_; }

 private:
  AttemptPainter& painter_;
  PictureSink sink_;
  double period_s_, next_s_ = 0;
  int written_ = 0;
};

}  // namespace trocar
