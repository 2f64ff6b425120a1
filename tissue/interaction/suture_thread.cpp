#include "tissue/interaction/suture_thread.h"

#include <algorithm>
#include <cmath>

#include "tissue/thin/rod_in_jaws.h"

namespace trocar {
namespace {

constexpr double kSwageAnchor = 2000;                 // N/m (a choice)
constexpr double kOffSwage = 3e-4;                    // m of thread that the swage keeps out of any hole
constexpr double kTailEnd = 5e-4;                     // m before its end, at which the tail has gone through
constexpr double kLeastInside = 0.5;                  // of the bridge at rest, thread in it
constexpr double kRoundHole = 0.004;                  // m of thread beside a hole that the surface does not push
constexpr double kSurfaceSeen = 0.008;                // m from the surface's nearest vertex
constexpr double kSurfacePush = 30;                   // N/m under the surface (a choice)
constexpr double kShaftPush = 200;                    // N/m in the shaft (a choice)
constexpr double kShaftBehind = 0.15;                 // m of shaft that the thread may touch
constexpr double kKnotDraws = 0.002;                  // m by which a knot draws its limbs together in a step
constexpr double kBesideKnot = 0.001;                 // m between a knot and the hole beside it
constexpr double kLimbFrom = 0.003;                   // m from a hole at which a knot may be tied
constexpr double kTied = 0.1;                         // N in both limbs that a knot is drawn tight with
constexpr double kHitchPull = 0.3, kSlackLimb = 0.2;  // N in one limb, and share of it in the other: a half hitch
constexpr double kLoopLeft = 0.006;                   // m of a closed loop beyond the tissue in it
constexpr double kBeyondKnot = 0.006;                 // m behind a knot where a limb's tension is read
constexpr double kThreadSampling = 0.001;             // m
constexpr int kRingAxes = 3;
constexpr int kNewton = 2;  // steps of Newton's method: the next step goes on from there

RodOptions rod_of(const SutureThreadOptions& o, double step_s) {
  RodOptions rod;
  rod.outer_radius_m = rod.wall_m = o.radius_m;
  rod.young_pa = o.young_pa;
  rod.density_kg_m3 = o.density_kg_m3;
  rod.content_kg_m3 = 0;
  rod.stiffening = 0;
  rod.most_stiffening = 1;
  rod.pre_strain = 0;
  rod.avulsion_n = o.swage_n;
  rod.tear_over_avulsion = o.break_n / o.swage_n;
  rod.mass_damping_per_s = o.damping_per_s;
  rod.gravity_m_s2 = {0, 0, -kGravity};
  rod.step_s = step_s;
  rod.most_iterations = kNewton;
  return rod;
}

StitchHole hole_at(const SoftOrgan& organ, const Vec3& rest_T, double arc_m) {
  StitchHole hole;
  hole.rest_T = rest_T;
  hole.shares = organ.shares_within(rest_T);
  hole.at_T = organ.place_T(hole.shares);
  hole.ring.arc_m = arc_m;
  hole.threaded = true;
  return hole;
}

}  // namespace

SutureThread::SutureThread(std::span<const Vec3> path_T, const SutureThreadOptions& options,
                           const NeedleTissueOptions& tissue, double step_s)
    : options_(options),
      tissue_(tissue),
      rod_(evenly_spaced(path_T, options.spacing_m), rod_of(options, step_s)),
      vertex_(rod_.nodes().size(), -1) {
  rod_.anchor(RodEnd::kStart, {.position = path_T.front(), .stiffness_n_per_m = kSwageAnchor, .clamped = false});
}

ThreadPull SutureThread::pull() const {
  if (!rod_.anchored(RodEnd::kStart)) return {};
  return {rod_.anchor_load(RodEnd::kStart).force, rod_.anchor_stiffness(RodEnd::kStart),
          rod_.anchor_way(RodEnd::kStart)};
}

std::optional<SutureThread::Held> SutureThread::held_first() const {
  if (!rod_.anchored(RodEnd::kStart)) return std::nullopt;
  std::optional<Held> first;
  const auto take = [&](double arc_m, const Vec3& place_T) {
    if (!first || arc_m < first->arc_m) first = Held{place_T, arc_m};
  };
  for (const Stitch& stitch : stitches_)
    for (const StitchHole* hole : {&stitch.exit, &stitch.entry})
      if (hole->threaded) take(hole->ring.arc_m, hole->at_T);
  for (const double arc : grip_.arcs()) take(arc, rod_.place_at(arc));
  const bool whole = !first || std::all_of(rod_.segments().begin(), rod_.segments().end(),
                                           [&](const RodSegment& s) { return s.whole || s.arc_from_m > first->arc_m; });
  return whole ? first : std::nullopt;
}

bool SutureThread::between(const Pose& X_TI, double opening_m) const {
  const RodGripOptions pads;
  return grip_.state() != GripState::kEmpty ||
         !arcs_between(rod_, X_TI, {pads.pad_length_m, pads.pad_width_m, opening_m}, 0, kThreadSampling).empty();
}

void SutureThread::enter(const SoftOrgan& organ, const NeedlePath& path) {
  const bool known = std::any_of(stitches_.begin(), stitches_.end(),
                                 [&](const Stitch& stitch) { return stitch.path == path.number(); });
  if (known || path.entry_arc_m() >= -kOffSwage || !rod_.anchored(RodEnd::kStart)) return;
  Stitch stitch;
  stitch.path = path.number();
  stitch.entry = hole_at(organ, path.entry_rest_T(), -path.entry_arc_m());
  stitch.exit.rest_T = path.end_rest_T();
  stitches_.push_back(std::move(stitch));
  knot_.reset();
  watch_.reset();
}

void SutureThread::come_out(const SoftOrgan& organ, const NeedleEvent& event) {
  for (Stitch& stitch : stitches_)
    if (stitch.path == event.path && !stitch.exit.threaded)
      stitch.exit = hole_at(organ, event.end_rest_T, std::max(kOffSwage, -event.end_arc_m));
}

void SutureThread::drop(std::int32_t path) {
  std::erase_if(stitches_, [path](const Stitch& stitch) { return stitch.path == path && !stitch.exit.threaded; });
}

void SutureThread::follow_cut(const SoftOrgan& organ) {
  for (Stitch& stitch : stitches_)
    for (StitchHole* hole : {&stitch.entry, &stitch.exit})
      if (hole->threaded) hole->shares = organ.shares_within(hole->rest_T);
  std::fill(vertex_.begin(), vertex_.end(), -1);
}

std::vector<Vec3> SutureThread::limb(Limb limb) const {
  std::vector<Vec3> out;
  if (stitches_.empty() || !tied_round(stitches_.back())) return out;
  const Stitch& stitch = stitches_.back();
  const StitchHole& from = limb == Limb::kLong ? stitch.exit : stitch.entry;
  out.push_back(from.at_T);
  for (const RodNode& node : rod_.nodes())
    if (limb == Limb::kLong ? node.arc_m < from.ring.arc_m : node.arc_m > from.ring.arc_m) out.push_back(node.position);
  if (limb == Limb::kLong) std::reverse(out.begin() + 1, out.end());
  return out;
}

double SutureThread::tension_at(double arc_m) const {
  const RodSegment& segment = rod_.segments()[rod_.segment_at(std::clamp(arc_m, 0.0, rod_.length_m()))];
  return segment.whole ? segment.tension_n : 0;
}

void SutureThread::push_off_organ(const OrganView& view, std::vector<RodSpring>& springs) {
  const SurfaceSnapshot& surface = *view.organ.surface();
  const auto nodes = rod_.nodes();
  vertex_.resize(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double arc = nodes[i].arc_m;
    const bool in_hole = std::any_of(stitches_.begin(), stitches_.end(), [&](const Stitch& stitch) {
      const double from = stitch.exit.threaded ? stitch.exit.ring.arc_m - kRoundHole : -1;
      return arc > from && arc < stitch.entry.ring.arc_m + kRoundHole;
    });
    const Vec3& place = nodes[i].position;
    if (const double under = view.floor_m - place.z(); under > 0)
      springs.push_back({arc, -Vec3::UnitZ(), kSurfacePush, under, true, 0});
    vertex_[i] = view.walk.nearest(surface.vertices, place, vertex_[i]);
    if (in_hole || (surface.vertices[static_cast<std::size_t>(vertex_[i])] - place).norm() > kSurfaceSeen) continue;
    const SurfaceFoot foot = view.walk.foot(surface.vertices, place, vertex_[i]);
    const double deep = options_.radius_m - foot.height_m;
    if (deep > 0) springs.push_back({arc, -foot.normal, kSurfacePush, deep, true, 0});
  }
}

void SutureThread::push_off_shaft(const Around& around, std::vector<RodSpring>& springs) const {
  if (around.tool == nullptr) return;
  const Pose X_IT = around.X_TI.inverse();
  const double reach = around.tool->shape.radius_m + options_.radius_m, begin = -around.tool->shape.jaw_length_m;
  for (std::size_t i = 0; i < rod_.segments().size(); ++i) {
    const RodSegment& segment = rod_.segments()[i];
    if (!segment.whole) continue;
    const Vec3 a = X_IT * rod_.nodes()[i].position, edge = X_IT * rod_.nodes()[i + 1].position - a;
    const double across = edge.head<2>().squaredNorm();
    const double along = across > 0 ? std::clamp(-a.head<2>().dot(edge.head<2>()) / across, 0.0, 1.0) : 0.5;
    const Vec3 near = a + along * edge;
    const double distance = near.head<2>().norm();
    if (near.z() > begin || near.z() < -kShaftBehind || distance >= reach || distance < 1e-6) continue;
    const Vec3 outward = around.X_TI.R * Vec3(near.x() / distance, near.y() / distance, 0);
    springs.push_back({segment.arc_from_m + along * (segment.arc_to_m - segment.arc_from_m), -outward, kShaftPush,
                       reach - distance, true, 0});
  }
}

void SutureThread::add_knot(std::vector<RodSpring>& springs) {
  if (!knot_) return;
  const auto going = [&](const RodRing& ring) {
    return Vec3(rod_.place_at(ring.arc_m) + rod_.options().step_s * rod_.velocity_at(ring.arc_m));
  };
  const Vec3 middle = (going(knot_->of_long) + going(knot_->of_tail)) / 2;
  for (RodRing* ring : {&knot_->of_long, &knot_->of_tail}) {
    const Vec3 from = rod_.place_at(ring->arc_m), way = middle - from;
    const double most = kKnotDraws + (going(*ring) - from).norm();
    ring->add_springs(rod_, from + std::min(1.0, most / std::max(way.norm(), 1e-9)) * way, options_.ring_n_per_m,
                      springs);
  }
}

void SutureThread::step(const OrganView& view, const Around& around, std::vector<SoftSpring>& springs) {
  events_.clear();
  std::vector<RodSpring> of_rod;
  if (around.jaws)
    grip_.reach(around.jaws->X_TI, around.jaws->opening_m, rod_, of_rod);
  else
    grip_.let_go();
  const std::size_t of_grip = of_rod.size();
  for (Stitch& stitch : stitches_)
    for (StitchHole* hole : {&stitch.exit, &stitch.entry}) {
      if (!hole->threaded) continue;
      hole->at_T = view.organ.place_T(hole->shares);
      hole->ring.add_springs(rod_, hole->at_T, options_.ring_n_per_m, of_rod);
    }
  const std::size_t of_holes = of_rod.size() - of_grip;
  add_knot(of_rod);
  const std::size_t of_knot = of_rod.size() - of_grip - of_holes;
  push_off_organ(view, of_rod);
  push_off_shaft(around, of_rod);
  if (rod_.anchored(RodEnd::kStart))
    rod_.anchor(RodEnd::kStart, {.position = around.swage_T - around.swage_way,
                                 .velocity = around.swage_way / rod_.options().step_s,
                                 .stiffness_n_per_m = kSwageAnchor,
                                 .clamped = false});
  rod_.step(of_rod);
  const std::span<const RodSpring> done = of_rod;
  if (around.jaws) grip_.feel(around.jaws->X_TI, done.first(of_grip), rod_);
  take_rod_events();
  feel_stitches(view, done.subspan(of_grip, of_holes), springs);
  feel_knot(done.subspan(of_grip + of_holes, of_knot));
  watch_throws(around);
}

void SutureThread::feel_stitches(const OrganView& view, std::span<const RodSpring> of_holes,
                                 std::vector<SoftSpring>& springs) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < stitches_.size(); ++i) {
    Stitch& stitch = stitches_[i];
    const double inside = stitch.exit.threaded ? stitch.bridge_m() : stitch.entry.ring.arc_m;
    for (StitchHole* hole : {&stitch.exit, &stitch.entry}) {
      if (!hole->threaded) continue;
      hole->ring.take(of_holes.subspan(next, kRingAxes));
      next += kRingAxes;
      hole->ring.add_loads(rod_, hole->shares, options_.ring_n_per_m, springs);
      // Holes keep their order, and some thread between them however the tissue there is squeezed.
      const double bridge = stitch.exit.threaded ? kLeastInside * stitch.bridge_m() : 0;
      const bool first = hole == &stitch.exit;
      const double from = !first                     ? (stitch.exit.threaded ? stitch.exit.ring.arc_m + bridge : 0)
                          : i + 1 < stitches_.size() ? stitches_[i + 1].entry.ring.arc_m
                                                     : kOffSwage;
      const double to = first   ? stitch.entry.ring.arc_m - bridge
                        : i > 0 ? stitches_[i - 1].exit.ring.arc_m
                                : rod_.length_m();
      hole->ring.settle(rod_, options_.ring_n_per_m, options_.friction_n_per_m * inside / 2, options_.edge_friction,
                        from, to);
    }
    const Vec3 sum = stitch.entry.ring.force_T + stitch.exit.ring.force_T,
               apart = stitch.entry.ring.force_T - stitch.exit.ring.force_T;
    stitch.load_n = std::max(sum.norm(), apart.norm());
    const bool over = stitch.load_n > pull_out_force(view.organ.material(), stitch.bridge_m(), tissue_);
    stitch.over_s = over && tied_round(stitch) ? stitch.over_s + rod_.options().step_s : 0;
  }
  const auto gone = [&](const Stitch& stitch) {
    const bool torn = stitch.over_s >= tissue_.overload_s;
    const bool drawn = tied_round(stitch) && stitch.entry.ring.arc_m > rod_.length_m() - kTailEnd;
    if (torn || drawn)
      events_.push_back({torn ? ThreadEvent::Kind::kPulledOut : ThreadEvent::Kind::kDrawnThrough,
                         {},
                         stitch.entry.rest_T,
                         stitch.exit.rest_T,
                         stitch.load_n,
                         stitch.entry.ring.arc_m});
    return torn || drawn;
  };
  const bool last_gone = !stitches_.empty() && gone(stitches_.back());
  if (last_gone) {
    stitches_.pop_back();
    knot_.reset();
    watch_.reset();
  }
  std::erase_if(stitches_, gone);
}

void SutureThread::feel_knot(std::span<const RodSpring> springs) {
  if (!knot_ || stitches_.empty()) return;
  const Stitch& stitch = stitches_.back();
  knot_->of_long.take(springs.first(kRingAxes));
  knot_->of_tail.take(springs.last(kRingAxes));
  const double limit = holding_force(knot_->throws, options_.knot), end = rod_.length_m();
  knot_->of_long.settle(rod_, options_.ring_n_per_m, limit, 0, 0, stitch.exit.ring.arc_m - kBesideKnot);
  knot_->of_tail.settle(rod_, options_.ring_n_per_m, limit, 0, stitch.entry.ring.arc_m + kBesideKnot, end);
  if (knot_->of_tail.arc_m > end - kTailEnd || knot_->of_long.arc_m < kOffSwage) {
    knot_.reset();
    events_.push_back({.kind = ThreadEvent::Kind::kUndone, .made = {}});
    return;
  }
  const double loop = knot_->of_tail.arc_m - knot_->of_long.arc_m - (stitch.entry.ring.arc_m - stitch.exit.ring.arc_m);
  if (knot_->tight || loop > stitch.bridge_m() + kLoopLeft) return;
  const double of_long = tension_at(knot_->of_long.arc_m - kBeyondKnot),
               of_tail = tension_at(knot_->of_tail.arc_m + kBeyondKnot);
  const double less = std::min(of_long, of_tail), more = std::max(of_long, of_tail);
  const bool hitch = more > kHitchPull && less < kSlackLimb * more;
  if (!hitch && less < kTied) return;
  knot_->tight = true;
  knot_->throws.back().hitch = hitch;
  events_.push_back({ThreadEvent::Kind::kTight, knot_->throws.back(), stitch.entry.rest_T, stitch.exit.rest_T, less});
}

void SutureThread::watch_throws(const Around& around) {
  if (around.tool == nullptr || stitches_.empty() || !tied_round(stitches_.back())) return;
  const std::vector<Vec3> of_long = limb(Limb::kLong), of_tail = limb(Limb::kTail);
  std::optional<Limb> held;
  const Stitch& stitch = stitches_.back();
  if (const std::vector<double> arcs = grip_.arcs(); !arcs.empty()) {
    const double arc = arcs[arcs.size() / 2];
    if (arc < stitch.exit.ring.arc_m) held = Limb::kLong;
    if (arc > stitch.entry.ring.arc_m) held = Limb::kTail;
  }
  if (const auto made = watch_.step({of_long, of_tail, around.X_TI, held})) tie(*made);
}

void SutureThread::tie(const Throw& made) {
  if (stitches_.empty() || !tied_round(stitches_.back())) return;
  const Stitch& stitch = stitches_.back();
  events_.push_back({ThreadEvent::Kind::kThrow, made, stitch.entry.rest_T, stitch.exit.rest_T});
  if (knot_) {
    knot_->throws.push_back(made);
    knot_->tight = false;
    return;
  }
  // Where the limbs are nearest to one another, off the tissue.
  double least = INFINITY;
  Knot knot;
  knot.throws = {made};
  for (const RodNode& a : rod_.nodes())
    for (const RodNode& b : rod_.nodes()) {
      if (a.arc_m > stitch.exit.ring.arc_m - kLimbFrom || b.arc_m < stitch.entry.ring.arc_m + kLimbFrom) continue;
      const double distance = (a.position - b.position).norm();
      if (distance < least) least = distance, knot.of_long.arc_m = a.arc_m, knot.of_tail.arc_m = b.arc_m;
    }
  if (std::isfinite(least)) knot_ = knot;
}

void SutureThread::take_rod_events() {
  for (const RodEvent& event : rod_.events()) {
    const bool broke = event.kind == RodEvent::Kind::kTorn;
    events_.push_back(
        {broke ? ThreadEvent::Kind::kBroke : ThreadEvent::Kind::kOffNeedle, {}, {}, {}, event.pull_n, event.arc_m});
  }
}

}  // namespace trocar
