#include "tissue/mesh/files/surface_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "tissue/mesh/files/winding.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar {
namespace {

/// Finds the role of each piece, the largest first: what a piece lies in is larger than it.
class PieceSorter {
 public:
  PieceSorter(const TriangleSurface& surface, const std::vector<double>& stored_m3)
      : surface_(surface),
        stored_m3_(stored_m3),
        volumes_m3_(piece_volumes_m3(surface)),
        piece_(triangle_components(surface)),
        order_(volumes_m3_.size()),
        role_(volumes_m3_.size(), Role::kLost),
        cavity_(volumes_m3_.size(), 0),
        boxes_(volumes_m3_.size()),
        points_(volumes_m3_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return volumes_m3_[a] > volumes_m3_[b]; });
    for (std::size_t t = 0; t < piece_.size(); ++t)
      for (const Vec3& corner : surface.corners(surface.triangles[t])) {
        boxes_[number(t)].extend(corner);
        points_[number(t)] = corner;
      }
  }

  SurfacePieces sorted(double least_share) {
    SurfacePieces result;
    result.count = order_.size();
    for (std::size_t rank = 0; rank < order_.size(); ++rank) {
      const std::size_t piece = order_[rank];
      const auto holder = rank < kMostLookedAt ? holder_of(rank) : std::nullopt;
      role_[piece] = holder ? role_within(piece, *holder) : role_alone(rank, least_share);
      if (role_[piece] == Role::kPart) ++result.parts;
      if (role_[piece] == Role::kWithin) ++result.within;
      if (role_[piece] == Role::kLost) result.lost_m3.push_back(volumes_m3_[piece]);
    }
    result.kept = selected([&](std::size_t piece) { return role_[piece] == Role::kPart; });
    for (std::size_t n = 1; n <= cavities_; ++n) result.cavities.push_back(cavity(n));
    return result;
  }

 private:
  enum class Role { kPart, kCavity, kIsland, kWithin, kLost };
  static constexpr std::size_t kMostLookedAt = 200;  ///< each costs a walk over what it may lie in

  std::size_t number(std::size_t triangle) const { return static_cast<std::size_t>(piece_[triangle]); }
  bool inward(std::size_t piece) const { return stored_m3_[piece] < 0; }

  template <typename Test>
  TriangleSurface selected(Test wanted) const {
    std::vector<bool> keep(piece_.size());
    for (std::size_t t = 0; t < keep.size(); ++t) keep[t] = wanted(number(t));
    return some_triangles(surface_, keep);
  }

  /// The smallest piece that the one of this rank lies in.
  std::optional<std::size_t> holder_of(std::size_t rank) {
    const Vec3& point = points_[order_[rank]];
    for (std::size_t larger = rank; larger-- > 0;) {
      const std::size_t other = order_[larger];
      if (!boxes_[other].contains(point)) continue;
      const auto [found, fresh] = alone_.try_emplace(other);
      if (fresh) found->second = selected([&](std::size_t piece) { return piece == other; });
      if (encloses(found->second, point)) return other;
    }
    return std::nullopt;
  }

  Role role_alone(std::size_t rank, double least_share) const {
    return rank == 0 || volumes_m3_[order_[rank]] >= least_share * volumes_m3_[order_[0]] ? Role::kPart : Role::kLost;
  }

  /// A cavity's number goes on to the islands in it.
  Role role_within(std::size_t piece, std::size_t holder) {
    const bool turned = inward(piece) != inward(holder);
    if (turned && role_[holder] == Role::kPart) {
      cavity_[piece] = ++cavities_;
      return Role::kCavity;
    }
    if (turned && role_[holder] == Role::kCavity) {
      cavity_[piece] = cavity_[holder];
      return Role::kIsland;
    }
    return Role::kWithin;
  }

  /// The wall outward, the islands in it inward.
  TriangleSurface cavity(std::size_t number_of_it) const {
    const auto role_is = [&](std::size_t piece, Role role) {
      return cavity_[piece] == number_of_it && role_[piece] == role;
    };
    TriangleSurface result = selected([&](std::size_t piece) { return role_is(piece, Role::kCavity); });
    const TriangleSurface islands = selected([&](std::size_t piece) { return role_is(piece, Role::kIsland); });
    append_turned(result, islands);
    return result;
  }

  const TriangleSurface& surface_;
  const std::vector<double>& stored_m3_;
  std::vector<double> volumes_m3_;
  std::vector<std::int32_t> piece_;  ///< of each triangle
  std::vector<std::size_t> order_;   ///< pieces, the largest first
  std::vector<Role> role_;
  std::vector<std::size_t> cavity_;  ///< of each piece, from 1; 0 for none
  std::size_t cavities_ = 0;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<Vec3> points_;                      ///< a corner of each piece
  std::map<std::size_t, TriangleSurface> alone_;  ///< pieces that others may lie in
};

}  // namespace

std::vector<double> piece_volumes_m3(const TriangleSurface& surface) {
  const auto piece = triangle_components(surface);
  const Vec3 origin = surface.bounds().center();  // far from the origin the sum loses digits
  std::vector<double> volumes;
  for (std::size_t t = 0; t < piece.size(); ++t) {
    const auto number = static_cast<std::size_t>(piece[t]);
    if (number >= volumes.size()) volumes.resize(number + 1, 0);
    const auto [a, b, c] = surface.corners(surface.triangles[t]);
    volumes[number] += (a - origin).dot((b - origin).cross(c - origin)) / 6;
  }
  return volumes;
}

SurfacePieces sorted_pieces(const TriangleSurface& surface, const std::vector<double>& stored_m3, double least_share) {
  return PieceSorter(surface, stored_m3).sorted(least_share);
}

std::vector<Vec3> points_within(const TriangleSurface& surface) {
  constexpr double kDepth = 1e-3;  // of the triangle's own size
  const auto piece = triangle_components(surface);
  std::vector<double> largest;
  std::vector<Vec3> points;
  for (std::size_t t = 0; t < piece.size(); ++t) {
    const auto number = static_cast<std::size_t>(piece[t]);
    if (number >= points.size()) points.resize(number + 1), largest.resize(number + 1, -1);
    const auto [a, b, c] = surface.corners(surface.triangles[t]);
    const Vec3 across = (b - a).cross(c - a);
    if (across.norm() <= largest[number]) continue;
    largest[number] = across.norm();
    points[number] = (a + b + c) / 3 - kDepth * std::sqrt(across.norm()) * across.normalized();
  }
  return points;
}

}  // namespace trocar
