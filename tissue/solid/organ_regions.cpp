#include "tissue/solid/organ_regions.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

/// On which side of the line a to b, seen from above, the place lies; never 0, and with the ends exchanged the
/// opposite to the last bit.
bool is_left(const Vec3& a, const Vec3& b, const Vec3& place) {
  const bool turned = std::pair(b.x(), b.y()) < std::pair(a.x(), a.y());
  const Vec3 &from = turned ? b : a, &to = turned ? a : b;
  const double cross = (to.x() - from.x()) * (place.y() - from.y()) - (to.y() - from.y()) * (place.x() - from.x());
  return (cross >= 0) != turned;
}

/// +1 where the line up from the place leaves through the triangle, -1 where it enters, else 0.
int crossing_above(const std::array<Vec3, 3>& triangle, const Vec3& place) {
  const auto& [a, b, c] = triangle;
  const bool left = is_left(a, b, place);
  if (is_left(b, c, place) != left || is_left(c, a, place) != left) return 0;
  const Vec3 normal = (b - a).cross(c - a);
  if (normal.z() == 0) return 0;
  const double height = a.z() - ((place.x() - a.x()) * normal.x() + (place.y() - a.y()) * normal.y()) / normal.z();
  return height > place.z() ? (left ? 1 : -1) : 0;
}

double top_of(const std::array<Vec3, 3>& triangle) {
  return std::max({triangle[0].z(), triangle[1].z(), triangle[2].z()});
}

}  // namespace

OrganRegions::Columns OrganRegions::columns_of(const TriangleSurface& surface) {
  Columns organ;
  organ.volume = surface.volume_m3();
  organ.box = surface.bounds();
  for (const auto& [a, b, c] : surface.triangles)
    organ.triangles.push_back({surface.vertices[static_cast<std::size_t>(a)],
                               surface.vertices[static_cast<std::size_t>(b)],
                               surface.vertices[static_cast<std::size_t>(c)]});
  std::sort(organ.triangles.begin(), organ.triangles.end(),
            [](const auto& a, const auto& b) { return top_of(a) > top_of(b); });
  const Vec3 size = organ.box.sizes();
  organ.edge = std::sqrt(size.x() * size.y() / static_cast<double>(organ.triangles.size()));
  const auto column = [&](double along, Eigen::Index axis) {
    return static_cast<int>((along - organ.box.min()[axis]) / organ.edge);
  };
  organ.wide = column(organ.box.max().x(), 0) + 1;
  const int deep = column(organ.box.max().y(), 1) + 1;
  const auto for_columns = [&](const std::array<Vec3, 3>& triangle, const auto& step) {
    const Vec3 low = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]);
    const Vec3 high = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]);
    for (int j = column(low.y(), 1); j <= column(high.y(), 1); ++j)
      for (int i = column(low.x(), 0); i <= column(high.x(), 0); ++i)
        step(static_cast<std::size_t>(j * organ.wide + i));
  };
  organ.first.assign(static_cast<std::size_t>(organ.wide) * static_cast<std::size_t>(deep) + 1, 0);
  for (const auto& triangle : organ.triangles) for_columns(triangle, [&](std::size_t at) { ++organ.first[at + 1]; });
  for (std::size_t n = 1; n < organ.first.size(); ++n) organ.first[n] += organ.first[n - 1];
  organ.listed.resize(organ.first.back());
  std::vector<std::uint32_t> next(organ.first.begin(), organ.first.end() - 1);
  for (std::uint32_t t = 0; t < organ.triangles.size(); ++t)
    for_columns(organ.triangles[t], [&](std::size_t at) { organ.listed[next[at]++] = t; });
  return organ;
}

bool OrganRegions::Columns::holds(const Vec3& place) const {
  if (!box.contains(place)) return false;
  const auto i = static_cast<std::size_t>((place.x() - box.min().x()) / edge);
  const auto j = static_cast<std::size_t>((place.y() - box.min().y()) / edge);
  const std::size_t at = j * static_cast<std::size_t>(wide) + i;
  int crossings = 0;
  for (std::uint32_t n = first[at]; n < first[at + 1]; ++n) {
    const std::array<Vec3, 3>& triangle = triangles[listed[n]];
    if (top_of(triangle) <= place.z()) break;  // and so are all behind it
    crossings += crossing_above(triangle, place);
  }
  return crossings > 0;
}

OrganRegions::OrganRegions(const std::vector<const TriangleSurface*>& surfaces) {
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    organs_.push_back(columns_of(*surfaces[n]));
    organs_.back().number = static_cast<int>(n) + 1;
  }
  std::stable_sort(organs_.begin(), organs_.end(),
                   [](const Columns& a, const Columns& b) { return a.volume < b.volume; });
}

int OrganRegions::at(const Vec3& place) const {
  for (const Columns& organ : organs_)
    if (organ.holds(place)) return organ.number;
  return 0;
}

double OrganRegions::taken(std::size_t smaller, std::size_t larger) const {
  constexpr int kSamples = 32;  // along each axis
  const Eigen::AlignedBox3d common = organs_[smaller].box.intersection(organs_[larger].box);
  if (common.isEmpty()) return 0;
  const Vec3 step = common.sizes() / kSamples;
  int hits = 0;
  for (int n = 0; n < kSamples * kSamples * kSamples; ++n) {
    const Vec3 sample(n % kSamples + 0.5, n / kSamples % kSamples + 0.5, n / (kSamples * kSamples) + 0.5);
    const Vec3 place = common.min() + step.cwiseProduct(sample);
    hits += organs_[larger].holds(place) && at(place) == organs_[smaller].number ? 1 : 0;
  }
  return hits * step.prod();
}

std::vector<double> OrganRegions::volumes() const {
  std::vector<double> volumes(organs_.size());
  for (std::size_t n = 0; n < organs_.size(); ++n) {
    double& volume = volumes[static_cast<std::size_t>(organs_[n].number - 1)];
    volume = organs_[n].volume;
    for (std::size_t smaller = 0; smaller < n; ++smaller) volume -= taken(smaller, n);
  }
  return volumes;
}

}  // namespace trocar
