#include "tissue/imaging/phantom/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar::phantom {
namespace {

constexpr double kStepMm = 1;
constexpr std::size_t kRun = 12;

/// Between b and c (Catmull-Rom): a and d only bend it.
Vec spline(const Vec& a, const Vec& b, const Vec& c, const Vec& d, double t) {
  return 0.5 * (2 * b + t * (c - a) + t * t * (2 * a - 5 * b + 4 * c - d) + t * t * t * (3 * b - a - 3 * c + d));
}

}  // namespace

double ellipsoid(const Vec& p, const Vec& centre, const Vec& radii) {
  const Vec scaled = (p - centre).cwiseQuotient(radii);
  const double length = scaled.norm();
  const double gradient = scaled.cwiseQuotient(radii).norm();
  return gradient < 1e-9 ? -radii.minCoeff() : length * (length - 1) / gradient;
}

double pillar(const Vec& p, double x, double y, double radius_x, double radius_y) {
  return ellipsoid(Vec(p.x(), p.y(), 0), Vec(x, y, 0), Vec(radius_x, radius_y, 1000));
}

double column(const Vec& p, double x, double y, double radius) { return std::hypot(p.x() - x, p.y() - y) - radius; }

double swept_ball(const Vec& p, const Vec& a, double radius_a, const Vec& b, double radius_b) {
  const Vec axis = b - a;
  const double t = std::clamp((p - a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  return (p - a - t * axis).norm() - (radius_a + t * (radius_b - radius_a));
}

double triangle_distance(const Vec& p, const Vec& a, const Vec& b, const Vec& c) {
  const Vec normal = (b - a).cross(c - a).normalized();
  const auto beyond = [&](const Vec& from, const Vec& to) { return (to - from).cross(normal).dot(p - from) > 0; };
  if (!beyond(a, b) && !beyond(b, c) && !beyond(c, a)) return std::abs(normal.dot(p - a));
  return std::min({swept_ball(p, a, 0, b, 0), swept_ball(p, b, 0, c, 0), swept_ball(p, c, 0, a, 0)});
}

double joined(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * width / 4;
}

double common(double a, double b, double width) { return -joined(-a, -b, width); }
double without(double a, double b, double width) { return common(a, -b, width); }

Tube::Tube(const std::vector<Knot>& knots) {
  const std::size_t last = knots.size() - 1;
  for (std::size_t n = 0; n < last; ++n) {
    const Knot &b = knots[n], &c = knots[n + 1];
    const Vec before = n == 0 ? Vec(2 * b.at - c.at) : knots[n - 1].at;
    const Vec after = n + 1 == last ? Vec(2 * c.at - b.at) : knots[n + 2].at;
    const int steps = std::max(1, static_cast<int>(std::ceil((c.at - b.at).norm() / kStepMm)));
    for (int step = 0; step < steps; ++step) {
      const double t = static_cast<double>(step) / steps;
      course_.push_back({spline(before, b.at, c.at, after, t), b.radius + t * (c.radius - b.radius)});
    }
  }
  course_.push_back(knots.back());
  index();
}

void Tube::ripple(double depth, double wave_mm) {
  double along = 0;
  for (std::size_t n = 0; n < course_.size(); ++n) {
    if (n > 0) along += (course_[n].at - course_[n - 1].at).norm();
    course_[n].radius *= 1 + depth * std::sin(2 * std::numbers::pi * along / wave_mm);
  }
  index();
}

void Tube::index() {
  runs_.clear();
  whole_ = {{}, 0, 0, course_.size() - 1};
  steps_.clear();
  for (std::size_t n = 0; n + 1 < course_.size(); ++n) {
    const Vec axis = course_[n + 1].at - course_[n].at;
    steps_.push_back(
        {course_[n].at, axis, 1 / axis.squaredNorm(), course_[n].radius, course_[n + 1].radius - course_[n].radius});
  }
  for (std::size_t first = 0; first + 1 < course_.size(); first += kRun) {
    Run run{{}, 0, first, std::min(first + kRun, course_.size() - 1)};
    for (std::size_t n = run.first; n <= run.last; ++n) {
      run.box.extend(course_[n].at);
      run.radius = std::max(run.radius, course_[n].radius);
    }
    runs_.push_back(run);
    whole_.box.extend(run.box);
    whole_.radius = std::max(whole_.radius, run.radius);
  }
}

double Tube::distance(const Vec& p, double reach) const {
  double nearest = reach;
  const double farthest = reach + whole_.radius;
  if (whole_.box.squaredExteriorDistance(p) >= farthest * farthest) return reach;
  for (const Run& run : runs_) {
    const double limit = nearest + run.radius;
    if (limit <= 0 || run.box.squaredExteriorDistance(p) >= limit * limit) continue;
    for (std::size_t n = run.first; n < run.last; ++n) {
      const Step& step = steps_[n];
      const Vec to = p - step.from;
      const double t = std::clamp(to.dot(step.axis) * step.per_length2, 0.0, 1.0);
      nearest = std::min(nearest, (to - t * step.axis).norm() - (step.radius + t * step.growth));
    }
  }
  return nearest;
}

bool Tube::misses(const Box& region) const {
  return std::all_of(runs_.begin(), runs_.end(),
                     [&](const Run& run) { return run.box.exteriorDistance(region) >= run.radius; });
}

Box Tube::box() const {
  Box box;
  for (const Knot& knot : course_) {
    box.extend(Vec(knot.at.array() - knot.radius));
    box.extend(Vec(knot.at.array() + knot.radius));
  }
  return box;
}

}  // namespace trocar::phantom
