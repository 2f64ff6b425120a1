// Slices put into a volume one by one: in RAS order at once, and sheared back where the gantry was tilted.
//
// A tilted pile has positions p_k = p_0 + k (h n + s): every slice is moved by k s within its own plane (linear
// interpolation), so the grid becomes one with right angles and every value stays where it was in the patient. Frame
// RAS, mm. Thread: one owner.
#pragma once

#include <vector>

#include "tissue/imaging/dicom/slice_stack.h"
#include "tissue/imaging/volumes/axis_order.h"
#include "tissue/imaging/volumes/image_volume.h"

namespace trocar {

class SliceVolume {
 public:
  /// @param outside value where no slice reaches after shearing
  /// @throws InputError naming `input` when the volume would be larger than an import may hold
  SliceVolume(const SliceStack& stack, float outside, const std::string& input);

  /// @param place in the pile, from 0
  /// @param values row by row
  void put(std::size_t place, const std::vector<float>& values);
  ImageVolume take() { return std::move(volume_); }

 private:
  std::vector<float> sheared(std::size_t place, const std::vector<float>& values) const;

  const SliceStack& stack_;
  float outside_;
  std::array<int, 3> stored_size_{};                  ///< columns, rows, slices of the upright grid
  Eigen::Vector2i margin_ = Eigen::Vector2i::Zero();  ///< pixels before the first of the first slice
  std::ptrdiff_t first_ = 0;
  std::array<std::ptrdiff_t, 3> stride_{};  ///< of the stored axes in the RAS array
  ImageVolume volume_;
};

}  // namespace trocar
