// A vessel that opens on an organ once none of its ducts that carry nothing, its strands, is whole any more. T, SI.
// Thread: plain values.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

/// An artery; radius and feed as VesselSize (tissue/interaction/bleeding.h).
struct BleederSetup {
  Vec3 place_T = Vec3::Zero();  ///< on the organ at rest
  double radius_m = 0, feed_m = 0;
};

}  // namespace trocar
