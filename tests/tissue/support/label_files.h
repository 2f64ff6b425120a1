// A label map of one layer read from any file that read_label_map takes.
#pragma once

#include "haptics/input_error.h"
#include "tissue/imaging/volumes/volume_reader.h"

namespace trocar::test {

inline LabelVolume read_label_volume(const std::filesystem::path& path) {
  LabelMap map = read_label_map(path);
  if (map.layers.size() > 1)
    throw InputError(path.string() + ": " + std::to_string(map.layers.size()) +
                     " layers of segments that overlap; one is wanted");
  return std::move(map.layers.front());
}

}  // namespace trocar::test
