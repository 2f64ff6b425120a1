#include "tissue/mesh/complex/complex_mesh.h"

#include <algorithm>

namespace trocar {

ComplexMesh::ComplexMesh(LabelComplex complex) : complex_(std::move(complex)) {
  dead_.assign(complex_.triangles.size(), false);
  fans_.resize(complex_.vertices.size());
  for (std::size_t t = 0; t < complex_.triangles.size(); ++t)
    for (const Index corner : complex_.triangles[t]) fans_[at(corner)].push_back(static_cast<Index>(t));
}

std::vector<ComplexMesh::Edge> ComplexMesh::edges() const {
  std::vector<std::pair<Index, Index>> all;
  for (std::size_t t = 0; t < complex_.triangles.size(); ++t)
    for (std::size_t n = 0; n < 3 && !dead_[t]; ++n)
      all.push_back(std::minmax({complex_.triangles[t][n], complex_.triangles[t][(n + 1) % 3]}));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::vector<Edge> result;
  for (const auto& [a, b] : all) result.push_back({a, b});
  return result;
}

std::vector<ComplexMesh::Index> ComplexMesh::around(Index a, Index b) const {
  std::vector<Index> result;
  for (const Index t : fan(a)) {
    const auto& corners = triangle(t);
    if (std::find(corners.begin(), corners.end(), b) != corners.end()) result.push_back(t);
  }
  return result;
}

std::vector<ComplexMesh::Index> ComplexMesh::neighbours(Index vertex) const {
  std::vector<Index> result;
  for (const Index t : fan(vertex))
    for (const Index corner : triangle(t))
      if (corner != vertex) result.push_back(corner);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

bool ComplexMesh::on_curve(Index a, Index b) const {
  const auto triangles = around(a, b);
  return triangles.size() != 2 || regions(triangles[0]) != regions(triangles[1]);
}

std::vector<ComplexMesh::Index> ComplexMesh::curve_neighbours(Index vertex) const {
  const auto& round = fan(vertex);
  bool one_pair = true;
  for (const Index t : round) one_pair = one_pair && regions(t) == regions(round[0]);
  std::vector<Index> result;
  if (one_pair) return result;
  for (const Index other : neighbours(vertex))
    if (on_curve(vertex, other)) result.push_back(other);
  return result;
}

ComplexMesh::Kind ComplexMesh::kind(Index vertex) const {
  const std::size_t curves = curve_neighbours(vertex).size();
  return curves == 0 ? Kind::patch : curves == 2 ? Kind::curve : Kind::corner;
}

ComplexMesh::Index ComplexMesh::third(Index t, Index a, Index b) const {
  for (const Index corner : triangle(t))
    if (corner != a && corner != b) return corner;
  return -1;
}

void ComplexMesh::detach(Index t, Index vertex) {
  auto& round = fans_[at(vertex)];
  round.erase(std::find(round.begin(), round.end(), t));
}

ComplexMesh::Index ComplexMesh::split(Index a, Index b) {
  const auto middle = static_cast<Index>(complex_.vertices.size());
  complex_.vertices.push_back((place(a) + place(b)) / 2);
  fans_.emplace_back();
  for (const Index t : around(a, b)) {
    auto half = triangle(t);
    std::replace(half.begin(), half.end(), a, middle);
    auto& kept = complex_.triangles[at(t)];
    std::replace(kept.begin(), kept.end(), b, middle);
    const auto fresh = static_cast<Index>(complex_.triangles.size());
    const Index apex = third(t, a, middle);
    complex_.triangles.push_back(half);
    complex_.regions.push_back(complex_.regions[at(t)]);
    dead_.push_back(false);
    detach(t, b);
    fans_[at(b)].push_back(fresh);
    fans_[at(apex)].push_back(fresh);
    fans_[at(middle)].push_back(t);
    fans_[at(middle)].push_back(fresh);
  }
  return middle;
}

bool ComplexMesh::may_collapse(Index a, Index b) const {
  const auto shared = around(a, b);
  std::vector<Index> apexes;
  for (const Index t : shared) apexes.push_back(third(t, a, b));
  std::sort(apexes.begin(), apexes.end());
  const auto near_a = neighbours(a), near_b = neighbours(b);
  std::vector<Index> common;
  std::set_intersection(near_a.begin(), near_a.end(), near_b.begin(), near_b.end(), std::back_inserter(common));
  if (common != apexes) return false;
  for (const Index t : fan(a))  // a triangle that both would have
    for (const Index u : fan(b)) {
      if (std::find(shared.begin(), shared.end(), t) != shared.end() ||
          std::find(shared.begin(), shared.end(), u) != shared.end())
        continue;
      int same = 0;
      for (const Index corner : triangle(t))
        for (const Index other : triangle(u)) same += corner == other && corner != a && corner != b ? 1 : 0;
      if (same >= 2) return false;
    }
  const auto curves_a = curve_neighbours(a), curves_b = curve_neighbours(b);
  if (curves_a.empty() || curves_b.empty()) return true;
  if (!on_curve(a, b)) return false;
  for (const Index other : curves_a)
    if (std::find(curves_b.begin(), curves_b.end(), other) != curves_b.end()) return false;  // a loop of three edges
  return true;
}

void ComplexMesh::collapse(Index a, Index b) {
  for (const Index t : around(a, b)) {
    dead_[at(t)] = true;
    for (const Index corner : std::array<Index, 3>(triangle(t))) detach(t, corner);
  }
  for (const Index t : fans_[at(b)]) {
    auto& corners = complex_.triangles[at(t)];
    std::replace(corners.begin(), corners.end(), b, a);
    fans_[at(a)].push_back(t);
  }
  fans_[at(b)].clear();
}

bool ComplexMesh::flip(Index a, Index b) {
  const auto pair = around(a, b);
  if (pair.size() != 2 || regions(pair[0]) != regions(pair[1])) return false;
  const Index c = third(pair[0], a, b), d = third(pair[1], a, b);
  if (c == d || !around(c, d).empty()) return false;
  auto& first = complex_.triangles[at(pair[0])];
  auto& second = complex_.triangles[at(pair[1])];
  std::replace(first.begin(), first.end(), b, d);    // (a, b, c) becomes (a, d, c)
  std::replace(second.begin(), second.end(), a, c);  // (b, a, d) becomes (b, c, d)
  detach(pair[0], b);
  detach(pair[1], a);
  fans_[at(d)].push_back(pair[0]);
  fans_[at(c)].push_back(pair[1]);
  return true;
}

LabelComplex ComplexMesh::compact() const {
  LabelComplex result;
  std::vector<Index> number(complex_.vertices.size(), -1);
  for (std::size_t t = 0; t < complex_.triangles.size(); ++t) {
    if (dead_[t]) continue;
    auto corners = complex_.triangles[t];
    for (Index& corner : corners) {
      Index& fresh = number[at(corner)];
      if (fresh < 0) {
        fresh = static_cast<Index>(result.vertices.size());
        result.vertices.push_back(complex_.vertices[at(corner)]);
      }
      corner = fresh;
    }
    result.triangles.push_back(corners);
    result.regions.push_back(complex_.regions[t]);
  }
  return result;
}

}  // namespace trocar
