#include "app/picture/models/show_anatomy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/picture/models/solid_noise.h"

namespace trocar {
namespace {

double smooth_min(double a, double b, double width) {
  const double h = std::clamp(0.5 + 0.5 * (b - a) / width, 0.0, 1.0);
  return b + (a - b) * h - width * h * (1 - h);
}

/// Capsule from a to b whose radius runs from one to the other.
double taper(const Vec3& p, const Vec3& a, double ra, const Vec3& b, double rb) {
  const Vec3 ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - t * ab).norm() - (ra + t * (rb - ra));
}

double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii) {
  const Vec3 q = (p - centre).cwiseQuotient(radii);
  return (q.norm() - 1) * radii.minCoeff();
}

double noise(const Vec3& p, double per_m, double seed) {
  const Vec3 q = per_m * p + Vec3(40 + 3.7 * seed, 50 + 1.3 * seed, 60 + 2.9 * seed);
  return gradient_noise(q.x(), q.y(), q.z(), 128);
}

double unit(int x, int y, std::uint32_t salt) {
  return lattice_hash(static_cast<std::uint32_t>(x + 1000), static_cast<std::uint32_t>(y + 1000), salt) / 4294967295.0;
}

double gallbladder(const Vec3& p, double seed) {
  double d = taper(p, {0.024, 0.012, 0.007}, 0.0175, {0.006, 0.014, -0.011}, 0.0125);
  d = smooth_min(d, taper(p, {0.006, 0.014, -0.011}, 0.0100, {-0.013, 0.018, -0.0185}, 0.0046), 0.010);
  d = smooth_min(d, taper(p, {-0.013, 0.018, -0.0185}, 0.0040, {-0.021, 0.022, -0.0165}, 0.0024), 0.005);
  d = smooth_min(d, taper(p, {-0.021, 0.022, -0.0165}, 0.0022, {-0.040, 0.0295, -0.0205}, 0.0025), 0.003);
  return d + 0.0018 * noise(p, 55, seed) + 0.0005 * noise(p, 170, seed);
}

double common_duct(const Vec3& p, double seed) {
  double d = taper(p, {-0.052, 0.066, 0.052}, 0.0046, {-0.042, 0.029, -0.018}, 0.0044);
  d = smooth_min(d, taper(p, {-0.042, 0.029, -0.018}, 0.0046, {-0.036, 0.030, -0.060}, 0.0050), 0.004);
  return d + 0.0005 * noise(p, 120, seed);
}

double artery(const Vec3& p, double seed) {
  const std::array<Vec3, 4> way = {Vec3(-0.082, 0.060, 0.004), Vec3(-0.046, 0.0395, -0.003),
                                   Vec3(-0.022, 0.026, -0.007), Vec3(-0.001, 0.013, -0.009)};
  double d = 1;
  for (std::size_t i = 0; i + 1 < way.size(); ++i)
    d = smooth_min(d, taper(p, way[i], 0.0013, way[i + 1], 0.0010), 0.002);
  return d + 0.0003 * noise(p, 150, seed);
}

double liver(const Vec3& p, double seed) {
  double d = ellipsoid(p, {-0.020, 0.058, 0.087}, {0.190, 0.088, 0.076});
  d = smooth_min(d, ellipsoid(p, {0.098, 0.055, 0.054}, {0.070, 0.070, 0.056}), 0.030);
  return d + 0.0045 * noise(p, 18, seed) + 0.0010 * noise(p, 70, seed);
}

double stomach(const Vec3& p, double seed) {
  double d = ellipsoid(p, {-0.090, 0.088, -0.022}, {0.095, 0.045, 0.045});
  d = smooth_min(d, ellipsoid(p, {0.070, 0.088, -0.026}, {0.090, 0.046, 0.042}), 0.02);
  return d + 0.0030 * noise(p, 28, seed) + 0.0009 * noise(p, 90, seed);
}

/// A heap of lobes: spheres on a jittered lattice, highest at the back and the sides, smoothly joined.
double fat(const Vec3& p, std::uint64_t seed) {
  constexpr double kPitch = 0.017;
  const int cx = static_cast<int>(std::floor(p.x() / kPitch)), cy = static_cast<int>(std::floor(p.y() / kPitch));
  const auto salt = static_cast<std::uint32_t>(seed * 97 + 5);
  double d = p.z() + 0.060;
  for (int i = cx - 2; i <= cx + 2; ++i)
    for (int j = cy - 2; j <= cy + 2; ++j) {
      const double x = (i + 0.15 + 0.7 * unit(i, j, salt)) * kPitch,
                   y = (j + 0.15 + 0.7 * unit(i, j, salt + 1)) * kPitch;
      const double side = std::clamp(std::abs(x + 0.01) / 0.09, 0.0, 1.0);
      const double z = -0.053 + 0.016 * side * side + 0.010 * unit(i, j, salt + 2);
      const double radius = kPitch * (0.62 + 0.42 * unit(i, j, salt + 3));
      d = smooth_min(d, (p - Vec3(x, y, z)).norm() - radius, 0.0042);
    }
  // It climbs round the ducts and hangs on the neck.
  d = smooth_min(d, taper(p, {-0.062, 0.036, -0.036}, 0.014, {-0.036, 0.034, -0.034}, 0.010), 0.006);
  d = smooth_min(d, taper(p, {-0.052, 0.044, -0.030}, 0.008, {-0.056, 0.060, 0.022}, 0.005), 0.008);
  d = smooth_min(d, taper(p, {-0.012, 0.034, -0.034}, 0.012, {-0.004, 0.030, -0.016}, 0.006), 0.008);
  const double s = static_cast<double>(seed);
  return d + 0.0024 * noise(p, 75, s) + 0.0011 * noise(p, 190, s);
}

}  // namespace

std::vector<ShowOrgan> show_anatomy(std::uint64_t seed) {
  const double s = static_cast<double>(seed % 97);
  const auto box = [](const Vec3& low, const Vec3& high) { return Eigen::AlignedBox3d(low, high); };
  return {{"gallbladder", [s](const Vec3& p) { return gallbladder(p, s); },
           box({-0.048, -0.012, -0.034}, {0.048, 0.036, 0.030}), 0.0012},
          {"liver", [s](const Vec3& p) { return liver(p, s); }, box({-0.225, -0.045, -0.010}, {0.185, 0.160, 0.180}),
           0.0060},
          {"bile duct", [s](const Vec3& p) { return common_duct(p, s); },
           box({-0.062, 0.020, -0.068}, {-0.028, 0.074, 0.060}), 0.0012},
          {"artery", [s](const Vec3& p) { return artery(p, s); }, box({-0.086, 0.008, -0.014}, {0.004, 0.064, 0.008}),
           0.0007},
          {"stomach", [s](const Vec3& p) { return stomach(p, s); }, box({-0.195, 0.030, -0.080}, {0.175, 0.145, 0.032}),
           0.0050},
          {"fat", [seed](const Vec3& p) { return fat(p, seed); }, box({-0.125, -0.060, -0.066}, {0.125, 0.072, 0.031}),
           0.0030}};
}

}  // namespace trocar
