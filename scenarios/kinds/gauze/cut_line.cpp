#include "scenarios/kinds/gauze/cut_line.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kFrays = 0.0006;    // m beyond a cut's ends, over which the threads part (a choice)
constexpr double kMet = 0.003;       // m between two cuts' ends that have met: more than half an edge of the mesh
constexpr double kNear = 0.4;        // of R: a cut further from the line than that does not come past it
constexpr double kBarApart = 0.001;  // m
constexpr int kLastBars = 1;        // the last of them, where a cut along the closed line meets the way in all the same
constexpr double kBarHalf = 0.010;  // m: a way in further aside is none
constexpr double kCorridor = 0.006;  // m beside the way in, in which a cut along it is part of it
constexpr double kAlongWay = 0.6;    // cosine between such a cut and the way
constexpr int kPieces = 10;          // of a cut, that are told apart
constexpr double kTurn = 2 * std::numbers::pi;

Eigen::Vector2d direction(double turn_rad) { return {std::cos(turn_rad), std::sin(turn_rad)}; }

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

CutLine::CutLine(const GauzeLine& line, double off_m) : line_(line), off_m_(off_m) {
  bars_ = std::min(kMostBars, static_cast<int>(line.way_in_m / kBarApart));
  area_m2_ = std::numbers::pi * line.long_m * line.across_m;
  for (int ray = 0; ray < kRays; ++ray) {
    arc_[static_cast<std::size_t>(ray)] = round_m_;
    const double turn = kTurn / kRays;
    round_m_ += (on_line((ray + 1) * turn) - on_line(ray * turn)).norm();
  }
}

/// Of the line, so far on from where the way in meets it.
double CutLine::radius(double turn_rad) const {
  const double from_long = line_.from_rad + line_.sense * turn_rad - line_.turned_rad;
  return line_.long_m * line_.across_m /
         std::hypot(line_.across_m * std::cos(from_long), line_.long_m * std::sin(from_long));
}

Eigen::Vector2d CutLine::on_line(double turn_rad) const {
  return radius(turn_rad) * direction(line_.from_rad + line_.sense * turn_rad);
}

/// From the closed line, square to it.
double CutLine::off(const Eigen::Vector2d& place) const {
  const double turn = line_.sense * (std::atan2(place.y(), place.x()) - line_.from_rad);
  constexpr double kBeside = 1e-3;  // rad
  const Eigen::Vector2d along = (on_line(turn + kBeside) - on_line(turn - kBeside)).normalized();
  return std::abs(cross(along, place - on_line(turn)));
}

bool CutLine::on_way_in(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const Eigen::Vector2d out = direction(line_.from_rad), middle = (from + to) / 2;
  return middle.dot(out) > radius(0) && std::abs(cross(out, middle)) < kCorridor &&
         std::abs((to - from).normalized().dot(out)) > kAlongWay;
}

void CutLine::cross_rays(const Eigen::Vector2d& a, const Eigen::Vector2d& b, Added& added, bool only_uncut) {
  for (int ray = 0; ray < kRays; ++ray) {
    const double turn = (ray + 0.5) * kTurn / kRays, R = radius(turn);
    const Eigen::Vector2d along = direction(line_.from_rad + line_.sense * turn);
    const double before = cross(along, a), behind = cross(along, b);
    if ((before < 0) == (behind < 0)) continue;
    const double r = along.dot(a + before / (before - behind) * (b - a));
    if (std::abs(r - R) > kNear * R) continue;
    const auto n = static_cast<std::size_t>(ray);
    if (only_uncut && crossed_[n]) continue;
    crossed_[n] = true;
    const double r2_off = std::abs(r * r - R * R);
    if (r2_off <= r2_off_[n]) continue;
    added.area_share += (r2_off - r2_off_[n]) / 2 * (kTurn / kRays) / area_m2_;
    r2_off_[n] = r2_off;
  }
}

void CutLine::meet(const Eigen::Vector2d& end, Added& added) {
  for (int n = 0; n < end_count_; ++n) {
    const Eigen::Vector2d& other = ends_[static_cast<std::size_t>(n)];
    if ((other - end).norm() < kMet) cross_rays(other, end, added, true);
  }
}

CutLine::Added CutLine::add(const Eigen::Vector2d& from, const Eigen::Vector2d& to, bool from_rim, bool to_rim) {
  Added added;
  const double length = (to - from).norm();
  if (!(length > 0)) return added;
  const Eigen::Vector2d way = (to - from) / length, a = from - kFrays * way, b = to + kFrays * way;
  const Eigen::Vector2d out = direction(line_.from_rad);
  // Where gauze ends at an end of the cut, the mesh has parted along the way in up to older cuts.
  const Eigen::Vector2d first = from_rim ? Eigen::Vector2d(from - kMet * way) : a,
                        last = to_rim ? Eigen::Vector2d(to + kMet * way) : b;
  for (int bar = 0; bar < bars_; ++bar) {  // from the edge on
    const double depth = radius(0) + line_.way_in_m * (1 - (bar + 0.5) / bars_);
    const double before = first.dot(out) - depth, behind = last.dot(out) - depth;
    if ((before < 0) == (behind < 0)) continue;
    const Eigen::Vector2d there = first + before / (before - behind) * (last - first);
    if (std::abs(cross(out, there)) < kBarHalf) passed_[static_cast<std::size_t>(bar)] = true;
  }
  if (on_way_in(from, to)) return added;
  cross_rays(a, b, added);
  if (from_rim) meet(from, added);
  if (to_rim) meet(to, added);
  for (const Eigen::Vector2d& end : {from, to})
    if (end_count_ < kMostEnds) ends_[static_cast<std::size_t>(end_count_++)] = end;
  for (int piece = 0; piece < kPieces; ++piece) {
    const double beside = off(from + (piece + 0.5) / kPieces * (to - from));
    added.off_m = std::max(added.off_m, beside);
    if (beside > off_m_) added.outside_share += length / kPieces / round_m_;
  }
  return added;
}

LinePlace CutLine::at(double arc_m) const {
  const Eigen::Vector2d out = direction(line_.from_rad);
  if (arc_m < line_.way_in_m) return {(radius(0) + line_.way_in_m - arc_m) * out, -out};
  const double round = std::min(arc_m - line_.way_in_m, round_m_);
  const auto next = std::upper_bound(arc_.begin(), arc_.end(), round);
  const auto ray = static_cast<int>(next - arc_.begin()) - 1;
  const double end = next == arc_.end() ? round_m_ : *next, begin = arc_[static_cast<std::size_t>(ray)];
  const double turn = (ray + (round - begin) / (end - begin)) * kTurn / kRays;
  constexpr double kBeside = 1e-3;  // rad
  return {on_line(turn), (on_line(turn + kBeside) - on_line(turn - kBeside)).normalized()};
}

bool CutLine::cut_at(double arc_m) const {
  if (arc_m < line_.way_in_m) {
    const int bar = std::clamp(static_cast<int>(arc_m / line_.way_in_m * bars_), 0, bars_ - 1);
    return passed_[static_cast<std::size_t>(bar)];
  }
  const auto next = std::upper_bound(arc_.begin(), arc_.end(), arc_m - line_.way_in_m);
  return crossed_[static_cast<std::size_t>(next - arc_.begin() - 1)];
}

double CutLine::uncut_from_m() const {
  for (int bar = 0; bar < bars_ - kLastBars; ++bar)
    if (!passed_[static_cast<std::size_t>(bar)]) return line_.way_in_m * bar / bars_;
  for (int ray = 0; ray < kRays; ++ray)
    if (!crossed_[static_cast<std::size_t>(ray)]) return line_.way_in_m + arc_[static_cast<std::size_t>(ray)];
  return line_.way_in_m + round_m_;
}

}  // namespace trocar
