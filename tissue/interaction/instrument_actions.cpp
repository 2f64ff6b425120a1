#include "tissue/interaction/instrument_actions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace trocar {
namespace {

constexpr double kAboveHook = 0.004;   // m that a hook's blade stands out of the tissue
constexpr double kRinseBelow = 0.008;  // m of opening: fingers that rinse
constexpr double kLeastTear = 1e-3;    // m between two holes
constexpr double kLeastForce = 1e-3;   // N of a contact that presses or passes current

/// The strongest contact on the organ.
struct Touch {
  MaterialPoint place;
  Vec3 normal_T = Vec3::UnitZ(), tool_T = Vec3::Zero();
  double force_n = 0;
};
std::optional<Touch> strongest_touch(const SolvedContacts& contacts, const SoftOrgan& organ) {
  std::optional<Touch> best;
  for (int i = 0; i < contacts.count; ++i) {
    const SolvedContact& contact = contacts.at[static_cast<std::size_t>(i)];
    const double force = contact.force_T.dot(contact.normal_T);
    if (!(force > kLeastForce) || (best && force <= best->force_n)) continue;
    if (const auto place = organ.place_of(contacts, i)) best = Touch{*place, contact.normal_T, contact.tool_T, force};
  }
  return best;
}

/// Where current enters the organ.
struct Electrode {
  Vec3 rest_T, now_T;
};

/// Of three places: the first, x to the second, z out of their plane.
Pose frame_of(const std::array<std::int32_t, 3>& vertices, const std::vector<Vec3>& at) {
  const Vec3 &a = at[static_cast<std::size_t>(vertices[0])], &b = at[static_cast<std::size_t>(vertices[1])],
             &c = at[static_cast<std::size_t>(vertices[2])];
  Pose X;
  X.p = a;
  X.R.col(0) = (b - a).normalized();
  X.R.col(2) = (b - a).cross(c - a).normalized();
  X.R.col(1) = X.R.col(2).cross(X.R.col(0));
  return X;
}

Vec3 outward_at(const SurfaceSnapshot& surface, std::int32_t triangle) {
  const auto& [a, b, c] = surface.triangles[static_cast<std::size_t>(triangle)];
  const auto at = [&](std::int32_t v) { return surface.vertices[static_cast<std::size_t>(v)]; };
  return (at(b) - at(a)).cross(at(c) - at(a)).normalized();
}

/// The triangle of the outside whose middle is nearest, but for slivers.
std::array<std::int32_t, 3> triangle_near(const SurfaceSnapshot& surface, const Vec3& place_T) {
  constexpr double kSliver = 1e-7;  // m2, twice its area
  std::array<std::int32_t, 3> nearest{};
  double least = INFINITY;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!surface.inside.empty() && surface.inside[t]) continue;
    const auto corner = [&](std::size_t k) {
      return surface.vertices[static_cast<std::size_t>(surface.triangles[t][k])];
    };
    const double distance = ((corner(0) + corner(1) + corner(2)) / 3 - place_T).squaredNorm();
    if (distance >= least || (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() < kSliver) continue;
    least = distance;
    nearest = surface.triangles[t];
  }
  return nearest;
}

}  // namespace

InstrumentActions::InstrumentActions(const SoftOrgan& organ, const InstrumentActionsOptions& options)
    : options_(options), bleeding_(*organ.rest()), heat_(organ.rest()) {}

bool InstrumentActions::before(const HapticState& newest, const Tool& tool, bool present, SoftOrgan& organ,
                               std::vector<SoftSpring>& springs) {
  const StylusState& stylus = newest.stylus;
  now_s_ = stylus.t_s;
  cut_now_ = false;
  blades_ = {};
  open_torn(organ);
  const bool grasps = present && tool.kind == InstrumentKind::kGrasper;
  if (grasps) {
    tear(organ, stylus);
    grip_.reach(stylus.X_TI, stylus.jaw_opening_m, organ, springs);
  } else {
    grip_.let_go();
  }
  if (!present) {
    widest_m_ = 0;
    hook_draws_ = false;
    return cut_now_;
  }
  if (tool.kind == InstrumentKind::kScissors) {
    if (closes(stylus.jaw_opening_m))
      cut_between_blades(stylus, organ);
    else
      feel_blades(stylus, organ);
  } else if (tool.kind == InstrumentKind::kClipApplier) {
    if (closes(stylus.jaw_opening_m)) set_clip(stylus, organ);
  } else {
    widest_m_ = 0;
  }
  if (tool.kind == InstrumentKind::kHook)
    draw_hook(newest, organ);
  else
    hook_draws_ = false;
  return cut_now_;
}

void InstrumentActions::after(const HapticState& newest, const Tool& tool, bool present,
                              std::span<const SoftSpring> springs, SoftOrgan& organ) {
  const StylusState& stylus = newest.stylus;
  if (present && tool.kind == InstrumentKind::kGrasper) grip_.feel(stylus.X_TI, springs, organ);
  bool sucks = false;
  state_.contact_c = 0;
  if (present) {
    press_wounds(newest, organ);
    may_rinse_ = tool.kind == InstrumentKind::kSuction && (may_rinse_ || stylus.jaw_opening_m >= kRinseBelow);
    if (tool.kind == InstrumentKind::kSuction) {
      sucks = stylus.pedal;
      if (sucks) bleeding_.suck({.tip_T = stylus.X_TI.p});
      if (may_rinse_ && stylus.jaw_opening_m < kRinseBelow)
        bleeding_.irrigate({.tip_T = stylus.X_TI.p, .direction_T = stylus.X_TI.R.col(2)});
    }
  }
  energise(newest, tool, organ);
  work_bed(stylus, present && stylus.pedal && tool.kind == InstrumentKind::kHook, organ);
  const double step_s = organ.solid().options().step_s;
  bleeding_.step(organ.surface()->vertices, step_s);
  clear_smoke(sucks);
  const BloodLedger ledger = bleeding_.ledger();
  state_.wounds = static_cast<std::int32_t>(bleeding_.wounds());
  state_.blood_ml = ledger.lost_ml;
  state_.blood_ml_per_min = ledger.rate_ml_per_min;
  state_.sucked_ml = ledger.sucked_ml + ledger.water_sucked_ml;
  state_.heat_j = heat_.ledger().delivered_j;
  dress(organ);
}

bool InstrumentActions::closes(double opening_m) {
  widest_m_ = std::max(widest_m_, opening_m);
  return widest_m_ >= options_.opened_m && opening_m <= options_.closed_m;
}

void InstrumentActions::refuse(CutRefusal why) {
  ++state_.refusals;
  state_.refusal = static_cast<std::int32_t>(why);
  state_.refused_s = now_s_;
}

void InstrumentActions::cut_between_blades(const StylusState& stylus, SoftOrgan& organ) {
  const Blade blade = scissor_blade(stylus.X_TI, options_.blades_m, widest_m_);
  widest_m_ = 0;
  const TracedCut ahead = trace_cut(*organ.surface(), blade);
  if (ahead.refusal == CutRefusal::kNone && runs_beside_wound(*organ.surface(), organ.surface()->inside, ahead.cut))
    return refuse(CutRefusal::kBesideCut);
  cut(blade, organ);
}

void InstrumentActions::feel_blades(const StylusState& stylus, const SoftOrgan& organ) {
  if (widest_m_ < options_.opened_m) return;
  // The energy of the cut over the way of closing: a spring that holds it when the blades have closed.
  const TracedCut ahead = trace_cut(*organ.surface(), scissor_blade(stylus.X_TI, options_.blades_m, widest_m_));
  if (ahead.refusal != CutRefusal::kNone) return;
  const double way = widest_m_ - options_.closed_m;
  blades_.thickness_m = widest_m_;
  blades_.stiffness_n_per_m =
      2 * organ.material(ahead.cut.crossings.front().triangle).toughness_j_per_m2 * ahead.area_m2 / (way * way);
}

WoundId InstrumentActions::cut(const Blade& blade, SoftOrgan& organ) {
  const OrganCut made = organ.cut(blade);
  if (made.refusal != CutRefusal::kNone) {
    refuse(made.refusal);
    return -1;
  }
  cut_now_ = true;
  ++state_.cuts;
  state_.cut_m2 += made.area_m2;
  state_.cut_m = made.length_m;
  state_.refusal = 0;
  grip_.follow_cut(organ);
  const std::vector<VertexOrigin> added(organ.added().begin(), organ.added().end());
  bleeding_.grow(*organ.rest(), added, organ.rest()->inside);
  heat_.grow(organ.rest(), added);
  std::vector<std::int32_t> bottom;  // begin, three of each crossing, end
  for (std::size_t i = 3; i < added.size(); i += 3) bottom.push_back(made.first_vertex + static_cast<std::int32_t>(i));
  return bleeding_.add_wound(bottom, 2 * made.area_m2, made.depth_m);
}

void InstrumentActions::set_clip(const StylusState& stylus, const SoftOrgan& organ) {
  widest_m_ = 0;
  const Vec3 along_T = stylus.X_TI.R.col(2);
  WoundId nearest = -1;
  double least = options_.clip_reach_m;
  for (WoundId id = 0; id < static_cast<WoundId>(bleeding_.wounds()); ++id) {
    const Vec3 way = bleeding_.wound(id).place_T - stylus.X_TI.p;
    const double distance = (way - std::clamp(way.dot(along_T), -options_.applier_m, 0.0) * along_T).norm();
    if (distance < least) least = distance, nearest = id;
  }
  if (nearest < 0) return refuse(CutRefusal::kNoWound);
  bleeding_.clip_wound(nearest, 1, 2 * options_.applier_m * bleeding_.wound(nearest).depth_m);
  ++state_.clips;
  state_.refusal = 0;
  const auto beside = triangle_near(*organ.surface(), bleeding_.wound(nearest).place_T);
  clips_.push_back({beside, frame_of(beside, organ.surface()->vertices).inverse() * stylus.X_TI});
}

void InstrumentActions::tear(SoftOrgan& organ, const StylusState& stylus) {
  const double limit = grip_.rupture_n_per_m(organ) * options_.tear_width_m;
  overloaded_s_ = grip_.pull_T().norm() > limit ? overloaded_s_ + organ.solid().options().step_s : 0;
  if (overloaded_s_ < options_.tear_after_s) return;
  overloaded_s_ = 0;
  // Across the pull, at the edge of what the pads hold, along their hinge.
  const Vec3 pull = grip_.pull_T().normalized(), middle = grip_.middle_T(organ);
  const Vec3 along = (stylus.X_TI.R.col(0) - stylus.X_TI.R.col(0).dot(pull) * pull).normalized();
  const double half = options_.tear_length_m / 2;
  tear_at(middle - half * along, middle + half * along, pull, organ);
  grip_.let_go();
}

void InstrumentActions::tear_at(const Vec3& from_T, const Vec3& to_T, const Vec3& into_T, SoftOrgan& organ) {
  if (cut(track_blade(from_T, to_T, into_T, options_.tear_depth_m, options_.tear_depth_m), organ) < 0) return;
  --state_.cuts;
  ++state_.tears;
}

void InstrumentActions::open_torn(SoftOrgan& organ) {
  for (const auto& [from, to] : std::exchange(torn_, {})) {
    const NodeShares at_from = organ.shares_within(from), at_to = organ.shares_within(to);
    if (at_from.node.empty() || at_to.node.empty()) continue;  // what it was torn out of is gone
    const Vec3 from_T = organ.place_T(at_from), to_T = organ.place_T(at_to);
    if ((to_T - from_T).norm() < kLeastTear) continue;
    tear_at(from_T, to_T, -outward_at(*organ.surface(), organ.nearest_place((from_T + to_T) / 2).triangle), organ);
  }
}

void InstrumentActions::draw_hook(const HapticState& newest, SoftOrgan& organ) {
  const auto touch = newest.stylus.pedal ? strongest_touch(newest.contacts, organ) : std::nullopt;
  // What boils or is gone already; a moment without, and the edge only rests there.
  const bool hot = state_.contact_c > options_.coagulates_c || !heat_.vaporised().empty();
  cold_s_ = hot ? 0 : cold_s_ + organ.solid().options().step_s;
  if (!touch || cold_s_ > options_.hook_waits_s) {
    hook_draws_ = false;
    return;
  }
  if (!hook_draws_) hook_from_T_ = touch->tool_T;
  hook_draws_ = true;
  const Vec3 way = touch->tool_T - hook_from_T_;
  if ((way - way.dot(touch->normal_T) * touch->normal_T).norm() < options_.track_m) return;
  const WoundId wound =
      cut(track_blade(hook_from_T_, touch->tool_T, -touch->normal_T, options_.track_depth_m, kAboveHook), organ);
  hook_from_T_ = touch->tool_T;
  if (wound >= 0) bleeding_.coagulate(wound, 0.8);  // its walls have been boiling
}

void InstrumentActions::energise(const HapticState& newest, const Tool& tool, const SoftOrgan& organ) {
  HeatSource source;
  const bool live = newest.stylus.pedal && describe(tool.kind).powered && tool.kind != InstrumentKind::kSuction;
  std::optional<Electrode> electrode;
  if (live && grip_.holds()) {  // what is between the pads is no contact of the loop
    electrode = {grip_.middle_rest_T(organ), grip_.middle_T(organ)};
  } else if (live) {
    if (const auto touch = strongest_touch(newest.contacts, organ))
      electrode = {organ.rest_place(touch->place), organ.place_T(touch->place)};
  }
  if (electrode) {
    const bool hook = tool.kind == InstrumentKind::kHook, grasper = tool.kind == InstrumentKind::kGrasper;
    source.rest_T = electrode->rest_T;
    source.radius_m = hook ? options_.hook_edge_m : options_.pad_contact_m;
    source.power_w = hook ? options_.cut_w : grasper ? options_.soft_w : options_.forced_w;
    source.mode = hook ? HeatMode::kCut : grasper ? HeatMode::kSoftCoagulation : HeatMode::kForcedCoagulation;
    source.tool = newest.stylus.instrument;
  }
  heat_.step({&source, electrode ? std::size_t{1} : std::size_t{0}});
  if (!electrode) return;
  state_.contact_c = heat_.given().front().contact_c;
  if (state_.contact_c > options_.coagulates_c)
    bleeding_.coagulate(electrode->now_T, std::max(source.radius_m, options_.coagulates_m),
                        std::min(1.0, options_.coagulates_per_s * organ.solid().options().step_s));
}

void InstrumentActions::work_bed(const StylusState& stylus, bool hook_live, SoftOrgan& organ) {
  OrganBed* bed = organ.bed();
  if (bed == nullptr) return;
  for (const std::int32_t freed : bed->freed()) {
    const OrganBed::Link& link = bed->links()[static_cast<std::size_t>(freed)];
    if (!link.vaporised) bleeding_.add_wound(std::span(&link.below, 1), options_.bed_oozes * link.area_m2, 0);
  }
  if (!heat_.cold())
    for (std::size_t i = 0; i < bed->links().size(); ++i)
      bed->soften(i, heat_.softened_at(organ.rest()->vertices[static_cast<std::size_t>(bed->links()[i].vertex)]));
  if (hook_live) bed->vaporise(stylus.X_TI.p, options_.hook_bed_m, *organ.surface());
  state_.bed_free = bed->free_share();
  state_.bed_hurt = bed->damage_share();
}

void InstrumentActions::press_wounds(const HapticState& newest, const SoftOrgan& organ) {
  if (bleeding_.wounds() == 0) return;
  const double area = std::numbers::pi * options_.press_radius_m * options_.press_radius_m;
  for (int i = 0; i < newest.contacts.count; ++i) {
    const SolvedContact& contact = newest.contacts.at[static_cast<std::size_t>(i)];
    const double force = contact.force_T.dot(contact.normal_T);
    if (!(force > kLeastForce)) continue;
    if (const auto place = organ.place_of(newest.contacts, i))
      bleeding_.press(organ.place_T(*place), options_.press_radius_m, force / area);
  }
}

void InstrumentActions::clear_smoke(bool sucked) {
  const double steam = heat_.ledger().steam_j;
  smoke_per_m_ += options_.smoke_per_j * (steam - steam_seen_j_);
  steam_seen_j_ = steam;
  smoke_per_m_ *= 1 - 0.01 / (sucked ? options_.smoke_sucked_s : options_.smoke_s);
  if (smoke_per_m_ < 1e-6) smoke_per_m_ = 0;
}

void InstrumentActions::tell(const SoftOrgan& organ, TissueFrame& frame) const {
  frame.surgery = state_;
  frame.smoke_per_m = smoke_per_m_;
  frame.clip_count = 0;
  for (const SetClip& clip : clips_) {
    if (frame.clip_count == kMaxClipsSeen) break;
    frame.clip[static_cast<std::size_t>(frame.clip_count++)] =
        frame_of(clip.vertices, organ.surface()->vertices) * clip.X_VC;
  }
  frame.drop_count = 0;
  for (const BloodDrop& drop : bleeding_.drops()) {
    if (frame.drop_count == kMaxDropsSeen) break;
    frame.drop[static_cast<std::size_t>(frame.drop_count++)] = {
        drop.place_T, std::cbrt(0.75 * std::numbers::inv_pi * drop.volume_m3)};
  }
}

void InstrumentActions::dress(SoftOrgan& organ) const {
  // An organ that nothing was done to bears nothing: no picture and no recording looks at it.
  std::vector<ShapeField> fields;
  if (bleeding_.wounds() > 0 || bleeding_.ledger().water_given_ml > 0) {
    fields.push_back({"blood", FieldPlace::kVertices, bleeding_.blood()});
    fields.push_back({"wet", FieldPlace::kVertices, bleeding_.wet()});
  }
  if (heat_.blocks() > 0 || state_.heat_j > 0) {
    fields.push_back({"char", FieldPlace::kVertices, heat_.charred()});
    fields.push_back({"whitening", FieldPlace::kVertices, heat_.white()});
  }
  organ.wear(std::move(fields));
}

}  // namespace trocar
