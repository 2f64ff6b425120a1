#include "tissue/mesh/complex/label_complex.h"

#include <algorithm>
#include <map>

#include "tissue/mesh/surface/isosurface.h"

namespace trocar {
namespace {

using Index = std::int32_t;
using Region = std::int16_t;

constexpr std::size_t kIslandSamples = 16;   ///< contacts of no more are parted where the same two have a larger one
constexpr double kComplexEdgeMargin = 0.08;  ///< share of an edge that a point keeps from its ends

/// The winning region of every sample, and how two regions compare there.
class Regions {
 public:
  Regions(const std::vector<RegionField>& fields, const std::array<int, 3>& size) : fields_(fields), size_(size) {
    const std::size_t count = offset(0, 0, size[2]);
    winner_.assign(count, 0);
    std::vector<float> best(count, 0), rest(count, 1);
    for (std::size_t n = 0; n < fields.size(); ++n) compete(n, best, rest);
    for (std::size_t v = 0; v < count; ++v)
      if (rest[v] >= best[v]) winner_[v] = 0;
    clear_border();
  }

  std::size_t offset(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size_[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(k));
  }
  Region at(std::size_t sample) const { return winner_[sample]; }

  double value(Region region, const std::array<int, 3>& p) const {
    if (region > 0)
      return own(static_cast<std::size_t>(region - 1), p) + fields_[static_cast<std::size_t>(region - 1)].offset;
    double rest = 1;
    for (std::size_t n = 0; n < fields_.size(); ++n) rest -= own(n, p);
    return rest;
  }

  /// Face-connected pieces of fewer samples than `least` go to the region that most of their outer neighbours have.
  void absorb(std::size_t least) {
    std::vector<bool> seen(winner_.size(), false);
    for (std::size_t start = 0; start < winner_.size(); ++start) {
      if (seen[start]) continue;
      std::vector<std::size_t> piece{start};
      std::map<Region, std::size_t> round;
      seen[start] = true;
      for (std::size_t n = 0; n < piece.size(); ++n)
        for (const std::size_t next : neighbours(piece[n])) {
          if (winner_[next] != winner_[start])
            ++round[winner_[next]];
          else if (!seen[next])
            seen[next] = true, piece.push_back(next);
        }
      if (piece.size() >= least || round.empty()) continue;
      const auto most = std::max_element(round.begin(), round.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      for (const std::size_t sample : piece) winner_[sample] = most->first;
    }
  }

  /// Parts two regions where they touch in a few samples only, beside a larger contact: such islands would have rims
  /// far shorter than a wanted edge. The larger region's samples go to the rest, no more than a tenth of them.
  void part_islands() {
    std::map<Region, std::size_t> count, lost;
    for (const Region region : winner_) ++count[region];
    for (auto& [pair, samples] : contacts(count)) {
      std::vector<std::vector<std::size_t>> islands = clusters(pair[0], samples);
      const auto largest = std::max_element(islands.begin(), islands.end(),
                                            [](const auto& a, const auto& b) { return a.size() < b.size(); });
      for (auto island = islands.begin(); island != islands.end(); ++island) {
        if (island == largest || island->size() > kIslandSamples) continue;
        if (10 * (lost[pair[1]] + island->size()) > count[pair[1]]) continue;
        lost[pair[1]] += island->size();
        for (const std::size_t sample : *island) winner_[sample] = 0;
      }
    }
  }

 private:
  /// Steps along the edges of the tetrahedra that the cubes of samples are cut into, and back.
  std::array<std::ptrdiff_t, 14> edge_steps() const {
    const auto row = static_cast<std::ptrdiff_t>(offset(0, 1, 0)), slice = static_cast<std::ptrdiff_t>(offset(0, 0, 1));
    const std::array<std::ptrdiff_t, 7> steps{1, row, slice, row + 1, slice + 1, slice + row, slice + row + 1};
    std::array<std::ptrdiff_t, 14> both{};
    for (std::size_t n = 0; n < steps.size(); ++n) both[2 * n] = -steps[n], both[2 * n + 1] = steps[n];
    return both;
  }

  static std::size_t stepped(std::size_t sample, std::ptrdiff_t step) {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(sample) + step);
  }

  /// Samples of the larger of two regions that touch the other along an edge of a tetrahedron, ascending; by the other
  /// and the larger.
  std::map<std::array<Region, 2>, std::vector<std::size_t>> contacts(const std::map<Region, std::size_t>& count) const {
    const auto steps = edge_steps();
    std::map<std::array<Region, 2>, std::vector<std::size_t>> found;
    for (std::size_t sample = 0; sample < winner_.size(); ++sample) {
      const Region here = winner_[sample];
      if (here == 0) continue;  // the outermost samples are the rest: all neighbours are there
      for (const std::ptrdiff_t step : steps) {
        const Region other = winner_[stepped(sample, step)];
        if (other == 0 || other == here) continue;
        if (std::pair(count.at(other), other) > std::pair(count.at(here), here)) continue;
        auto& samples = found[{other, here}];
        if (samples.empty() || samples.back() != sample) samples.push_back(sample);
      }
    }
    return found;
  }

  /// Contacts that hang together over a tetrahedron, as their faces do: of neighbours that touch one sample in common.
  /// @param samples that touch `other`, ascending
  std::vector<std::vector<std::size_t>> clusters(Region other, const std::vector<std::size_t>& samples) const {
    const auto steps = edge_steps();
    std::vector<bool> seen(samples.size(), false);
    const auto join = [&](std::vector<std::size_t>& cluster, std::size_t next) {
      const auto found = std::lower_bound(samples.begin(), samples.end(), next);
      if (found == samples.end() || *found != next || seen[static_cast<std::size_t>(found - samples.begin())]) return;
      seen[static_cast<std::size_t>(found - samples.begin())] = true;
      cluster.push_back(next);
    };
    std::vector<std::vector<std::size_t>> result;
    for (const std::size_t start : samples) {
      std::vector<std::size_t> cluster;
      join(cluster, start);
      for (std::size_t n = 0; n < cluster.size(); ++n)
        for (const std::ptrdiff_t to : steps) {
          if (winner_[stepped(cluster[n], to)] != other) continue;
          for (const std::ptrdiff_t back : steps) {
            const bool edge = std::find(steps.begin(), steps.end(), to + back) != steps.end();
            if (edge) join(cluster, stepped(cluster[n], to + back));
          }
        }
      if (!cluster.empty()) result.push_back(std::move(cluster));
    }
    return result;
  }

  double own(std::size_t n, const std::array<int, 3>& p) const {
    const RegionField& f = fields_[n];
    const int i = p[0] - f.first[0], j = p[1] - f.first[1], k = p[2] - f.first[2];
    if (i < 0 || j < 0 || k < 0 || i >= f.field.size[0] || j >= f.field.size[1] || k >= f.field.size[2]) return 0;
    return f.field.values[f.field.offset(i, j, k)];
  }

  void compete(std::size_t n, std::vector<float>& best, std::vector<float>& rest) {
    const RegionField& f = fields_[n];
    for (int k = 0; k < f.field.size[2]; ++k)
      for (int j = 0; j < f.field.size[1]; ++j)
        for (int i = 0; i < f.field.size[0]; ++i) {
          const std::array<int, 3> p{i + f.first[0], j + f.first[1], k + f.first[2]};
          if (p[0] < 0 || p[1] < 0 || p[2] < 0 || p[0] >= size_[0] || p[1] >= size_[1] || p[2] >= size_[2]) continue;
          const float value = f.field.values[f.field.offset(i, j, k)];
          const std::size_t sample = offset(p[0], p[1], p[2]);
          rest[sample] -= value;
          if (value + f.offset > best[sample] && value > 0.02F)
            best[sample] = value + f.offset, winner_[sample] = static_cast<Region>(n + 1);
        }
  }

  void clear_border() {
    for (int k = 0; k < size_[2]; ++k)
      for (int j = 0; j < size_[1]; ++j)
        for (int i = 0; i < size_[0]; ++i)
          if (i == 0 || j == 0 || k == 0 || i + 1 == size_[0] || j + 1 == size_[1] || k + 1 == size_[2])
            winner_[offset(i, j, k)] = 0;
  }

  /// The samples that share a face; at the grid's border the sample itself stands in.
  std::array<std::size_t, 6> neighbours(std::size_t sample) const {
    const std::size_t row = static_cast<std::size_t>(size_[0]), slice = row * static_cast<std::size_t>(size_[1]);
    const std::size_t i = sample % row, j = sample % slice / row, k = sample / slice;
    return {i > 0 ? sample - 1 : sample,     i + 1 < row ? sample + 1 : sample,
            j > 0 ? sample - row : sample,   j + 1 < static_cast<std::size_t>(size_[1]) ? sample + row : sample,
            k > 0 ? sample - slice : sample, k + 1 < static_cast<std::size_t>(size_[2]) ? sample + slice : sample};
  }

  const std::vector<RegionField>& fields_;
  std::array<int, 3> size_;
  std::vector<Region> winner_;
};

class ComplexMarcher {
 public:
  ComplexMarcher(const Regions& regions, const std::array<int, 3>& size, const Vec3& spacing)
      : regions_(regions), size_(size), spacing_(spacing) {}

  LabelComplex march() {
    for (place_[2] = 0; place_[2] + 1 < size_[2]; ++place_[2])
      for (place_[1] = 0; place_[1] + 1 < size_[1]; ++place_[1])
        for (place_[0] = 0; place_[0] + 1 < size_[0]; ++place_[0]) cube();
    return std::move(complex_);
  }

 private:
  using Key = std::array<std::size_t, 4>;

  struct Corner {
    std::size_t sample;
    std::array<int, 3> place;
    Region region;
  };

  void cube() {
    std::array<Corner, 8> corners;
    bool mixed = false;
    for (std::size_t n = 0; n < 8; ++n) {
      const int bits = static_cast<int>(n);
      corners[n].place = {place_[0] + (bits & 1), place_[1] + (bits >> 1 & 1), place_[2] + (bits >> 2)};
      corners[n].sample = regions_.offset(corners[n].place[0], corners[n].place[1], corners[n].place[2]);
      corners[n].region = regions_.at(corners[n].sample);
      mixed = mixed || corners[n].region != corners[0].region;
    }
    if (!mixed) return;
    for (const auto& t : kKuhnTetrahedra) {
      std::array<Corner, 4> four;
      for (std::size_t n = 0; n < 4; ++n) four[n] = corners[static_cast<std::size_t>(t[n])];
      std::stable_sort(four.begin(), four.end(), [](const Corner& a, const Corner& b) { return a.region < b.region; });
      tetrahedron(four);
    }
  }

  /// Corners sorted by region: equal regions lie side by side.
  void tetrahedron(const std::array<Corner, 4>& c) {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t n = 0; n < 4; ++n) {
      if (n == 0 || c[n].region != c[n - 1].region) groups.emplace_back();
      groups.back().push_back(n);
    }
    if (groups.size() == 2) two_regions(c, groups);
    if (groups.size() == 3) three_regions(c, groups);
    if (groups.size() == 4) four_regions(c);
  }

  void two_regions(const std::array<Corner, 4>& c, const std::vector<std::vector<std::size_t>>& g) {
    const auto& low = g[0];
    const auto& high = g[1];
    if (low.size() == 2) {
      quad(c, low[0], high[0], {{{low[0], high[0]}, {low[1], high[0]}, {low[1], high[1]}, {low[0], high[1]}}});
      return;
    }
    const auto& one = low.size() == 1 ? low : high;
    const auto& three = low.size() == 1 ? high : low;
    polygon(c, low[0], high[0], {{one[0], three[0]}, {one[0], three[1]}, {one[0], three[2]}});
  }

  void three_regions(const std::array<Corner, 4>& c, const std::vector<std::vector<std::size_t>>& g) {
    const auto twice = static_cast<std::size_t>(
        std::find_if(g.begin(), g.end(), [](const auto& x) { return x.size() == 2; }) - g.begin());
    const std::size_t a = g[twice][0], a2 = g[twice][1];
    std::array<std::size_t, 2> others{};
    for (std::size_t n = 0, m = 0; n < 3; ++n)
      if (n != twice) others[m++] = g[n][0];
    for (const std::size_t x : others)
      polygon(c, std::min(a, x), std::max(a, x),
              {{a, x}, {a2, x}, {a2, others[0], others[1]}, {a, others[0], others[1]}});
    polygon(c, others[0], others[1], {{others[0], others[1]}, {a, others[0], others[1]}, {a2, others[0], others[1]}});
  }

  void four_regions(const std::array<Corner, 4>& c) {
    for (std::size_t x = 0; x < 4; ++x)
      for (std::size_t y = x + 1; y < 4; ++y) {
        std::array<std::size_t, 2> rest{};
        for (std::size_t n = 0, m = 0; n < 4; ++n)
          if (n != x && n != y) rest[m++] = n;
        polygon(c, x, y, {{x, y}, {x, y, rest[0]}, {0, 1, 2, 3}, {x, y, rest[1]}});
      }
  }

  void quad(const std::array<Corner, 4>& c, std::size_t low, std::size_t high,
            const std::array<std::array<std::size_t, 2>, 4>& edges) {
    std::vector<std::vector<std::size_t>> points;
    for (const auto& e : edges) points.push_back({e[0], e[1]});
    polygon(c, low, high, points);
  }

  /// Polygon of the mean points of sets of corners, wound so that its normal runs from corner `low` to corner `high`.
  void polygon(const std::array<Corner, 4>& c, std::size_t low, std::size_t high,
               const std::vector<std::vector<std::size_t>>& points) {
    std::vector<Index> ids;
    std::vector<Vec3> ideal;
    for (const auto& point : points) {
      ids.push_back(vertex(c, point));
      Vec3 mean = Vec3::Zero();
      for (const std::size_t n : point) mean += grid(c[n]) / static_cast<double>(point.size());
      ideal.push_back(mean);
    }
    Vec3 normal = Vec3::Zero();
    for (std::size_t n = 1; n + 1 < ideal.size(); ++n) normal += (ideal[n] - ideal[0]).cross(ideal[n + 1] - ideal[0]);
    const bool turn = normal.dot(grid(c[high]) - grid(c[low])) < 0;
    for (std::size_t n = 1; n + 1 < ids.size(); ++n) {
      complex_.triangles.push_back({ids[0], ids[turn ? n + 1 : n], ids[turn ? n : n + 1]});
      complex_.regions.push_back({c[low].region, c[high].region});
    }
  }

  static Vec3 grid(const Corner& corner) {
    return {double(corner.place[0]), double(corner.place[1]), double(corner.place[2])};
  }

  /// The vertex of a set of corners of different regions.
  Index vertex(const std::array<Corner, 4>& c, const std::vector<std::size_t>& corners) {
    Key key{0, 0, 0, 0};
    for (std::size_t n = 0; n < corners.size(); ++n) key[n] = c[corners[n]].sample + 1;
    std::sort(key.begin(), key.end());
    const auto [entry, fresh] = numbers_.try_emplace(key, static_cast<Index>(complex_.vertices.size()));
    if (fresh) complex_.vertices.push_back(place_of(c, corners).cwiseProduct(spacing_));
    return entry->second;
  }

  Vec3 place_of(const std::array<Corner, 4>& c, const std::vector<std::size_t>& corners) const {
    if (corners.size() == 2) return crossing(c[corners[0]], c[corners[1]]);
    Vec3 sum = Vec3::Zero();
    for (std::size_t x = 0; x < corners.size(); ++x)
      for (std::size_t y = x + 1; y < corners.size(); ++y) sum += crossing(c[corners[x]], c[corners[y]]);
    return sum / static_cast<double>(corners.size() * (corners.size() - 1) / 2);
  }

  Vec3 crossing(const Corner& p, const Corner& q) const {
    const double at_p = regions_.value(p.region, p.place) - regions_.value(q.region, p.place);
    const double at_q = regions_.value(q.region, q.place) - regions_.value(p.region, q.place);
    const double share = at_p >= 0 && at_q >= 0 && at_p + at_q > 0 ? at_p / (at_p + at_q) : 0.5;
    return grid(p) + std::clamp(share, kComplexEdgeMargin, 1 - kComplexEdgeMargin) * (grid(q) - grid(p));
  }

  const Regions& regions_;
  std::array<int, 3> size_;
  Vec3 spacing_;
  std::array<int, 3> place_{};
  LabelComplex complex_;
  std::map<Key, Index> numbers_;
};

}  // namespace

TriangleSurface LabelComplex::border(int region, std::vector<std::int32_t>* source) const {
  TriangleSurface surface;
  std::vector<Index> number(vertices.size(), -1);
  if (source != nullptr) source->clear();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (regions[t][0] != region && regions[t][1] != region) continue;
    auto triangle = triangles[t];
    if (regions[t][1] == region) std::swap(triangle[1], triangle[2]);
    for (Index& vertex : triangle) {
      Index& own = number[static_cast<std::size_t>(vertex)];
      if (own < 0) {
        own = static_cast<Index>(surface.vertices.size());
        surface.vertices.push_back(vertices[static_cast<std::size_t>(vertex)]);
      }
      vertex = own;
    }
    surface.triangles.push_back(triangle);
    if (source != nullptr) source->push_back(static_cast<Index>(t));
  }
  return surface;
}

LabelComplex label_complex(const std::vector<RegionField>& fields, const std::array<int, 3>& size,
                           const Vec3& spacing_m, std::size_t least_samples) {
  Regions regions(fields, size);
  regions.absorb(least_samples);
  regions.part_islands();
  regions.absorb(least_samples);
  return ComplexMarcher(regions, size, spacing_m).march();
}

}  // namespace trocar
