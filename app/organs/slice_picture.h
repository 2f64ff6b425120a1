// Slices of an image with the outlines of organs, as a radiologist reads them: the patient's right on the left of the
// picture.
//
// Axial seen from the feet (anterior up), coronal from the front (superior up), sagittal from the left (anterior on the
// left, superior up). The ground is the image in a window of values; without an image the labels; without both an empty
// field. Frame RAS; mm.
#pragma once

#include <string>
#include <vector>

#include "app/picture/gl/canvas.h"
#include "app/picture/gl/image.h"
#include "tissue/imaging/labels/label_map.h"
#include "tissue/imaging/volumes/image_volume.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

enum class SlicePlane { kAxial, kCoronal, kSagittal };

struct SliceOutline {
  const TriangleSurface* surface = nullptr;  ///< RAS, m
  Colour colour;
};

struct SliceGround {
  const ImageVolume* image = nullptr;
  const LabelMap* labels = nullptr;  ///< drawn without an image: marked voxels light
};

/// @param centre_mm the slice goes through it and the picture is centred on it
/// @param extent_mm shown width of the shorter side
Image slice_picture(const SliceGround& ground, const std::vector<SliceOutline>& outlines, SlicePlane plane,
                    const Vec3& centre_mm, double extent_mm, int size_px);

/// Outline segments of a closed surface in a plane x_axis = value, RAS mm; pairs of points.
std::vector<std::array<Vec3, 2>> cut_by_plane(const TriangleSurface& surface, int axis, double value_mm);

/// Window of values that shows soft tissue: CT -160..240 HU, else the 1st to the 99th percentile.
std::array<double, 2> display_window(const ImageVolume& image);

}  // namespace trocar
