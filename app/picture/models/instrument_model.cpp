#include "app/picture/models/instrument_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/picture/models/loft.h"

namespace trocar {

PictureMesh build_shaft(double radius_m, double length_m) {
  const double r = radius_m, hinge = -kJawLength_m;
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

PictureMesh build_jaw(double radius_m) {
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

Pose jaw_pose(int side, double opening_m) {
  const double half = std::clamp(0.5 * opening_m, 0.0, 0.7 * kJawLength_m);
  const double angle = std::asin(half / kJawLength_m);
  Pose X;
  X.p = Vec3(0, 0, -kJawLength_m);
  // Upper jaw: its tip (z) turns towards +y, which is a negative rotation about x.
  const Mat3 swing = Eigen::AngleAxisd(-angle, Vec3::UnitX()).toRotationMatrix();
  X.R = side > 0 ? swing : Mat3(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()).toRotationMatrix() * swing);
  return X;
}

}  // namespace trocar
