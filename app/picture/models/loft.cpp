#include "app/picture/models/loft.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {

PictureMesh loft(int rings, int around, const std::function<Vec3(int, int)>& at,
                 const std::function<float(int)>& accent) {
  PictureMesh mesh;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j <= around; ++j) {
      const Vec3 p = at(i, j % around);
      const Vec3 along = at(std::min(i + 1, rings - 1), j % around) - at(std::max(i - 1, 0), j % around);
      const Vec3 round = at(i, (j + 1) % around) - at(i, (j + around - 1) % around);
      Vec3 n = round.cross(along);
      n = n.norm() > 1e-15 ? Vec3(n.normalized()) : Vec3(Vec3::UnitZ());
      const Eigen::Vector3f pf = p.cast<float>(), nf = n.cast<float>();
      mesh.vertices.push_back({{pf.x(), pf.y(), pf.z()}, {nf.x(), nf.y(), nf.z()}, {1.0F, accent(i)}});
    }
  for (int i = 0; i + 1 < rings; ++i)
    for (int j = 0; j < around; ++j) {
      const auto a = static_cast<std::uint32_t>(i * (around + 1) + j), b = a + 1;
      const auto c = a + static_cast<std::uint32_t>(around + 1), d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, c, b, d, c});
    }
  return mesh;
}

void append(PictureMesh& mesh, const PictureMesh& part) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const std::uint32_t index : part.indices) mesh.indices.push_back(first + index);
}

PictureMesh turned(const std::vector<ProfilePoint>& profile, int around) {
  return loft(
      static_cast<int>(profile.size()), around,
      [&](int i, int j) {
        const ProfilePoint& s = profile[static_cast<std::size_t>(i)];
        const double angle = 2 * std::numbers::pi * j / around;
        return Vec3(s.radius * std::cos(angle), s.radius * std::sin(angle), s.z);
      },
      [&](int i) { return profile[static_cast<std::size_t>(i)].accent; });
}

}  // namespace trocar
