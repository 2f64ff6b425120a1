#include "haptics/contact/contact_renderer.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "haptics/contact/half_spaces.h"
#include "haptics/contact/ring_contact.h"

namespace trocar {
namespace {

constexpr int kMaxSteps = 10;  // of half a radius: 12 mm a tick at r = 2.5 mm, 6 mm with jaws
constexpr int kSweeps = 4;     // pushes a step over all near triangles
constexpr int kShareRounds = 12;
constexpr double kShareGain = 1e-10;     // m, a contact that would carry less is not asked
constexpr double kSingularGram = 1e-12;  // determinant of the normals' products
constexpr double kMostWedge = 10;        // of the depth: what all contacts together carry of it, however they oppose
constexpr int kMostFall = 32;            // of half a radius in the air between two surfaces: 20 mm with jaws
constexpr double kIdleTravel = 1e-3;     // m a period, beyond what the instrument itself moves
constexpr double kArrived = 1e-7;        // m, remaining slide at which the proxy rests
constexpr double kSlideSlack = 5e-5;     // m beyond the radius within which a triangle bounds the slide
constexpr double kAgainst = 0.05;        // cosine of 87 deg between a slide and the way into what stops it ...
constexpr double kHeadOn = 0.5;          // ... and of 60 deg of a fall, which grazes walls on its way
constexpr double kShareSlack = 1e-5;     // m beyond the radius within which a triangle may carry force
constexpr double kSameNormal = 0.9998;   // cosine of 1.1 deg: contacts closer than this are one
constexpr double kSamePoint = 5e-4;      // m
constexpr double kBlendTravel = 2e-3;    // m over which stiffness follows a change of material
constexpr double kIdleTurn = 0.009;      // rad a period that the force may turn as the proxy slides on: 0.5 deg
constexpr double kRounding = 3e-3;       // m that the instrument moves for one rad more
constexpr int kTurnHalvings = 5;         // of the way that the proxy slides
constexpr double kMostChange = 300;      // N/s of what tissue does: 0.3 N a period of 1 ms
constexpr double kParting = 0.05;        // s over which a contact that is none any more is let go (a choice)

}  // namespace

void ContactRenderer::take(const ToolShape& shape) {
  shape_ = shape;
  known_ = 0;
  near_.forget();
  friction_.reset();
  eased_ = eased_spring_ = {};
  eased_stored_ = eased_j_ = 0;
}

ContactResult ContactRenderer::update(const Pose& X_TI, const Twist& V_TI_T, const ContactPatch& newest,
                                      double jaw_opening_m, double drawn_m) {
  tool_ = tool_capsules(shape_, jaw_opening_m, newest.held, drawn_m);
  thinnest_m_ = tool_.at[0].radius_m;
  for (int c = 1; c < tool_.count; ++c) thinnest_m_ = std::min(thinnest_m_, tool_.at[c].radius_m);
  const ContactPatch& patch = glide_.follow(newest, contacts_, stored_j_, thinnest_m_);
  near_.travel(glide_.moved_m());
  part_with_lost(X_TI, patch);
  contacts_.topology = patch.topology;
  contacts_.count = 0;
  stored_j_ = 0;
  glide_.pulled(Vec3::Zero(), X_TI);
  ContactResult result = law_ == ContactLaw::kThesis ? thesis_law(X_TI, patch) : proxy_law(X_TI, V_TI_T, patch);
  if (patch.hold.stiffness_n_per_m > 0) add_hold(X_TI, patch.hold, result);
  if (newest.ring.count > 1) add_ring(X_TI, V_TI_T, newest.ring, result);
  add_parting(X_TI, result);
  if (glide_.force_share() < 1) fade(result);
  if (law_ == ContactLaw::kProxy && patch.glide_s > 0) ease(X_TI, result);
  return result;
}

void ContactRenderer::part_with_lost(const Pose& X_TI, const ContactPatch& patch) {
  if (patch.glide_s <= 0 || patch.stamp == parted_stamp_) return;
  parted_stamp_ = patch.stamp;
  if (contacts_.topology != patch.topology) return;
  Wrench lost;
  double gone = 0, all = 0;
  const auto end = patch.triangle.begin() + patch.count;
  for (int i = 0; i < contacts_.count; ++i) {
    const SolvedContact& contact = contacts_.at[i];
    const double force = contact.force_T.dot(contact.normal_T);
    all += force;
    if (std::any_of(patch.triangle.begin(), end,
                    [&](const PatchTriangle& triangle) { return triangle.id == contact.place.triangle; }))
      continue;
    gone += force;
    lost.force += contact.force_T;
    lost.moment += (contact.tool_T - X_TI.p).cross(contact.force_T);
  }
  if (gone <= 0) return;
  parting_ = parting_ * parting_share_ + lost;
  parting_j_ = (parting_share_ > 0 ? parting_j_ : 0) + stored_j_ * gone / all;
  parting_share_ = 1;
  parting_tip_ = last_goal_;
}

/// It does no more on the tool than the contacts had stored.
void ContactRenderer::add_parting(const Pose& X_TI, ContactResult& result) {
  if (parting_share_ <= 0) return;
  parting_j_ -= parting_share_ * parting_.force.dot(X_TI.p - parting_tip_);
  parting_tip_ = X_TI.p;
  parting_share_ = parting_j_ > 0 ? parting_share_ - glide_.period_s() / kParting : 0;
  if (parting_share_ <= 0) return;
  const Wrench left = parting_ * parting_share_;
  result.F_I_T = result.F_I_T + left;
  result.spring_I_T = result.spring_I_T + left;
  result.stored_j += parting_j_;
  if (result.contact) return;
  result.contact = result.tip_contact = true;
  result.point_T = X_TI.p;
  result.normal_T = parting_.force.normalized();
}

void ContactRenderer::add_hold(const Pose& X_TI, const GripHold& hold, ContactResult& result) {
  const Vec3 point = X_TI * hold.point_I, stretch = hold.anchor_T - point;
  Wrench pull;
  pull.force = hold.stiffness_n_per_m * stretch;
  pull.moment = (point - X_TI.p).cross(pull.force);
  glide_.pulled(pull.force, X_TI);
  result.F_I_T = result.F_I_T + pull;
  result.spring_I_T = result.spring_I_T + pull;
  result.stored_j += 0.5 * hold.stiffness_n_per_m * stretch.squaredNorm();
  if (result.contact || stretch.norm() < kArrived) return;
  result.contact = result.tip_contact = true;  // the jaws, not the shaft
  result.point_T = point;
  result.normal_T = stretch.normalized();
  result.depth_m = stretch.norm();
}

void ContactRenderer::add_ring(const Pose& X_TI, const Twist& V_TI_T, const RingOnWire& ring, ContactResult& result) {
  const RingTouch touch = touch_ring(ring, X_TI, V_TI_T);
  if (touch.depth_m <= 0) return;
  result.F_I_T = result.F_I_T + touch.spring_I_T * touch.damping_factor;
  result.spring_I_T = result.spring_I_T + touch.spring_I_T;
  result.stored_j += touch.stored_j;
  if (result.contact) return;
  result.contact = result.tip_contact = true;  // the ring, not the shaft
  result.damping_factor = touch.damping_factor;
  result.point_T = touch.point_T;
  result.normal_T = touch.normal_T;
  result.depth_m = touch.depth_m;
}

void ContactRenderer::fade(ContactResult& result) {
  const double share = glide_.force_share();
  result.F_I_T = result.F_I_T * share;
  result.spring_I_T = result.spring_I_T * share;
  result.stored_j *= share;
  stored_j_ *= share;
  for (int i = 0; i < contacts_.count; ++i) contacts_.at[i].force_T *= share;
}

void ContactRenderer::ease(const Pose& X_TI, ContactResult& result) {
  const Vec3 moved = X_TI.p - std::exchange(eased_tip_, X_TI.p);
  const double lost = std::exchange(eased_stored_, result.stored_j) - result.stored_j;
  const double change = (result.F_I_T.force - eased_.force).norm(), most = kMostChange * glide_.period_s();
  const double share = change > most ? most / change : 1;
  const Wrench felt = eased_ * (1 - share) + result.F_I_T * share;
  const bool stronger = felt.force.norm() > result.F_I_T.force.norm();
  // A force that lags does no more on the tool than the springs had stored that are gone.
  eased_j_ = share < 1 ? eased_j_ + std::max(0.0, lost) : 0;
  if (stronger) eased_j_ -= (felt.force - result.F_I_T.force).dot(moved);
  if (share < 1 && (!stronger || eased_j_ > 0)) {
    result.F_I_T = felt;
    result.spring_I_T = eased_spring_ * (1 - share) + result.spring_I_T * share;
    if (stronger) result.stored_j += eased_j_;
    if (!result.contact) {
      result.contact = result.tip_contact = true;
      result.point_T = X_TI.p;
      result.normal_T = felt.force.normalized();
    }
  }
  eased_ = result.F_I_T;
  eased_spring_ = result.spring_I_T;
}

ContactResult ContactRenderer::thesis_law(const Pose& X_TI, const ContactPatch& patch) {
  ContactResult result;
  double nearest = -1;
  int index = -1;
  for (int i = 0; i < patch.count; ++i) {
    const Vec3 point = closest_point_on_triangle(X_TI.p, patch.corners(i));
    const double distance = (point - X_TI.p).norm();
    if (nearest < 0 || distance < nearest) {
      nearest = distance;
      index = i;
      result.point_T = point;
    }
  }
  const PatchTriangle* triangle = index < 0 ? nullptr : &patch.triangle[index];
  if (!triangle || (X_TI.p - result.point_T).dot(triangle->normal) >= 0) return result;
  result.contact = result.tip_contact = true;
  result.depth_m = nearest;
  result.normal_T = triangle->normal;
  const double stiffness = patch.material[static_cast<std::size_t>(triangle->material)].stiffness_n_per_m;
  result.F_I_T.force = stiffness * (result.point_T - X_TI.p);
  result.F_I_T.moment = (result.point_T - X_TI.p).cross(result.F_I_T.force);
  result.spring_I_T = result.F_I_T;
  result.stored_j = 0.5 * stiffness * nearest * nearest;
  contacts_.at[contacts_.count++] = {{triangle->id, barycentric_of(result.point_T, patch.corners(index))},
                                     triangle->normal,
                                     result.F_I_T.force,
                                     {},
                                     X_TI.p,
                                     1};
  return result;
}

void ContactRenderer::move_proxy(const Vec3& goal, const CapsuleAxes& axes, const ContactPatch& patch) {
  const double turn = turn_to(axes);
  const double moved = (goal - last_goal_).norm();
  last_goal_ = goal;
  touch_count_ = 0;
  const int turns = std::clamp(static_cast<int>(std::ceil(turn / (0.5 * thinnest_m_))), 1, kMaxSteps);
  const CapsuleAxes before = axes_;
  for (int i = 1; i <= turns; ++i) {
    const double s = static_cast<double>(i) / turns;
    for (int c = 0; c < tool_.count; ++c) {
      axes_[c].front = before[c].front + s * (axes[c].front - before[c].front);
      axes_[c].back = before[c].back + s * (axes[c].back - before[c].back);
    }
    near_.turn(before, axes, 1.0 / turns);
    project(patch, kSlideSlack);  // the instrument may have turned into the surface
  }
  // The proxy slides no further than this in one period, and no further than its force may turn.
  const double allowance = kIdleTravel + 1.5 * moved, most_turn = kIdleTurn + moved / kRounding;
  const Vec3 from = proxy_;
  const double whole = slide(goal, allowance, patch);
  const auto holds = [&] { return !push_.isZero(0) && turned() <= most_turn; };
  if (last_push_.isZero(0) || holds()) return;
  const auto holds_after = [&](double way) {
    near_.travel((from - proxy_).norm());
    proxy_ = from;
    project(patch, kSlideSlack);
    slide(goal, way, patch);
    return holds();
  };
  // If it turns without a slide a wall is met: that is not held back.
  double least = 0, most = holds_after(0) ? whole : 0;
  for (int i = 0; i < kTurnHalvings && most > 0; ++i) {
    const double middle = (least + most) / 2;
    (holds_after(middle) ? least : most) = middle;
  }
  holds_after(most > 0 ? least : allowance);
}

double ContactRenderer::turned() const {
  return std::acos(std::min(1.0, push_.dot(last_push_) / (push_.norm() * last_push_.norm())));
}

double ContactRenderer::slide(const Vec3& goal, double allowance, const ContactPatch& patch) {
  double way = 0;
  const double stride = 0.5 * thinnest_m_;
  double fall = stride;
  for (int slides = 0, falls = 0; falls < kMostFall;) {
    const Vec3 wish = goal - proxy_, step = free_step(wish);
    const double length = step.norm();
    if (length < kArrived) break;
    // In the air, slid off an edge, or with walls beside it that do not hold it, it carries nothing however deep the
    // instrument is: it falls until it lands.
    const bool in_air = touch_count_ == 0 || (length > allowance && (wish - step).norm() < kArrived);
    if (!in_air && (allowance <= kArrived || slides == kMaxSteps)) break;
    ++(in_air ? falls : slides);
    double travel = std::min({length, stride, in_air ? fall : allowance});
    const Vec3 along = step / length;
    proxy_ += travel * along;
    near_.travel(travel);
    const double back = std::min(travel, overshoot(along, in_air ? kHeadOn : kAgainst, patch));
    proxy_ -= back * along;
    near_.travel(back);
    travel -= back;
    if (!in_air) {
      allowance -= travel;
      way += travel;
    }
    project(patch, kSlideSlack);
    // How far back it met something is only near the truth close to it: who would have to go back all the way tries
    // less.
    fall = in_air && travel < kArrived ? fall / 4 : stride;
    if (in_air && touch_count_ > 0) allowance = std::max(allowance, kIdleTravel);
  }
  // Sliding off a ridge leaves the proxy a hair above it: who carries the force is asked with a wider slack.
  project(patch, kShareSlack);
  if (touch_count_ == 0) lean_on_nearest(goal, patch);
  const Vec3 y = proxy_ - goal;
  push_ = touch_count_ == 0 || y.norm() < kArrived ? Vec3(Vec3::Zero()) : Vec3(y - share_out(y));
  return way;
}

std::pair<ClosestPair, double> ContactRenderer::measure(int n, const ContactPatch& patch) {
  const NearPairs::Pair pair = near_.at(n);
  const CapsuleAxis& axis = axes_[pair.capsule];
  const ClosestPair closest =
      closest_segment_triangle(proxy_ + axis.front, proxy_ + axis.back, patch.corners(pair.index));
  const double gap = closest.distance - tool_.at[pair.capsule].radius_m;
  near_.measured(n, gap);
  return {closest, gap};
}

/// Pushed out from there it would lose the surface that it slides on, and slide back in the next period.
double ContactRenderer::overshoot(const Vec3& along, double least_cosine, const ContactPatch& patch) {
  near_.keep_up({tool_, axes_, proxy_}, patch, kSlideSlack);
  double back = 0;
  for (int n = 0; n < near_.count(); ++n) {
    if (!near_.due(near_.at(n), 0)) continue;
    const auto [closest, gap] = measure(n, patch);
    if (gap > -kSlideSlack || closest.distance < 1e-9) continue;
    const double against = along.dot(closest.on_triangle - closest.on_segment) / closest.distance;
    if (against > least_cosine) back = std::max(back, -gap / against);
  }
  return back;
}

void ContactRenderer::lean_on_nearest(const Vec3& goal, const ContactPatch& patch) {
  project(patch, kSlideSlack);
  if (touch_count_ == 0 || (goal - proxy_).norm() < kArrived) return;
  const auto nearest = std::min_element(touch_.begin(), touch_.begin() + touch_count_,
                                        [](const Touch& l, const Touch& r) { return l.gap < r.gap; });
  const double gap = std::max(0.0, nearest->gap);
  proxy_ -= gap * nearest->normal;
  near_.travel(gap);
  project(patch, kShareSlack);
}

double ContactRenderer::turn_to(const CapsuleAxes& axes) const {
  double furthest = 0;
  for (int c = 0; c < tool_.count; ++c) {
    furthest = std::max({furthest, (axes[c].front - axes_[c].front).norm(), (axes[c].back - axes_[c].back).norm()});
  }
  return furthest;
}

CapsuleAxes ContactRenderer::place_capsules(const Pose& X_TI) {
  CapsuleAxes axes;
  for (int c = 0; c < tool_.count; ++c) {
    const Capsule& capsule = tool_.at[c];
    axes[c].front = X_TI.R * capsule.X_IC.p;
    axes[c].back = axes[c].front - X_TI.R * (capsule.X_IC.R.col(2) * capsule.length_m);
  }
  if (!started_) {
    proxy_ = last_goal_ = X_TI.p;
    last_push_.setZero();
    axes_ = axes;
    started_ = true;
  }
  for (int c = known_; c < tool_.count; ++c) axes_[c] = axes[c];  // picked up just now
  known_ = tool_.count;
  return axes;
}

ContactResult ContactRenderer::proxy_law(const Pose& X_TI, const Twist& V_TI_T, const ContactPatch& patch) {
  const Vec3 goal = X_TI.p;
  const CapsuleAxes axes = place_capsules(X_TI);
  const double travel = (goal - last_goal_).norm();
  move_proxy(goal, axes, patch);

  ContactResult result;
  const Vec3 y = proxy_ - goal;
  const bool free = push_.isZero(0);
  last_push_ = push_;
  const Touch* largest = &touch_[0];
  for (int i = 0; !free && i < touch_count_; ++i) {
    if (touch_[i].share > largest->share) largest = &touch_[i];
  }
  if (free || largest->share <= 0) {
    touching_ = false;
    friction_.reset();
    return result;
  }
  blend_material(patch, travel);
  list_pressed(patch);
  const double depth = push_.norm(), approach = approach_speed(V_TI_T, depth);
  const double damping = result.damping_factor = std::max(0.0, 1 + 1.5 * blend_.damping_s_per_m * approach);
  glide_.dissipated((damping - 1) * blend_.stiffness_n_per_m * depth * approach * glide_.period_s());
  for (int i = 0; i < contacts_.count; ++i) {
    const PressedPlace& p = pressed_[i];
    const Vec3 force = blend_.stiffness_n_per_m * p.share * p.normal;
    result.spring_I_T.force += force;
    result.spring_I_T.moment += (p.foot - proxy_).cross(force);
    contacts_.at[i].force_T = force * damping;
    contacts_.at[i].tool_T = p.foot - y;
    contacts_.at[i].share = std::clamp(p.share / std::max(kArrived, p.normal.dot(push_)), 0.0, 1.0);
  }
  result.F_I_T = result.spring_I_T * damping;
  result.contact = true;
  result.tip_contact = largest->at_tip;
  result.point_T = largest->point;
  result.normal_T = push_ / depth;
  result.depth_m = depth;
  result.stored_j = stored_j_ = 0.5 * blend_.stiffness_n_per_m * depth * depth;
  add_friction(X_TI, V_TI_T, patch, result);
  return result;
}

void ContactRenderer::list_pressed(const ContactPatch& patch) {
  for (int i = 0; i < touch_count_ && contacts_.count < kMaxPressedPlaces; ++i) {
    const Touch& t = touch_[i];
    if (t.share <= 0) continue;
    SolvedContact& contact = contacts_.at[contacts_.count];
    contact.place = {patch.triangle[t.index].id, barycentric_of(t.point, patch.corners(t.index))};
    contact.normal_T = t.normal;
    const Vec3 velocity = patch.velocity_at(t.index, contact.place.weight);
    pressed_[contacts_.count++] = {t.point, t.normal, t.share, t.index, t.capsule, velocity};
  }
}

void ContactRenderer::add_friction(const Pose& X_TI, const Twist& V_TI_T, const ContactPatch& patch,
                                   ContactResult& result) {
  const FrictionResult friction =
      friction_.update({X_TI, V_TI_T, tool_, proxy_ - X_TI.p}, pressed(), blend_.stiffness_n_per_m, patch);
  for (int i = 0; i < contacts_.count; ++i) {
    contacts_.at[i].force_T += friction.at[i].force;
    contacts_.at[i].anchor = friction.at[i].anchor;
  }
  result.F_I_T = result.F_I_T + friction.F_I_T;
  result.spring_I_T = result.spring_I_T + friction.F_I_T;
  result.stored_j += friction.stored_j;
  result.slipping = friction.slipping;
}

void ContactRenderer::blend_material(const ContactPatch& patch, double travel_m) {
  double sum = 0, stiffness = 0, damping = 0;
  for (int i = 0; i < touch_count_; ++i) {
    const auto& material = patch.material[static_cast<std::size_t>(patch.triangle[touch_[i].index].material)];
    sum += touch_[i].share;
    stiffness += touch_[i].share * material.stiffness_n_per_m;
    damping += touch_[i].share * material.damping_s_per_m;
  }
  // Of gliding tissue the stiffness is of the place and glides itself.
  const double follow = touching_ && patch.glide_s <= 0 ? std::min(1.0, travel_m / kBlendTravel) : 1;
  touching_ = true;
  blend_.stiffness_n_per_m += follow * (stiffness / sum - blend_.stiffness_n_per_m);
  blend_.damping_s_per_m += follow * (damping / sum - blend_.damping_s_per_m);
}

double ContactRenderer::approach_speed(const Twist& V_TI_T, double depth_m) const {
  double power = 0;
  for (const PressedPlace& p : pressed()) {
    const Vec3 lever = p.foot - proxy_;
    power -= p.share * p.normal.dot(V_TI_T.linear + V_TI_T.angular.cross(lever) - p.velocity);
  }
  return power / depth_m;
}

void ContactRenderer::project(const ContactPatch& patch, double slack) {
  for (int i = 0; i < kSweeps; ++i) {
    if (sweep(patch, slack) < kArrived) return;
  }
}

double ContactRenderer::sweep(const ContactPatch& patch, double slack) {
  const PlacedTool placed{tool_, axes_, proxy_};
  touch_count_ = 0;
  double deepest = 0;
  near_.keep_up(placed, patch, slack);
  for (int n = 0; n < near_.count(); ++n) {
    if (!near_.due(near_.at(n), slack)) continue;
    const NearPairs::Pair pair = near_.at(n);
    const auto [closest, gap] = measure(n, patch);
    if (gap > slack) continue;
    // On the axis itself the direction is undefined: the surface's own normal leads out.
    Vec3 normal = patch.triangle[pair.index].normal;
    if (closest.distance > 1e-9) normal = (closest.on_segment - closest.on_triangle) / closest.distance;
    if (gap < 0) {
      proxy_ -= gap * normal;
      near_.travel(-gap);
      if (near_.keep_up(placed, patch, slack)) n = near_.first_after(pair) - 1;  // pushed further than the list reached
    }
    deepest = std::max(deepest, -gap);
    const bool at_tip = tool_.at[pair.capsule].foremost && closest.along == 0;
    add_touch({normal, closest.on_triangle, gap, pair.index, pair.capsule, at_tip});
  }
  return deepest;
}

void ContactRenderer::add_touch(const Touch& touch) {
  for (int i = 0; i < touch_count_; ++i) {
    if (touch_[i].capsule == touch.capsule && touch_[i].normal.dot(touch.normal) > kSameNormal &&
        (touch_[i].point - touch.point).norm() < kSamePoint) {
      if (touch.gap < touch_[i].gap) touch_[i] = touch;  // the nearer one is the surface's true foot
      return;
    }
  }
  if (touch_count_ < kMaxContacts) {
    touch_[touch_count_++] = touch;
    return;
  }
  const auto furthest =
      std::max_element(touch_.begin(), touch_.end(), [](const Touch& l, const Touch& r) { return l.gap < r.gap; });
  if (touch.gap < furthest->gap) *furthest = touch;
}

Vec3 ContactRenderer::free_step(const Vec3& wish) const {
  std::array<HalfSpace, kMaxContacts> half_spaces;
  for (int i = 0; i < touch_count_; ++i) {
    half_spaces[i] = {touch_[i].normal, std::max(0.0, touch_[i].gap)};
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
  for (int round = 0; round < kShareRounds && carrying_count_ < kMaxPressedPlaces; ++round) {
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
    double reach = 1;  // how far towards that solution all shares stay positive, and are borne
    double sum_now = 0, sum_then = 0;
    for (int i = 0; i < carrying_count_; ++i) {
      const double now = touch_[carrying_[i]].share;
      if (share[i] <= 0) reach = std::min(reach, now / (now - share[i]));
      sum_now += now;
      sum_then += share[i];
    }
    // Planes that nearly face each other would have to press by a thousand times what they hold, and friction with
    // them.
    const double most = kMostWedge * y.norm();
    const bool wedged = sum_then > most;
    if (wedged) reach = std::min(reach, std::max(0.0, most - sum_now) / (sum_then - sum_now));
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
    const bool settled = kept == carrying_count_ || wedged;
    carrying_count_ = kept;
    if (settled) return;
  }
}

}  // namespace trocar
