#include "app/picture/models/curved_subdivision.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

namespace trocar {
namespace {

constexpr double kCurvature = 0.55;  // share of the way onto the tangent planes (Boubekeur and Alexa use 3/4 at most)

Vec3 onto_plane(const Vec3& point, const Vec3& origin, const Vec3& normal) {
  return point - normal * normal.dot(point - origin);
}

void check_count(std::size_t got, std::size_t wanted) {
  if (got != wanted)
    throw std::invalid_argument("a surface of " + std::to_string(wanted) + " vertices moves with as many, not " +
                                std::to_string(got));
}

}  // namespace

CurvedSubdivision::CurvedSubdivision(const TriangleSurface& surface, std::size_t max_triangles,
                                     std::vector<bool> straight) {
  if (!straight.empty()) check_count(straight.size(), surface.vertices.size());
  stages_.push_back({surface, {}, std::move(straight)});
  if (surface.volume_m3() < 0)  // inside out: culling would show the far wall
    for (auto& triangle : stages_[0].surface.triangles) std::swap(triangle[1], triangle[2]);
  while (!fine().triangles.empty() && fine().triangles.size() * 4 <= max_triangles) {
    stages_.push_back(split(stages_.back()));
    place_midpoints(stages_.size() - 1);
  }
}

CurvedSubdivision::Stage CurvedSubdivision::split(const Stage& stage) {
  const TriangleSurface& surface = stage.surface;
  Stage out;
  out.surface.vertices = surface.vertices;
  out.surface.triangles.reserve(surface.triangles.size() * 4);
  std::unordered_map<std::uint64_t, std::int32_t> midpoints;
  midpoints.reserve(surface.triangles.size() * 3 / 2);
  const auto midpoint = [&](std::int32_t a, std::int32_t b) {
    const auto [low, high] = std::minmax(a, b);
    const std::uint64_t key = (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint64_t>(high);
    const auto [place, inserted] = midpoints.try_emplace(
        key, static_cast<std::int32_t>(surface.vertices.size()) + static_cast<std::int32_t>(out.edges.size()));
    if (inserted) out.edges.push_back({low, high});
    return place->second;
  };
  for (const auto& [a, b, c] : surface.triangles) {
    const std::int32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    out.surface.triangles.push_back({a, ab, ca});
    out.surface.triangles.push_back({ab, b, bc});
    out.surface.triangles.push_back({ca, bc, c});
    out.surface.triangles.push_back({ab, bc, ca});
  }
  out.surface.vertices.resize(surface.vertices.size() + out.edges.size());
  out.straight = stage.straight;
  for (const auto& [a, b] : out.edges) {
    if (stage.straight.empty()) break;
    out.straight.push_back(stage.straight[static_cast<std::size_t>(a)] && stage.straight[static_cast<std::size_t>(b)]);
  }
  return out;
}

void CurvedSubdivision::place_midpoints(std::size_t stage) {
  const TriangleSurface& coarse = stages_[stage - 1].surface;
  const std::vector<bool>& straight = stages_[stage].straight;
  const std::vector<Vec3> normals = coarse.vertex_normals();
  std::size_t at = coarse.vertices.size();
  for (const auto& [a, b] : stages_[stage].edges) {
    const auto first = static_cast<std::size_t>(a), second = static_cast<std::size_t>(b);
    const Vec3 flat = 0.5 * (coarse.vertices[first] + coarse.vertices[second]);
    if (!straight.empty() && straight[at]) {
      stages_[stage].surface.vertices[at++] = flat;
      continue;
    }
    const Vec3 curved = 0.5 * (onto_plane(flat, coarse.vertices[first], normals[first]) +
                               onto_plane(flat, coarse.vertices[second], normals[second]));
    stages_[stage].surface.vertices[at++] = flat + kCurvature * (curved - flat);
  }
}

const TriangleSurface& CurvedSubdivision::move(const std::vector<Vec3>& vertices) {
  check_count(vertices.size(), stages_[0].surface.vertices.size());
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    const std::vector<Vec3>& from = i == 0 ? vertices : stages_[i - 1].surface.vertices;
    std::copy(from.begin(), from.end(), stages_[i].surface.vertices.begin());
    if (i > 0) place_midpoints(i);
  }
  return fine();
}

std::vector<float> CurvedSubdivision::spread(const std::vector<float>& values) const {
  check_count(values.size(), stages_[0].surface.vertices.size());
  std::vector<float> out = values;
  out.reserve(fine().vertices.size());
  for (const Stage& stage : stages_)
    for (const auto& [a, b] : stage.edges)
      out.push_back(0.5F * (out[static_cast<std::size_t>(a)] + out[static_cast<std::size_t>(b)]));
  return out;
}

}  // namespace trocar
