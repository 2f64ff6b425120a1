#include "haptics/control/contact_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "haptics/control/segment_triangle.h"

namespace trocar {
namespace {

constexpr int kMaxSteps = 10;         // of half a radius: 12 mm a tick at r = 2.5 mm
constexpr int kSweeps = 4;            // pushes a step over all near triangles
constexpr int kShareSweeps = 30;
constexpr double kIdleTravel = 1e-3;  // m a period, beyond what the instrument itself moves
constexpr double kArrived = 1e-7;     // m, remaining slide at which the proxy rests
constexpr double kSlideSlack = 2e-7;  // m beyond the radius within which a triangle stops the slide
constexpr double kShareSlack = 1e-5;  // m beyond the radius within which a triangle may carry force
constexpr double kSameNormal = 0.9998;  // cosine of 1.1 deg: contacts closer than this are one
constexpr double kSamePoint = 5e-4;   // m

}  // namespace

ContactResult ContactRenderer::update(const Pose& X_TI, const Twist& V_TI_T, const ContactPatch& patch) {
  return law_ == ContactLaw::kThesis ? thesis_law(X_TI, patch) : proxy_law(X_TI, V_TI_T, patch);
}

ContactResult ContactRenderer::thesis_law(const Pose& X_TI, const ContactPatch& patch) const {
  ContactResult result;
  double nearest = -1;
  const PatchTriangle* triangle = nullptr;
  for (int i = 0; i < patch.count; ++i) {
    const Vec3 point = closest_point_on_triangle(X_TI.p, patch.triangle[i].vertex);
    const double distance = (point - X_TI.p).norm();
    if (nearest < 0 || distance < nearest) {
      nearest = distance;
      triangle = &patch.triangle[i];
      result.point_T = point;
    }
  }
  if (!triangle || (X_TI.p - result.point_T).dot(triangle->normal) >= 0) return result;
  result.contact = result.tip_contact = true;
  result.depth_m = nearest;
  result.normal_T = triangle->normal;
  result.F_I_T.force = patch.stiffness_n_per_m * (result.point_T - X_TI.p);
  result.F_I_T.moment = (result.point_T - X_TI.p).cross(result.F_I_T.force);
  result.stored_j = 0.5 * patch.stiffness_n_per_m * nearest * nearest;
  return result;
}

ContactResult ContactRenderer::proxy_law(const Pose& X_TI, const Twist& V_TI_T, const ContactPatch& patch) {
  const Vec3 goal = X_TI.p;
  backwards_ = X_TI.R.col(2) * -shape_.shaft_length_m;
  if (!started_) {
    proxy_ = last_goal_ = goal;
    started_ = true;
  }
  // The proxy may travel this far in one period, so triangles further away need no look.
  double allowance = kIdleTravel + 1.5 * (goal - last_goal_).norm();
  last_goal_ = goal;
  gather(shape_.radius_m + allowance, patch);
  touch_count_ = 0;
  project(patch, kSlideSlack);  // the shaft may have turned into the surface
  for (int i = 0; i < kMaxSteps && allowance > kArrived; ++i) {
    const Vec3 step = -share_out(proxy_ - goal);  // what no contact opposes
    const double length = step.norm();
    if (length < kArrived) break;
    const double travel = std::min({length, 0.5 * shape_.radius_m, allowance});
    proxy_ += step * (travel / length);
    allowance -= travel;
    project(patch, kSlideSlack);
  }
  // Sliding off a ridge leaves the proxy a hair above it: who carries the force is asked with a wider slack.
  project(patch, kShareSlack);

  ContactResult result;
  const Vec3 y = proxy_ - goal;
  if (touch_count_ == 0 || y.norm() < kArrived) return result;
  share_out(y);
  const double approach = approach_speed(V_TI_T, y.norm());
  const double damping = result.damping_factor = std::max(0.0, 1 + 1.5 * patch.damping_s_per_m * approach);
  const Touch* largest = &touch_[0];
  for (int i = 0; i < touch_count_; ++i) {
    const Touch& t = touch_[i];
    const Vec3 force = patch.stiffness_n_per_m * damping * t.share * t.normal;
    result.F_I_T.force += force;
    result.F_I_T.moment += (t.point - proxy_).cross(force);
    if (t.share > largest->share) largest = &t;
  }
  if (largest->share <= 0) return result;
  result.contact = true;
  result.tip_contact = largest->at_tip;
  result.point_T = largest->point;
  result.normal_T = y.normalized();
  result.depth_m = y.norm();
  result.stored_j = 0.5 * patch.stiffness_n_per_m * y.squaredNorm();
  return result;
}

double ContactRenderer::approach_speed(const Twist& V_TI_T, double depth_m) const {
  double power = 0;
  for (int i = 0; i < touch_count_; ++i) {
    const Vec3 lever = touch_[i].point - proxy_;
    power -= touch_[i].share * touch_[i].normal.dot(V_TI_T.linear + V_TI_T.angular.cross(lever));
  }
  return power / depth_m;
}

void ContactRenderer::gather(double reach, const ContactPatch& patch) {
  near_count_ = 0;
  const Vec3 axis = backwards_ / shape_.shaft_length_m;
  for (int i = 0; i < patch.count && near_count_ < kMaxNear; ++i) {
    const auto& v = patch.triangle[i].vertex;
    const Vec3 centre = (v[0] + v[1] + v[2]) / 3;
    const double size = std::sqrt(std::max({(v[0] - centre).squaredNorm(), (v[1] - centre).squaredNorm(),
                                            (v[2] - centre).squaredNorm()}));
    const Vec3 offset = centre - proxy_;
    const double along = std::clamp(offset.dot(axis), 0.0, shape_.shaft_length_m);
    if ((offset - axis * along).norm() <= reach + size) near_[near_count_++] = i;
  }
}

void ContactRenderer::project(const ContactPatch& patch, double slack) {
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    touch_count_ = 0;
    double deepest = 0;
    for (int i = 0; i < near_count_; ++i) {
      const PatchTriangle& triangle = patch.triangle[near_[i]];
      const ClosestPair pair = closest_segment_triangle(proxy_, proxy_ + backwards_, triangle.vertex);
      if (pair.distance > shape_.radius_m + slack) continue;
      // On the axis itself the direction is undefined: the surface's own normal leads out.
      Vec3 normal = triangle.normal;
      if (pair.distance > 1e-9) normal = (pair.on_segment - pair.on_triangle) / pair.distance;
      const double inside = shape_.radius_m - pair.distance;
      if (inside > 0) proxy_ += inside * normal;
      deepest = std::max(deepest, inside);
      add_touch({normal, pair.on_triangle, pair.distance, pair.along == 0});
    }
    if (deepest < kArrived) return;
  }
}

void ContactRenderer::add_touch(const Touch& touch) {
  for (int i = 0; i < touch_count_; ++i) {
    if (touch_[i].normal.dot(touch.normal) > kSameNormal && (touch_[i].point - touch.point).norm() < kSamePoint) {
      if (touch.distance < touch_[i].distance) touch_[i] = touch;  // the nearer one is the surface's true foot
      return;
    }
  }
  if (touch_count_ < kMaxContacts) touch_[touch_count_++] = touch;
}

Vec3 ContactRenderer::share_out(const Vec3& y) {
  // Hildreth's Gauss-Seidel on min |sum share_i n_i - y|^2, share_i >= 0; the rest is the projection of y on the
  // directions that no contact opposes.
  // The contact best aligned with y comes first: of the near-parallel ones on a smooth surface it is the true one.
  for (int i = 1; i < touch_count_; ++i) {
    if (touch_[i].normal.dot(y) > touch_[0].normal.dot(y)) std::swap(touch_[0], touch_[i]);
  }
  Vec3 rest = y;
  for (int i = 0; i < touch_count_; ++i) touch_[i].share = 0;
  for (int sweep = 0; sweep < kShareSweeps; ++sweep) {
    double change = 0;
    for (int i = 0; i < touch_count_; ++i) {
      const double before = touch_[i].share;
      touch_[i].share = std::max(0.0, before + rest.dot(touch_[i].normal));
      rest -= (touch_[i].share - before) * touch_[i].normal;
      change = std::max(change, std::abs(touch_[i].share - before));
    }
    if (change < kArrived) break;
  }
  return rest;
}

}  // namespace trocar
