#include "app/picture/models/show_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "app/picture/models/show_anatomy.h"
#include "app/picture/models/solid_noise.h"
#include "app/picture/scene/scope_pose.h"

namespace trocar {
namespace {

using Kind = TissueMarkKind;

Pose instrument_at(const Vec3& tip, const Vec3& shaft_from, double roll = 0) {
  Pose X;
  const Vec3 z = -shaft_from.normalized();
  X.R.col(0) = z.cross(Vec3::UnitZ()).normalized();
  X.R.col(1) = z.cross(X.R.col(0));
  X.R.col(2) = z;
  X.R = X.R * Eigen::AngleAxisd(roll, Vec3::UnitZ()).toRotationMatrix();
  X.p = tip;
  return X;
}

/// The organs of the scene as one distance, and where the scope's rays meet it.
struct Sight {
  explicit Sight(std::uint64_t seed, const Camera& camera) : organs(show_anatomy(seed)), eye(camera.eye_T) {
    forward = (camera.look_at_T - eye).normalized();
    right = forward.cross(camera.up_T).normalized();
    up = right.cross(forward);
  }
  double operator()(const Vec3& p) const {
    double d = 1;
    for (const ShowOrgan& organ : organs)
      if (organ.box.exteriorDistance(p) < d)
        d = std::min(d, organ.box.contains(p) ? organ.distance(p) : organ.box.exteriorDistance(p) + 0.002);
    return d;
  }
  /// @param x,y tangents of the angles right and up of the line of sight.
  Vec3 hit(double x, double y) const {
    return first_hit(std::cref(*this), eye, (forward + x * right + y * up).normalized(), 0.4);
  }
  Vec3 normal(const Vec3& at) const { return slope_of(std::cref(*this), at); }

  std::vector<ShowOrgan> organs;
  Vec3 eye, forward, right, up;
};

Camera abdomen_camera() {
  Camera camera;
  camera.eye_T = Vec3(-0.004, -0.088, 0.022);
  camera.look_at_T = Vec3(-0.003, 0.006, -0.008);
  camera.diagonal_fov_deg = 72;
  return camera;
}

SceneView abdomen(std::uint64_t seed) {
  SceneView view;
  for (const ShowOrgan& organ : show_anatomy(seed)) {
    SurfacePtr surface = still_surface(implicit_surface(organ.distance, organ.box, organ.cell_m));
    if (view.organ)
      view.adjacent.push_back({std::move(surface), organ.material});
    else
      view.organ = std::move(surface), view.material = organ.material;
  }
  view.camera = abdomen_camera();
  view.X_TI = instrument_at({0.029, -0.014, -0.017}, Vec3(0.80, -0.40, 0.10), 0.7);
  view.jaw_opening_m = 0.010;
  InstrumentView left;
  left.X_TI = instrument_at({-0.018, 0.010, -0.021}, Vec3(-0.80, -0.50, -0.12), -0.3);
  left.jaw_opening_m = 0.007;
  view.more_instruments.push_back(left);
  return view;
}

/// Blots along a line of sight angles, unevenly sized.
void blot(SceneView& view, const Sight& sight, Kind kind, std::initializer_list<std::array<double, 4>> places) {
  for (const auto& [x, y, radius_m, strength] : places)
    view.marks.push_back({kind, sight.hit(x, y), radius_m, strength});
}

void add_blood(SceneView& view, const Sight& sight) {
  blot(view, sight, Kind::kBlood,
       {{0.04, -0.20, 0.0075, 1},
        {0.09, -0.29, 0.0080, 1},
        {0.05, -0.36, 0.0090, 1},
        {0.13, -0.38, 0.0060, 0.9},
        {-0.03, -0.31, 0.0045, 0.8},
        {0.20, -0.43, 0.0040, 0.7},
        {-0.10, -0.40, 0.0030, 0.8},
        {0.10, -0.13, 0.0030, 0.8}});
}

void add_char(SceneView& view, const Sight& sight) {
  blot(view, sight, Kind::kChar,
       {{-0.05, 0.02, 0.0040, 1},
        {-0.02, 0.07, 0.0042, 1},
        {0.01, 0.12, 0.0038, 0.9},
        {0.05, 0.16, 0.0034, 0.9},
        {0.18, -0.05, 0.0030, 0.8},
        {-0.20, 0.17, 0.0050, 0.9}});
  blot(view, sight, Kind::kWhitening,
       {{-0.05, 0.02, 0.0085, 0.7}, {0.01, 0.12, 0.0085, 0.7}, {0.18, -0.05, 0.0070, 0.7}, {-0.20, 0.17, 0.0105, 0.7}});
}

/// The right instrument presses on the gallbladder's body.
void press(SceneView& view, const Sight& sight) {
  const Vec3 at = sight.hit(0.22, 0.06), normal = sight.normal(at);
  view.dimple_normal_T = normal;
  view.dimple_depth_m = 0.0030;
  view.dimple_T = at - view.dimple_depth_m * normal;
  view.X_TI = instrument_at(at - view.dimple_depth_m * normal, Vec3(0.75, -0.62, 0.02), 0.3);
  view.jaw_opening_m = 0;
  blot(view, sight, Kind::kWhitening, {{0.02, -0.08, 0.0075, 1}, {-0.27, 0.22, 0.0110, 0.9}});
}

SceneObject box(const Vec3& centre, const Vec3& size, const Vec3& colour) {
  SceneObject object;
  object.size_m = size;
  object.X_TO.p = centre;
  object.colour = colour;
  return object;
}

SceneView board() {
  SceneView view;
  SceneObject plate = box(Vec3::Zero(), {0.100, 0.100, 0.004}, {0.15, 0.16, 0.17});
  plate.shape = SceneObject::Shape::kBoard;
  plate.look = SceneObject::Look::kBoard;
  plate.accent = {0.44, 0.44, 0.42};
  view.objects.push_back(plate);
  for (int i = 0; i < 6; ++i) {
    const FoamClass& foam = foam_classes()[static_cast<std::size_t>(i % 3)];
    SceneObject block = box({-0.040 + 0.016 * i, 0.026, 0.010}, {0.014, 0.014, 0.020}, foam.colour);
    block.look = SceneObject::Look::kFoam;
    block.accent = foam.band;
    block.bands = foam.bands;
    view.objects.push_back(block);
    SceneObject ring =
        box({-0.040 + 0.016 * i, i % 2 ? -0.016 : -0.032, 0.0005}, {0.016, 0, 0.001}, {0.46, 0.46, 0.45});
    ring.shape = SceneObject::Shape::kRing;
    if (i == 3) ring.style = SceneObject::Style::kLit;
    view.objects.push_back(ring);
  }
  view.stage_T = Eigen::AlignedBox3d(Vec3(-0.05, -0.05, -0.004), Vec3(0.05, 0.05, 0.0));
  view.X_TI = instrument_at({0.012, -0.010, 0.022}, Vec3(0.62, -0.40, 0.70), 0.2);
  view.jaw_opening_m = 0.012;
  view.camera.eye_T = Vec3(-0.012, -0.112, 0.098);
  view.camera.look_at_T = Vec3(0.0, -0.002, 0.004);
  view.camera.diagonal_fov_deg = 72;
  return view;
}

/// The same place through a 30 degree scope, post and head turned: the notch wanders, the tick tells where up is.
Camera thirty_degrees(const Camera& straight) {
  ScopePose pose = scope_behind(straight, std::numbers::pi / 6);
  pose.post_rad = 0.45;
  pose.head_rad = level_head_rad(pose) + 0.20;
  return scope_camera(pose);
}

}  // namespace

const std::vector<std::string>& show_scene_names() {
  static const std::vector<std::string> kNames = {"abdomen", "blood", "char",          "whitening", "wet",
                                                  "smoke",   "fog",   "thirty-degree", "board"};
  return kNames;
}

SceneView with_fields(const SceneView& abdomen, const std::string& name, std::uint64_t seed) {
  SceneView view = abdomen;
  const Sight sight(seed, view.camera);
  if (name == "blood") add_blood(view, sight);
  if (name == "char") add_char(view, sight);
  if (name == "whitening") press(view, sight);
  if (name == "wet")
    blot(view, sight, Kind::kWet,
         {{0.12, 0.36, 0.022, 1}, {-0.25, 0.30, 0.016, 1}, {0.02, -0.35, 0.014, 1}, {0.22, -0.40, 0.012, 1}});
  if (name == "smoke") {
    add_char(view, sight);
    view.smoke_per_m = 9;
  }
  if (name == "fog") view.lens = {.fog = 0.75, .blood = 0.35, .wipe = 0.42};
  if (name == "thirty-degree") view.camera = thirty_degrees(view.camera);
  return view;
}

SceneView show_scene(const std::string& name, std::uint64_t seed) {
  const auto& names = show_scene_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw std::invalid_argument("no scene is called " + name);
  return name == "board" ? board() : with_fields(abdomen(seed), name, seed);
}

}  // namespace trocar
