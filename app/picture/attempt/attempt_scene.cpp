#include "app/picture/attempt/attempt_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/picture/kinds/board_object.h"
#include "app/picture/kinds/kind_picture.h"
#include "tissue/thin/clip.h"
#include "tissue/thin/duct_tube.h"
#include "tissue/tissue_frame.h"

namespace trocar {
namespace {

using Shape = SceneObject::Shape;
using Style = SceneObject::Style;
using Look = SceneObject::Look;

constexpr double kFieldDeg = 72;
constexpr double kOfFrame = 0.9;         // of what the picture's height shows: the start stands within
constexpr double kTipSeen = 0.004;       // m round the tip of an instrument that comes in
constexpr double kToWork_s = 1.5;        // from the start's view to the work's
constexpr double kSleeveInside = 0.025;  // m of the port's tube on the scope's side of the wall

const Vec3 kBoardLines(0.44, 0.44, 0.42);
const Vec3 kNeutralFoam(0.45, 0.43, 0.38);
const Vec3 kPegColour(0.52, 0.52, 0.54);
const Vec3 kTitanium(0.62, 0.61, 0.60), kDarkBlood(0.16, 0.004, 0.004);
const Vec3 kNeedleColour(0.58, 0.58, 0.60), kThreadColour(0.08, 0.14, 0.62);
constexpr double kThreadWider = 0.00015;  // m
constexpr std::size_t kOfSuture = 2;      // needle and thread, the last thin parts
constexpr double kOnNeedle = 0.0006;      // m of opening of jaws that hold a needle
constexpr double kClosedGap = 0.0004;     // m that tissue keeps between a closed clip's legs

/// That the picture shows at a distance of 1: the frame cuts the round field above and below, 0.5 of the height against
/// a radius of 0.64 of it.
double half_height() { return 0.5 / 0.64 * std::tan(0.5 * kFieldDeg * std::numbers::pi / 180); }

std::vector<TargetMark> marks(const DirectorView& director) {
  std::vector<TargetMark> out;
  const DirectorStatus& status = director.status();
  for (std::size_t i = 0; i < director.board().targets.size(); ++i) {
    const Target& target = director.board().targets[i];
    const int index = static_cast<int>(i);
    auto state = TargetMark::State::kWaiting;
    if (status.done.test(i))
      state = TargetMark::State::kDone;
    else if (index == status.target_index)
      state = TargetMark::State::kLit;
    out.push_back({target.centre_T, target.normal_T, target.radius_m, state});
  }
  return out;
}

void add_start(const SessionView& view, std::vector<SceneObject>& out) {
  const Phase phase = view.director.status().phase;
  if (!waits_for_start(phase)) return;
  SceneObject start;
  start.shape = Shape::kSphere;
  start.style = Style::kGhostLit;
  start.size_m = Vec3::Constant(2 * view.scene.setup.exercise.start_sphere_m);
  start.X_TO.p = view.director.board().start_T;
  out.push_back(start);
}

/// The port rides on the shaft: its tube follows the shaft's direction, the wall gives way.
void add_port(const SessionView& view, std::vector<SceneObject>& out) {
  if (!view.scene.loop.map.fulcrum) return;
  SceneObject sleeve;
  sleeve.shape = Shape::kSleeve;
  sleeve.size_m = {2 * view.scene.loop.tool.radius_m + 0.0006, 0, 2 * kSleeveInside};
  sleeve.colour = {0.42, 0.45, 0.47};
  sleeve.accent = {0.02, 0.02, 0.02};
  sleeve.X_TO.R = view.record.stylus.X_TI.R;
  sleeve.X_TO.p = view.scene.loop.map.fulcrum->port_T + kSleeveInside * sleeve.X_TO.R.col(2);
  out.push_back(sleeve);
}

SceneObject peg_object(const PegPost& peg) {
  SceneObject out;
  out.shape = Shape::kCylinder;
  out.look = Look::kSteel;
  out.size_m = {2 * peg.radius_m, 0, peg.height_m};
  out.X_TO.p = peg.foot_T + Vec3(0, 0, peg.height_m / 2);
  out.colour = kPegColour;
  return out;
}

SceneObject block_object(const Pose& X_TO, const Vec3& size, int colour) {
  SceneObject block;
  block.look = Look::kFoam;
  block.X_TO = X_TO;
  block.size_m = size;
  if (colour >= 0 && colour < static_cast<int>(foam_classes().size())) {
    const FoamClass& foam = foam_classes()[static_cast<std::size_t>(colour)];
    block.colour = foam.colour;
    block.accent = foam.band;
    block.bands = foam.bands;
  } else {
    block.colour = kNeutralFoam;
  }
  return block;
}

/// A block between the jaws gives way: by as much as the jaws are nearer to each other than it is thick.
void pinch(SceneObject& block, const StylusState& stylus) {
  const Vec3 across_O = block.X_TO.R.transpose() * stylus.X_TI.R.col(1);  // jaws open along y of I
  Eigen::Index axis = 0;
  across_O.cwiseAbs().maxCoeff(&axis);
  block.pinch_O = Vec3::Unit(axis);
  block.pinch_depth_m = std::clamp(block.size_m[axis] - stylus.jaw_opening_m, 0.0, 0.6 * block.size_m[axis]);
}

/// Blood, char and the like, smoke, and what is on the lens.
void add_marks(const TissueFrame& tissue, SceneView& out) {
  out.marks.assign(tissue.mark.begin(), tissue.mark.begin() + tissue.mark_count);
  out.smoke_per_m = tissue.smoke_per_m;
  out.lens.fog = tissue.lens_fog;
  out.lens.blood = tissue.lens_blood;
}

/// Clips on wounds, and blood in the air.
void add_clips_and_drops(const TissueFrame& tissue, std::vector<SceneObject>& out) {
  for (std::int32_t i = 0; i < tissue.clip_count; ++i) {
    SceneObject clip;
    clip.shape = Shape::kClip;
    clip.look = Look::kSteel;
    clip.colour = kTitanium;
    clip.size_m = {ClipOptions{}.width_m, kClosedGap, ClipOptions{}.length_m};
    clip.X_TO = tissue.clip[static_cast<std::size_t>(i)];
    out.push_back(clip);
  }
  for (std::int32_t i = 0; i < tissue.drop_count; ++i) {
    const DropState& drop = tissue.drop[static_cast<std::size_t>(i)];
    SceneObject bead;
    bead.shape = Shape::kSphere;
    bead.colour = kDarkBlood;
    bead.size_m = Vec3::Constant(2 * drop.radius_m);
    bead.X_TO.p = drop.place_T;
    out.push_back(bead);
  }
}

}  // namespace

std::vector<SceneObject> rigid_objects(const RigidScene& rigid, const TissueFrame* frame, int lit_block) {
  std::vector<SceneObject> out;
  if (rigid.board) {
    const BoardPlate& plate = *rigid.board;
    out.push_back(board_object(plate.top_z_m, 2 * plate.half_extent_m, plate.thickness_m, Vec3::Zero(), kBoardLines));
  }
  for (std::size_t i = 0; i < rigid.rings.size(); ++i) {
    SceneObject ring;
    ring.shape = Shape::kRing;
    ring.size_m = {2 * rigid.rings[i].radius_m + 0.002, 0, 0.001};
    ring.X_TO.p = rigid.rings[i].centre_T;
    ring.colour = Vec3(0.46, 0.46, 0.45);
    if (static_cast<int>(i) == lit_block) ring.style = Style::kLit;
    out.push_back(ring);
  }
  std::transform(rigid.pegs.begin(), rigid.pegs.end(), std::back_inserter(out), peg_object);
  for (std::size_t i = 0; i < rigid.blocks.size(); ++i) {
    const FoamBlock& laid = rigid.blocks[i];
    const bool ring = laid.hole_radius_m > 0;
    SceneObject block = ring ? triangle_object(laid) : block_object(laid.X_TO, laid.size_m, laid.colour);
    if (frame && static_cast<int>(i) < frame->object_count) {
      const ObjectState& now = frame->object[i];
      block.X_TO = now.X_TO;
      if (!ring) block.size_m = now.size_m;
      block.wear = now.crushed ? 1 : 0;
    }
    if (lit_block >= 0 && i == static_cast<std::size_t>(lit_block) % rigid.blocks.size()) block.style = Style::kLit;
    out.push_back(block);
  }
  return out;
}

Camera attempt_camera(const Scene& scene) {
  const TargetLayout& layout = scene.setup.exercise.layout;
  Camera camera;
  camera.diagonal_fov_deg = kFieldDeg;
  const Eigen::AlignedBox3d work = picture_of(scene.setup.exercise).work(scene);
  if (work.isEmpty()) {
    camera.look_at_T = scene.board.centre_T + Vec3(0, 0.004, 0.004);
    camera.eye_T = camera.look_at_T + Vec3(-0.012, -1.15 * layout.region_y_m, 1.0 * layout.region_y_m);
    return camera;
  }
  const double distance = 0.5 * work.sizes().norm() / std::sin(std::atan(half_height()));
  camera.look_at_T = work.center();
  camera.eye_T = camera.look_at_T + Vec3(-0.08, -0.75, 0.66).normalized() * distance;
  return camera;
}

bool is_scope(const Exercise& exercise) { return picture_of(exercise).sees != nullptr; }

namespace {

/// Drawn back along its line of sight until a sphere is in the picture.
Camera drawn_back(Camera camera, const Vec3& centre_T, double radius_m) {
  const Vec3 away = (camera.look_at_T - camera.eye_T).normalized(), way = centre_T - camera.eye_T;
  const double deep = way.dot(away), aside = (way - deep * away).norm() + radius_m;
  camera.eye_T -= std::max(0.0, aside / (kOfFrame * half_height()) - deep) * away;
  return camera;
}

}  // namespace

Camera attempt_camera(const SessionView& view) {
  const Scene& scene = view.scene;
  const KindPicture& picture = picture_of(scene.setup.exercise);
  if (picture.sees) return picture.sees(scene, view.record.stylus.X_TI);
  const DirectorStatus& status = view.director.status();
  Camera camera = attempt_camera(scene);
  Camera whole = drawn_back(camera, scene.board.start_T, scene.setup.exercise.start_sphere_m);
  if (!scene.loop.daq.motors) whole = drawn_back(whole, entry_T(scene), kTipSeen);
  const double s = waits_for_start(status.phase) ? 0 : std::min(1.0, status.run_time_s / kToWork_s);
  camera.eye_T += (1 - s * s * (3 - 2 * s)) * (whole.eye_T - camera.eye_T);
  return camera;
}

namespace {

/// On tissue that gives way the loop's depth is that of the whole dent; the surface has most of it already. What is
/// left is how far tip and shaft reach into the surface as it is.
double left_of_dimple(const SceneView& view) {
  constexpr double kUnder = 0.006;  // m to the sides, within which a vertex lies under the instrument
  const Vec3 normal = view.dimple_normal_T, shaft = -view.X_TI.R.col(2);
  const Vec3 along = shaft - shaft.dot(normal) * normal;
  const double flat2 = std::max(along.squaredNorm(), 0.01);
  double deepest = 0;
  for (const Vec3& vertex : view.organ->vertices) {
    const Vec3 from = vertex - *view.dimple_T;
    const Vec3 off = from - std::clamp(from.dot(along) / flat2, 0.0, view.shaft_length_m) * shaft;
    const double height = off.dot(normal), aside2 = off.squaredNorm() - height * height;
    if (height > view.dimple_depth_m + kUnder) continue;  // of another fold, over the tool
    deepest = std::max(deepest, std::min(height, view.dimple_depth_m) * std::exp(-aside2 / (2 * kUnder * kUnder)));
  }
  return deepest;
}

}  // namespace

InstrumentKind in_hand(const SessionView& view) {
  const std::vector<InstrumentKind>& all = view.scene.setup.exercise.instruments;
  return all[std::min(static_cast<std::size_t>(view.record.stylus.instrument), all.size() - 1)];
}

SceneView attempt_scene(const SessionView& view) {
  const StylusState& stylus = view.record.stylus;
  SceneView out;
  const KindDescription& kind = kind_of(view.scene.setup.exercise);
  if (kind.on_organ) {
    out.organ = view.organ_T ? view.organ_T : view.scene.organ_T;
    out.material = view.scene.organ.material;
    for (const Organ& other : view.scene.organ.adjacent)
      if (other.name == view.scene.bound) out.second_material = other.material;
    out.targets = marks(view.director);
    if (const auto add_marks = picture_of(view.scene.setup.exercise).add_marks) add_marks(view, out.targets);
    for (const AdjacentOrgan& organ : view.scene.adjacent.organs)
      out.adjacent.push_back({organ.surface_T, organ.material});
    if (view.scene.soft) out.breath_T = bed_shift(view.scene.setup.exercise.breathing, stylus.t_s);
    const std::vector<SurfacePtr>& thin_T = view.thin_T.empty() ? view.scene.thin_T : view.thin_T;
    std::vector<std::string> materials;
    for (const DuctSetup& duct : view.scene.ducts) materials.push_back(duct.material.name);
    for (const SheetSetup& sheet : view.scene.sheets) materials.push_back(sheet.material.name);
    const std::size_t tissue = std::min(thin_T.size(), materials.size());
    for (std::size_t i = 0; i < tissue; ++i) out.adjacent.push_back({thin_T[i], materials[i]});
    if (thin_T.size() >= tissue + kOfSuture) {
      out.wires.push_back({thin_T[tissue], SceneObject::Look::kSteel, kNeedleColour});
      out.wires.push_back({thin_T[tissue + 1], SceneObject::Look::kPlastic, kThreadColour, kThreadWider});
    }
  }
  picture_of(view.scene.setup.exercise).add_objects(view, out.objects);
  auto rigid = rigid_objects(view.scene.board.rigid, view.tissue, view.director.status().target_index);
  if (view.tissue && view.tissue->held() && view.tissue->grip_object >= 0) {
    const std::size_t first = rigid.size() - view.scene.board.rigid.blocks.size();  // blocks come last
    SceneObject& held = rigid.at(first + static_cast<std::size_t>(view.tissue->grip_object));
    if (held.shape == Shape::kBox) pinch(held, stylus);
  }
  out.objects.insert(out.objects.end(), rigid.begin(), rigid.end());
  add_start(view, out.objects);
  add_port(view, out.objects);
  for (const SceneObject& object : out.objects) {
    if (object.shape != Shape::kBoard) continue;
    const Vec3 half(0.5 * object.size_m.x(), 0.5 * object.size_m.y(), 0);
    out.stage_T.extend(Vec3(object.X_TO.p - half - Vec3(0, 0, object.size_m.z()))).extend(Vec3(object.X_TO.p + half));
  }
  out.instrument = in_hand(view);
  out.X_TI = stylus.X_TI;
  out.shaft_radius_m = view.scene.loop.tool.radius_m;
  out.shaft_length_m = view.scene.loop.tool.shaft_length_m;
  out.jaw_opening_m = stylus.jaw_opening_m;
  if (view.tissue && view.tissue->suture.held) out.jaw_opening_m = std::min(out.jaw_opening_m, kOnNeedle);
  out.roll_stripe = kind.oriented;
  const bool pulls = view.tissue && view.tissue->held();  // on a fold, which is no dent
  if (stylus.contact && kind.on_organ && !pulls) {
    out.dimple_normal_T = stylus.contact_normal_T;
    out.dimple_depth_m = stylus.depth_m;
    out.dimple_T = stylus.X_TI.p - view.scene.loop.tool.radius_m * stylus.contact_normal_T;
    if (out.organ->rest) out.dimple_depth_m = left_of_dimple(out);
  }
  if (view.tissue) add_marks(*view.tissue, out);
  if (view.tissue) add_clips_and_drops(*view.tissue, out.objects);
  out.camera = attempt_camera(view);
  return out;
}

}  // namespace trocar
