// Surfaces of revolution and other tubes, ring by ring, for everything turned or moulded in the picture.
//
// Thread: any. Metres.
#pragma once

#include <functional>
#include <vector>

#include "app/picture/models/picture_mesh.h"

namespace trocar {

/// Rings of `around` points, joined; the seam is doubled. Normals from neighbours: at(ring, place) must run so that
/// (round the ring) x (along the rings) points outwards. `accent(i)` becomes light[1] of ring i.
PictureMesh loft(int rings, int around, const std::function<Vec3(int, int)>& at,
                 const std::function<float(int)>& accent);

/// Puts a part to a mesh.
void append(PictureMesh& mesh, const PictureMesh& part);

/// One point of a profile turned about z.
struct ProfilePoint {
  double z, radius;
  float accent;
};

/// The profile turned about z. Running towards +z the surface faces outwards, towards -z inwards.
PictureMesh turned(const std::vector<ProfilePoint>& profile, int around);

}  // namespace trocar
