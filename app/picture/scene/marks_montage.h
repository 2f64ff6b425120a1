// One picture that points at each of the twelve marks of a laparoscopic view: four by three cut-outs of the show scene,
// each with a ring round the mark and its name.
//
// Pixels. Thread: the one on which the renderer's context is current.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "app/picture/gl/image.h"
#include "app/picture/scene/renderer.h"

namespace trocar {

struct MarkPointer {
  const char* label;
  const char* scene;  ///< of show_scene()
  double zoom;        ///< width of the whole picture over that of the cut-out
  double x, y;        ///< where the mark is in the whole picture, 0..1 from the top left
  double radius;      ///< of the ring, in heights of the cut-out; 0: no ring
};

const std::array<MarkPointer, 12>& twelve_marks();

/// @param width,height px of the montage, at least 640 x 360.
Image marks_montage(Renderer& renderer, int width, int height, std::uint64_t seed);

}  // namespace trocar
