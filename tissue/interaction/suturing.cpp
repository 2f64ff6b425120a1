#include "tissue/interaction/suturing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <utility>

#include "haptics/input_error.h"
#include "tissue/thin/rod_in_jaws.h"

namespace trocar {
namespace {

// Where a cut of an organ has a triangle, as DuctChange. Recordings of before have a sheet's mark, whose changes are
// whole numbers of four bytes, as no event of a suture is.
constexpr std::int32_t kSutureMark = -44, kFormerSutureMark = -43;
constexpr int kThreadSides = 6;
constexpr std::size_t kNeedlePlaces = 3;
constexpr double kUnderOrgan = 0.005;  // m of the organ's lowest place over what a lost needle lies on
constexpr double kBladeWidth = 0.002, kBladesShut = 0.0005;  // m, as ScissorsOptions
constexpr double kShutOn = 0.00005;  // m by which fingers that hold a needle are nearer than its wire is wide

double lowest(const TriangleSurface& surface) {
  double z = INFINITY;
  for (const Vec3& vertex : surface.vertices) z = std::min(z, vertex.z());
  return z;
}

std::vector<Vec3> drawn_thread(const SutureSetup& setup) {
  const Vec3 swage = setup.X_TN * setup.needle.place(0);
  return {swage, swage + setup.thread_m * setup.thread_along_T.normalized()};
}

template <typename Value>
void put_of_suture(std::string& out, const Value& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename Value>
Value take_of_suture(std::string_view& bytes) {
  if (bytes.size() < sizeof(Value)) throw InputError("an event of a suture ends too early");
  Value value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

SutureEvent::Kind kind_of(NeedleEvent::Kind kind) {
  switch (kind) {
    case NeedleEvent::Kind::kTaken:
      return SutureEvent::Kind::kTaken;
    case NeedleEvent::Kind::kLetGo:
      return SutureEvent::Kind::kLetGo;
    case NeedleEvent::Kind::kPuncture:
      return SutureEvent::Kind::kPuncture;
    case NeedleEvent::Kind::kExit:
      return SutureEvent::Kind::kExit;
    case NeedleEvent::Kind::kWithdrawn:
      return SutureEvent::Kind::kWithdrawn;
    case NeedleEvent::Kind::kThrough:
      return SutureEvent::Kind::kStitch;
    case NeedleEvent::Kind::kTorn:
      break;
  }
  return SutureEvent::Kind::kNeedleTorn;
}

SutureEvent::Kind kind_of(ThreadEvent::Kind kind) {
  switch (kind) {
    case ThreadEvent::Kind::kThrow:
      return SutureEvent::Kind::kThrow;
    case ThreadEvent::Kind::kTight:
      return SutureEvent::Kind::kTight;
    case ThreadEvent::Kind::kUndone:
      return SutureEvent::Kind::kUndone;
    case ThreadEvent::Kind::kPulledOut:
      return SutureEvent::Kind::kPulledOut;
    case ThreadEvent::Kind::kDrawnThrough:
      return SutureEvent::Kind::kDrawnThrough;
    case ThreadEvent::Kind::kBroke:
      return SutureEvent::Kind::kBroke;
    case ThreadEvent::Kind::kOffNeedle:
      break;
  }
  return SutureEvent::Kind::kOffNeedle;
}

bool in_scene(const StylusState& stylus, bool present) {
  return present && stylus.X_TI.p.allFinite() && stylus.X_TI.R.allFinite() && std::isfinite(stylus.jaw_opening_m);
}

/// Those that take needle and thread.
std::optional<DriverJaws> driver_jaws(const StylusState& stylus, const Tool& tool, bool present) {
  const bool drives = tool.kind == InstrumentKind::kNeedleDriver || tool.kind == InstrumentKind::kGrasper;
  if (!drives || !in_scene(stylus, present)) return std::nullopt;
  return DriverJaws{stylus.X_TI, stylus.jaw_opening_m};
}

void add_rod_nodes(const ElasticRod& rod, std::vector<NodePlace>& nodes_T) {
  const std::size_t first = nodes_T.size();
  nodes_T.resize(first + rod.nodes().size());
  for (const RodNode& node : rod.nodes())
    nodes_T[first + static_cast<std::size_t>(node.id)] = node.position.cast<float>();
}

}  // namespace

std::string suture_event_bytes(const SutureEvent& event) {
  std::string out;
  put_of_suture(out, kSutureMark);
  put_of_suture(out, static_cast<std::uint8_t>(event.kind));
  for (const Vec3& place : {event.entry_rest_T, event.exit_rest_T})
    for (int i = 0; i < 3; ++i) put_of_suture(out, place[i]);
  put_of_suture(out, event.force_n);
  put_of_suture(out, event.arc_m);
  put_of_suture(out, event.turns);
  put_of_suture(out, event.sense);
  put_of_suture(out, static_cast<std::uint8_t>(event.hitch));
  return out;
}

bool is_suture_event(std::string_view bytes) {
  std::int32_t mark = 0;
  if (bytes.size() < sizeof mark) return false;
  std::memcpy(&mark, bytes.data(), sizeof mark);
  return mark == kSutureMark || (mark == kFormerSutureMark && bytes.size() % sizeof mark != 0);
}

SutureEvent parse_suture_event(std::string_view bytes) {
  SutureEvent event;
  if (!is_suture_event(bytes)) throw InputError("a change of the tissue is not a suture's");
  take_of_suture<std::int32_t>(bytes);
  const auto kind = take_of_suture<std::uint8_t>(bytes);
  if (kind > static_cast<std::uint8_t>(SutureEvent::Kind::kSnipped))
    throw InputError("an event of a suture is unknown");
  event.kind = static_cast<SutureEvent::Kind>(kind);
  for (Vec3* place : {&event.entry_rest_T, &event.exit_rest_T})
    for (int i = 0; i < 3; ++i) (*place)[i] = take_of_suture<double>(bytes);
  event.force_n = take_of_suture<double>(bytes);
  event.arc_m = take_of_suture<double>(bytes);
  event.turns = take_of_suture<std::int32_t>(bytes);
  event.sense = take_of_suture<std::int32_t>(bytes);
  event.hitch = take_of_suture<std::uint8_t>(bytes) != 0;
  const bool sound = event.entry_rest_T.allFinite() && event.exit_rest_T.allFinite() && std::isfinite(event.force_n) &&
                     std::isfinite(event.arc_m);
  if (!sound || !bytes.empty()) throw InputError("an event of a suture cannot be read");
  return event;
}

Pose needle_in_jaws(const NeedleShape& needle, double share) {
  constexpr double kBehindTip = 0.002;  // m
  const double arc = share * needle.length_m;
  Pose X_NI;
  X_NI.R.col(0) = -needle.tangent(arc);
  X_NI.R.col(1) = -needle.place(arc).normalized();
  X_NI.R.col(2) = X_NI.R.col(0).cross(X_NI.R.col(1));
  X_NI.p = needle.place(arc) + kBehindTip * X_NI.R.col(2);
  return X_NI.inverse();
}

Suturing::Suturing(const SutureSetup& setup, const SoftOrgan& organ, const SutureCounts& so_far)
    : setup_(setup),
      topology_(organ.topology()),
      walk_(*organ.rest()),
      floor_m_(lowest(*organ.rest()) - kUnderOrgan),
      needle_(setup.needle, setup.X_TN, setup.tissue, setup.jaws),
      thread_(drawn_thread(setup), setup.thread, setup.tissue, organ.solid().options().step_s),
      tube_(still_surface(needle_tube(setup.needle))),
      thread_seen_(thread_.rod(), kThreadSides),
      seen_{needle_surface(tube_, setup.X_TN), thread_seen_.surface()},
      counts_(so_far) {
  if (setup.stands) needle_.stand();
}

void Suturing::load(const Pose& X_TI, const Pose& X_IN) {
  needle_.load(X_TI, X_IN);
  locked_ = true;
}

std::optional<DriverJaws> Suturing::locked_jaws(const StylusState& stylus, const Tool& tool, bool present) const {
  auto jaws = driver_jaws(stylus, tool, present);
  if (jaws && locked_) jaws->opening_m = 0;
  return jaws;
}

bool Suturing::jaws_taken(const StylusState& stylus, const Tool& tool, bool present) const {
  if (tool.kind == InstrumentKind::kScissors && in_scene(stylus, present))
    return thread_.between(stylus.X_TI, stylus.jaw_opening_m);
  const auto driver = locked_jaws(stylus, tool, present);
  return driver && (needle_.held() || needle_.between(driver->X_TI, driver->opening_m) ||
                    thread_.between(driver->X_TI, driver->opening_m));
}

void Suturing::follow(const SoftOrgan& organ) {
  if (organ.topology() == topology_) return;
  topology_ = organ.topology();
  walk_ = SurfaceWalk(*organ.rest());
  needle_.follow_cut(organ);
  thread_.follow_cut(organ);
}

void Suturing::before(const HapticState& newest, const Tool& tool, bool present, const SoftOrgan& organ,
                      std::vector<SoftSpring>& springs) {
  events_.clear();
  if (std::exchange(new_, false)) events_.push_back({.kind = SutureEvent::Kind::kBroughtIn});
  follow(organ);
  const OrganView view{organ, walk_, floor_m_};
  if (newest.stylus.jaw_opening_m < 2 * setup_.needle.wire_radius_m - kShutOn) locked_ = false;
  const auto driver = locked_jaws(newest.stylus, tool, present);
  const std::size_t first = springs.size();
  std::vector<SoftSpring> of_needle;
  if (!needle_.held())
    if (const auto held = thread_.held_first()) needle_.tether(held->place_T, held->arc_m);
  needle_.before(view, driver, pull_, of_needle);
  SutureThread::Around around{.swage_T = needle_.swage_T(), .swage_way = needle_.swage_way(), .jaws = {}, .X_TI = {}};
  if (driver && needle_.state() == GripState::kEmpty) around.jaws = driver;
  if (in_scene(newest.stylus, present)) {
    around.tool = &tool, around.X_TI = newest.stylus.X_TI;
    if (tool.kind == InstrumentKind::kScissors) snip(newest.stylus);
  }
  // Of a needle that stands ready only its way counts: its thread runs freely in the holes.
  for (const NeedlePath& path : setup_.stands ? std::span<const NeedlePath>() : needle_.paths()) {
    if (path.entry_arc_m() > 0) thread_.drop(path.number());
    thread_.enter(organ, path);
  }
  thread_.step(view, around, springs);
  of_thread_ = springs.size() - first;
  springs.insert(springs.end(), of_needle.begin(), of_needle.end());
  pull_ = thread_.pull();
}

void Suturing::after(const HapticState& newest, const Tool& tool, bool present, std::span<const SoftSpring> springs,
                     const SoftOrgan& organ) {
  const OrganView view{organ, walk_, floor_m_};
  needle_.after(view, locked_jaws(newest.stylus, tool, present), pull_, springs.subspan(of_thread_));
  take_needle_events(organ);
  take_thread_events();
  for (const SutureEvent& event : events_) count(event);
  seen_[0] = needle_surface(tube_, needle_.X_TN());
  thread_seen_.follow(thread_.rod());
  seen_[1] = thread_seen_.surface();
}

void Suturing::take_needle_events(const SoftOrgan& organ) {
  for (const NeedleEvent& event : needle_.events()) {
    const SutureEvent::Kind kind = kind_of(event.kind);
    if (kind == SutureEvent::Kind::kStitch && !setup_.stands) thread_.come_out(organ, event);
    if (kind == SutureEvent::Kind::kNeedleTorn || kind == SutureEvent::Kind::kWithdrawn) thread_.drop(event.path);
    events_.push_back(
        {.kind = kind, .entry_rest_T = event.entry_rest_T, .exit_rest_T = event.end_rest_T, .force_n = event.force_n});
  }
}

void Suturing::take_thread_events() {
  for (const ThreadEvent& event : thread_.events()) {
    const bool throws = event.kind == ThreadEvent::Kind::kThrow || event.kind == ThreadEvent::Kind::kTight;
    events_.push_back({kind_of(event.kind), event.entry_rest_T, event.end_rest_T, event.force_n, event.arc_m,
                       throws ? event.made.turns : 0, throws ? event.made.sense : 0, event.made.hitch});
  }
}

void Suturing::count(const SutureEvent& event) {
  switch (event.kind) {
    case SutureEvent::Kind::kBroughtIn:
      ++counts_.needles;
      break;
    case SutureEvent::Kind::kTaken:
      ++counts_.regrasps;
      break;
    case SutureEvent::Kind::kPuncture:
      ++counts_.punctures;
      break;
    case SutureEvent::Kind::kExit:
      ++counts_.exits;
      break;
    case SutureEvent::Kind::kStitch:
      ++counts_.stitches;
      break;
    case SutureEvent::Kind::kThrow:
      ++counts_.throws;
      break;
    case SutureEvent::Kind::kNeedleTorn:
    case SutureEvent::Kind::kPulledOut:
      ++counts_.tears;
      break;
    case SutureEvent::Kind::kLetGo:
    case SutureEvent::Kind::kWithdrawn:
    case SutureEvent::Kind::kTight:
    case SutureEvent::Kind::kUndone:
    case SutureEvent::Kind::kDrawnThrough:
    case SutureEvent::Kind::kBroke:
    case SutureEvent::Kind::kOffNeedle:
    case SutureEvent::Kind::kSnipped:
      break;
  }
}

void Suturing::snip(const StylusState& stylus) {
  const double opening = stylus.jaw_opening_m;
  if (opening > blades_m_) in_blades_.reset();
  blades_m_ = opening;
  const JawSpace blades{describe(InstrumentKind::kScissors).jaw_length_m, kBladeWidth, opening};
  const std::vector<double> arcs = arcs_between(thread_.rod(), stylus.X_TI, blades, 0, kBladeWidth / 2);
  if (!arcs.empty() && opening > kBladesShut) in_blades_ = arcs[arcs.size() / 2];
  if (!in_blades_ || opening > kBladesShut) return;
  if (const auto arc = thread_.sever(*in_blades_))
    events_.push_back({.kind = SutureEvent::Kind::kSnipped, .arc_m = *arc});
  in_blades_.reset();
}

SutureState Suturing::state() const {
  return {.needles = counts_.needles,
          .punctures = counts_.punctures,
          .stitches = counts_.stitches,
          .throws = counts_.throws,
          .tears = counts_.tears,
          .knot = static_cast<std::int32_t>(knot()),
          .held = needle_.held(),
          .pull_n = needle_.held() ? needle_.load_T().force.norm() : 0};
}

KnotKind Suturing::knot() const { return thread_.knot() ? knot_kind(thread_.knot()->throws) : KnotKind::kNone; }

GripState Suturing::grip() const {
  return needle_.state() != GripState::kEmpty ? needle_.state() : thread_.grip().state();
}

GripBlock Suturing::block() const {
  return needle_.block().stiffness_n_per_m > 0 ? needle_.block() : thread_.grip().block();
}

GripHold Suturing::hold() const { return needle_.held() ? needle_.hold() : thread_.grip().hold(); }

void Suturing::add_nodes(std::vector<NodePlace>& nodes_T) const {
  const double radius = setup_.needle.radius_m();
  const Pose& X = needle_.X_TN();
  for (const Vec3& place : {X.p, Vec3(X.p + radius * X.R.col(0)), Vec3(X.p + radius * X.R.col(1))})
    nodes_T.push_back(place.cast<float>());
  add_rod_nodes(thread_.rod(), nodes_T);
}

SuturePlayback::SuturePlayback(const SutureSetup& setup, std::span<const std::string> changes)
    : rod_(evenly_spaced(drawn_thread(setup), setup.thread.spacing_m),
           [&] {
             RodOptions options;
             options.outer_radius_m = options.wall_m = setup.thread.radius_m;
             return options;
           }()),
      thread_(rod_, kThreadSides),
      tube_(still_surface(needle_tube(setup.needle))),
      radius_m_(setup.needle.radius_m()) {
  std::vector<SutureEvent> events;
  for (const std::string& bytes : changes) {
    if (!is_suture_event(bytes)) continue;
    events.push_back(parse_suture_event(bytes));
    if (events.back().kind == SutureEvent::Kind::kBroughtIn) there_ = true, events.clear();
  }
  for (const SutureEvent& event : events) {
    if (event.kind != SutureEvent::Kind::kBroke && event.kind != SutureEvent::Kind::kSnipped) continue;
    rod_.sever(event.arc_m);
    thread_.follow(rod_);  // one break after the other: its surface grows by each
  }
}

std::size_t SuturePlayback::nodes() const { return there_ ? kNeedlePlaces + rod_.nodes().size() : 0; }

Pose SuturePlayback::needle_at(std::span<const NodePlace> nodes_T) const {
  Pose X;
  X.p = nodes_T[0].cast<double>();
  X.R.col(0) = ((nodes_T[1].cast<double>() - X.p) / radius_m_).normalized();
  const Vec3 y = nodes_T[2].cast<double>() - X.p;
  X.R.col(1) = (y - y.dot(X.R.col(0)) * X.R.col(0)).normalized();
  X.R.col(2) = X.R.col(0).cross(X.R.col(1));
  return X;
}

std::vector<SurfacePtr> SuturePlayback::at(std::span<const NodePlace> nodes_T) const {
  assert(nodes_T.size() == nodes());
  if (!there_) return {};
  ElasticRod rod = rod_;  // from the same state each time: the rings' turn hangs on no earlier moment
  RodSurface thread = thread_;
  std::vector<Vec3> places;
  for (const RodNode& node : rod.nodes())
    places.push_back(nodes_T[kNeedlePlaces + static_cast<std::size_t>(node.id)].cast<double>());
  rod.place(places);
  thread.follow(rod);
  return {needle_surface(tube_, needle_at(nodes_T)), thread.surface()};
}

}  // namespace trocar
