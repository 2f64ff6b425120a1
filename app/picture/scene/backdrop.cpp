#include "app/picture/scene/backdrop.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "app/picture/models/solid_noise.h"

namespace trocar {
namespace {

struct Sample {
  Vec3 point;
  double open;  ///< openness to light
};

/// Triangulates a rows x columns sheet; normals by central differences, `flip` turns the winding.
PictureMesh sheet(int rows, int columns, bool flip, const std::function<Sample(double, double)>& at) {
  PictureMesh mesh;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j <= columns; ++j) {
      const double u = static_cast<double>(i) / rows, v = static_cast<double>(j) / columns, e = 0.4 / rows;
      const Sample here = at(u, v);
      Vec3 n = (at(u + e, v).point - at(u - e, v).point).cross(at(u, v + e).point - at(u, v - e).point);
      n = n.norm() > 0 ? Vec3(n.normalized() * (flip ? -1.0 : 1.0)) : Vec3(Vec3::UnitZ());
      const Eigen::Vector3f p = here.point.cast<float>(), m = n.cast<float>();
      mesh.vertices.push_back({{p.x(), p.y(), p.z()}, {m.x(), m.y(), m.z()}, {static_cast<float>(here.open), 0.0F}});
    }
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const auto a = static_cast<std::uint32_t>(i * (columns + 1) + j), b = a + 1;
      const auto c = a + static_cast<std::uint32_t>(columns + 1), d = c + 1;
      if (flip)
        mesh.indices.insert(mesh.indices.end(), {a, b, c, b, d, c});
      else
        mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
    }
  return mesh;
}

double unit_hash(int x, int y, int salt) {
  return lattice_hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(salt)) /
         4294967295.0;
}

/// Height of rounded lobes in 0..1 on a jittered unit lattice; creases run between them.
double lobes(double x, double y, int salt) {
  double best = 0;
  const int cx = static_cast<int>(std::floor(x)), cy = static_cast<int>(std::floor(y));
  for (int i = cx - 1; i <= cx + 1; ++i)
    for (int j = cy - 1; j <= cy + 1; ++j) {
      const double dx = x - (i + 0.2 + 0.6 * unit_hash(i, j, salt)),
                   dy = y - (j + 0.2 + 0.6 * unit_hash(i, j, salt + 1));
      const double radius = 0.75 + 0.35 * unit_hash(i, j, salt + 2);
      best = std::max(best, (0.7 + 0.3 * unit_hash(i, j, salt + 3)) *
                                std::sqrt(std::max(0.0, 1 - (dx * dx + dy * dy) / (radius * radius))));
    }
  return best;
}

}  // namespace

PictureMesh build_cavity(const Eigen::AlignedBox3d& organ_T) {
  const Vec3 centre = organ_T.center() + Vec3(0, 0.02, 0);
  const Vec3 radii = 0.5 * organ_T.sizes() + Vec3(0.12, 0.12, 0.15);
  return sheet(36, 56, true, [&](double u, double v) {
    const double polar = std::numbers::pi * u, turn = 2 * std::numbers::pi * v;
    const Vec3 d(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
    const double swell = 1 + 0.05 * gradient_noise(3 * d.x() + 9, 3 * d.y() + 5, 3 * d.z() + 2, 64) +
                         0.02 * gradient_noise(9 * d.x() + 30, 9 * d.y() + 20, 9 * d.z() + 10, 64);
    return Sample{centre + Vec3(radii.cwiseProduct(d) * swell), 0.9};
  });
}

PictureMesh build_fat_bed(const Eigen::AlignedBox3d& organ_T) {
  const Vec3 centre = organ_T.center(), size = organ_T.sizes();
  const double half_x = 0.5 * size.x() + 0.13, half_y = 0.5 * size.y() + 0.13;
  const double floor_z = organ_T.min().z() + 0.12 * size.z(), relief = std::clamp(0.22 * size.z(), 0.006, 0.022);
  constexpr double kLobe = 0.030;  // m, size of a lobe of omentum
  return sheet(84, 84, false, [&](double u, double v) {
    const double x = centre.x() + (2 * u - 1) * half_x, y = centre.y() + (2 * v - 1) * half_y;
    const double wx = x / kLobe + 0.35 * gradient_noise(x * 40 + 50, y * 40 + 50, 0.5, 256);
    const double wy = y / kLobe + 0.35 * gradient_noise(x * 40 + 90, y * 40 + 20, 3.5, 256);
    const double big = lobes(wx, wy, 11), small = lobes(2.3 * wx + 7, 2.3 * wy + 3, 29);
    const double rim = std::max(std::abs(2 * u - 1), std::abs(2 * v - 1));
    const double z = floor_z + relief * (big + 0.35 * small - 0.4) + 0.05 * rim * rim * rim;
    return Sample{Vec3(x, y, z), std::clamp(0.25 + 0.55 * big + 0.35 * small, 0.0, 1.0)};
  });
}

PictureMesh build_trainer_box(const Eigen::AlignedBox3d& stage_T) {
  const Vec3 centre = stage_T.center();
  const double flat = 0.5 * stage_T.sizes().head<2>().maxCoeff() + 0.025;  // m from the middle to where it rises
  constexpr double kRise = 0.09, kWall = 0.16;
  return sheet(72, 72, false, [&](double u, double v) {
    // A square is mapped to a disc-like sheet: distance from the middle decides floor, bend and wall.
    const double a = 2 * u - 1, b = 2 * v - 1;
    const double square = std::max(std::abs(a), std::abs(b)), round = std::hypot(a, b);
    const double run = square * (flat + 0.5 * std::numbers::pi * kRise + kWall);
    const double bend = std::clamp((run - flat) / kRise, 0.0, 0.5 * std::numbers::pi);
    const double out = std::min(run, flat) + kRise * std::sin(bend);
    const double up = kRise * (1 - std::cos(bend)) + std::max(0.0, run - flat - 0.5 * std::numbers::pi * kRise);
    const double x = round > 0 ? a / round * out : 0.0, y = round > 0 ? b / round * out : 0.0;
    const double fold = gradient_noise(14 * x + 40, 9 * y + 40, 0.5, 256) * std::clamp(run / flat - 0.75, 0.0, 1.0);
    return Sample{Vec3(centre.x() + x, centre.y() + y, stage_T.min().z() - 0.0005 + up + 0.006 * fold),
                  1.0 - 0.3 * std::clamp(bend, 0.0, 1.0)};
  });
}

}  // namespace trocar
