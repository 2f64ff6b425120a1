#include "tissue/thin/clip.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tissue/thin/rod_in_jaws.h"

namespace trocar {
namespace {

constexpr double kLeastHold = 0.1;  // of what a clip bears that has hardly any rod beyond it

/// How much rod there is from an arc to the nearest end of its piece that hangs on nothing.
double stump_beyond(const ElasticRod& rod, double arc_m) {
  double least = rod.length_m();
  const std::size_t at = rod.segment_at(arc_m);
  for (const RodPart& part : rod.parts()) {
    if (at < part.first || at >= part.last) continue;
    if (!part.anchored_first) least = std::min(least, arc_m - rod.nodes()[part.first].arc_m);
    if (!part.anchored_last) least = std::min(least, rod.nodes()[part.last].arc_m - arc_m);
  }
  return std::max(0.0, least);
}

}  // namespace

Clip* ClipSet::find(std::int32_t number) {
  const auto index = static_cast<std::size_t>(number) - 1;
  return number >= 1 && index < clips_.size() && clips_[index].on ? &clips_[index] : nullptr;
}

std::int32_t ClipSet::place(ElasticRod& rod, Lumen& lumen, double arc_m, double width_share, const Pose& X_TI) {
  const Mat3 rod_frame = rod.frame_at(arc_m);
  Clip clip;
  clip.number = static_cast<std::int32_t>(clips_.size()) + 1;
  clip.arc_m = arc_m;
  clip.width_share = std::clamp(width_share, 0.0, 1.0);
  clip.offset_rod = rod_frame.transpose() * (X_TI.p - rod.place_at(arc_m));
  clip.rotation_rod = rod_frame.transpose() * X_TI.R;
  clip.X_TC = X_TI;
  const double half = options_.width_m / 2;
  Held held;
  held.splint = rod.splint(arc_m - half, arc_m + half, options_.mass_kg);
  held.closure = lumen.clip(arc_m - half, arc_m + half, clip.width_share, options_.holds_pa,
                            angle_in_rod(rod, arc_m, X_TI.R.col(1)));
  clips_.push_back(clip);
  held_.push_back(held);
  return clip.number;
}

void ClipSet::pull(std::int32_t number, const Vec3& force_T) {
  if (find(number) && force_T.allFinite()) held_[static_cast<std::size_t>(number) - 1].pull_T += force_T;
}

void ClipSet::pull_held(std::span<const double> arcs, const Vec3& force_T) {
  for (const double arc : arcs) pull(number_at(arc), force_T / static_cast<double>(arcs.size()));
}

void ClipSet::pull_touched(std::span<const RodSpring> springs) {
  for (const RodSpring& spring : springs) pull(number_at(spring.arc_m), -spring.force_n * spring.direction);
}

std::int32_t ClipSet::number_at(double arc_m) const {
  double nearest = options_.width_m / 2;
  std::int32_t found = 0;
  for (const Clip& clip : clips_) {
    const double off = std::abs(clip.arc_m - arc_m);
    if (!clip.on || off > nearest) continue;
    nearest = off;
    found = clip.number;
  }
  return found;
}

double ClipSet::bears_n(const Clip& clip, const ElasticRod& rod) const {
  const double stump = (stump_beyond(rod, clip.arc_m) - options_.width_m / 2) / options_.stump_m;
  return options_.pull_off_n * std::pow(clip.width_share, options_.part_power) * std::clamp(stump, kLeastHold, 1.0);
}

void ClipSet::remove(std::int32_t number, ElasticRod& rod, Lumen& lumen) {
  Clip* clip = find(number);
  if (!clip) return;
  clip->on = false;
  const Held& held = held_[static_cast<std::size_t>(number) - 1];
  rod.take_splint(held.splint);
  lumen.open(held.closure);
}

std::vector<std::int32_t> ClipSet::step(ElasticRod& rod, Lumen& lumen) {
  std::vector<std::int32_t> off;
  for (std::size_t i = 0; i < clips_.size(); ++i) {
    Clip& clip = clips_[i];
    if (!clip.on) continue;
    Held& held = held_[i];
    const Mat3 frame = rod.frame_at(clip.arc_m);
    clip.X_TC = {frame * clip.rotation_rod, rod.place_at(clip.arc_m) + frame * clip.offset_rod};
    const double along = std::abs(held.pull_T.dot(frame.col(2)));
    held.over_s = along > bears_n(clip, rod) ? held.over_s + rod.options().step_s : 0;
    held.pull_T = Vec3::Zero();
    if (held.over_s < options_.overload_s) continue;
    off.push_back(clip.number);
    remove(clip.number, rod, lumen);
  }
  return off;
}

std::vector<double> ClipSet::arcs() const {
  std::vector<double> arcs;
  for (const Clip& clip : clips_)
    if (clip.on) arcs.push_back(clip.arc_m);
  std::sort(arcs.begin(), arcs.end());
  return arcs;
}

TriangleSurface clip_model(const ClipOptions& options, double gap_m, double crotch_m) {
  // Outline in (z, y), counter-clockwise seen from +x with y to the left of z: outside first, then the slot.
  const double base = -options.length_m, inside = base + options.leg_m, leg = options.leg_m;
  const double tip = gap_m / 2, crotch = crotch_m / 2;
  const std::array<std::array<double, 2>, 8> outline{{{base, -crotch - leg},
                                                      {0, -tip - leg},
                                                      {0, -tip},
                                                      {inside, -crotch},
                                                      {inside, crotch},
                                                      {0, tip},
                                                      {0, tip + leg},
                                                      {base, crotch + leg}}};
  TriangleSurface model;
  for (const double side : {-0.5, 0.5})
    for (const auto& [z, y] : outline) model.vertices.emplace_back(side * options.width_m, y, z);
  constexpr std::array<std::array<std::int32_t, 4>, 3> kQuads{{{0, 1, 2, 3}, {0, 3, 4, 7}, {7, 4, 5, 6}}};
  for (const auto& [a, b, c, d] : kQuads) {  // from z to y is about -x
    model.triangles.push_back({a, b, c});
    model.triangles.push_back({a, c, d});
    model.triangles.push_back({8 + a, 8 + c, 8 + b});
    model.triangles.push_back({8 + a, 8 + d, 8 + c});
  }
  for (std::int32_t i = 0; i < 8; ++i) {
    const std::int32_t next = (i + 1) % 8;
    model.triangles.push_back({i, 8 + next, next});
    model.triangles.push_back({i, 8 + i, 8 + next});
  }
  return model;
}

}  // namespace trocar
