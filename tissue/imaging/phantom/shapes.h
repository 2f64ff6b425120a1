// Implicit shapes that the phantom is drawn from: signed distances (approximate where a shape is squashed), mm,
// negative inside, RAS. Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace trocar::phantom {

using Vec = Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

double ellipsoid(const Vec& p, const Vec& centre, const Vec& radii);
/// The same in the plane across the body: endless from head to foot.
double pillar(const Vec& p, double x, double y, double radius_x, double radius_y);
double column(const Vec& p, double x, double y, double radius);
/// A ball that travels from a to b while its radius changes.
double swept_ball(const Vec& p, const Vec& a, double radius_a, const Vec& b, double radius_b);
double triangle_distance(const Vec& p, const Vec& a, const Vec& b, const Vec& c);

/// Union with a fillet of about `width` (quadratic smooth minimum).
double joined(double a, double b, double width);
double common(double a, double b, double width);
double without(double a, double b, double width);

struct Knot {
  Vec at;
  double radius;
};

/// A ball that travels along a smooth curve through knots (Catmull-Rom), sampled in steps of about 1 mm.
class Tube {
 public:
  explicit Tube(const std::vector<Knot>& knots);

  /// Waves along the course: the radius times 1 + depth * sin(2 pi s / wave_mm).
  void ripple(double depth, double wave_mm);
  /// @param reach parts farther than this are passed over: where the answer would be more, it is `reach`
  double distance(const Vec& p, double reach = 1e9) const;
  Box box() const;
  /// No point of the tube lies in the box.
  bool misses(const Box& region) const;
  const std::vector<Knot>& course() const { return course_; }

 private:
  struct Run {
    Box box;  ///< of the points, not of the tube
    double radius;
    std::size_t first, last;
  };
  void index();

  /// Between two points of the course, ready for the distance.
  struct Step {
    Vec from, axis;
    double per_length2, radius, growth;
  };
  std::vector<Knot> course_;
  std::vector<Step> steps_;
  Run whole_;
  std::vector<Run> runs_;
};

}  // namespace trocar::phantom
