#include "app/picture/models/instrument_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "app/picture/models/loft.h"

namespace trocar {
namespace {

constexpr double kMilli = 1e-3;
constexpr double kBeyond = 0.8e-3;  // m that blades and clip jaws reach beyond the tip

PictureMesh toothed_jaw(double radius_m);

/// A wire of steel bent into an L, its foot towards -y (RodHookOptions), in a sheath that narrows to it.
PictureMesh hook_body(double radius_m, double length_m) {
  const double r = radius_m, end = -11.5 * kMilli, wire = 0.55 * kMilli, front = 2.2 * kMilli, bend = 1.2 * kMilli,
               foot = 6.0 * kMilli;
  PictureMesh mesh = turned({{-length_m, r, 0},
                             {end - 3.2 * kMilli, r, 0},
                             {end - 2.6 * kMilli, 0.97 * r, 0},
                             {end - 1.2 * kMilli, 0.66 * r, 0},
                             {end, 0.50 * r, 0},
                             {end + 3.6 * kMilli, 0.46 * r, 0},
                             {end + 4.0 * kMilli, 0.38 * r, 0},
                             {end + 4.1 * kMilli, 0.0, 0}},
                            28);
  struct Station {
    Vec3 at, along;
    double radius;
  };
  std::vector<Station> way;
  const double straight_end = front - wire - bend;
  for (const double z : {end + 3.0 * kMilli, -4.0 * kMilli, -1.0 * kMilli, straight_end})
    way.push_back({{0, 0, z}, Vec3::UnitZ(), wire});
  constexpr int kBends = 8;
  for (int k = 1; k <= kBends; ++k) {
    const double a = 0.5 * std::numbers::pi * k / kBends;
    way.push_back(
        {{0, -bend * (1 - std::cos(a)), straight_end + bend * std::sin(a)}, {0, -std::sin(a), std::cos(a)}, wire});
  }
  const double z = front - wire;
  for (const auto& [out, radius] : {std::pair(foot - 0.5 * kMilli, wire),
                                    {foot - 0.15 * kMilli, 0.8 * wire},
                                    {foot, 0.4 * wire},
                                    {foot + 0.02 * kMilli, 0.0}})
    way.push_back({{0, -out, z}, -Vec3::UnitY(), radius});
  constexpr int kAround = 14;
  append(mesh, loft(
                   static_cast<int>(way.size()), kAround,
                   [&](int i, int j) {
                     const Station& s = way[static_cast<std::size_t>(i)];
                     const double angle = 2 * std::numbers::pi * j / kAround;
                     const Vec3 across = s.along.cross(Vec3::UnitX());
                     return Vec3(s.at + s.radius * (std::cos(angle) * Vec3::UnitX() + std::sin(angle) * across));
                   },
                   [](int) { return 1.0F; }));
  return mesh;
}

/// A steel tube with a rounded open end and two rows of holes behind it.
PictureMesh suction_body(double radius_m, double length_m) {
  const double r = radius_m, front = 1.6 * kMilli, bore = 0.72 * r;
  constexpr int kAround = 48, kHoles = 4;
  std::vector<ProfilePoint> profile = {{-length_m, r, 1}, {-40 * kMilli, r, 1}};
  for (double z = -16 * kMilli; z < front - 1.2 * kMilli; z += 0.25 * kMilli) profile.push_back({z, r, 1});
  for (int k = 0; k <= 8; ++k) {  // the lip
    const double a = std::numbers::pi * k / 8, middle = 0.5 * (r + bore), half = 0.5 * (r - bore);
    profile.push_back({front - half + half * std::sin(a), middle + half * std::cos(a), 1});
  }
  profile.push_back({front - 1.2 * kMilli, bore, 0});
  profile.push_back({front - 12 * kMilli, bore, 0});
  profile.push_back({front - 12 * kMilli, 0.0, 0});
  PictureMesh mesh = turned(profile, kAround);
  // Holes are what is dark: insulation.
  for (PictureVertex& v : mesh.vertices) {
    const double x = v.position[0], y = v.position[1], z = v.position[2];
    if (std::hypot(x, y) < 0.99 * r) continue;
    for (int hole = 0; hole < kHoles; ++hole) {
      const double turn = hole % 2 == 0 ? 0.0 : 0.5 * std::numbers::pi, at = -(3.5 + 2.5 * hole) * kMilli;
      const double across = std::abs(-std::sin(turn) * x + std::cos(turn) * y);
      if (std::hypot(across, z - at) < 0.85 * kMilli) v.light[1] = 0;
    }
  }
  return mesh;
}

/// One blade: flat inside at x = 0 where it passes the other, its edge at y = 0, its back rounded.
PictureMesh blade(double radius_m) {
  constexpr int kRings = 40;
  const double length = drawn_jaw_length_m(InstrumentKind::kScissors) + kBeyond;
  static constexpr std::array<std::pair<double, double>, 12> kSection{{{0.0, -0.12},
                                                                       {0.30, 0.02},
                                                                       {0.75, 0.24},
                                                                       {0.98, 0.48},
                                                                       {1.0, 0.66},
                                                                       {0.86, 0.86},
                                                                       {0.58, 0.98},
                                                                       {0.26, 1.0},
                                                                       {0.03, 0.96},
                                                                       {0.0, 0.80},
                                                                       {0.0, 0.45},
                                                                       {0.0, 0.10}}};
  return loft(
      kRings, static_cast<int>(kSection.size()),
      [&](int i, int j) {
        const double along = static_cast<double>(i) / (kRings - 1);
        const double nose = std::sqrt(std::max(0.0, 1 - std::pow(along, 10.0)));
        const double heel = std::min(1.0, 0.75 + 4 * along);
        const double height = 0.80 * radius_m * (1 - 0.62 * along) * nose * heel;
        const double thickness = 0.50 * radius_m * (1 - 0.45 * along) * nose;
        const auto& [x, y] = kSection[static_cast<std::size_t>(j)];
        return Vec3(x * thickness, y * height, along * length);
      },
      [](int) { return 1.0F; });
}

/// One jaw of the clip applier: a flat bar bowed away from the other, that meets it at the end.
PictureMesh clip_jaw(double radius_m) {
  constexpr int kRings = 36, kAround = 20;
  const double length = drawn_jaw_length_m(InstrumentKind::kClipApplier) + kBeyond;
  return loft(
      kRings, kAround,
      [&](int i, int j) {
        const double along = static_cast<double>(i) / (kRings - 1);
        const double nose = std::sqrt(std::max(0.0, 1 - std::pow(along, 16.0)));
        const double bow = 0.44 * radius_m * std::sin(std::numbers::pi * std::min(1.0, along / 0.92));
        const double half_thick = 0.21 * radius_m * nose, half_wide = 0.42 * radius_m * (1 + 0.12 * along) * nose;
        const double angle = 2 * std::numbers::pi * j / kAround;
        const auto squared = [](double v) { return std::copysign(std::sqrt(std::abs(v)), v); };
        return Vec3(half_wide * squared(std::cos(angle)), 0.22 * radius_m + bow + half_thick * squared(std::sin(angle)),
                    along * length);
      },
      [](int) { return 1.0F; });
}

/// One jaw of the needle driver: short and stout, flat inside.
PictureMesh driver_jaw(double radius_m) {
  constexpr int kRings = 36, kAround = 20;
  const double length = drawn_jaw_length_m(InstrumentKind::kNeedleDriver) + kBeyond;
  return loft(
      kRings, kAround,
      [&](int i, int j) {
        const double along = static_cast<double>(i) / (kRings - 1);
        const double nose = std::sqrt(std::max(0.0, 1 - std::pow(along, 12.0)));
        const double half_width = 0.72 * radius_m * (1 - 0.25 * along) * nose,
                     height = 0.80 * radius_m * (1 - 0.35 * along) * nose;
        const double angle = 2 * std::numbers::pi * j / kAround, s = std::sin(angle);
        return Vec3(half_width * std::cos(angle), s > 0 ? height * s : 0.0, along * length);
      },
      [](int) { return 1.0F; });
}

struct Shape {
  double jaw_length_m;
  PictureMesh (*body)(double radius_m, double length_m);
  PictureMesh (*jaw)(double radius_m);
};

template <InstrumentKind kind>
PictureMesh hinged_body(double radius_m, double length_m) {
  return build_shaft(radius_m, length_m, drawn_jaw_length_m(kind));
}

PictureMesh no_jaw(double) { return {}; }

/// In the order of InstrumentKind.
const std::array<Shape, kInstruments.size()>& shapes() {
  using enum InstrumentKind;
  static const std::array<Shape, kInstruments.size()> table{
      {{kJawLength_m, hinged_body<kProbe>, toothed_jaw},
       {kJawLength_m, hinged_body<kGrasper>, toothed_jaw},
       {describe(kScissors).jaw_length_m, hinged_body<kScissors>, blade},
       {0, hook_body, no_jaw},
       {describe(kClipApplier).jaw_length_m, hinged_body<kClipApplier>, clip_jaw},
       {0, suction_body, no_jaw},
       {describe(kNeedleDriver).jaw_length_m, hinged_body<kNeedleDriver>, driver_jaw}}};
  return table;
}

const Shape& shape_of(InstrumentKind kind) { return shapes()[static_cast<std::size_t>(kind)]; }

}  // namespace

double drawn_jaw_length_m(InstrumentKind kind) { return shape_of(kind).jaw_length_m; }

PictureMesh build_body(InstrumentKind kind, double radius_m, double length_m) {
  return shape_of(kind).body(radius_m, length_m);
}

PictureMesh build_jaw(InstrumentKind kind, double radius_m) { return shape_of(kind).jaw(radius_m); }

PictureMesh build_shaft(double radius_m, double length_m, double jaw_length_m) {
  const double r = radius_m, hinge = -jaw_length_m;
  const std::vector<ProfilePoint> profile = {{-length_m, r, 0},
                                             {hinge - 0.0160, r, 0},
                                             {hinge - 0.0100, r, 0},
                                             {hinge - 0.0092, 0.97 * r, 0},
                                             {hinge - 0.0091, 0.86 * r, 0},
                                             {hinge - 0.0090, 0.86 * r, 1},
                                             {hinge - 0.0060, 0.86 * r, 1},
                                             {hinge - 0.0052, 0.80 * r, 1},
                                             {hinge - 0.0010, 0.80 * r, 1},
                                             {hinge + 0.0008, 0.70 * r, 1},
                                             {hinge + 0.0018, 0.45 * r, 1},
                                             {hinge + 0.0020, 0.0, 1}};
  return turned(profile, 28);
}

namespace {

PictureMesh toothed_jaw(double radius_m) {
  constexpr int kRings = 49, kAround = 18;
  return loft(
      kRings, kAround,
      [&](int i, int j) {
        const double along = static_cast<double>(i) / (kRings - 1);
        const double z = along * kJawLength_m;
        const double taper = (1 - 0.42 * along) * std::sqrt(std::max(0.0, 1 - std::pow(along, 14.0)));
        const double half_width = 0.80 * radius_m * taper, height = 0.78 * radius_m * taper;
        const double tooth = i % 3 == 1 && along > 0.18 && along < 0.97 ? 0.16 * radius_m : 0.0;
        const double angle = 2 * std::numbers::pi * j / kAround;  // upper half round, lower half flat
        const double s = std::sin(angle);
        return Vec3(half_width * std::cos(angle), s > 0 ? height * s : tooth * (s < -0.2 ? 1.0 : 0.0), z);
      },
      [](int) { return 1.0F; });
}

}  // namespace

Pose jaw_pose(int side, double opening_m, double jaw_length_m) {
  const double half = std::clamp(0.5 * opening_m, 0.0, 0.7 * jaw_length_m);
  const double angle = std::asin(half / jaw_length_m);
  Pose X;
  X.p = Vec3(0, 0, -jaw_length_m);
  // Upper jaw: its tip (z) turns towards +y, which is a negative rotation about x.
  const Mat3 swing = Eigen::AngleAxisd(-angle, Vec3::UnitX()).toRotationMatrix();
  X.R = side > 0 ? swing : Mat3(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()).toRotationMatrix() * swing);
  return X;
}

}  // namespace trocar
