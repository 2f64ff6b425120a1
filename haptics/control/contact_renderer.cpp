#include "haptics/control/contact_renderer.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "haptics/control/half_spaces.h"
#include "haptics/control/segment_triangle.h"

namespace trocar {
namespace {

constexpr int kMaxSteps = 10;  // of half a radius: 12 mm a tick at r = 2.5 mm
constexpr int kSweeps = 4;     // pushes a step over all near triangles
constexpr int kShareRounds = 12;
constexpr double kShareGain = 1e-10;     // m, a contact that would carry less is not asked
constexpr double kSingularGram = 1e-12;  // determinant of the normals' products
constexpr double kIdleTravel = 1e-3;     // m a period, beyond what the instrument itself moves
constexpr double kArrived = 1e-7;        // m, remaining slide at which the proxy rests
constexpr double kSlideSlack = 5e-5;     // m beyond the radius within which a triangle bounds the slide
constexpr double kShareSlack = 1e-5;     // m beyond the radius within which a triangle may carry force
constexpr double kSameNormal = 0.9998;   // cosine of 1.1 deg: contacts closer than this are one
constexpr double kSamePoint = 5e-4;      // m

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
    const Vec3 step = free_step(goal - proxy_);
    const double length = step.norm();
    if (length < kArrived) break;
    const double travel = std::min({length, 0.5 * shape_.radius_m, allowance});
    proxy_ += step * (travel / length);
    allowance -= travel;
    travelled_ += travel;
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
  std::array<Near, kMaxPatchTriangles> found;
  int count = 0;
  travelled_ = 0;
  const Vec3 axis = backwards_ / shape_.shaft_length_m;
  for (int i = 0; i < patch.count; ++i) {
    const auto& v = patch.triangle[i].vertex;
    const Vec3 centre = (v[0] + v[1] + v[2]) / 3;
    const double size2 =
        std::max({(v[0] - centre).squaredNorm(), (v[1] - centre).squaredNorm(), (v[2] - centre).squaredNorm()});
    const Vec3 offset = centre - proxy_;
    const double along = std::clamp(offset.dot(axis), 0.0, shape_.shaft_length_m);
    const double centre2 = (offset - axis * along).squaredNorm();
    if (centre2 > 2 * (reach * reach + size2)) continue;  // (a + b)^2 <= 2 (a^2 + b^2): most leave without a root
    const double distance = std::sqrt(centre2) - std::sqrt(size2);
    if (distance <= reach) found[count++] = {distance, 0, i};
  }
  if (count > kMaxNear) {  // the nearest, whatever the order of the patch
    std::nth_element(found.begin(), found.begin() + kMaxNear, found.begin() + count, [](const Near& l, const Near& r) {
      return l.distance != r.distance ? l.distance < r.distance : l.index < r.index;
    });
    count = kMaxNear;
    std::sort(found.begin(), found.begin() + count, [](const Near& l, const Near& r) { return l.index < r.index; });
  }
  std::copy(found.begin(), found.begin() + count, near_.begin());
  near_count_ = count;
}

void ContactRenderer::project(const ContactPatch& patch, double slack) {
  const double reach = shape_.radius_m + slack;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    touch_count_ = 0;
    double deepest = 0;
    for (int i = 0; i < near_count_; ++i) {
      Near& near = near_[i];
      if (near.distance - (travelled_ - near.travelled) > reach) continue;
      const PatchTriangle& triangle = patch.triangle[near.index];
      const ClosestPair pair = closest_segment_triangle(proxy_, proxy_ + backwards_, triangle.vertex);
      near.distance = pair.distance;
      near.travelled = travelled_;
      if (pair.distance > reach) continue;
      // On the axis itself the direction is undefined: the surface's own normal leads out.
      Vec3 normal = triangle.normal;
      if (pair.distance > 1e-9) normal = (pair.on_segment - pair.on_triangle) / pair.distance;
      const double inside = shape_.radius_m - pair.distance;
      if (inside > 0) {
        proxy_ += inside * normal;
        travelled_ += inside;
      }
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
  if (touch_count_ < kMaxContacts) {
    touch_[touch_count_++] = touch;
    return;
  }
  const auto furthest = std::max_element(touch_.begin(), touch_.end(),
                                         [](const Touch& l, const Touch& r) { return l.distance < r.distance; });
  if (touch.distance < furthest->distance) *furthest = touch;
}

Vec3 ContactRenderer::free_step(const Vec3& wish) const {
  std::array<HalfSpace, kMaxContacts> half_spaces;
  for (int i = 0; i < touch_count_; ++i) {
    half_spaces[i] = {touch_[i].normal, std::max(0.0, touch_[i].distance - shape_.radius_m)};
  }
  return nearest_allowed(wish, {half_spaces.data(), static_cast<std::size_t>(touch_count_)});
}

Vec3 ContactRenderer::share_out(const Vec3& y) {
  // min |sum share_i n_i - y|^2, share_i >= 0, by the active-set method of Lawson and Hanson (1974): exact after a few
  // rounds however nearly parallel the normals are. At most three contacts carry in space. What is left of y is its
  // projection on the directions that no contact opposes.
  for (int i = 0; i < touch_count_; ++i) touch_[i].share = 0;
  carrying_count_ = 0;
  Vec3 rest = y;
  for (int round = 0; round < kShareRounds && carrying_count_ < kMaxCarrying; ++round) {
    int best = -1;
    double gain = kShareGain;
    for (int i = 0; i < touch_count_; ++i) {
      if (touch_[i].share == 0 && touch_[i].normal.dot(rest) > gain) {
        best = i;
        gain = touch_[i].normal.dot(rest);
      }
    }
    if (best < 0) break;
    carrying_[carrying_count_++] = best;
    balance(y);
    rest = y;
    for (int i = 0; i < carrying_count_; ++i) rest -= touch_[carrying_[i]].share * touch_[carrying_[i]].normal;
  }
  return rest;
}

void ContactRenderer::balance(const Vec3& y) {
  while (carrying_count_ > 0) {
    Mat3 gram = Mat3::Identity();
    Vec3 wanted = Vec3::Zero();
    for (int i = 0; i < carrying_count_; ++i) {
      wanted[i] = touch_[carrying_[i]].normal.dot(y);
      for (int j = 0; j < i; ++j) {
        gram(i, j) = gram(j, i) = touch_[carrying_[i]].normal.dot(touch_[carrying_[j]].normal);
      }
    }
    if (gram.determinant() < kSingularGram) {  // the newest lies in the plane of the others
      touch_[carrying_[--carrying_count_]].share = 0;
      return;
    }
    const Vec3 share = gram.inverse() * wanted;
    double reach = 1;  // how far towards that solution all shares stay positive
    for (int i = 0; i < carrying_count_; ++i) {
      const double now = touch_[carrying_[i]].share;
      if (share[i] <= 0) reach = std::min(reach, now / (now - share[i]));
    }
    int kept = 0;
    for (int i = 0; i < carrying_count_; ++i) {
      double& now = touch_[carrying_[i]].share;
      now += reach * (share[i] - now);
      if (share[i] <= 0 && now <= kShareGain) {
        now = 0;
      } else {
        carrying_[kept++] = carrying_[i];
      }
    }
    if (kept == carrying_count_) return;
    carrying_count_ = kept;
  }
}

}  // namespace trocar
