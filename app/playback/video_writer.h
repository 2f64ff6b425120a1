// Pictures into a film, by the program ffmpeg when it is there; it is never linked.
//
// Raw RGB through a pipe; .mp4 (H.264), .webm (VP9) or .mkv by the name. Thread: one.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "app/graphics/image.h"

namespace trocar {

class VideoWriter {
 public:
  /// @throws InputError for an ending that is none of these or an existing file, EnvironmentError when ffmpeg is missing (says what works without).
  VideoWriter(const std::filesystem::path& file, int width, int height, double fps);
  /// Ends the film as close() does, but silently.
  ~VideoWriter();
  /// @throws EnvironmentError with ffmpeg's last words when it has died (full disk).
  void add(const Image& image);
  /// Waits for ffmpeg. The file is whole only after this. @throws EnvironmentError.
  void close();
  int frames() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Path of ffmpeg on PATH, empty without.
std::string find_ffmpeg();

}  // namespace trocar
