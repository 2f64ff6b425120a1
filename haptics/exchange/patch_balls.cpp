#include "haptics/exchange/patch_balls.h"

#include <algorithm>
#include <cmath>

#include "haptics/exchange/contact_patch.h"

namespace trocar {

TriangleBall ball_round(const std::array<Vec3, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const Vec3 centre = (a + b + c) / 3;
  return {centre,
          std::sqrt(std::max({(a - centre).squaredNorm(), (b - centre).squaredNorm(), (c - centre).squaredNorm()}))};
}

void enclose(const ContactPatch& patch, PatchBalls& balls) {
  balls.count = patch.count;
  balls.stamp = patch.stamp;
  if (patch.count > 0) balls.origin = patch.corners(0)[0];
  for (std::int32_t n = 0; n < patch.count; ++n) {
    const auto i = static_cast<std::size_t>(n);
    const TriangleBall ball = ball_round(patch.corners(n));
    const Eigen::Vector3f centre = (ball.centre - balls.origin).cast<float>();
    balls.x[i] = centre.x();
    balls.y[i] = centre.y();
    balls.z[i] = centre.z();
    const float radius = static_cast<float>(ball.radius);
    balls.radius[i] = radius + PatchBalls::kRounding * (radius + centre.lpNorm<1>());
  }
}

}  // namespace trocar
