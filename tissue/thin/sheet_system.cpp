#include "tissue/thin/sheet_system.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "haptics/contact/segment_triangle.h"
#include "haptics/input_error.h"
#include "tissue/thin/rod_on_solid.h"

namespace trocar {
namespace {

constexpr double kEarth = 9.81;            // m/s2
constexpr double kOpenBlades = 0.003;      // m from which on a sheet can come between them (a choice)
constexpr double kCutReach = 0.9;          // of an edge: how far from the blades' line the cut runs
constexpr double kResistBlock = 500;       // N/m of what blades cut, about its force
constexpr double kBurnReach = 0.8;         // of an edge, round the hook's tip
constexpr double kMayTouch = 0.002;        // m over the organ from which a node may come to lie on it within a step
constexpr double kNoSheetDrag = 1e-6;      // N
constexpr int kSearch = 12;                // vertices of the organ that a node may pass in a step
constexpr double kTipsOver = 0.006;        // m beyond the tips, in which what they press on still is: their roundness
constexpr double kCloses = 0.9;            // of how far they stood open, from which on blades are closing
constexpr double kNarrows = 0.0002;        // m: blades that narrow by less stand still (a choice)
constexpr int kStandSteps = 25;            // for so long (a choice)
constexpr int kBiteSteps = 10;             // for which a press counts on: closing tips wander on what they press
constexpr double kSpreadTolerance = 2e-6;  // m, of a sheet in a frame: it is seen, and pressed by soft touches alone
constexpr double kRimStrip = 0.004;        // m: so narrow a strip between a cut and the rim parts with it (a choice)
constexpr std::size_t kCrumb = 20;         // triangles: so small a piece stays where it hangs
constexpr double kRimStep = 0.00025;       // m
constexpr double kRests = 0.0005;          // m/s of its fastest node, below which a sheet in a frame rests
constexpr double kSpreadStill = 1e-6;      // m
constexpr double kOnSheet = 0.0005;        // m between a place and the sheet that bears it
constexpr double kNearer = 0.64;           // of the squared distance: by so much another vertex must be nearer

bool carries(const SolvedContact& contact) {
  return contact.share > 0 && contact.force_T.allFinite() && contact.tool_T.allFinite() && contact.normal_T.allFinite();
}

SheetOptions options_of(const SheetSetup& setup, double step_s) {
  SheetOptions options = sheet_options(setup.material, setup.thickness_m);
  options.gravity_m_s2 = {0, 0, -kEarth};
  options.step_s = step_s;
  if (setup.framed) options.tolerance_m = kSpreadTolerance;
  return options;
}

/// What was drawn; of a sheet that is spread in a frame, as it was before.
TriangleSurface at_rest(const SheetSetup& setup, double frame_strain) {
  TriangleSurface rest = setup.drawn_T;
  if (!setup.framed || rest.vertices.empty()) return rest;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& vertex : rest.vertices) middle += vertex / static_cast<double>(rest.vertices.size());
  for (Vec3& vertex : rest.vertices) vertex = middle + (vertex - middle) / (1 + frame_strain);
  return rest;
}

std::int32_t nearest_of(std::span<const Vec3> vertices, const Vec3& place) {
  const auto nearest = std::min_element(vertices.begin(), vertices.end(), [&](const Vec3& a, const Vec3& b) {
    return (a - place).squaredNorm() < (b - place).squaredNorm();
  });
  return static_cast<std::int32_t>(nearest - vertices.begin());
}

const Vec3& vertex_of(const SurfaceSnapshot& surface, std::int32_t v) {
  return surface.vertices[static_cast<std::size_t>(v)];
}

}  // namespace

SheetSystem::SheetSystem(std::span<const SheetSetup> sheets, const SoftOrgan& organ, const SheetSystemOptions& options)
    : options_(options) {
  know(organ);
  for (const SheetSetup& setup : sheets) {
    try {
      ElasticSheet sheet(at_rest(setup, options_.frame_strain), options_of(setup, organ.solid().options().step_s));
      sheets_.push_back({setup, std::move(sheet), SheetSurface(setup), SheetGrip(options_.grip)});
    } catch (const InputError& error) {
      throw InputError("sheet '" + setup.name + "': " + error.what());
    }
    Sheet& of = sheets_.back();
    of.edge_m = std::sqrt(of.sheet.mean_area_m2() * 4 / std::sqrt(3.0));
    if (setup.framed) spread(of);
    for (const Vec3& place : of.sheet.position()) of.beneath.push_back(nearest_of(organ.rest()->vertices, place));
    for (const std::int32_t node : setup.hinge) {
      if (node < 0 || static_cast<std::size_t>(node) >= of.beneath.size())
        throw InputError("sheet '" + setup.name + "': a place of its hinge is none");
      if (setup.framed) continue;
      const std::int32_t vertex = of.beneath[static_cast<std::size_t>(node)];
      of.hinge.push_back(
          {node, vertex, of.sheet.position()[static_cast<std::size_t>(node)] - vertex_of(*organ.rest(), vertex)});
    }
    for (const auto& corner : of.sheet.triangles()) {
      contact_.triangles.push_back(corner);  // numbered by follow()
      sheet_of_triangle_.push_back(static_cast<std::int32_t>(sheets_.size() - 1));
    }
  }
  between_.assign(contact_.triangles.size(), false);
  follow();
  grown_ = false;
}

void SheetSystem::know(const SoftOrgan& organ) {
  organ_topology_ = organ.topology();
  const SurfaceSnapshot& rest = *organ.rest();
  fan_.assign(rest.vertices.size(), {});
  for (std::size_t t = 0; t < rest.triangles.size(); ++t) {
    if (!rest.inside.empty() && rest.inside[t]) continue;
    for (const std::int32_t v : rest.triangles[t])
      fan_[static_cast<std::size_t>(v)].push_back(static_cast<std::int32_t>(t));
  }
}

NodeShares SheetSystem::shares_at(const SoftOrgan& organ, std::int32_t vertex) const {
  const auto& fan = fan_[static_cast<std::size_t>(vertex)];
  if (fan.empty()) return {};
  const auto& corners = organ.rest()->triangles[static_cast<std::size_t>(fan.front())];
  MaterialPoint place{fan.front(), {0, 0, 0}};
  place.weight[static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin())] = 1;
  return organ.shares_of(place);
}

Vec3 SheetSystem::normal_at(const SoftOrgan& organ, std::int32_t vertex) const {
  Vec3 sum = Vec3::Zero();
  const SurfaceSnapshot& now = *organ.surface();
  for (const std::int32_t t : fan_[static_cast<std::size_t>(vertex)]) {
    const auto& [a, b, c] = now.triangles[static_cast<std::size_t>(t)];
    sum += (vertex_of(now, b) - vertex_of(now, a)).cross(vertex_of(now, c) - vertex_of(now, a));
  }
  return sum.norm() > 0 ? Vec3(sum.normalized()) : Vec3(Vec3::UnitZ());
}

bool SheetSystem::jaws_taken(const StylusState& stylus, const Tool& tool, bool present) const {
  if (!present || !std::isfinite(stylus.jaw_opening_m) || !stylus.X_TI.p.allFinite() || !stylus.X_TI.R.allFinite())
    return false;
  const bool grasps = tool.kind == InstrumentKind::kGrasper;
  if (!grasps && tool.kind != InstrumentKind::kScissors) return false;
  if (!grasps && open_) return true;
  return std::any_of(sheets_.begin(), sheets_.end(), [&](const Sheet& of) {
    if (of.setup.framed && !grasps) return of.snipped;
    return of.grip.state() != GripState::kEmpty ||
           !triangles_between(of.sheet, stylus.X_TI, grasps ? options_.grip.pad_length_m : options_.scissors.blade_m,
                              grasps ? options_.grip.pad_width_m : options_.scissors.width_m, stylus.jaw_opening_m, 0)
                .empty();
  });
}

/// Springs of the loop's contacts on one sheet, and of their friction.
void SheetSystem::touch(std::size_t sheet, const SheetContacts& given, std::vector<SheetSpring>& springs) {
  if (given.first_triangle < 0) return;
  std::int32_t first = given.first_triangle;
  for (std::size_t s = 0; s < sheet; ++s) first += static_cast<std::int32_t>(sheets_[s].sheet.triangles().size());
  const ElasticSheet& of = sheets_[sheet].sheet;
  for (std::int32_t i = 0; i < given.contacts.count; ++i) {
    const SolvedContact& contact = given.contacts.at[static_cast<std::size_t>(i)];
    MaterialPoint place = contact.place;
    place.triangle -= first;
    if (place.triangle < 0 || place.triangle >= static_cast<std::int32_t>(of.triangles().size()) || !carries(contact))
      continue;
    const double stiffness = contact.share * options_.touch_n_per_m;
    springs.push_back({.place = place,
                       .direction = contact.normal_T,
                       .stiffness_n_per_m = stiffness,
                       .stretch_m = contact.normal_T.dot(of.place_T(place) - contact.tool_T),
                       .pushes_only = true});
    const Vec3 drag = contact.force_T - contact.force_T.dot(contact.normal_T) * contact.normal_T;
    const double size = drag.norm();
    if (size < kNoSheetDrag) continue;
    springs.push_back({.place = place,
                       .direction = drag / size,
                       .stiffness_n_per_m = options_.drag_share * stiffness,
                       .stretch_m = size / (options_.drag_share * stiffness)});
  }
}

/// Springs of the nodes that are in the organ, within half a thickness of it, or may come there within the step: one
/// that is known only once it is in falls into the organ by g h^2 first, and is thrown out again.
void SheetSystem::lie(Sheet& of, const SoftOrgan& organ, std::vector<SheetSpring>& springs) {
  of.lying = springs.size();
  of.on_organ.clear();
  const SurfaceSnapshot& now = *organ.surface();
  std::vector<MaterialPoint> place(of.sheet.position().size());
  for (std::size_t t = 0; t < of.sheet.triangles().size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      MaterialPoint& at = place[static_cast<std::size_t>(of.sheet.triangles()[t][i])];
      if (at.triangle >= 0) continue;
      at.triangle = static_cast<std::int32_t>(t);
      at.weight[i] = 1;
    }
  for (std::size_t n = 0; n < of.beneath.size(); ++n) {
    std::int32_t& nearest = of.beneath[n];
    const Vec3& p = of.sheet.position()[n];
    double least = (vertex_of(now, nearest) - p).squaredNorm();
    for (int step = 0; step < kSearch; ++step) {
      std::int32_t better = -1;
      least *= kNearer;  // what another one must beat
      for (const std::int32_t t : fan_[static_cast<std::size_t>(nearest)])
        for (const std::int32_t v : now.triangles[static_cast<std::size_t>(t)])
          if (const double there = (vertex_of(now, v) - p).squaredNorm(); there < least) least = there, better = v;
      if (better < 0) break;
      nearest = better;
    }
    const Vec3 normal = normal_at(organ, nearest);
    const double deep = of.sheet.options().thickness_m / 2 - normal.dot(p - vertex_of(now, nearest));
    if (deep < -kMayTouch || deep > options_.lying_reach_m) continue;
    // No stiffer than what it lies on: a crumb that cuts have left would be thrown about between two steps.
    const double beneath = organ.solid().held_stiffness(shares_at(organ, nearest));
    springs.push_back(
        {.place = place[n],
         .direction = -normal,
         .stiffness_n_per_m = beneath > 0 ? std::min(options_.lying_n_per_m, beneath) : options_.lying_n_per_m,
         .stretch_m = deep,
         .pushes_only = true});
    of.on_organ.push_back(static_cast<std::int32_t>(n));
  }
}

void SheetSystem::step(const HapticState& newest, const SheetContacts& contacts, const Tool& tool, bool present,
                       const SoftOrgan& organ, std::vector<SoftSpring>& springs) {
  const StylusState& stylus = newest.stylus;
  changed_.clear();
  block_ = {};
  hold_ = {};
  pull_n_ = 0;
  if (organ.topology() != organ_topology_) know(organ);
  const bool sound =
      present && stylus.X_TI.p.allFinite() && stylus.X_TI.R.allFinite() && std::isfinite(stylus.jaw_opening_m);
  if (sound && tool.kind == InstrumentKind::kScissors)
    use_scissors(stylus);
  else
    open_ = false;
  if (sound && tool.kind == InstrumentKind::kHook && stylus.pedal)
    burn(stylus, contacts);
  else
    burns_ = false;
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    Sheet& of = sheets_[s];
    feel_tips(s, contacts);
    if (of.setup.framed) use_tips(s, stylus, sound && tool.kind == InstrumentKind::kScissors);
    for (const Hinge& hinge : of.hinge) {
      const RodAnchor at = anchor_on(organ.solid(), shares_at(organ, hinge.vertex), options_.hinge_n_per_m);
      of.sheet.anchor({hinge.node, at.position + hinge.offset_T, at.velocity, at.stiffness_n_per_m});
    }
    std::vector<SheetSpring> of_sheet;
    if (sound && tool.kind == InstrumentKind::kGrasper)
      of.grip.reach(stylus.X_TI, stylus.jaw_opening_m, of.sheet, of_sheet);
    else
      of.grip.let_go();
    const std::size_t of_jaws = of_sheet.size();
    if (present) touch(s, contacts, of_sheet);
    if (!of.setup.framed) lie(of, organ, of_sheet);
    of.still = of.still && of.setup.framed && of_sheet.empty() && changed_.empty();
    if (of.still) continue;
    of.sheet.step(of_sheet);
    of.still = of_sheet.empty() && std::all_of(of.sheet.velocity().begin(), of.sheet.velocity().end(),
                                               [](const Vec3& velocity) { return velocity.norm() < kRests; });
    if (of.grip.state() != GripState::kEmpty) {
      of.grip.feel(stylus.X_TI, std::span(of_sheet).first(of_jaws), of.sheet);
      if (block_.stiffness_n_per_m < of.grip.block().stiffness_n_per_m) block_ = of.grip.block();
      if (hold_.stiffness_n_per_m < of.grip.hold().stiffness_n_per_m) hold_ = of.grip.hold();
    }
    if (!of.sheet.torn().empty()) {
      changed_.push_back({static_cast<std::int32_t>(s), {of.sheet.torn().begin(), of.sheet.torn().end()}});
      ++tears_;
    }
    if (of.setup.framed) continue;
    // The organ's part: what a hinge pulls, what lies on it presses, with the stiffness of either.
    const std::vector<Mat3> stiffness = of.sheet.anchor_stiffness();
    for (std::size_t a = 0; a < stiffness.size(); ++a) {
      const SheetAnchor& anchor = of.sheet.anchors()[a];
      const auto hinge =
          std::find_if(of.hinge.begin(), of.hinge.end(), [&](const Hinge& h) { return h.node == anchor.node; });
      if (hinge == of.hinge.end()) continue;
      const Vec3 way = organ.solid().options().step_s * anchor.velocity;
      for (const SoftSpring& spring : load_springs({anchor.force, way, stiffness[a]}, shares_at(organ, hinge->vertex)))
        springs.push_back(spring);
    }
    for (std::size_t i = 0; i < of.on_organ.size(); ++i) {
      const SheetSpring& spring = of_sheet[of.lying + i];
      const auto node = static_cast<std::size_t>(of.on_organ[i]);
      const double now = spring.stretch_m + spring.direction.dot(of.sheet.position()[node] - of.sheet.before()[node]);
      springs.push_back(
          {shares_at(organ, of.beneath[node]), -spring.direction, spring.stiffness_n_per_m, now, true, 0});
    }
  }
  // What is beside jaws that have the sheet is no contact, and comes back only once it is away from them.
  std::int32_t first = 0;
  for (const Sheet& of : sheets_) {
    const auto count = static_cast<std::int32_t>(of.sheet.triangles().size());
    const bool taken = of.grip.state() != GripState::kEmpty || (open_ && !of.setup.framed),
               cuts = tool.kind == InstrumentKind::kScissors;
    std::vector<bool> between(static_cast<std::size_t>(count), false);
    if (sound)
      for (const std::int32_t t :
           triangles_between(of.sheet, stylus.X_TI, cuts ? options_.scissors.blade_m : options_.grip.pad_length_m,
                             cuts ? options_.scissors.width_m : options_.grip.pad_width_m, stylus.jaw_opening_m,
                             options_.near_jaws_m))
        between[static_cast<std::size_t>(t)] = taken || between_[static_cast<std::size_t>(first + t)];
    std::copy(between.begin(), between.end(), between_.begin() + first);
    first += count;
  }
  follow();
}

void SheetSystem::use_scissors(const StylusState& stylus) {
  const ScissorsOptions& o = options_.scissors;
  const Pose& X_TI = stylus.X_TI;
  bool between = false;
  for (const Sheet& of : sheets_)
    between = between || (!of.setup.framed &&
                          !triangles_between(of.sheet, X_TI, o.blade_m, o.width_m,
                                             std::max(stylus.jaw_opening_m, of.setup.thickness_m), of.edge_m / 2)
                               .empty());
  if (!between) open_ = false;
  if (between && stylus.jaw_opening_m > kOpenBlades) open_ = true;
  if (!open_) return;
  double resist = 0;
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    const Sheet& of = sheets_[s];
    if (of.setup.framed) continue;
    // The energy of the whole cut over the way of the blades.
    resist += of.setup.material.toughness_j_per_m2 * of.setup.thickness_m * o.blade_m / (2 * kOpenBlades);
    if (stylus.jaw_opening_m >= o.shut_opening_m) continue;
    part(s, of.sheet.chain({X_TI * Vec3(0, 0, -o.blade_m), X_TI.p, kCutReach * of.edge_m}));
  }
  if (stylus.jaw_opening_m >= o.shut_opening_m)
    block_ = {stylus.jaw_opening_m + resist / kResistBlock, kResistBlock};
  else
    open_ = false;
}

/// Clips hold its rim where it was drawn.
void SheetSystem::spread(Sheet& of) const {
  of.sheet.place(of.setup.drawn_T.vertices);
  for (const std::int32_t node : of.setup.hinge)
    if (node >= 0 && static_cast<std::size_t>(node) < of.setup.drawn_T.vertices.size())
      of.sheet.anchor(
          {node, of.setup.drawn_T.vertices[static_cast<std::size_t>(node)], Vec3::Zero(), options_.clip_n_per_m});
  of.sheet.settle({}, kSpreadStill);
  of.drawn_T.assign(of.sheet.position().begin(), of.sheet.position().end());
}

void SheetSystem::feel_tips(std::size_t sheet, const SheetContacts& given) {
  Sheet& of = sheets_[sheet];
  of.pressed_n = 0;
  if (given.first_triangle < 0) return;
  std::int32_t first = given.first_triangle;
  for (std::size_t s = 0; s < sheet; ++s) first += static_cast<std::int32_t>(sheets_[s].sheet.triangles().size());
  Vec3 pull = Vec3::Zero(), sunk = Vec3::Zero();
  for (std::int32_t i = 0; i < given.contacts.count; ++i) {
    const SolvedContact& contact = given.contacts.at[static_cast<std::size_t>(i)];
    const std::int32_t triangle = contact.place.triangle - first;
    if (triangle < 0 || triangle >= static_cast<std::int32_t>(of.sheet.triangles().size()) || !carries(contact))
      continue;
    pull += contact.force_T;
    const double press = std::max(0.0, contact.force_T.dot(contact.normal_T));
    of.pressed_n += press;
    sunk += press * (of.sheet.place_T({triangle, contact.place.weight}) - contact.tool_T);
  }
  if (of.pressed_n > 0) of.sunk_T = sunk / of.pressed_n;
  pull_n_ = std::max(pull_n_, pull.norm());
}

void SheetSystem::use_tips(std::size_t sheet, const StylusState& stylus, bool scissors) {
  Sheet& of = sheets_[sheet];
  const ScissorsOptions& o = options_.scissors;
  const double now_m = stylus.jaw_opening_m;
  of.bite_steps = of.pressed_n >= options_.bite_n ? 0 : of.bite_steps + 1;
  // Blades that have cut it, and are not off it before they open, have closed on nothing else.
  of.snipped = scissors && (of.bite_steps <= kBiteSteps || (of.snipped && now_m < kOpenBlades));
  if (!scissors || of.bite_steps > kBiteSteps) {
    of.closing = {};
    return;
  }
  Sheet::Closing& closing = of.closing;
  // Blades that open again, or stand half closed a while, close from there.
  closing.stood_steps = now_m < closing.narrowest_m - kNarrows ? 0 : closing.stood_steps + 1;
  if (closing.stood_steps == 0) closing.narrowest_m = now_m;
  const bool anew = now_m > closing.narrowest_m + kNarrows || closing.stood_steps > kStandSteps;
  if (now_m >= kOpenBlades && anew) closing = {.from_m = now_m, .narrowest_m = now_m};
  if (closing.from_m < kOpenBlades) return;
  // What lies between the blades as they begin to close: they may drag it, or be dragged, before they are shut.
  if (!closing.caught && now_m <= kCloses * closing.from_m) {
    // Where they press and not where they have sunk in to: along a shaft that leans that is millimetres aside.
    const Pose X_TI{stylus.X_TI.R, stylus.X_TI.p + of.sunk_T};
    closing.caught = cut_between(sheet, X_TI, std::min(options_.snip_m, closing.from_m) / 2);
  }
  if (now_m < o.shut_opening_m) {
    if (const auto cut = std::exchange(closing, {}).caught) part_along(sheet, *cut);
    return;
  }
  const double resist = of.setup.material.toughness_j_per_m2 * of.setup.thickness_m * options_.snip_m / kOpenBlades;
  if (now_m < kOpenBlades) block_ = {now_m + resist / kResistBlock, kResistBlock};
}

/// Where the blades' plane crosses the sheet between their tips, from end to end.
std::optional<SheetCutSeen> SheetSystem::cut_between(std::size_t sheet, const Pose& X_TI, double half_m) const {
  const Sheet& of = sheets_[sheet];
  const Pose X_IT = X_TI.inverse();
  double least = half_m, most = -half_m;
  SheetCutSeen cut{static_cast<std::int32_t>(sheet)};
  for (const auto& corner : of.sheet.triangles()) {
    std::array<Vec3, 3> at_I, drawn;
    for (std::size_t i = 0; i < 3; ++i) {
      at_I[i] = X_IT * of.sheet.position()[static_cast<std::size_t>(corner[i])];
      drawn[i] = of.drawn_T[static_cast<std::size_t>(corner[i])];
    }
    std::array<Vec3, 2> on_I, on_drawn;
    std::size_t ends = 0;
    for (std::size_t i = 0; i < 3 && ends < 2; ++i) {
      const std::size_t j = (i + 1) % 3;
      const double from = at_I[i].x(), to = at_I[j].x();
      if ((from < 0) == (to < 0)) continue;
      const double share = from / (from - to);
      on_I[ends] = at_I[i] + share * (at_I[j] - at_I[i]);
      on_drawn[ends++] = drawn[i] + share * (drawn[j] - drawn[i]);
    }
    if (ends < 2) continue;
    const auto middle_z = (on_I[0].z() + on_I[1].z()) / 2;
    if (middle_z > kTipsOver || middle_z < -options_.scissors.blade_m) continue;
    const Vec3 way = on_I[1] - on_I[0];
    for (const std::size_t end : {0, 1}) {
      const double y = std::clamp(on_I[end].y(), -half_m, half_m);
      const double share = std::abs(way.y()) > 0 ? (y - on_I[0].y()) / way.y() : 0;
      if (share < 0 || share > 1) continue;
      const Vec3 place = on_drawn[0] + share * (on_drawn[1] - on_drawn[0]);
      if (y <= least) least = y, cut.from_rest_T = place;
      if (y >= most) most = y, cut.to_rest_T = place;
    }
  }
  if (most <= least) return std::nullopt;
  cut.from_rim = least > -half_m, cut.to_rim = most < half_m;
  const Vec3 way = (cut.to_rest_T - cut.from_rest_T).normalized();
  cut.from_rest_T = through_rim(cut.from_rest_T, -way);
  cut.to_rest_T = through_rim(cut.to_rest_T, way);
  return cut;
}

/// Would a piece fall out that is a crumb, now that these edges are cut?
bool SheetSystem::leaves_crumb(const Sheet& of) {
  std::vector<std::array<std::int32_t, 3>> triangles(of.sheet.triangles().begin(), of.sheet.triangles().end());
  part_triangles(triangles, static_cast<std::int32_t>(of.sheet.position().size()), of.cut_edges);
  std::map<SheetEdge, std::vector<std::size_t>> beside;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
      beside[{a, b}].push_back(t);
    }
  std::vector<bool> seen(triangles.size(), false);
  for (std::size_t first = 0; first < triangles.size(); ++first) {
    if (seen[first]) continue;
    std::size_t count = 0;
    seen[first] = true;
    for (std::vector<std::size_t> reached{first}; !reached.empty(); ++count) {
      const std::size_t t = reached.back();
      reached.pop_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [a, b] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
        for (const std::size_t other : beside[{a, b}]) {
          if (seen[other]) continue;
          seen[other] = true;
          reached.push_back(other);
        }
      }
    }
    if (count < kCrumb) return true;
  }
  return false;
}

/// The rim in that direction if it is near, else the same place.
Vec3 SheetSystem::through_rim(const Vec3& drawn_T, const Vec3& way) const {
  if (place_on(drawn_T + kRimStrip * way)) return drawn_T;
  Vec3 last = drawn_T;
  for (double on = kRimStep; on < kRimStrip && place_on(drawn_T + on * way); on += kRimStep) last = drawn_T + on * way;
  return last;
}

void SheetSystem::part_along(std::size_t sheet, const SheetCutSeen& cut) {
  Sheet& of = sheets_[sheet];
  seen_cuts_.push_back(cut);
  ++cuts_;
  const auto from = place_on(cut.from_rest_T), to = place_on(cut.to_rest_T);
  if (!from || !to) return;
  const SheetCut line{of.sheet.place_T(from->on), of.sheet.place_T(to->on), kCutReach * of.edge_m};
  for (const SheetEdge& edge : of.sheet.chain(line)) {
    of.cut_edges.push_back(edge);
    if (leaves_crumb(of)) of.cut_edges.pop_back();
  }
  if (of.sheet.part(of.cut_edges) <= 0) return;
  changed_.push_back({static_cast<std::int32_t>(sheet), of.cut_edges});
}

std::optional<SheetPlace> SheetSystem::place_on(const Vec3& drawn_T) const {
  std::optional<SheetPlace> nearest;
  double least = kOnSheet;
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    const Sheet& of = sheets_[s];
    if (!of.setup.framed) continue;
    for (std::size_t t = 0; t < of.sheet.triangles().size(); ++t) {
      std::array<Vec3, 3> at;
      for (std::size_t i = 0; i < 3; ++i) at[i] = of.drawn_T[static_cast<std::size_t>(of.sheet.triangles()[t][i])];
      const Vec3 foot = closest_point_on_triangle(drawn_T, at);
      if (const double off = (foot - drawn_T).norm(); off < least)
        least = off, nearest = SheetPlace{s, {static_cast<std::int32_t>(t), barycentric_of(foot, at)}};
    }
  }
  return nearest;
}

SurfacePlace SheetSystem::now(const SheetPlace& place) const {
  const ElasticSheet& of = sheets_[place.sheet].sheet;
  const auto& [a, b, c] = of.triangles()[static_cast<std::size_t>(place.on.triangle)];
  const auto at = [&](std::int32_t node) { return of.position()[static_cast<std::size_t>(node)]; };
  return {of.place_T(place.on), (at(b) - at(a)).cross(at(c) - at(a)).normalized()};
}

/// A live hook on a sheet cuts along its way.
void SheetSystem::burn(const StylusState& stylus, const SheetContacts& given) {
  const auto count = static_cast<std::int32_t>(contact_.triangles.size());
  bool touches = false;
  for (std::int32_t i = 0; given.first_triangle >= 0 && i < given.contacts.count; ++i) {
    const SolvedContact& contact = given.contacts.at[static_cast<std::size_t>(i)];
    const std::int32_t triangle = contact.place.triangle - given.first_triangle;
    touches = touches ||
              (triangle >= 0 && triangle < count && contact.force_T.dot(contact.normal_T) > options_.least_force_n);
  }
  if (!touches) return;
  if (!burns_) burnt_T_ = stylus.X_TI.p;
  burns_ = true;
  for (std::size_t s = 0; s < sheets_.size(); ++s) {
    const double edge = sheets_[s].edge_m;
    if ((stylus.X_TI.p - burnt_T_).norm() < edge) continue;
    part(s, sheets_[s].sheet.chain({burnt_T_, stylus.X_TI.p, kBurnReach * edge}));
    burnt_T_ = stylus.X_TI.p;
  }
}

void SheetSystem::part(std::size_t sheet, std::vector<SheetEdge> edges) {
  if (edges.empty() || sheets_[sheet].sheet.part(edges) <= 0) return;
  changed_.push_back({static_cast<std::int32_t>(sheet), std::move(edges)});
  ++cuts_;
}

void SheetSystem::follow() {
  grown_ = false;
  for (Sheet& of : sheets_) {
    const std::size_t drawn = of.setup.drawn_T.vertices.size(), known = of.beneath.size();
    const auto copied = of.sheet.copied().subspan(known - drawn);
    if (copied.empty()) continue;
    grown_ = true;
    for (const std::int32_t node : copied) {
      of.beneath.push_back(std::int32_t(of.beneath[static_cast<std::size_t>(node)]));
      if (of.setup.framed) of.drawn_T.push_back(Vec3(of.drawn_T[static_cast<std::size_t>(node)]));
    }
    of.seen.part(of.sheet.triangles(), copied);
  }
  contact_.vertices.clear();
  before_.clear();
  seen_.clear();
  std::size_t triangle = 0;
  for (const Sheet& of : sheets_) {
    const auto first = static_cast<std::int32_t>(contact_.vertices.size());
    const auto at = of.sheet.position(), was = of.sheet.before();
    contact_.vertices.insert(contact_.vertices.end(), at.begin(), at.end());
    before_.insert(before_.end(), was.begin(), was.end());
    for (const auto& [a, b, c] : of.sheet.triangles())
      contact_.triangles[triangle++] = {first + a, first + b, first + c};
    seen_.push_back(of.seen.at(at));
  }
}

ContactMaterial SheetSystem::material(std::size_t sheet) const {
  ContactMaterial out;
  out.stiffness_n_per_m = options_.touch_n_per_m;
  out.damping_s_per_m = options_.damping_s_per_m;
  out.mu_static = sheets_[sheet].setup.material.mu_static;
  out.mu_dynamic = sheets_[sheet].setup.material.mu_dynamic;
  return out;
}

GripState SheetSystem::grip() const {
  GripState best = GripState::kEmpty;
  for (const Sheet& of : sheets_) best = std::max(best, of.grip.state());
  return best;
}

double SheetSystem::slipped_m() const {
  double most = 0;
  for (const Sheet& of : sheets_) most = std::max(most, of.grip.slipped_m());
  return most;
}

void SheetSystem::add_nodes(std::vector<NodePlace>& nodes_T) const {
  for (const Vec3& vertex : contact_.vertices) nodes_T.push_back(vertex.cast<float>());
}

}  // namespace trocar
