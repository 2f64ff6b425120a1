// Pictures into a film, by the program ffmpeg when it is there; it is never linked.
//
// Raw RGB through a socket; .mp4 (H.264), .webm (VP9) or .mkv (H.264) by the name. Sizes that these codecs cannot have
// (odd ones) get a black line more. It is written to NAME.part, which becomes NAME when it is whole and is removed when
// it is not. The same pictures give the same film as long as ffmpeg is the same. Thread: one.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "app/picture/gl/image.h"

namespace trocar {

class VideoWriter {
 public:
  /// @param width,height px, at least 16. @throws InputError for an ending that is none of these or an existing file,
  /// EnvironmentError when ffmpeg is missing (says what works without) or the folder cannot be written.
  VideoWriter(const std::filesystem::path& file, int width, int height, double fps);
  /// Without close() nothing stays.
  ~VideoWriter();
  /// @throws EnvironmentError with ffmpeg's last words when it has died (full disk); std::invalid_argument for another
  /// size.
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

/// What the constructor would refuse, without beginning anything: before a long computation. @throws as it does.
void check_video_file(const std::filesystem::path& file);

}  // namespace trocar
