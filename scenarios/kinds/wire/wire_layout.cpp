#include "scenarios/kinds/wire/wire_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "haptics/input_error.h"
#include "haptics/least_turn.h"
#include "scenarios/kinds/wire/wire_rules.h"
#include "scenarios/layout/board_random.h"

namespace trocar {
namespace {

using Line = std::vector<Eigen::Vector2d>;  // across, up

constexpr int kWireDraws = 4000;
constexpr int kBends = 3;
constexpr double kLeastLeg = 0.005;    // m
constexpr double kPointStep = 0.001;   // m of wire from point to point
constexpr int kStepsPerPoint = 8;      // of the heading's integral
constexpr double kBeforeWire = 0.012;  // m from the wire's end to where the ring rests at the start

/// Headings, legs and bends of one draw.
struct WireDraw {
  std::array<double, kBends + 1> heading, leg;
  std::array<double, kBends> bend, arc;
  double legs_m = 0;  ///< all of them together
};

WireDraw draw_wire(const WireRules& rules, BoardRandom& random) {
  const auto between = [&](double low, double high) { return low + random.uniform() * (high - low); };
  WireDraw draw;
  double side = random.uniform() < 0.5 ? 1 : -1;
  for (double& heading : draw.heading) {
    heading = side * between(rules.least_heading_rad, rules.most_heading_rad);
    side = -side;
  }
  draw.legs_m = rules.length_m;
  for (std::size_t i = 0; i < kBends; ++i) {
    draw.bend[i] = between(rules.least_bend_m, rules.widest_bend_m);
    draw.arc[i] = draw.bend[i] * std::abs(draw.heading[i + 1] - draw.heading[i]);
    draw.legs_m -= draw.arc[i];
  }
  for (double& leg : draw.leg) leg = between(1, 2);
  const double sum = std::accumulate(draw.leg.begin(), draw.leg.end(), 0.0);
  for (double& leg : draw.leg) leg *= draw.legs_m / sum;
  return draw;
}

double heading_at(const WireDraw& draw, double along_m) {
  for (std::size_t i = 0; i < kBends; ++i) {
    if (along_m < draw.leg[i]) return draw.heading[i];
    along_m -= draw.leg[i];
    if (along_m < draw.arc[i]) return draw.heading[i] + (draw.heading[i + 1] - draw.heading[i]) * along_m / draw.arc[i];
    along_m -= draw.arc[i];
  }
  return draw.heading[kBends];
}

/// Its middle at the origin.
Line trace_wire(const WireDraw& draw, double length_m) {
  const int points = static_cast<int>(std::lround(length_m / kPointStep));
  const double step = length_m / points / kStepsPerPoint;
  Line line{Eigen::Vector2d::Zero()};
  Eigen::Vector2d at = Eigen::Vector2d::Zero(), low = at, high = at;
  for (int i = 0; i < points * kStepsPerPoint; ++i) {
    const double heading = heading_at(draw, (i + 0.5) * step);
    at += step * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    if (i % kStepsPerPoint == kStepsPerPoint - 1) line.push_back(at);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  for (Eigen::Vector2d& point : line) point -= (low + high) / 2;
  return line;
}

bool fits(const Line& line, const TargetLayout& layout) {
  return std::all_of(line.begin(), line.end(), [&](const Eigen::Vector2d& point) {
    return std::abs(point.x()) <= layout.region_x_m / 2 && std::abs(point.y()) <= layout.relief_m;
  });
}

/// Onto the plane that faces the trainee, or onto the sphere round the port: a point's distance and direction from the
/// middle are kept.
Vec3 place_on(const ExerciseLevel& level, const Eigen::Vector2d& point) {
  if (level.mapping != Mapping::kFulcrum) return {point.x(), 0, point.y()};
  const double radius = level.port_m.norm(), way = point.norm();
  const Vec3 u = -level.port_m / radius;
  const Vec3 across = (Vec3::UnitX() - u.x() * u).normalized(), up = u.cross(across);
  if (way <= 0) return Vec3::Zero();
  const Vec3 towards = (point.x() * across + point.y() * (up.z() < 0 ? Vec3(-up) : up)) / way;
  return level.port_m + radius * (std::cos(way / radius) * u + std::sin(way / radius) * towards);
}

/// The least turn from rest that brings shaft and ring to where the wire is: through a port onto the line to it first.
Mat3 gate_turn(const ExerciseLevel& level, const Mat3& R_TI_rest, const Vec3& normal_I, const Vec3& centre_T,
               const Vec3& tangent_T) {
  const auto least = [](const Vec3& from, const Vec3& to) { return least_turn(from, to).toRotationMatrix(); };
  if (level.mapping != Mapping::kFulcrum) return least(R_TI_rest * normal_I, tangent_T) * R_TI_rest;
  const Vec3 u = (centre_T - level.port_m).normalized();
  const Mat3 R = least(R_TI_rest.col(2), u) * R_TI_rest;
  const Vec3 across = (tangent_T - tangent_T.dot(u) * u).normalized(), n = R * normal_I;
  return Eigen::AngleAxisd(std::atan2(n.cross(across).dot(u), n.dot(across)), u).toRotationMatrix() * R;
}

}  // namespace

RingOnWire ring_of(const Exercise& exercise, const ExerciseLevel& level) {
  const WireRules& rules = own_rules<WireRules>(exercise);
  RingOnWire ring;
  ring.centre_I = Vec3(0, 0, own_rules<WireLevel>(level).ring_radius_m + rules.ring_thickness_m / 2);
  ring.normal_I = Vec3(std::cos(rules.ring_turn_rad), std::sin(rules.ring_turn_rad), 0);
  ring.play_m = own_rules<WireLevel>(level).ring_radius_m - rules.radius_m;
  ring.stiffness_n_per_m = rules.stiffness_n_per_m;
  ring.damping_s_per_m = rules.damping_s_per_m;
  return ring;
}

std::vector<double> arc_lengths(const std::vector<Vec3>& line) {
  std::vector<double> along(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i) along[i] = along[i - 1] + (line[i] - line[i - 1]).norm();
  return along;
}

std::vector<double> gate_places(int count, double length_m) {
  std::vector<double> places;
  for (int i = 1; i <= count; ++i) places.push_back(i * length_m / (count + 1));
  return places;
}

Board lay_out_wire(const Exercise& exercise, const ExerciseLevel& level, const Mat3& R_TI_rest, int board) {
  const WireRules& rules = own_rules<WireRules>(exercise);
  BoardRandom random(board);
  Line line;
  for (int draw = 0; draw < kWireDraws && line.empty(); ++draw) {
    const WireDraw wire = draw_wire(rules, random);
    if (*std::min_element(wire.leg.begin(), wire.leg.end()) < kLeastLeg) continue;
    Line tried = trace_wire(wire, rules.length_m);
    if (fits(tried, exercise.layout)) line = std::move(tried);
  }
  if (line.empty())
    throw InputError("board " + std::to_string(board) + " of exercise '" + exercise.id +
                     "': the region has no room for the wire");
  Board result;
  for (const Eigen::Vector2d& point : line) result.wire_T.push_back(place_on(level, point));
  const RingOnWire ring = ring_of(exercise, level);
  const std::vector<double> along = arc_lengths(result.wire_T);
  for (const double gate : gate_places(exercise.layout.count, along.back())) {
    const auto i = static_cast<std::size_t>(std::lower_bound(along.begin(), along.end(), gate) - along.begin());
    const Vec3 &before = result.wire_T[i - 1], &after = result.wire_T[i];
    const Vec3 centre = before + (gate - along[i - 1]) / (along[i] - along[i - 1]) * (after - before);
    const Mat3 R = gate_turn(level, R_TI_rest, ring.normal_I, centre, (after - before).normalized());
    result.targets.push_back({centre - R * ring.centre_I, -R.col(2), ring.play_m, {}, R});
  }
  const Vec3 way = (result.wire_T[1] - result.wire_T[0]).normalized();
  result.start_T = result.wire_T[0] - kBeforeWire * way - R_TI_rest * ring.centre_I + exercise.start_above_m;
  return result;
}

}  // namespace trocar
