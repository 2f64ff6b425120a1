#include "app/picture/models/solid_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/picture/models/loft.h"
#include "tissue/thin/clip.h"

namespace trocar {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPoint = 1e-6;  // m: radius of a closed end, so that its normal is still known

/// Coordinates along an edge of half length h: the rounding in three steps, the flat part in `cells`.
std::vector<double> edge_places(double h, double round, int cells) {
  std::vector<double> places;
  for (const double share : {0.0, 0.35, 0.7}) places.push_back(-h + share * round);
  for (int i = 0; i <= cells; ++i) places.push_back((h - round) * (2.0 * i / cells - 1));
  for (const double share : {0.7, 0.35, 0.0}) places.push_back(h - share * round);
  return places;
}

/// One face of the rounded box: outward axis `axis`, side +1 or -1.
void add_face(PictureMesh& mesh, const Vec3& half, double round, int cells, int axis, int side) {
  const int u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
  const auto us = edge_places(half[u_axis], round, cells), vs = edge_places(half[v_axis], round, cells);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const double u : us)
    for (const double v : vs) {
      Vec3 p;
      p[axis] = side * half[axis];
      p[u_axis] = u;
      p[v_axis] = v;
      const Vec3 inner = half - Vec3::Constant(round);
      const Vec3 core = p.cwiseMax(-inner).cwiseMin(inner);
      const Vec3 n = (p - core).normalized();
      const Eigen::Vector3f pf = (core + round * n).cast<float>(), nf = n.cast<float>();
      mesh.vertices.push_back({{pf.x(), pf.y(), pf.z()}, {nf.x(), nf.y(), nf.z()}, {1.0F, 0.0F}});
    }
  const auto columns = static_cast<std::uint32_t>(vs.size());
  for (std::uint32_t i = 0; i + 1 < us.size(); ++i)
    for (std::uint32_t j = 0; j + 1 < columns; ++j) {
      const std::uint32_t a = first + i * columns + j, b = a + 1, c = a + columns, d = c + 1;
      if (side > 0)
        mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
      else
        mesh.indices.insert(mesh.indices.end(), {a, b, c, b, d, c});
    }
}

void append(PictureMesh& mesh, PictureMesh part, const Vec3& offset, float accent) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (PictureVertex& vertex : part.vertices) {
    for (int k = 0; k < 3; ++k) vertex.position[k] += static_cast<float>(offset[k]);
    vertex.light[1] = accent;
    mesh.vertices.push_back(vertex);
  }
  for (const std::uint32_t index : part.indices) mesh.indices.push_back(first + index);
}

PictureMesh build_cylinder(double diameter, double length) {
  const double r = 0.5 * diameter, h = 0.5 * length, e = 0.12 * std::min(r, h);
  return turned({{-h, kPoint, 0},
                 {-h, r - e, 0},
                 {-h + 0.3 * e, r - 0.3 * e, 0},
                 {-h + e, r, 0},
                 {h - e, r, 0},
                 {h - 0.3 * e, r - 0.3 * e, 0},
                 {h, r - e, 0},
                 {h, kPoint, 0}},
                28);
}

PictureMesh build_ring(double outer_diameter, double wire) {
  const double r = 0.5 * wire, middle = 0.5 * outer_diameter - r;
  constexpr int kRound = 40, kWire = 12;
  return loft(
      kRound + 1, kWire,
      [&](int i, int j) {
        const double turn = 2 * kPi * (i % kRound) / kRound, section = -2 * kPi * j / kWire;
        const double out = middle + r * std::cos(section);
        return Vec3(out * std::cos(turn), out * std::sin(turn), r * std::sin(section));
      },
      [](int) { return 0.0F; });
}

/// Section by section round the hole: rounded a little where faces meet.
PictureMesh build_triangle(double side, double hole, double height) {
  constexpr int kRound = 96, kSection = 16;
  const double inside = side / (2 * std::sqrt(3.0)), in = 0.5 * hole, h = 0.5 * height, e = 0.3 * (inside - in);
  const auto outer = [&](double turn) {  // to the side that is met there
    double nearest = -1;
    for (int k = 0; k < 3; ++k) nearest = std::max(nearest, std::cos(turn + 0.5 * kPi - 2 * kPi * k / 3));
    return inside / nearest;
  };
  return loft(
      kRound + 1, kSection,
      [&](int i, int j) {
        const double turn = 2 * kPi * (i % kRound) / kRound, out = outer(turn), middle = 0.5 * (in + out);
        const std::array<Eigen::Vector2d, kSection> section = {{{out, 0.9 * h},
                                                                {out, 0},
                                                                {out, -0.9 * h},
                                                                {out, -h + e},
                                                                {out - e, -h},
                                                                {middle, -h},
                                                                {in + 2 * e, -h},
                                                                {in + e, -h},
                                                                {in, -h + e},
                                                                {in, -0.9 * h},
                                                                {in, 0},
                                                                {in, h - e},
                                                                {in + e, h},
                                                                {middle, h},
                                                                {out - e, h},
                                                                {out, h - e}}};
        const Eigen::Vector2d& at = section[static_cast<std::size_t>(j % kSection)];
        return Vec3(at.x() * std::cos(turn), at.x() * std::sin(turn), at.y());
      },
      [](int) { return 0.0F; });
}

PictureMesh build_sphere(double diameter) {
  std::vector<ProfilePoint> profile;
  constexpr int kRings = 16;
  for (int i = 0; i <= kRings; ++i) {
    const double polar = kPi * i / kRings, r = 0.5 * diameter;
    profile.push_back({-r * std::cos(polar), std::max(r * std::sin(polar), kPoint), 0});
  }
  return turned(profile, 24);
}

/// A pen as a surgeon holds one: slim tip, accented, and a fin at the back that shows how it is rolled.
PictureMesh build_pen(double diameter, double length) {
  const double r = 0.5 * diameter, cone = std::min(4 * r, 0.4 * length);
  PictureMesh pen = turned({{-length, kPoint, 0},
                            {-length, 0.80 * r, 0},
                            {-length + 0.3 * r, r, 0},
                            {-cone - 0.02 * r, r, 0},
                            {-cone, r, 1},
                            {-0.30 * r, 0.24 * r, 1},
                            {-0.06 * r, 0.14 * r, 1},
                            {0, kPoint, 1}},
                           24);
  const double fin_length = 0.28 * length;
  append(pen, build_rounded_box({0.5 * r, 1.6 * r, fin_length}, 0.2 * r, 1), {0, 1.4 * r, -length + 0.5 * fin_length},
         1.0F);
  return pen;
}

/// Tube with a slanted inner end, as cannulas have, and a wider head outside the wall.
PictureMesh build_sleeve(double bore, double length) {
  const double inner = 0.5 * bore, outer = inner + 0.0012, head = 2.4 * inner + 0.004;
  const double slant = 0.9 * outer;
  const std::vector<ProfilePoint> profile = {
      {-length - 0.012, inner, 0}, {-length - 0.012, head - 0.001, 0},  {-length - 0.011, head, 0},
      {-length, head, 0},          {-length + 0.002, outer + 0.001, 0}, {-length + 0.004, outer, 0},
      {-0.0004, outer, 0},         {0, 0.5 * (inner + outer), 0},       {-0.0002, inner, 1},
      {-0.0006, inner, 1},         {-length - 0.012, inner, 1}};
  constexpr int kAround = 28;
  return loft(
      static_cast<int>(profile.size()), kAround,
      [&](int i, int j) {
        const ProfilePoint& s = profile[static_cast<std::size_t>(i)];
        const double angle = 2 * kPi * j / kAround;
        const double shift = s.z > -0.002 ? slant * (std::cos(angle) - 1) * s.radius / outer : 0.0;
        return Vec3(s.radius * std::cos(angle), s.radius * std::sin(angle), s.z + shift);
      },
      [&](int i) { return profile[static_cast<std::size_t>(i)].accent; });
}

/// Turned, its floor as thick as its wall; the rim is accented.
PictureMesh build_cup(double bore, double outer_diameter, double depth) {
  const double in = 0.5 * bore, out = 0.5 * outer_diameter, e = 0.25 * (out - in), foot = -depth - (out - in);
  return turned({{foot, kPoint, 0},
                 {foot, out - e, 0},
                 {foot + e, out, 0},
                 {-5 * e, out, 0},
                 {-5 * e, out, 1},
                 {-e, out, 1},
                 {0, out - e, 1},
                 {0, in + e, 1},
                 {-e, in, 1},
                 {-1.5 * e, in, 0},
                 {-depth, in, 0},
                 {-depth, kPoint, 0}},
                40);
}

PictureMesh build_board(const Vec3& size) {
  PictureMesh board;
  append(board, build_rounded_box(size, std::min(0.0012, 0.3 * size.z()), 1), {0, 0, -0.5 * size.z()}, 0.0F);
  return board;
}

/// Bent of flat wire: every face has its own normal.
PictureMesh build_clip(const Vec3& size) {
  const TriangleSurface model = clip_model({.length_m = size.z(), .width_m = size.x()}, size.y(), size.y());
  PictureMesh mesh;
  for (const auto& [a, b, c] : model.triangles) {
    const std::array<Vec3, 3> corner = {model.vertices[static_cast<std::size_t>(a)],
                                        model.vertices[static_cast<std::size_t>(b)],
                                        model.vertices[static_cast<std::size_t>(c)]};
    const Eigen::Vector3f n = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized().cast<float>();
    for (const Vec3& p : corner) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back({{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())},
                               {n.x(), n.y(), n.z()},
                               {1.0F, 0.0F}});
    }
  }
  return mesh;
}

}  // namespace

PictureMesh build_rounded_box(const Vec3& size_m, double round_m, int cells) {
  PictureMesh mesh;
  const double round = std::clamp(round_m, 1e-6, 0.49 * size_m.minCoeff());
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {1, -1}) add_face(mesh, 0.5 * size_m, round, cells, axis, side);
  return mesh;
}

PictureMesh build_solid(SceneObject::Shape shape, const Vec3& size_m) {
  switch (shape) {
    case SceneObject::Shape::kBox:
      return build_rounded_box(size_m, 0.09 * size_m.minCoeff(), 7);
    case SceneObject::Shape::kCylinder:
      return build_cylinder(size_m.x(), size_m.z());
    case SceneObject::Shape::kRing:
      return build_ring(size_m.x(), size_m.z());
    case SceneObject::Shape::kTriangle:
      return build_triangle(size_m.x(), size_m.y(), size_m.z());
    case SceneObject::Shape::kPen:
      return build_pen(size_m.x(), size_m.z());
    case SceneObject::Shape::kSphere:
      return build_sphere(size_m.x());
    case SceneObject::Shape::kCup:
      return build_cup(size_m.x(), size_m.y(), size_m.z());
    case SceneObject::Shape::kBoard:
      return build_board(size_m);
    case SceneObject::Shape::kSleeve:
      return build_sleeve(size_m.x(), size_m.z());
    case SceneObject::Shape::kClip:
      return build_clip(size_m);
  }
  return {};
}

}  // namespace trocar
