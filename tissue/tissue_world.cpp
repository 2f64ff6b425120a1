#include "tissue/tissue_world.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "haptics/contact/segment_triangle.h"

namespace trocar {
namespace {

constexpr double kFirstStep = 0.01;    // s
constexpr double kLongestStep = 0.05;  // s: a gap in the states never counts as more
constexpr double kFeed = 0.2;          // m of a vessel of the same radius: the resistance before it; unchecked
constexpr double kBesideNick = 0.01;   // of a vessel's length
constexpr double kAhead = 0.003;       // m from a tool within which tissue is told of it (a choice)
constexpr double kLaidOff = 1;         // s after which a needle that was let go is replaced
constexpr double kDry = 0.05;          // of a bleeder's lumen: less is closed, a four-hundredth of its flow
constexpr double kBed = 2e-12;         // m3/(Pa s) of the capillaries behind a vessel; unchecked

}  // namespace

TissueWorld::TissueWorld(const TissueSetup& setup)
    : organ_(setup.organ),
      adjacent_(setup.adjacent),
      tools_(setup.tools),
      seen_(setup.seen_T),
      bleeders_(setup.bleeders) {
  assert(!tools_.empty());
  assert(adjacent_.size() < kMaxPatchMaterials && (adjacent_.empty() || setup.rigid.empty()));
  if (setup.soft && seen_) {
    SoftOrganOptions options = setup.soft->options;
    options.tool_radius_m = tools_.front().shape.radius_m;
    std::vector<TissueSolid> materials{setup.soft->material};
    if (setup.soft->neighbour) materials.push_back(*setup.soft->neighbour);
    soft_.emplace(setup.soft->lattice, seen_, materials, options, setup.soft->bed);
    breathing_ = setup.soft->breathing;
    organ_.mu_static = setup.soft->material.mu_static;
    organ_.mu_dynamic = setup.soft->material.mu_dynamic;
    const auto own = static_cast<std::int32_t>(seen_->vertices.size());
    adjacent_T_.vertices.assign(setup.organ_T->vertices.begin() + own, setup.organ_T->vertices.end());
    for (std::size_t t = seen_->triangles.size(); t < setup.organ_T->triangles.size(); ++t) {
      const auto& [a, b, c] = setup.organ_T->triangles[t];
      adjacent_T_.triangles.push_back({a - own, b - own, c - own});
      adjacent_material_.push_back(setup.triangle_material.empty() ? 0 : setup.triangle_material[t]);
    }
    if (!adjacent_T_.triangles.empty()) soft_->set_beside(adjacent_T_);
    if (!setup.ducts.empty()) {
      ducts_.emplace(setup.ducts, *soft_, options.tool_radius_m);
      last_topology_ = soft_->topology();
      thin_.assign(ducts_->seen().begin(), ducts_->seen().end());
    }
    if (!setup.sheets.empty()) {
      sheets_.emplace(setup.sheets, *soft_);
      last_topology_ = soft_->topology();
      thin_.insert(thin_.end(), sheets_->seen().begin(), sheets_->seen().end());
    }
    follow(setup.followed);
    suture_ = setup.suture;
    actions_.emplace(*soft_);
    hang_vessels();
    gather_felt();
    std::copy(setup.organ_T->vertices.begin(), setup.organ_T->vertices.end(), felt_.vertices.begin());  // not rounded
    extraction_.emplace(felt_, triangle_material_);
  } else if (setup.organ_T && !setup.organ_T->triangles.empty()) {
    extraction_.emplace(*setup.organ_T, setup.triangle_material);
  }
  if (!setup.rigid.empty()) rigid_.emplace(setup.rigid, tools_.front());
}

const Tool& TissueWorld::in_hand(const StylusState& stylus) const {
  return tools_[std::min(static_cast<std::size_t>(std::max(0, stylus.instrument)), tools_.size() - 1)];
}

void TissueWorld::step(const HapticState& newest, bool present, ContactPatch& patch) {
  const StylusState& state = newest.stylus;
  const double dt_s = frame_.stamp == 0 ? kFirstStep : std::clamp(state.t_s - frame_.t_s, 0.0, kLongestStep);
  ++frame_.stamp;
  frame_.t_s = state.t_s;
  patch.stamp = frame_.stamp;
  patch.topology = soft_ ? soft_->topology() : seen_ ? seen_->topology : 0;
  patch.clear();
  patch.reach_m = kPatchRadius;
  patch.material[0] = organ_;
  std::copy(adjacent_.begin(), adjacent_.end(), patch.material.begin() + 1);
  patch.grip = {};
  patch.held = {};
  const Tool& tool = in_hand(state);
  const JawReading jaws{state.X_TI, state.V_TI_T, state.jaw_opening_m, state.grip_force_n};
  if (rigid_) rigid_->take(tool);
  if (rigid_) rigid_->step(jaws, present, dt_s);
  if (rigid_) patch.held = rigid_->held();
  if (rigid_) patch.hold = rigid_->hold();
  if (soft_) step_soft(newest, tool, present);
  if (present && extraction_) extraction_->extract(state.X_TI, tool.shape, patch, state.jaw_opening_m);
  if (soft_) {
    patch.material[0].stiffness_n_per_m = soft_->stiffness_n_per_m();
    patch.glide_s = soft_->solid().options().step_s;
    patch.follows = frame_.stamp - 1;
    patch.given_j = soft_->given_j();
    patch.topology = soft_->topology();  // a cut in this step has changed it
    patch.hold = actions_->grip().hold();
    patch.grip = actions_->block();
    clear_taken(patch);
    frame_.grip = actions_->grip().state();
    frame_.slipped_m = actions_->grip().slipped_m();
    actions_->tell(*soft_, frame_);
    tell_followed();
    tell_touched(newest.contacts);
    tell_wounds();
    tell_gap(state.X_TI.p, tool, patch);
    if (ducts_) add_ducts(patch);
    if (sheets_) add_sheets(patch);
    if (suturing_) add_suture(patch);
  }
  if (present && rigid_) rigid_->add_to(jaws, patch);
  enclose(patch, patch.balls);
  if (rigid_) rigid_->describe(frame_);
  dropped_ += static_cast<std::uint64_t>(patch.dropped);
}

void TissueWorld::step_soft(const HapticState& newest, const Tool& tool, bool present) {
  SolvedContacts contacts = newest.contacts;
  if (contacts.count == 0) contacts.topology = soft_->topology();
  if (present && contacts.topology == soft_->topology())
    extraction_->look_ahead(
        newest.stylus.X_TI, tool_capsules(tool.shape, newest.stylus.jaw_opening_m, {}), kAhead,
        [this](std::int32_t triangle) { return felt(triangle); }, contacts);
  bring_needle(newest.stylus, tool, present);
  // Jaws that have a duct, needle or thread between them do nothing to the organ: to it they are a probe.
  const bool sews = suturing_ && suturing_->jaws_taken(newest.stylus, tool, present);
  const bool taken = sews || (ducts_ && ducts_->jaws_taken(newest.stylus, tool, present)) ||
                     (sheets_ && sheets_->jaws_taken(newest.stylus, tool, present));
  const Tool probe{InstrumentKind::kProbe, tool.shape};
  const Tool& on_organ = taken ? probe : tool;
  std::vector<SoftSpring> springs;
  bool cut = actions_->before(newest, on_organ, present, *soft_, springs);
  const std::size_t own = springs.size();
  if (cut) {
    last_topology_ = soft_->topology() - 1;
    last_first_thin_triangle_ = first_thin_triangle_;
  }
  const std::int32_t thin = first_thin(contacts);
  if (ducts_) {
    ducts_->step(newest, {contacts, thin < 0 ? -1 : thin + sheet_triangles()}, sews ? probe : tool, present, *soft_,
                 springs);
    tell_vessels();
    open_bleeders();
    cut = cut || ducts_->grown();
  }
  if (sheets_) {
    sheets_->step(newest, {newest.contacts, thin}, sews ? probe : tool, present, *soft_, springs);
    cut = cut || sheets_->grown();
  }
  const std::size_t before_suture = springs.size();
  if (suturing_) suturing_->before(newest, tool, present, *soft_, springs);
  if (cut) gather_felt();
  const Vec3 shift_T = bed_shift(breathing_, frame_.t_s);
  soft_->carry(shift_T);
  soft_->step(contacts, present ? &newest.stylus.X_TI.p : nullptr, springs);
  actions_->after(newest, on_organ, present, std::span(springs).first(own), *soft_);
  if (suturing_) {
    suturing_->after(newest, tool, present, std::span(springs).subspan(before_suture), *soft_);
    for (const SutureEvent& event : suturing_->events())
      if (event.kind == SutureEvent::Kind::kPulledOut || event.kind == SutureEvent::Kind::kNeedleTorn)
        actions_->tear_open(event.entry_rest_T, event.exit_rest_T);
  }
  const double step_s = soft_->solid().options().step_s;
  const auto follow = [&](std::size_t first, std::span<const Vec3> places) {
    for (std::size_t v = 0; v < places.size(); ++v) {
      velocity_[first + v] = (places[v] - felt_.vertices[first + v]) / step_s;
      felt_.vertices[first + v] = places[v];
    }
  };
  follow(0, soft_->felt());
  if (breathing_.depth_m > 0 || breathing_.beat_m > 0)
    for (std::size_t v = 0; v < adjacent_T_.vertices.size(); ++v)  // they go along as they are
      follow(organ_vertices_ + v, std::array{Vec3(adjacent_T_.vertices[v] + shift_T)});
  if (sheets_) follow(organ_vertices_ + adjacent_T_.vertices.size(), sheets_->contact().vertices);
  if (ducts_) follow(first_duct_vertex_, ducts_->contact().vertices);
  if (ducts_ || sheets_ || suture_) keep_changes();
  extraction_->refit(velocity_);
}

void TissueWorld::gather_felt() {
  // What was there stays where it was, so that its velocity is that of the step. The lips and the bottom of a cut come
  // from where the surface was whole, and so open over a step: at once, the tip would fall into the groove.
  const auto& organ = *soft_->rest();
  const std::size_t known_organ = organ_vertices_, known_ducts = first_duct_vertex_;
  TriangleSurface felt;
  felt.vertices.assign(soft_->felt().begin(), soft_->felt().end());
  std::copy_n(felt_.vertices.begin(), std::min(known_organ, felt_.vertices.size()), felt.vertices.begin());
  const auto added = soft_->added();
  if (known_organ > 0 && known_organ + added.size() == felt.vertices.size())
    for (std::size_t i = 0; i < added.size(); ++i) {
      const Vec3 from = felt.vertices[static_cast<std::size_t>(added[i].from)];
      felt.vertices[known_organ + i] =
          from + added[i].share * (felt.vertices[static_cast<std::size_t>(added[i].to)] - from);
    }
  felt.triangles = organ.triangles;
  std::vector<std::int32_t> material(organ.triangles.size(), 0);
  const auto append = [&](const TriangleSurface& more) {
    const auto first = static_cast<std::int32_t>(felt.vertices.size());
    felt.vertices.insert(felt.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const auto& [a, b, c] : more.triangles) felt.triangles.push_back({first + a, first + b, first + c});
    return static_cast<std::size_t>(first);
  };
  const std::size_t beside = append(adjacent_T_);
  if (known_organ > 0)
    std::copy_n(felt_.vertices.begin() + static_cast<std::ptrdiff_t>(known_organ), adjacent_T_.vertices.size(),
                felt.vertices.begin() + static_cast<std::ptrdiff_t>(beside));
  material.insert(material.end(), adjacent_material_.begin(), adjacent_material_.end());
  first_thin_triangle_ = static_cast<std::int32_t>(felt.triangles.size());
  if (sheets_) {
    const std::size_t first = append(sheets_->contact());
    std::copy(sheets_->before().begin(), sheets_->before().end(),
              felt.vertices.begin() + static_cast<std::ptrdiff_t>(first));
    for (const std::int32_t sheet : sheets_->sheet_of_triangle())
      material.push_back(thin_material((ducts_ ? ducts_->size() : 0) + static_cast<std::size_t>(sheet)));
  }
  first_duct_vertex_ = felt.vertices.size();
  if (ducts_) {
    const std::size_t first = append(ducts_->contact());
    for (std::size_t v = known_ducts; known_organ > 0 && v < felt_.vertices.size(); ++v)
      felt.vertices[first + v - known_ducts] = felt_.vertices[v];
    for (const std::int32_t duct : ducts_->duct_of_triangle())
      material.push_back(thin_material(static_cast<std::size_t>(duct)));
  }
  felt_ = std::move(felt);
  triangle_material_ = std::move(material);
  velocity_.assign(felt_.vertices.size(), Vec3::Zero());
  organ_vertices_ = organ.vertices.size();
  extraction_.emplace(felt_, triangle_material_);
}

/// Behind those of the adjacent organs; where the patch has no room for more, that of the last place.
std::int32_t TissueWorld::thin_material(std::size_t n) const {
  return static_cast<std::int32_t>(std::min<std::size_t>(1 + adjacent_.size() + n, kMaxPatchMaterials - 1));
}

std::int32_t TissueWorld::first_thin(const SolvedContacts& contacts) const {
  if (contacts.topology == soft_->topology() && last_first_thin_triangle_ < 0) return first_thin_triangle_;
  // The organ has more triangles since its last cut: those of the thin parts begin later.
  if (contacts.topology == last_topology_) return last_first_thin_triangle_;
  return contacts.topology == soft_->topology() ? first_thin_triangle_ : -1;
}

void TissueWorld::hang_vessels() {
  if (!ducts_) return;
  VesselFlow flow;
  for (std::size_t d = 0; d < ducts_->size(); ++d) {
    vessel_.push_back(-1);
    const DuctSetup& setup = ducts_->setup(d);
    if (setup.content != DuctContent::kBlood) continue;
    const double radius = setup.outer_radius_m - setup.wall_m;
    const std::int32_t source = flow.add_node({Supply::kArterial, 0}), begin = flow.add_node({}),
                       end = flow.add_node({Supply::kNone, kBed});
    flow.add_vessel({source, begin, radius, kFeed});
    vessel_.back() = flow.add_vessel({begin, end, radius, ducts_->tube(d).rod.length_m()});
  }
  actions_->bleeding().hang(flow);
}

void TissueWorld::tell_vessels() {
  for (std::size_t d = 0; d < vessel_.size(); ++d) {
    if (vessel_[d] < 0) continue;
    const auto [arc_m, share] = ducts_->pressed(d).value_or(std::pair(0.0, 0.0));
    actions_->bleeding().pinch_vessel(vessel_[d], arc_m / ducts_->tube(d).rod.length_m(), share);
  }
  for (const DuctChange& change : ducts_->changed()) {
    const auto duct = static_cast<std::size_t>(change.duct);
    const ElasticRod& rod = ducts_->tube(duct).rod;
    if (vessel_[duct] < 0) continue;
    const double at = change.arc_m / rod.length_m();
    // Both ends bleed onto the organ where it is nearest.
    const auto open = [&] {
      const MaterialPoint place = soft_->nearest_place(rod.place_at(change.arc_m));
      actions_->bleeding().cut_vessel(vessel_[duct], at, place, place);
    };
    switch (change.kind) {
      case DuctChange::Kind::kCut:
      case DuctChange::Kind::kTorn:
      case DuctChange::Kind::kAvulsed:
        open();
        break;
      case DuctChange::Kind::kClipped:
      case DuctChange::Kind::kSealed:
        actions_->bleeding().clip_vessel(vessel_[duct], at, change.share);
        break;
      case DuctChange::Kind::kUnclipped:
        actions_->bleeding().unclip_vessel(vessel_[duct], at);
        break;
      case DuctChange::Kind::kNicked:
        // A hole of that share of its lumen: two ends that are otherwise closed. What would flow on is not missed.
        open();
        for (const double side : {-kBesideNick, kBesideNick})
          actions_->bleeding().clip_vessel(vessel_[duct], std::clamp(at + side, 0.0, 1.0), 1 - change.share);
        break;
    }
  }
}

void TissueWorld::open_bleeders() {
  if (bleeders_.empty() || !bleeds_.empty() || ducts_->any_strand_whole()) return;
  for (const BleederSetup& bleeder : bleeders_) {
    const MaterialPoint place = soft_->nearest_place(soft_->place_T(soft_->shares_within(bleeder.place_T)));
    bleeds_.push_back(actions_->bleeding().open_vessel(
        place, {.supply = Supply::kArterial, .radius_m = bleeder.radius_m, .feed_m = bleeder.feed_m}));
  }
}

void TissueWorld::tell_wounds() {
  frame_.wound_count = static_cast<std::int32_t>(bleeds_.size());
  for (std::size_t i = 0; i < bleeds_.size(); ++i) {
    const WoundState wound = actions_->bleeding().wound(bleeds_[i]);
    frame_.wound[i] = {wound.place_T, wound.rate_ml_per_min, wound.lost_ml, wound.open_share > kDry ? 1 : 0};
  }
}

/// Of organ and neighbours, not of ducts and sheets.
void TissueWorld::tell_gap(const Vec3& tip_T, const Tool& tool, const ContactPatch& patch) {
  frame_.tip_gap_m = std::numeric_limits<double>::infinity();
  const double tip_radius = tool.shape.jaw_length_m > 0 ? tool.shape.jaw_radius_m : tool.shape.radius_m;
  for (std::int32_t i = 0; i < patch.count; ++i) {
    if (patch.triangle[static_cast<std::size_t>(i)].id >= first_thin_triangle_) continue;
    const Vec3 nearest = closest_point_on_triangle(tip_T, patch.corners(i));
    frame_.tip_gap_m = std::min(frame_.tip_gap_m, (nearest - tip_T).norm() - tip_radius);
  }
}

void TissueWorld::add_ducts(ContactPatch& patch) {
  for (std::size_t d = 0; d < ducts_->size(); ++d)
    patch.material[static_cast<std::size_t>(thin_material(d))] = ducts_->material(d);
  if (ducts_->block().stiffness_n_per_m > 0) patch.grip = ducts_->block();
  if (ducts_->hold().stiffness_n_per_m > 0) patch.hold = ducts_->hold();
  if (ducts_->grip() > frame_.grip) {
    frame_.grip = ducts_->grip();
    frame_.slipped_m = ducts_->slipped_m();
  }
  SurgeryState& surgery = frame_.surgery;
  const std::int32_t closings = surgery.cuts + surgery.clips + surgery.refusals;
  if (closings != organ_closings_) refusal_ = surgery.refusal;
  organ_closings_ = closings;
  if (ducts_->closing()) refusal_ = *ducts_->closing();
  if (ducts_->closing().value_or(0) != 0) refused_s_ = frame_.t_s;
  surgery.refused_s = std::max(surgery.refused_s, refused_s_);
  surgery.refusal = refusal_;
  const std::int32_t organ_done = surgery.cuts + surgery.tears, ducts_done = ducts_->cuts() + ducts_->tears();
  if (ducts_done != duct_cuts_) duct_cut_last_ = true;
  if (organ_done != organ_cuts_) duct_cut_last_ = false;
  organ_cuts_ = organ_done, duct_cuts_ = ducts_done;
  if (duct_cut_last_) surgery.cut_m = 0;  // no line of the organ's
  surgery.cuts += ducts_->cuts();
  surgery.tears += ducts_->tears();
  surgery.clips += ducts_->clips();
  surgery.refusals += ducts_->refusals();
  for (const Pose& clip : ducts_->clip_poses())
    if (frame_.clip_count < kMaxClipsSeen) frame_.clip[static_cast<std::size_t>(frame_.clip_count++)] = clip;
  frame_.touched_duct = ducts_->touched();
  const std::vector<DuctMark> marks = ducts_->marks();
  frame_.duct_mark_count = static_cast<std::int32_t>(std::min<std::size_t>(marks.size(), kMaxDuctMarks));
  std::copy_n(marks.begin(), frame_.duct_mark_count, frame_.duct_mark.begin());
  surgery.bile_leaks = ducts_->bile_leaks();
  surgery.bile_ml = ducts_->bile_ml();
}

void TissueWorld::add_sheets(ContactPatch& patch) {
  for (std::size_t n = 0; n < sheets_->size(); ++n)
    patch.material[static_cast<std::size_t>(thin_material((ducts_ ? ducts_->size() : 0) + n))] = sheets_->material(n);
  if (sheets_->block().stiffness_n_per_m > 0) patch.grip = sheets_->block();
  if (sheets_->hold().stiffness_n_per_m > 0) patch.hold = sheets_->hold();
  if (sheets_->grip() > frame_.grip) {
    frame_.grip = sheets_->grip();
    frame_.slipped_m = sheets_->slipped_m();
  }
  frame_.sheet_pull_n = sheets_->pull_n();
  const auto cuts = sheets_->seen_cuts();
  for (auto n = static_cast<std::size_t>(frame_.sheet_cut_count); n < cuts.size(); ++n)
    frame_.sheet_cut[n % kMaxSheetCutsSeen] = cuts[n];
  frame_.sheet_cut_count = static_cast<std::int32_t>(cuts.size());
  frame_.surgery.cuts += sheets_->cuts();
  frame_.surgery.tears += sheets_->tears();
}

bool TissueWorld::felt(std::int32_t triangle) const {
  if (triangle < static_cast<std::int32_t>(soft_->rest()->triangles.size())) return actions_->grip().felt(triangle);
  const std::int32_t thin = triangle - first_thin_triangle_;
  if (thin < 0) return true;  // an adjacent organ
  return thin < sheet_triangles() ? sheets_->felt(thin) : ducts_->felt(thin - sheet_triangles());
}

void TissueWorld::clear_taken(ContactPatch& patch) const {
  for (std::int32_t i = 0; i < patch.count;) {
    if (!felt(patch.triangle[static_cast<std::size_t>(i)].id))
      patch.triangle[static_cast<std::size_t>(i)] = patch.triangle[static_cast<std::size_t>(--patch.count)];
    else
      ++i;
  }
}

/// Whoever lets go of a needle that is in no tissue gets another where the first stood.
void TissueWorld::set_needle_up(double dt_s) {
  const bool laid_off =
      suturing_ && !suturing_->needle().held() && !suturing_->needle().stands() && suturing_->needle().paths().empty();
  laid_off_s_ = laid_off ? laid_off_s_ + dt_s : 0;
  if (suturing_ && laid_off_s_ < kLaidOff) return;
  const SutureCounts so_far = suturing_ ? suturing_->counts() : SutureCounts{};
  suturing_.emplace(*suture_, *soft_, so_far);
}

void TissueWorld::bring_needle(const StylusState& stylus, const Tool& tool, bool present) {
  if (!suture_) return;
  if (suture_->stands) return set_needle_up(soft_->solid().options().step_s);
  const bool sound = stylus.X_TI.p.allFinite() && stylus.X_TI.R.allFinite();
  const bool drives = present && sound && tool.kind == InstrumentKind::kNeedleDriver, taken_up = drives && !drives_;
  drives_ = drives;
  if (!taken_up || (suturing_ && (suturing_->sewn_in() || suturing_->needle().held()))) return;
  SutureSetup setup = *suture_;
  const Pose X_IN = needle_in_jaws(setup.needle);
  setup.X_TN = stylus.X_TI * X_IN;
  setup.thread_along_T = -stylus.X_TI.R.col(2);
  const SutureCounts so_far = suturing_ ? suturing_->counts() : SutureCounts{};
  suturing_.emplace(setup, *soft_, so_far);
  suturing_->load(stylus.X_TI, X_IN);
}

void TissueWorld::add_suture(ContactPatch& patch) {
  if (suturing_->block().stiffness_n_per_m > 0) patch.grip = suturing_->block();
  if (suturing_->hold().stiffness_n_per_m > 0) patch.hold = suturing_->hold();
  if (suturing_->grip() > frame_.grip) {
    frame_.grip = suturing_->grip();
    frame_.slipped_m = suturing_->slipped_m();
  }
  frame_.suture = suturing_->state();
  tell_needle();
}

void TissueWorld::tell_needle() {
  const SutureNeedle& needle = suturing_->needle();
  NeedleSight& sight = frame_.needle;
  sight = {.there = true, .X_TN = needle.X_TN(), .bite = {}};
  if (needle.held()) sight.held_share = needle.held_arc_m() / needle.shape().length_m;
  for (const NeedlePath& path : needle.paths()) {
    if (sight.bite_count == kMaxBitesSeen) break;
    sight.bite[static_cast<std::size_t>(sight.bite_count++)] = {
        path.number(), path.entry_rest_T(), path.end_rest_T(), path.entry_along_T(), path.through(), path.load_n()};
  }
}

void TissueWorld::keep_changes() {
  for (; organ_cuts_kept_ < soft_->cuts().size(); ++organ_cuts_kept_)
    changes_.push_back(soft_->cuts()[organ_cuts_kept_]);
  nodes_.assign(soft_->solid().position().begin(), soft_->solid().position().end());
  thin_.clear();
  if (ducts_) {
    for (const DuctChange& change : ducts_->changed()) changes_.push_back(duct_change_bytes(change));
    ducts_->add_nodes(nodes_);
    thin_.assign(ducts_->seen().begin(), ducts_->seen().end());
  }
  if (sheets_) {
    for (const SheetChange& change : sheets_->changed()) changes_.push_back(sheet_change_bytes(change));
    sheets_->add_nodes(nodes_);
    thin_.insert(thin_.end(), sheets_->seen().begin(), sheets_->seen().end());
  }
  if (suturing_) {
    for (const SutureEvent& event : suturing_->events()) changes_.push_back(suture_event_bytes(event));
    suturing_->add_nodes(nodes_);
    thin_.insert(thin_.end(), suturing_->seen().begin(), suturing_->seen().end());
  }
}

void TissueWorld::follow(std::span<const SurfacePlace> places_T) {
  assert(places_T.size() <= kMaxFollowedPlaces);
  const TriangleSurface& rest = *soft_->rest();
  for (const SurfacePlace& place : places_T) {
    double least = std::numeric_limits<double>::infinity();
    Followed nearest{{}, {}, place};
    for (const auto& corner : rest.triangles) {
      const std::array<Vec3, 3> at = rest.corners(corner);
      const Vec3 foot = closest_point_on_triangle(place.point_T, at);
      const double distance = (foot - place.point_T).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      nearest.corner = corner;
      nearest.weight = barycentric_of(foot, at);
    }
    if (sheets_) nearest.on_sheet = sheets_->place_on(place.point_T);
    followed_.push_back(nearest);
  }
  tell_followed();
}

void TissueWorld::tell_followed() {
  frame_.place_count = static_cast<std::int32_t>(followed_.size());
  for (std::size_t i = 0; i < followed_.size(); ++i) {
    const Followed& f = followed_[i];
    if (f.on_sheet) {
      frame_.place[i] = sheets_->now(*f.on_sheet);
      continue;
    }
    // A surface's normal goes with the inverse transpose of how the tissue is stretched.
    const Mat3 F = soft_->gradient_within(f.rest.point_T);
    frame_.place[i] = {interpolate(f.weight, soft_->surface()->corners(f.corner)),
                       (F.inverse().transpose() * f.rest.normal_T).normalized()};
  }
}

void TissueWorld::tell_touched(const SolvedContacts& contacts) {
  frame_.touched_rest_T.reset();
  const auto end = contacts.at.begin() + contacts.count;
  const auto most = std::max_element(contacts.at.begin(), end,
                                     [](const SolvedContact& a, const SolvedContact& b) { return a.share < b.share; });
  if (most == end) return;
  if (const auto place = soft_->place_of(contacts, static_cast<int>(most - contacts.at.begin())))
    frame_.touched_rest_T = soft_->rest_place(*place);
}

TissueShape TissueWorld::shape() const {
  if (!soft_) return {};
  if (!nodes_.empty()) {
    const std::size_t organ = soft_->solid().position().size();
    return {.topology = seen_->topology + changes_.size(),
            .nodes_T = nodes_,
            .fields = soft_->fields(),
            .changes = changes_,
            .thin_T = std::span(nodes_).subspan(organ)};
  }
  return {.topology = soft_->topology(),
          .nodes_T = soft_->solid().position(),
          .fields = soft_->fields(),
          .changes = soft_->cuts()};
}

}  // namespace trocar
