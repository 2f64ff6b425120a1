#include "tissue/imaging/phantom/phantom.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace trocar {
namespace {

using Vec = Eigen::Vector3d;

double ellipsoid(const Vec& p, const Vec& centre, const Vec& radii) {
  const Vec scaled = (p - centre).cwiseQuotient(radii);
  const double length = scaled.norm();
  const double gradient = scaled.cwiseQuotient(radii).norm();
  return gradient < 1e-9 ? -radii.minCoeff() : length * (length - 1) / gradient;
}

/// A ball that travels from a to b while its radius changes.
double swept_ball(const Vec& p, const Vec& a, double radius_a, const Vec& b, double radius_b) {
  const Vec axis = b - a;
  const double t = std::clamp((p - a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  return (p - a - t * axis).norm() - (radius_a + t * (radius_b - radius_a));
}

double column(const Vec& p, double x, double y, double radius) { return std::hypot(p.x() - x, p.y() - y) - radius; }

/// Union with a fillet of about `width` (quadratic smooth minimum).
double joined(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * width / 4;
}

double common(double a, double b, double width) { return -joined(-a, -b, width); }
double without(double a, double b, double width) { return common(a, -b, width); }

double trunk(const Vec& p, double inset) {
  return ellipsoid(Vec(p.x(), p.y(), 0), Vec(0, 8, 0), Vec(168 - inset, 118 - inset, 1000));
}

double spine(const Vec& p) {
  return joined(column(p, 0, -62, 21), ellipsoid(Vec(p.x(), p.y(), 0), Vec(0, -92, 0), Vec(9, 18, 1000)), 8);
}
double vena_cava(const Vec& p) { return column(p, 24, -36, 11); }
double aorta(const Vec& p) { return column(p, -14, -32, 9.5); }

double kidney(const Vec& p, double side) {
  const Vec centre(side * 62, -48, side > 0 ? -58 : -46);
  const double body = ellipsoid(p, centre, Vec(26, 24, 53));
  return without(body, ellipsoid(p, centre - Vec(side * 27, -6, 0), Vec(14, 12, 18)), 8);
}

double spleen(const Vec& p) {
  const double body = ellipsoid(p, Vec(-112, -26, 32), Vec(30, 52, 52));
  return without(body, ellipsoid(p, Vec(-70, -4, 28), Vec(30, 46, 60)), 12);
}

double stomach(const Vec& p) {
  return joined(ellipsoid(p, Vec(-74, 34, 34), Vec(34, 36, 48)), ellipsoid(p, Vec(-30, 52, -22), Vec(44, 22, 20)), 30);
}

/// Diaphragm: two domes; what lies above them within the rib cage is lung.
double below_diaphragm(const Vec& p) {
  const double right = ellipsoid(p, Vec(70, 0, 4), Vec(100, 106, 96));
  const double left = ellipsoid(p, Vec(-72, 6, 4), Vec(100, 100, 84));
  return p.z() < 4 ? -1 : joined(right, left, 20);
}

struct Tissue {
  double hounsfield;
  std::uint16_t label;
};

/// What lies at a point. Labels: table "totalsegmentator-v1".
Tissue tissue_at(const Vec& p) {
  if (trunk(p, 0) > 0) return {-1000, 0};
  if (trunk(p, 2) > 0) return {20, 0};     // skin
  if (trunk(p, 16) > 0) return {-105, 0};  // subcutaneous fat
  if (spine(p) < 0) return {spine(p) < -3 ? 190.0 : 420.0, 0};
  if (phantom_gallbladder_mm(p) < 0) return {8, 4};
  if (phantom_liver_mm(p) < 0) return {112, 5};
  if (spleen(p) < 0) return {122, 1};
  if (kidney(p, 1) < 0) return {185, 2};
  if (kidney(p, -1) < 0) return {185, 3};
  if (aorta(p) < 0) return {165, 7};
  if (vena_cava(p) < 0) return {140, 8};
  if (stomach(p) < 0) return {p.y() > 62 && p.z() > 20 ? -850.0 : 25.0, 6};
  if (trunk(p, 28) > 0) return {58, 0};  // muscle and ribs' bed
  if (below_diaphragm(p) > 0) return {-840, 0};
  return {-95, 0};  // fat round the organs
}

/// Normal deviates by Box and Muller from a named generator: the same on every machine.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : engine_(seed) {}

  double operator()() {
    const double u = (static_cast<double>(engine_() >> 11) + 1) * 0x1p-53,
                 v = static_cast<double>(engine_() >> 11) * 0x1p-53;
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
  }

 private:
  std::mt19937_64 engine_;
};

/// (1, 2, 1) / 4 along each axis: the point spread of the scanner.
void blur(std::vector<double>& values, const std::array<int, 3>& size) {
  std::size_t stride = 1;
  for (const int extent : size) {
    const auto length = static_cast<std::size_t>(extent);
    for (std::size_t start = 0; start < values.size(); ++start) {
      if (start / stride % length != 0) continue;
      double before = values[start];
      for (std::size_t n = 0; n < length; ++n) {
        const double here = values[start + n * stride], after = values[start + std::min(n + 1, length - 1) * stride];
        values[start + n * stride] = (before + 2 * here + after) / 4;
        before = here;
      }
    }
    stride *= length;
  }
}

}  // namespace

double phantom_gallbladder_mm(const Vec& p) {
  static const Vec fundus(49, 59, -49), body(41, 39, -34), infundibulum(33, 16, -11), neck(27, 4, 2), duct(20, 0, 9);
  const double sac = joined(swept_ball(p, fundus, 12.5, body, 14), swept_ball(p, body, 14, infundibulum, 8.5), 4);
  return joined(sac, joined(swept_ball(p, infundibulum, 8.5, neck, 4.5), swept_ball(p, neck, 4.5, duct, 3), 3), 6);
}

double phantom_liver_mm(const Vec& p) {
  const double right = ellipsoid(p, Vec(68, 0, 6), Vec(72, 79, 82));
  const double left = ellipsoid(p, Vec(-18, 38, 42), Vec(80, 44, 28));
  double liver = joined(right, left, 45);
  liver = common(liver, trunk(p, 30), 10);
  const Vec out(-0.55, -0.45, -0.70), on_surface(60, 10, -16);
  constexpr double kVisceralRadius = 300;
  liver = without(liver, (p - on_surface - kVisceralRadius * out).norm() - kVisceralRadius, 12);
  liver = without(liver, ellipsoid(p, Vec(-48, 18, -28), Vec(70, 75, 52)), 10);  // bed of the stomach
  liver = without(liver, spine(p) - 10, 14);
  liver = without(liver, vena_cava(p) - 1, 6);
  liver = without(liver, kidney(p, 1) - 4, 12);
  liver = without(liver, ellipsoid(p, Vec(4, 74, 2), Vec(9, 34, 36)), 12);  // fissure of the round ligament
  return without(liver, phantom_gallbladder_mm(p) - 2, 4);
}

CtPhantom make_phantom(const PhantomOptions& options, const Progress&) {
  const Vec low(-175, -120, -120), high(175, 135, 115);
  CtPhantom phantom;
  LabelVolume& labels = phantom.labels;
  for (int axis = 0; axis < 3; ++axis)
    labels.size[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::floor((high[axis] - low[axis]) / options.voxel_mm)) + 1;
  labels.index_to_ras_mm.linear() = Eigen::Matrix3d::Identity() * options.voxel_mm;
  labels.index_to_ras_mm.translation() = low;
  Noise noise(options.seed);
  std::vector<double> values;
  for (int k = 0; k < labels.size[2]; ++k)
    for (int j = 0; j < labels.size[1]; ++j)
      for (int i = 0; i < labels.size[0]; ++i) {
        const Tissue tissue = tissue_at(labels.index_to_ras_mm * Vec(i, j, k));
        labels.labels.push_back(tissue.label);
        values.push_back(tissue.hounsfield + options.noise_hu * 4 * noise());
      }
  blur(values, labels.size);
  for (const double value : values)
    phantom.hounsfield.push_back(static_cast<std::int16_t>(std::lround(std::clamp(value, -1024.0, 3071.0))));
  return phantom;
}

}  // namespace trocar
