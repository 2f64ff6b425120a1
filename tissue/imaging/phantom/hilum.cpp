#include "tissue/imaging/phantom/hilum.h"

#include "tissue/imaging/phantom/phantom_labels.h"

namespace trocar::phantom {
namespace {

using Course = std::vector<Vec>;

/// Where the cystic duct meets the hepatic duct.
Vec junction(const Anatomy& a) {
  if (a.variant == PhantomVariant::kShortDuct) return {9.5, -0.5, 3.5 + 0.3 * a.junction_mm};
  if (a.variant == PhantomVariant::kLowInsertion) return {12, -10, -52 + 0.5 * a.junction_mm};
  return {7.5, -3, -20 + a.junction_mm};
}

/// From the gallbladder's neck, which ends at (20, 0, 9), to the junction.
Course cystic_duct(const Anatomy& a) {
  const double bow = a.duct_bow_mm;
  const Vec neck(21.4, 0.8, 7.6), tip(20, 0, 9);
  if (a.variant == PhantomVariant::kShortDuct) return {neck, tip, Vec(15.5, -1.8, 7.6 + bow), junction(a)};
  Course course{neck, tip, Vec(17, -2.2, 9), Vec(14.8 + bow, -3.8, 4.5)};
  if (a.variant == PhantomVariant::kLowInsertion)
    for (const Vec& at : {Vec(14.5, -6, -8), Vec(14.5, -8, -22), Vec(15.5, -10.5, -38)})
      course.push_back(at + Vec(bow, 0, 0));
  else
    for (const Vec& at : {Vec(14.3, -4.5, -4), Vec(12, -4.3, -13)})
      course.push_back(at + Vec(bow, 0, 0.5 * a.junction_mm));
  course.push_back(junction(a));
  return course;
}

Course hepatic_duct(const Anatomy& a) {
  if (a.variant == PhantomVariant::kShortDuct) return {Vec(8, 7, 27), Vec(6, 5, 18), Vec(6.5, 3, 11), junction(a)};
  Course course{Vec(8, 7, 27), Vec(5.5, 4.5, 18), Vec(3.5, 3, 10), Vec(3.5, 1.5, 0), Vec(5, -0.5, -10)};
  if (a.variant == PhantomVariant::kLowInsertion) course.insert(course.end(), {Vec(7.5, -3, -20), Vec(8, -7, -36)});
  course.push_back(junction(a));
  return course;
}

/// From the junction to the papilla on the inner wall of the descending duodenum.
Course bile_duct(const Anatomy& a) {
  Course course{junction(a)};
  if (a.variant == PhantomVariant::kShortDuct) course.insert(course.end(), {Vec(8, -1.5, -8), Vec(7.5, -3, -20)});
  if (a.variant != PhantomVariant::kLowInsertion) course.insert(course.end(), {Vec(8, -7, -36), Vec(12, -10, -52)});
  course.insert(course.end(), {Vec(19, -9, -66), Vec(25, -6, -75)});
  return course;
}

/// Ends within the gallbladder's neck, so that it reaches the wall.
Course cystic_artery(const Anatomy& a) {
  const double bow = a.artery_bow_mm;
  if (a.variant == PhantomVariant::kArteryAnterior)
    return {Vec(-3, -0.5, 8),       Vec(-2.5, 4.5, 8.5 + bow), Vec(0.5, 8.6, 9 + bow), Vec(5.5, 9.3, 9.5 + bow),
            Vec(11, 7.6, 10 + bow), Vec(16.5, 5, 10.6),        Vec(22, 2, 7)};
  return {Vec(12, -4.2, 14.2), Vec(16, -6, 12.8 + bow), Vec(20, -6.2, 10 + bow), Vec(23, -4.2, 6.5), Vec(25.2, 1, 4)};
}

Tube even(const Course& course, double radius) {
  std::vector<Knot> knots;
  for (const Vec& at : course) knots.push_back({at, radius});
  return Tube(knots);
}

}  // namespace

std::vector<NamedTube> hilum(const Anatomy& a) {
  namespace label = phantom_label;
  const double duct = a.duct_calibre, artery = a.artery_calibre;
  const Course hepatic{Vec(-14, -23, 2), Vec(-13, -13, 4), Vec(-10, -5, -2),
                       Vec(-6, -2, -5),  Vec(-4, -1, 2),   Vec(-3, -0.5, 8)};
  const Course right{Vec(-3, -0.5, 8), Vec(0, -3.5, 11), Vec(4, -5, 12.5),
                     Vec(9, -4.5, 13), Vec(14, -4, 15),  Vec(20, -2, 21)};
  const Course left{Vec(-3, -0.5, 8), Vec(-3, 1, 14), Vec(-6, 6, 22), Vec(-10, 10, 30)};
  return {{label::kBileDuct, even(bile_duct(a), 2.75 * duct)},
          {label::kHepaticDuct, even(hepatic_duct(a), 2.4 * duct)},
          {label::kCysticDuct, even(cystic_duct(a), 1.65 * duct)},
          {label::kHepaticArtery, even(hepatic, 2.4 * artery)},
          {label::kRightHepaticArtery, even(right, 1.8 * artery)},
          {label::kLeftHepaticArtery, even(left, 1.6 * artery)},
          {label::kCysticArtery, even(cystic_artery(a), 1.0 * artery)}};
}

std::array<Vec, 3> hepatocystic_triangle(const Anatomy& anatomy) {
  return {Vec(22, 1, 7), Vec(6, 5, 20), junction(anatomy)};
}

}  // namespace trocar::phantom

namespace trocar {

double PhantomTube::length_mm() const {
  double length = 0;
  for (std::size_t n = 1; n < points_mm.size(); ++n) length += (points_mm[n] - points_mm[n - 1]).norm();
  return length;
}

std::vector<PhantomTube> phantom_hilum(PhantomVariant variant, std::uint64_t patient) {
  std::vector<PhantomTube> tubes;
  for (const phantom::NamedTube& each : phantom::hilum(phantom::anatomy_of(variant, patient))) {
    PhantomTube tube;
    tube.label = each.label;
    for (const LabelName& entry : kPhantomLabels)
      if (entry.number == each.label) tube.name = entry.name;
    for (const phantom::Knot& knot : each.tube.course()) {
      tube.points_mm.push_back(knot.at);
      tube.radii_mm.push_back(knot.radius);
    }
    tubes.push_back(std::move(tube));
  }
  return tubes;
}

}  // namespace trocar
