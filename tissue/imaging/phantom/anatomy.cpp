#include "tissue/imaging/phantom/anatomy.h"

#include <random>

namespace trocar::phantom {
namespace {

/// Even deviates in low..high from a named generator: the same on every machine.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 engine_;
};

void vary(Anatomy& anatomy, std::uint64_t patient) {
  Draw draw(patient);
  anatomy.liver_scale = draw(0.97, 1.03);
  anatomy.sac_scale = draw(0.92, 1.06);
  anatomy.spleen_scale = draw(0.96, 1.04);
  anatomy.duct_calibre = draw(0.88, 1.12);
  anatomy.artery_calibre = draw(0.88, 1.12);
  anatomy.junction_mm = draw(-5, 5);
  anatomy.duct_bow_mm = draw(-0.8, 0.8);
  anatomy.artery_bow_mm = draw(-0.6, 0.6);
  anatomy.outer_fat_mm += draw(-4, 6);
  anatomy.omentum_mm *= draw(0.8, 1.2);
  anatomy.hilum_fat_mm *= draw(0.85, 1.15);
}

}  // namespace

Anatomy anatomy_of(PhantomVariant variant, std::uint64_t patient) {
  Anatomy anatomy;
  anatomy.variant = variant;
  if (variant == PhantomVariant::kFat) anatomy.outer_fat_mm = 22, anatomy.omentum_mm = 18, anatomy.hilum_fat_mm = 9;
  if (patient != 0) vary(anatomy, patient);
  return anatomy;
}

double trunk(const Vec& p, double inset) {
  return ellipsoid(Vec(p.x(), p.y(), 0), Vec(0, 8, 0), Vec(168 - inset, 118 - inset, 1000));
}

double spine(const Vec& p) {
  return joined(column(p, 0, -62, 21), ellipsoid(Vec(p.x(), p.y(), 0), Vec(0, -92, 0), Vec(9, 18, 1000)), 8);
}

double vena_cava(const Vec& p) { return column(p, 24, -36, 11); }

double kidney(const Vec& p, double side) {
  const Vec centre(side * 62, -48, side > 0 ? -58 : -46);
  const double body = ellipsoid(p, centre, Vec(26, 24, 53));
  return without(body, ellipsoid(p, centre - Vec(side * 27, -6, 0), Vec(14, 12, 18)), 8);
}

double spleen(const Vec& p, const Anatomy& anatomy) {
  const double body = ellipsoid(p, Vec(-112, -26, 32), Vec(30, 52, 52) * anatomy.spleen_scale);
  const double against_stomach = without(body, ellipsoid(p, Vec(-70, -4, 28), Vec(30, 46, 60)), 12);
  return common(against_stomach, trunk(p, 31), 10);
}

double gallbladder(const Vec& p, const Anatomy& anatomy) {
  static const Vec fundus(49, 59, -49), body(41, 39, -34), infundibulum(33, 16, -11), neck(27, 4, 2), duct(20, 0, 9);
  const double s = anatomy.sac_scale;
  const double sac =
      joined(swept_ball(p, fundus, 12.5 * s, body, 14 * s), swept_ball(p, body, 14 * s, infundibulum, 8.5 * s), 4);
  return joined(sac, joined(swept_ball(p, infundibulum, 8.5 * s, neck, 4.5), swept_ball(p, neck, 4.5, duct, 3), 3), 6);
}

double liver_lobes(const Vec& p, const Anatomy& anatomy) {
  const double right = ellipsoid(p, Vec(68, 0, 6), Vec(72, 79, 82) * anatomy.liver_scale);
  const double left = ellipsoid(p, Vec(-18, 38, 42), Vec(80, 44, 28) * anatomy.liver_scale);
  return joined(right, left, 45);
}

double liver(const Vec& p, const Anatomy& anatomy) {
  double liver = common(liver_lobes(p, anatomy), trunk(p, 30), 10);
  const Vec out(-0.55, -0.45, -0.70), on_surface(60, 10, -16);
  constexpr double kVisceralRadius = 300;
  liver = without(liver, (p - on_surface - kVisceralRadius * out).norm() - kVisceralRadius, 12);
  liver = without(liver, ellipsoid(p, Vec(-48, 18, -28), Vec(70, 75, 52)), 10);  // bed of the stomach
  liver = without(liver, spine(p) - 10, 14);
  liver = without(liver, vena_cava(p) - 1, 6);
  liver = without(liver, kidney(p, 1) - 4, 12);
  liver = without(liver, ellipsoid(p, Vec(4, 74, 2), Vec(9, 34, 36)), 12);  // fissure of the round ligament
  return without(liver, gallbladder(p, anatomy) - 2, 4);
}

}  // namespace trocar::phantom

namespace trocar {

double phantom_gallbladder_mm(const Eigen::Vector3d& point_mm) { return phantom::gallbladder(point_mm, {}); }
double phantom_liver_mm(const Eigen::Vector3d& point_mm) { return phantom::liver(point_mm, {}); }

}  // namespace trocar
