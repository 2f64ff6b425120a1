#include "app/window/run/run_view.h"

#include <algorithm>
#include <cmath>

#include "app/picture/scene/scope_pose.h"
#include "haptics/least_turn.h"

namespace trocar {
namespace {

constexpr double kPortBehind = 0.09;   // m from the lens back to where the scope passes the wall
constexpr double kSteepest = 1.5;      // rad of the shaft up or down: beyond it "level" means nothing
constexpr double kThreadFrom = 0.004;  // m
constexpr double kRing = 0.009, kWire = 0.0007, kThread = 0.0005;
constexpr double kLensClear = 0.003;                    // m before what the lens would touch
constexpr double kShaftSeen = 0.2, kShaftStep = 0.004;  // m of the instrument
constexpr double kArrowEdge = 4;                        // px: dark edge round it

SceneObject ghost(SceneObject::Shape shape, const Vec3& size_m, const Pose& X_TO) {
  SceneObject object;
  object.shape = shape;
  object.style = SceneObject::Style::kGhost;
  object.size_m = size_m;
  object.X_TO = X_TO;
  return object;
}

ScopePose moved_scope(const Camera& camera, const Steering::ScopeMove& move, double tilt_rad) {
  ScopePose pose = scope_behind(camera, tilt_rad, kPortBehind);
  pose.yaw_rad += move.yaw_rad;
  pose.pitch_rad = std::clamp(pose.pitch_rad + move.pitch_rad, -kSteepest, kSteepest);
  pose.depth_m += move.depth_m;
  pose.post_rad = move.post_rad;
  pose.head_rad -= move.post_rad;
  return pose;
}

}  // namespace

Camera moved_camera(const Camera& camera, const Steering::ScopeMove& move, double tilt_rad) {
  return move == Steering::ScopeMove{} && tilt_rad == 0 ? camera : scope_camera(moved_scope(camera, move, tilt_rad));
}

double clear_depth(const Camera& camera, const Steering::ScopeMove& move, double tilt_rad,
                   const std::vector<SurfacePtr>& surfaces_T, const Pose& X_TI) {
  const ScopePose pose = moved_scope(camera, move, tilt_rad);
  const Vec3 along_T = (scope_camera(pose).eye_T - pose.port_T).normalized();
  double deepest = pose.depth_m;
  const auto pass = [&](const Vec3& p_T) {
    const Vec3 from_port = p_T - pose.port_T;
    const double across = from_port.dot(along_T), in = across - kLensClear;
    if (across > 0 && in < deepest && (from_port - across * along_T).squaredNorm() < kScopeClear * kScopeClear)
      deepest = in;
  };
  for (const SurfacePtr& surface : surfaces_T) std::ranges::for_each(surface->vertices, pass);
  for (double back = 0; back < kShaftSeen; back += kShaftStep) pass(X_TI.p - back * X_TI.R.col(2));
  return std::max(move.depth_m - (pose.depth_m - deepest), -ScopeHand::kMostDepth_m);
}

void add_ghost(SceneView& view, const HandIntent& target) {
  const Vec3 way = target.X_TI.p - view.X_TI.p;
  const double distance = way.norm();
  if (!(distance > kGhostFrom)) return;
  view.objects.push_back(ghost(SceneObject::Shape::kRing, {kRing, kRing, kWire}, target.X_TI));
  if (distance < kThreadFrom) return;
  const Mat3 along = least_turn(Vec3::UnitZ(), way).toRotationMatrix();
  view.objects.push_back(
      ghost(SceneObject::Shape::kCylinder, {kThread, kThread, distance}, {along, view.X_TI.p + 0.5 * way}));
}

std::optional<double> rim_angle(const Camera& camera, const PixelRect& picture, const Vec3& tip_T) {
  const ScopeOptics optics(camera, picture);
  if (const auto seen = optics.project(tip_T)) {
    const bool inside = seen->x() >= picture.x && seen->x() <= picture.x + picture.width && seen->y() >= picture.y &&
                        seen->y() <= picture.y + picture.height;  // the frame cuts the circle above and below
    if (inside) return std::nullopt;
  }
  const Vec3 way = tip_T - optics.eye();
  return std::atan2(way.dot(optics.up()), way.dot(optics.right()));
}

double rim_reach(const PixelRect& picture, double angle_rad, double size, const std::vector<HudBox>& clear_of) {
  const double c = std::cos(angle_rad), s = -std::sin(angle_rad), half = 0.6 * size + kArrowEdge;  // y down
  const double x = picture.x + 0.5 * picture.width, y = picture.y + 0.5 * picture.height;
  const double radius = std::min(0.64 * picture.height, 0.49 * picture.width);
  double reach =
      std::min(radius, std::abs(s) > 1e-3 ? (0.5 * picture.height - size) / std::abs(s) : radius) - kArrowEdge;
  const auto covers = [&](const HudBox& box) {
    const double middle = reach - 0.5 * size, along = 0.5 * size + kArrowEdge;  // of the rectangle that holds the arrow
    const double wide = along * std::abs(c) + half * std::abs(s), high = along * std::abs(s) + half * std::abs(c);
    const double mid_x = x + middle * c, mid_y = y + middle * s;
    return mid_x + wide > box.x && mid_x - wide < box.right() && mid_y + high > box.y && mid_y - high < box.bottom();
  };
  while (reach > size && std::any_of(clear_of.begin(), clear_of.end(), covers)) reach -= 1;
  return reach;
}

void hide_guides(SceneView& view) {
  std::erase_if(view.targets, [](const TargetMark& mark) { return mark.state != TargetMark::State::kLit; });
  std::erase_if(view.objects, [](const SceneObject& object) {
    using Shape = SceneObject::Shape;
    const bool plumb = object.style == SceneObject::Style::kGhostLit &&
                       (object.shape == Shape::kCylinder || object.shape == Shape::kRing);
    return plumb || (object.shape == Shape::kPen && object.style != SceneObject::Style::kGhostLit);
  });
}

}  // namespace trocar
