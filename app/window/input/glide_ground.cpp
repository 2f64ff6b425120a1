#include "app/window/input/glide_ground.h"

namespace trocar {
namespace {

constexpr double kNearest = 0.01, kFarthest = 0.5, kStep = 0.001;  // m from the lens
constexpr int kHalvings = 10;

}  // namespace

std::optional<Vec3> seen_ground(const GlideGround& ground, const Camera& camera, const Vec3& through_T) {
  const Vec3 way = (through_T - camera.eye_T).normalized();
  const auto below = [&](double t) {
    const Vec3 p = camera.eye_T + t * way;
    return p.z() <= ground.height(p.x(), p.y());
  };
  for (double far = kNearest; far < kFarthest; far += kStep) {
    if (!below(far)) continue;
    double near = far - kStep;
    for (int n = 0; n < kHalvings; ++n) (below(0.5 * (near + far)) ? far : near) = 0.5 * (near + far);
    return Vec3(camera.eye_T + far * way);
  }
  return std::nullopt;
}

}  // namespace trocar
