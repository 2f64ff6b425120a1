#include "tissue/thin/duct_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "haptics/contact/tool_shape.h"
#include "haptics/input_error.h"
#include "tissue/thin/rod_contact.h"
#include "tissue/thin/rod_in_jaws.h"
#include "tissue/thin/rod_on_solid.h"
#include "tissue/thin/rod_section.h"

namespace trocar {
namespace {

constexpr double kOffOrgan = 0.002;       // m of a drawn end from the organ's nearest vertex
constexpr double kLooseLoad = 1e-3;       // N/m of a spring that is a force
constexpr double kAnchorage = 2000;       // N/m (a choice)
constexpr double kSampling = 0.001;       // m along a rod between jaws
constexpr double kClear = 0.001;          // m beyond the jaws in which a rod is no contact
constexpr double kApplierWidth = 0.003;   // m of the applier's jaws round a clip
constexpr double kBladeBlock = 500;       // N/m of what blades cut, about its force
constexpr double kClipBlock = 2000;       // N/m of a clip between blades
constexpr double kClipThickness = 0.002;  // m of a clip between blades
constexpr double kMinute = 60;            // s
constexpr std::int32_t kBladesOnClip = kFirstClipRefusal + 16;

constexpr std::array kEnds{RodEnd::kStart, RodEnd::kFinish};

RodGripOptions grasp_options(const DuctSystemOptions& options) {
  RodGripOptions out = options.grip;
  out.clip_legs_m = 2 * options.applier.clip.leg_m;
  return out;
}

RodGripOptions clasp_options(const DuctSystemOptions& options) {
  RodGripOptions out = options.grip;
  out.pad_length_m = options.applier.clip.length_m;
  out.pad_width_m = kApplierWidth;
  return out;
}

std::int32_t nearest_vertex(const TriangleSurface& surface, const Vec3& place) {
  const auto nearest = std::min_element(
      surface.vertices.begin(), surface.vertices.end(),
      [&](const Vec3& a, const Vec3& b) { return (a - place).squaredNorm() < (b - place).squaredNorm(); });
  return static_cast<std::int32_t>(nearest - surface.vertices.begin());
}

/// Which of them holds the strongest contact; -1: none is one.
std::int32_t borne_most(std::span<const SolvedContacts> touches) {
  double most = 0;
  std::int32_t found = -1;
  for (std::size_t d = 0; d < touches.size(); ++d)
    for (std::int32_t i = 0; i < touches[d].count; ++i) {
      const SolvedContact& contact = touches[d].at[static_cast<std::size_t>(i)];
      const double force = contact.force_T.dot(contact.normal_T);
      if (force > most) most = force, found = static_cast<std::int32_t>(d);
    }
  return found;
}

std::optional<DuctMark::Kind> opening_of(DuctChange::Kind kind) {
  switch (kind) {
    case DuctChange::Kind::kCut:
      return DuctMark::Kind::kCut;
    case DuctChange::Kind::kNicked:
      return DuctMark::Kind::kNick;
    case DuctChange::Kind::kTorn:
    case DuctChange::Kind::kAvulsed:
      return DuctMark::Kind::kTorn;
    case DuctChange::Kind::kClipped:
    case DuctChange::Kind::kSealed:
    case DuctChange::Kind::kUnclipped:
      break;
  }
  return std::nullopt;
}

bool holds(GripState state) { return state == GripState::kHolding || state == GripState::kSlipping; }

/// What an instrument has between its jaws; nothing without jaws.
std::optional<JawSpace> jaw_space(const DuctSystemOptions& options, InstrumentKind kind, double opening_m) {
  switch (kind) {
    case InstrumentKind::kGrasper:
      return JawSpace{options.grip.pad_length_m, options.grip.pad_width_m, opening_m};
    case InstrumentKind::kScissors:
      return JawSpace{options.scissors.blade_m, options.scissors.width_m, opening_m};
    case InstrumentKind::kClipApplier:
      return JawSpace{options.applier.clip.length_m, kApplierWidth, opening_m};
    case InstrumentKind::kProbe:
    case InstrumentKind::kHook:
    case InstrumentKind::kSuction:
    case InstrumentKind::kNeedleDriver:
      break;
  }
  return std::nullopt;
}

}  // namespace

std::string_view closing_words(std::int32_t refusal) {
  if (refusal == kBladesOnClip) return "The blades stand on a clip.";
  if (refusal == kClipCameOff) return "A clip was pulled off.";
  if (refusal > 0 && refusal <= static_cast<std::int32_t>(CutRefusal::kBesideCut))
    return refusal_words(static_cast<CutRefusal>(refusal));
  const std::int32_t of_clip = refusal - kFirstClipRefusal;
  if (of_clip > 0 && of_clip <= static_cast<std::int32_t>(ClipRefusal::kNotShut))
    return sentence(static_cast<ClipRefusal>(of_clip));
  return {};
}

DuctSystem::DuctSystem(std::span<const DuctSetup> ducts, const SoftOrgan& organ, double tool_radius_m,
                       const DuctSystemOptions& options)
    : options_(options), tool_radius_m_(tool_radius_m), applier_(options.applier), scissors_(options.scissors) {
  for (const DuctSetup& setup : ducts) {
    try {
      DuctTube tube(setup, organ.solid().options().step_s);
      RodSurface touched(tube.rod, options_.contact_sides);
      ducts_.push_back({setup, std::move(tube), std::move(touched), RodGrip(grasp_options(options_)),
                        RodGrip(clasp_options(options_))});
      ducts_.back().hook = RodHook(options_.hook);
    } catch (const InputError& error) {
      throw InputError("duct '" + setup.name + "': " + error.what());
    }
    Duct& duct = ducts_.back();
    for (std::size_t end = 0; end < 2; ++end) {
      if (setup.ends[end] == DuctHold::kFixed) continue;
      const Vec3& drawn = end == 0 ? setup.path_T.front() : setup.path_T.back();
      duct.vertex[end] = nearest_vertex(*organ.rest(), drawn);
      const double off = (organ.rest()->vertices[static_cast<std::size_t>(duct.vertex[end])] - drawn).norm();
      if (!(off < kOffOrgan)) throw InputError("duct '" + setup.name + "': an end finds no place on the organ");
    }
    seen_.push_back(duct.tube.seen.surface());
  }
  between_.assign(ducts_.size(), false);
  passed_.assign(ducts_.size(), false);
  find_places(organ);
  anchor(organ);
  for (Duct& duct : ducts_) {
    duct.tube.rod.settle();
    for (std::size_t end = 0; end < 2; ++end) duct.rest_load[end] = duct.tube.rod.anchor_load(kEnds[end]).force;
  }
  follow();
  grown_ = false;
}

void DuctSystem::find_places(const SoftOrgan& organ) {
  organ_topology_ = organ.topology();
  const SurfaceSnapshot& rest = *organ.rest();
  for (Duct& duct : ducts_)
    for (std::size_t end = 0; end < 2; ++end) {
      if (duct.vertex[end] < 0) continue;
      for (std::size_t t = 0; t < rest.triangles.size(); ++t) {
        const auto& corners = rest.triangles[t];
        const auto corner = std::find(corners.begin(), corners.end(), duct.vertex[end]);
        if (corner == corners.end() || (!rest.inside.empty() && rest.inside[t])) continue;
        MaterialPoint place{static_cast<std::int32_t>(t), {0, 0, 0}};
        place.weight[static_cast<std::size_t>(corner - corners.begin())] = 1;
        duct.place[end] = organ.shares_of(place);
        break;
      }
    }
}

void DuctSystem::anchor(const SoftOrgan& organ) {
  for (Duct& duct : ducts_)
    for (std::size_t end = 0; end < 2; ++end) {
      if (duct.vertex[end] >= 0)
        duct.tube.rod.anchor(kEnds[end], anchor_on(organ.solid(), duct.place[end], kAnchorage));
      else
        duct.tube.rod.anchor(kEnds[end], {.position = end == 0 ? duct.setup.path_T.front() : duct.setup.path_T.back(),
                                          .stiffness_n_per_m = kAnchorage});
    }
}

void DuctSystem::add_loads(const Duct& duct, std::vector<SoftSpring>& springs) const {
  for (std::size_t end = 0; end < 2; ++end) {
    if (duct.vertex[end] < 0) continue;
    const Vec3& rest = duct.rest_load[end];
    if (duct.tube.rod.anchored(kEnds[end])) {
      for (SoftSpring spring : load_springs(anchor_load(duct.tube.rod, kEnds[end]), duct.place[end])) {
        spring.stretch_m += spring.direction.dot(rest) / spring.stiffness_n_per_m;
        springs.push_back(std::move(spring));
      }
    } else if (rest.norm() > 0) {  // it came off
      springs.push_back({duct.place[end], rest.normalized(), kLooseLoad, rest.norm() / kLooseLoad, false, 0});
    }
  }
}

bool DuctSystem::jaws_taken(const StylusState& stylus, const Tool& tool, bool present) const {
  const auto jaws = jaw_space(options_, tool.kind, stylus.jaw_opening_m);
  if (!present || !jaws || !std::isfinite(stylus.jaw_opening_m) || !stylus.X_TI.p.allFinite()) return false;
  return std::any_of(ducts_.begin(), ducts_.end(), [&](const Duct& duct) {
    return duct.grip.state() != GripState::kEmpty || duct.clasp.state() != GripState::kEmpty ||
           !arcs_between(duct.tube.rod, stylus.X_TI, *jaws, 0, kSampling).empty();
  });
}

SolvedContacts DuctSystem::contacts_of(std::size_t duct, const DuctContacts& given) const {
  SolvedContacts out;
  if (given.first_triangle < 0) return out;
  for (std::int32_t i = 0; i < given.contacts.count; ++i) {
    SolvedContact contact = given.contacts.at[static_cast<std::size_t>(i)];
    const std::int32_t triangle = contact.place.triangle - given.first_triangle;
    for (const Piece& piece : pieces_) {
      if (piece.duct != duct || triangle < piece.first_triangle || triangle >= piece.first_triangle + piece.triangles)
        continue;
      contact.place.triangle = piece.triangle + triangle - piece.first_triangle;
      out.at[static_cast<std::size_t>(out.count++)] = contact;
    }
  }
  return out;
}

void DuctSystem::step(const HapticState& newest, const DuctContacts& contacts, const Tool& tool, bool present,
                      const SoftOrgan& organ, std::vector<SoftSpring>& springs) {
  const StylusState& stylus = newest.stylus;
  changed_.clear();
  closing_.reset();
  block_ = {};
  hold_ = {};
  if (organ.topology() != organ_topology_) find_places(organ);
  std::vector<std::vector<RodSpring>> of_rods(ducts_.size());
  std::vector<std::size_t> of_jaws(ducts_.size()), of_hook(ducts_.size());
  for (std::size_t d = 0; d < ducts_.size(); ++d) {
    Duct& duct = ducts_[d];
    duct.tube.lumen.begin();
    const std::vector<double> clips = duct.tube.clips.arcs();
    for (RodGrip* grip : {&duct.grip, &duct.clasp}) {
      const InstrumentKind wanted = grip == &duct.grip ? InstrumentKind::kGrasper : InstrumentKind::kClipApplier;
      if (!present || tool.kind != wanted) {
        grip->let_go();
        continue;
      }
      grip->reach(stylus.X_TI, stylus.jaw_opening_m, duct.tube.rod, of_rods[d], clips);
      grip->press(duct.tube.lumen);
    }
    of_jaws[d] = of_rods[d].size();
    if (present && tool.kind == InstrumentKind::kHook && whole(duct))  // stumps slip off the foot
      duct.hook.reach(stylus.X_TI, duct.tube.rod, of_rods[d]);
    else
      duct.hook.let_go();
    of_hook[d] = of_rods[d].size();
  }
  if (present) use_jaws(stylus, tool, organ);
  std::vector<SolvedContacts> touches;
  for (std::size_t d = 0; d < ducts_.size(); ++d) touches.push_back(contacts_of(d, contacts));
  touched_ = hooked() >= 0 ? hooked() : present ? borne_most(touches) : -1;
  if (present && touched_ < 0) touched_ = surrounded(stylus, tool);
  if (present) weld(stylus, tool, touches);
  anchor(organ);
  for (std::size_t d = 0; d < ducts_.size(); ++d) {
    Duct& duct = ducts_[d];
    if (present) {
      const auto pushes =
          rod_contacts(touches[d], 0, duct.touched, dent_stiffness(duct.tube.rod.options(), tool_radius_m_));
      of_rods[d].insert(of_rods[d].end(), pushes.begin(), pushes.end());
    }
    duct.tube.rod.step(of_rods[d]);
    for (RodGrip* grip : {&duct.grip, &duct.clasp}) {
      if (grip->state() == GripState::kEmpty) continue;
      grip->feel(stylus.X_TI, std::span(of_rods[d]).first(of_jaws[d]), duct.tube.rod);
      duct.tube.clips.pull_held(grip->clips(), -grip->pull_T());
      if (block_.stiffness_n_per_m < grip->block().stiffness_n_per_m) block_ = grip->block();
      if (hold_.stiffness_n_per_m < grip->hold().stiffness_n_per_m) hold_ = grip->hold();
    }
    duct.hook.feel(stylus.X_TI, std::span(of_rods[d]).subspan(of_jaws[d], of_hook[d] - of_jaws[d]), duct.tube.rod);
    if (hold_.stiffness_n_per_m < duct.hook.hold().stiffness_n_per_m) hold_ = duct.hook.hold();
    duct.tube.clips.pull_touched(std::span(of_rods[d]).subspan(of_jaws[d]));
  }
  take_events();
  for (std::size_t d = 0; d < ducts_.size(); ++d) lose_clips(d);
  follow();
  for (const Duct& duct : ducts_) add_loads(duct, springs);
  const bool leaks = std::any_of(ducts_.begin(), ducts_.end(), [&](const Duct& duct) {
    const auto ends = duct.tube.lumen.ends(duct.tube.rod);
    return duct.setup.content == DuctContent::kBile && ends.size() > 2 && ends[1].outside && !tight(duct, ends[1]);
  });
  if (leaks) bile_ml_ += options_.bile_ml_per_min / kMinute * organ.solid().options().step_s;
}

std::vector<ClipSurroundings::Rod> DuctSystem::rods(std::vector<std::vector<double>>& arcs) const {
  std::vector<ClipSurroundings::Rod> out;
  for (const Duct& duct : ducts_) arcs.push_back(duct.tube.clips.arcs());
  for (std::size_t d = 0; d < ducts_.size(); ++d) out.push_back({&ducts_[d].tube.rod, arcs[d]});
  return out;
}

/// The only one whose axis passes between the jaws; -1: none or several do.
std::int32_t DuctSystem::surrounded(const StylusState& stylus, const Tool& tool) const {
  const auto jaws = jaw_space(options_, tool.kind, stylus.jaw_opening_m);
  std::int32_t found = -1;
  for (std::size_t d = 0; jaws && d < ducts_.size(); ++d) {
    const auto crossings = rod_crossings(ducts_[d].tube.rod, stylus.X_TI, *jaws);
    const bool inside = std::any_of(crossings.begin(), crossings.end(), [&](const RodCrossing& crossing) {
      return crossing.point_I.z() < 0 && std::abs(crossing.point_I.y()) <= jaws->opening_m / 2;
    });
    if (inside && found >= 0) return -1;
    if (inside) found = static_cast<std::int32_t>(d);
  }
  return found;
}

void DuctSystem::use_jaws(const StylusState& stylus, const Tool& tool, const SoftOrgan& organ) {
  const auto jaws = jaw_space(options_, tool.kind, stylus.jaw_opening_m);
  const ToolCapsules capsules = tool_capsules(tool.shape, stylus.jaw_opening_m, {});
  for (std::size_t d = 0; d < ducts_.size(); ++d) {
    const Duct& duct = ducts_[d];
    const bool was = between_[d] || passed_[d];
    const bool stumps = duct.setup.slack && !whole(duct);  // they lie down before what comes
    const bool held = duct.grip.state() != GripState::kEmpty || duct.clasp.state() != GripState::kEmpty;
    between_[d] = stumps || duct.hook.holds() ||
                  (jaws && (held || !arcs_between(duct.tube.rod, stylus.X_TI, *jaws, kClear, kSampling).empty()));
    passed_[d] = !between_[d] && was && overlaps(duct.tube.rod, stylus.X_TI, capsules, kSampling);
  }
  std::vector<std::vector<double>> arcs;
  const std::vector<ClipSurroundings::Rod> all = rods(arcs);
  if (tool.kind == InstrumentKind::kClipApplier) use_applier(stylus, all, organ);
  if (tool.kind == InstrumentKind::kScissors) use_scissors(stylus, all);
}

void DuctSystem::use_applier(const StylusState& stylus, std::span<const ClipSurroundings::Rod> rods,
                             const SoftOrgan& organ) {
  const auto outcome =
      applier_.step(stylus.X_TI, stylus.jaw_opening_m, {.rods = rods, .organ_T = organ.surface().get()});
  if (!outcome) return;
  // With nothing between them the organ has been asked.
  const bool between = std::find(between_.begin(), between_.end(), true) != between_.end();
  if (outcome->verdict.refusal == ClipRefusal::kNothingBetween && !between) return;
  closing_ = refusal_code(outcome->verdict.refusal);
  if (!outcome->placed) {
    ++refusals_;
    return;
  }
  const auto d = static_cast<std::size_t>(outcome->verdict.rod);
  change(DuctTube::clip_change(outcome->verdict.rod, ducts_[d].tube.rod, outcome->verdict.arc_m,
                               outcome->verdict.width_share, stylus.X_TI));
  ++clips_;
}

void DuctSystem::use_scissors(const StylusState& stylus, std::span<const ClipSurroundings::Rod> rods) {
  const bool was_jammed = scissors_.jammed();
  for (const RodCut& cut : scissors_.step(stylus.X_TI, stylus.jaw_opening_m, rods)) {
    change({cut.share < 1 ? DuctChange::Kind::kNicked : DuctChange::Kind::kCut, cut.rod, cut.arc_m, cut.share});
    ++cuts_;
    closing_ = 0;
  }
  if (scissors_.jammed()) {
    block_ = {std::max(stylus.jaw_opening_m, kClipThickness), kClipBlock};
    if (was_jammed) return;
    closing_ = kBladesOnClip;
    ++refusals_;
  } else if (scissors_.resist_n() > 0) {
    block_ = {stylus.jaw_opening_m + scissors_.resist_n() / kBladeBlock, kBladeBlock};
  }
}

/// The one that pulls hardest on it.
std::int32_t DuctSystem::hooked() const {
  std::int32_t found = -1;
  double most = -1;
  for (std::size_t d = 0; d < ducts_.size(); ++d)
    if (ducts_[d].hook.holds() && ducts_[d].hook.load_n() > most)
      most = ducts_[d].hook.load_n(), found = static_cast<std::int32_t>(d);
  return found;
}

/// Current through a rod that lies on the foot seals it, and then parts it; while it hops off, it does not cool.
void DuctSystem::burn_through(bool live, std::size_t d) {
  Duct& duct = ducts_[d];
  if (!live) {
    duct.hot_s = 0;
    duct.seared = false;
    return;
  }
  if (duct.hook.load_n() > options_.least_force_n) duct.hot_s += duct.tube.rod.options().step_s;
  const double arc = duct.hook.arc_m();
  if (!duct.seared && duct.hot_s >= options_.hook_seals_s) {
    duct.seared = true;
    change({DuctChange::Kind::kSealed, static_cast<std::int32_t>(d), arc});
  }
  if (duct.hot_s < options_.hook_parts_s) return;
  duct.hot_s = 0;
  duct.seared = false;
  change({DuctChange::Kind::kCut, static_cast<std::int32_t>(d), arc});
  ++cuts_;
}

void DuctSystem::weld(const StylusState& stylus, const Tool& tool, std::span<const SolvedContacts> touches) {
  const bool live = stylus.pedal && describe(tool.kind).powered && tool.kind != InstrumentKind::kSuction;
  for (std::size_t d = 0; d < ducts_.size(); ++d) {
    Duct& duct = ducts_[d];
    if (duct.hook.holds()) {
      burn_through(live, d);
      continue;
    }
    double arc = -1;
    if (live && holds(duct.grip.state()) && !duct.grip.arcs().empty()) {
      const std::vector<double> arcs = duct.grip.arcs();
      arc = arcs[arcs.size() / 2];
    }
    double strongest = options_.least_force_n;
    for (std::int32_t i = 0; live && i < touches[d].count; ++i) {
      const SolvedContact& contact = touches[d].at[static_cast<std::size_t>(i)];
      const double force = contact.force_T.dot(contact.normal_T);
      if (force > strongest) strongest = force, arc = duct.touched.arc_of(contact.place);
    }
    const auto segments = duct.tube.lumen.segments(duct.tube.rod);
    const bool welded = arc >= 0 && segments[duct.tube.rod.segment_at(arc)].state == LumenState::kSealed;
    duct.hot_s = arc >= 0 && !welded ? duct.hot_s + duct.tube.rod.options().step_s : 0;
    if (duct.hot_s < options_.weld_s) continue;
    duct.hot_s = 0;
    change({DuctChange::Kind::kSealed, static_cast<std::int32_t>(d), arc});
  }
}

void DuctSystem::change(const DuctChange& change) {
  Duct& duct = ducts_[static_cast<std::size_t>(change.duct)];
  if (!duct.tube.apply(change)) return;
  changed_.push_back(change);
  if (const auto kind = opening_of(change.kind))
    duct.openings.push_back({.kind = *kind, .duct = change.duct, .arc_m = change.arc_m, .share = change.share});
}

void DuctSystem::take_events() {
  for (std::size_t d = 0; d < ducts_.size(); ++d)
    for (const RodEvent& event : ducts_[d].tube.rod.events()) {
      const bool torn = event.kind == RodEvent::Kind::kTorn;  // the rod has done it
      changed_.push_back(
          {torn ? DuctChange::Kind::kTorn : DuctChange::Kind::kAvulsed, static_cast<std::int32_t>(d), event.arc_m});
      ducts_[d].openings.push_back(
          {.kind = DuctMark::Kind::kTorn, .duct = static_cast<std::int32_t>(d), .arc_m = event.arc_m});
      ++tears_;
    }
}

/// Jaws that held one have nothing any more.
void DuctSystem::lose_clips(std::size_t d) {
  Duct& duct = ducts_[d];
  for (const std::int32_t number : duct.tube.clips.step(duct.tube.rod, duct.tube.lumen)) {
    const double arc = duct.tube.clips.clips()[static_cast<std::size_t>(number) - 1].arc_m;
    changed_.push_back({DuctChange::Kind::kUnclipped, static_cast<std::int32_t>(d), arc});
    for (RodGrip* grip : {&duct.grip, &duct.clasp})
      if (std::find(grip->clips().begin(), grip->clips().end(), arc) != grip->clips().end()) grip->let_go();
    if (closing_.value_or(0) == 0) closing_ = kClipCameOff;
    ++refusals_;
  }
}

std::int32_t DuctSystem::contact_vertex(std::size_t duct, std::int32_t vertex) const {
  for (const Piece& piece : pieces_)
    if (piece.duct == duct && vertex >= piece.vertex && vertex < piece.vertex + piece.vertices)
      return piece.first_vertex + vertex - piece.vertex;
  return -1;
}

void DuctSystem::follow() {
  grown_ = false;
  for (std::size_t d = 0; d < ducts_.size(); ++d) {
    Duct& duct = ducts_[d];
    duct.tube.seen.follow(duct.tube.rod, &duct.tube.lumen);
    duct.touched.follow(duct.tube.rod, &duct.tube.lumen);
    seen_[d] = duct.tube.seen.surface();
    const SurfaceSnapshot& tube = *duct.touched.surface();
    Piece piece{.duct = d,
                .first_vertex = static_cast<std::int32_t>(contact_.vertices.size()),
                .first_triangle = static_cast<std::int32_t>(contact_.triangles.size())};
    for (const Piece& before : pieces_) {
      if (before.duct != d) continue;
      piece.vertex = before.vertex + before.vertices;
      piece.triangle = before.triangle + before.triangles;
    }
    piece.vertices = static_cast<std::int32_t>(tube.vertices.size()) - piece.vertex;
    piece.triangles = static_cast<std::int32_t>(tube.triangles.size()) - piece.triangle;
    if (piece.vertices == 0 && piece.triangles == 0) continue;
    grown_ = true;
    pieces_.push_back(piece);
    contact_.vertices.resize(contact_.vertices.size() + static_cast<std::size_t>(piece.vertices));
    contact_.triangles.resize(contact_.triangles.size() + static_cast<std::size_t>(piece.triangles));
    duct_of_triangle_.resize(contact_.triangles.size(), static_cast<std::int32_t>(d));
  }
  for (const Piece& piece : pieces_) {
    const SurfaceSnapshot& tube = *ducts_[piece.duct].touched.surface();
    std::copy_n(tube.vertices.begin() + piece.vertex, piece.vertices, contact_.vertices.begin() + piece.first_vertex);
    for (std::int32_t t = 0; grown_ && t < piece.triangles; ++t) {
      auto corners = tube.triangles[static_cast<std::size_t>(piece.triangle + t)];
      for (std::int32_t& corner : corners) corner = contact_vertex(piece.duct, corner);
      contact_.triangles[static_cast<std::size_t>(piece.first_triangle + t)] = corners;
    }
  }
}

ContactMaterial DuctSystem::material(std::size_t duct) const {
  ContactMaterial out;
  out.stiffness_n_per_m = dent_stiffness(ducts_[duct].tube.rod.options(), tool_radius_m_);
  out.damping_s_per_m = options_.damping_s_per_m;
  out.mu_static = ducts_[duct].setup.material.mu_static;
  out.mu_dynamic = ducts_[duct].setup.material.mu_dynamic;
  return out;
}

bool DuctSystem::felt(std::int32_t triangle) const {
  const auto d = static_cast<std::size_t>(duct_of_triangle_[static_cast<std::size_t>(triangle)]);
  return !between_[d] && !passed_[d];
}

GripState DuctSystem::grip() const {
  GripState best = GripState::kEmpty;
  for (const Duct& duct : ducts_)
    for (const GripState state : {duct.grip.state(), duct.clasp.state()})
      if (state > best) best = state;
  return best;
}

double DuctSystem::slipped_m() const {
  double most = 0;
  for (const Duct& duct : ducts_) most = std::max(most, duct.grip.slipped_m());
  return most;
}

void DuctSystem::add_nodes(std::vector<NodePlace>& nodes_T) const {
  for (const Duct& duct : ducts_) duct.tube.add_nodes(nodes_T);
}

bool DuctSystem::whole(const Duct& duct) {
  return std::all_of(duct.openings.begin(), duct.openings.end(),
                     [](const DuctMark& mark) { return mark.kind == DuctMark::Kind::kNick; });
}

bool DuctSystem::any_strand_whole() const {
  return std::any_of(ducts_.begin(), ducts_.end(),
                     [](const Duct& duct) { return duct.setup.content == DuctContent::kNothing && whole(duct); });
}

std::vector<DuctMark> DuctSystem::marks() const {
  std::vector<DuctMark> out;
  for (std::size_t d = 0; d < ducts_.size(); ++d) {
    const DuctTube& tube = ducts_[d].tube;
    const double flat_m = rod_section(tube.rod.options(), 1).half_width_m;
    for (const Clip& clip : tube.clips.clips()) {
      if (!clip.on) continue;
      const double across = std::min(1.0, std::abs(clip.rotation_rod(2, 0)));
      out.push_back({DuctMark::Kind::kClip, static_cast<std::int32_t>(d), clip.arc_m, clip.width_share,
                     std::acos(across), clip.offset_rod.dot(clip.rotation_rod.col(2)) - flat_m});
    }
    out.insert(out.end(), ducts_[d].openings.begin(), ducts_[d].openings.end());
  }
  return out;
}

std::vector<Pose> DuctSystem::clip_poses() const {
  std::vector<Pose> out;
  for (const Duct& duct : ducts_)
    for (const Clip& clip : duct.tube.clips.clips())
      if (clip.on) out.push_back(clip.X_TC);
  return out;
}

/// Between an open end and what its piece hangs on something closes the lumen.
bool DuctSystem::tight(const Duct& duct, const LumenEnd& end) const {
  const RodPart& part = duct.tube.rod.parts()[end.part];
  if (!part.anchored_first && !part.anchored_last) return true;  // nothing comes
  const auto segments = duct.tube.lumen.segments(duct.tube.rod);
  return std::any_of(segments.begin() + static_cast<std::ptrdiff_t>(part.first),
                     segments.begin() + static_cast<std::ptrdiff_t>(part.last), [](const LumenSegment& segment) {
                       return segment.open <= 0 && segment.holds_pa > 0 && segment.state != LumenState::kPressed;
                     });
}

std::optional<std::pair<double, double>> DuctSystem::pressed(std::size_t duct) const {
  const Duct& one = ducts_[duct];
  for (const RodGrip* grip : {&one.grip, &one.clasp})
    if (const auto arc_m = grip->pressed_arc_m())
      return std::pair(*arc_m, one.tube.lumen.shape_at(one.tube.rod, *arc_m).flatness);
  return std::nullopt;
}

std::int32_t DuctSystem::bile_leaks() const {
  std::int32_t count = 0;
  for (const Duct& duct : ducts_) {
    if (duct.setup.content != DuctContent::kBile) continue;
    for (const LumenEnd& end : duct.tube.lumen.ends(duct.tube.rod)) count += end.outside && !tight(duct, end);
    count += static_cast<std::int32_t>(duct.tube.lumen.leaks().size());
  }
  return count;
}

}  // namespace trocar
