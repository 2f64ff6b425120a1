// Two blocks of tissue, one on the other with a bed between them, and a hand that pulls on the upper one.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "tissue/solid/soft_organ.h"

namespace trocar::test {

/// A box whose faces are divided into squares of that edge, two triangles each; closed.
inline TriangleSurface divided_box(const Vec3& low, const Vec3& high, double edge_m) {
  TriangleSurface s;
  std::array<int, 3> count{};
  for (int a = 0; a < 3; ++a) count[std::size_t(a)] = std::max(1, int(std::lround((high[a] - low[a]) / edge_m)));
  std::map<std::array<int, 3>, std::int32_t> number;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [entry, fresh] = number.try_emplace(at, std::int32_t(s.vertices.size()));
    if (fresh) {
      Vec3 p;
      for (int a = 0; a < 3; ++a) p[a] = low[a] + (high[a] - low[a]) * at[std::size_t(a)] / count[std::size_t(a)];
      s.vertices.push_back(p);
    }
    return entry->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (int i = 0; i < count[std::size_t(u)]; ++i)
        for (int j = 0; j < count[std::size_t(v)]; ++j) {
          const auto at = [&](int di, int dj) {
            std::array<int, 3> p{};
            p[std::size_t(axis)] = upper ? count[std::size_t(axis)] : 0;
            p[std::size_t(u)] = i + di;
            p[std::size_t(v)] = j + dj;
            return vertex(p);
          };
          const std::int32_t a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
          if (upper)
            s.triangles.push_back({a, b, c}), s.triangles.push_back({a, c, d});
          else
            s.triangles.push_back({a, c, b}), s.triangles.push_back({a, d, c});
        }
    }
  return s;
}

struct BedScene {
  Vec3 below_m{0.08, 0.04, 0.03};  ///< size of the lower block, its top in z = 0, its end in x = 0
  Vec3 above_m{0.06, 0.03, 0.01};  ///< of the upper one, its end in x = 0 too
  double gap_m = 0.001, edge_m = 0.01, triangle_m = 0.0025;
  TissueSolid below, above;
  BedOptions bed;
  SoftOrganOptions organ;

  BedScene() {
    below.young_pa = 5000;
    above.young_pa = 20000;
    above.poisson = 0.49;
  }
  SurfacePtr lower() const {
    return still_surface(
        divided_box({0, -below_m.y() / 2, -below_m.z()}, {below_m.x(), below_m.y() / 2, 0}, 2 * triangle_m));
  }
  SurfacePtr upper() const {
    return still_surface(divided_box({0.01, -above_m.y() / 2, gap_m},
                                     {0.01 + above_m.x(), above_m.y() / 2, gap_m + above_m.z()}, triangle_m));
  }
  SoftOrgan made() const {
    SoftOrganOptions options = organ;
    options.solid.edge_m = edge_m;
    const SurfacePtr first = lower(), second = upper();
    const Lattice one = build_lattice(*first, {.cell_m = edge_m}).lattice;
    const Lattice two = build_lattice(*second, {.cell_m = edge_m, .grid_m = one.origin_m}).lattice;
    return SoftOrgan(beside(one, two), both_surfaces(*first, *second), std::array{below, above}, options, bed);
  }
};

/// Places of an organ that a hand holds on to, each by a spring to where it wants it.
class BedHand {
 public:
  /// @param holds which vertices of the upper organ
  template <class Wanted>
  BedHand(const SoftOrgan& organ, Wanted holds, double stiffness_n_per_m) {
    for (std::size_t t = 0; t < organ.rest()->triangles.size(); ++t) {
      if (organ.part_of(std::int32_t(t)) != 1) continue;
      const MaterialPoint place{std::int32_t(t), {1. / 3, 1. / 3, 1. / 3}};
      const Vec3 at = organ.place_T(place);
      if (!holds(at)) continue;
      places_.push_back({place, organ.shares_of(place), at});
    }
    constexpr std::size_t kMost = 40;  // of places: a hand of hundreds is most of the step
    const std::size_t stride = (places_.size() + kMost - 1) / kMost;
    for (std::size_t i = 0; stride > 1 && i * stride < places_.size(); ++i) places_[i] = places_[i * stride];
    if (stride > 1) places_.resize((places_.size() + stride - 1) / stride);
    stiffness_ = stiffness_n_per_m / double(places_.size());
  }
  /// One step with the hand moved by `by` from where it took hold. @return its force on the organ, N
  Vec3 step(SoftOrgan& organ, const Vec3& by) {
    std::vector<SoftSpring> springs;
    for (const Place& p : places_)
      for (int axis = 0; axis < 3; ++axis)
        springs.push_back(
            {p.shares, Vec3::Unit(axis), stiffness_, (organ.place_T(p.place) - p.from - by)[axis], false, 0});
    organ.step({}, nullptr, springs);
    Vec3 force = Vec3::Zero();
    for (const SoftSpring& s : springs) force -= s.force_n * s.direction;
    work_ += 0.5 * (force + force_).dot(by - by_);
    by_ = by;
    return force_ = force;
  }
  double work_j() const { return work_; }
  /// Energy of its springs now.
  double held_j(const SoftOrgan& organ) const {
    double sum = 0;
    for (const Place& p : places_) sum += 0.5 * stiffness_ * (organ.place_T(p.place) - p.from - by_).squaredNorm();
    return sum;
  }
  std::size_t places() const { return places_.size(); }

 private:
  struct Place {
    MaterialPoint place;
    NodeShares shares;
    Vec3 from;
  };
  std::vector<Place> places_;
  double stiffness_ = 0, work_ = 0;
  Vec3 by_ = Vec3::Zero(), force_ = Vec3::Zero();
};

}  // namespace trocar::test
