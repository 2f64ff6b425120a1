#include "tissue/imaging/labels/one_layer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "haptics/input_error.h"
#include "tissue/imaging/labels/label_grid.h"

namespace trocar {
namespace {

constexpr double kLeastLeft = 0.1;  // of a segment's voxels: with fewer it is another organ's rim and no organ

struct Claim {
  const Segment* segment;
  std::size_t voxels, lost = 0;
  std::map<const Segment*, std::size_t> to{};
};

std::string called(const Segment& segment) {
  return segment.name.empty() ? "label " + std::to_string(segment.number) : "\"" + segment.name + "\"";
}

/// "liver" of one, "a and 2 more" of several, those that took most first.
std::string takers(const Claim& claim) {
  std::vector<std::pair<std::size_t, const Segment*>> by_share;
  for (const auto& [segment, voxels] : claim.to) by_share.emplace_back(voxels, segment);
  std::stable_sort(by_share.begin(), by_share.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string out = called(*by_share.front().second);
  if (by_share.size() > 1) out += " and " + std::to_string(by_share.size() - 1) + " more";
  return out;
}

std::string share_words(std::size_t part, std::size_t whole) {
  const double share = 100 * static_cast<double>(part) / static_cast<double>(whole);
  return share < 1 ? "less than 1 %" : std::to_string(std::lround(share)) + " %";
}

bool possible(const LabelMap& map, const std::vector<Segment>& wanted) {
  std::set<std::size_t> layers;
  std::set<int> numbers;
  for (const Segment& segment : wanted) {
    layers.insert(segment.layer);
    numbers.insert(segment.number);
  }
  const VoxelGrid grid = grid_of(map.layers.front());
  return layers.size() > 1 && numbers.size() == wanted.size() &&
         std::all_of(map.layers.begin(), map.layers.end(),
                     [&](const LabelVolume& layer) { return same_grid(grid, grid_of(layer)); });
}

}  // namespace

std::optional<LabelMap> in_one_layer(const LabelMap& map, const std::vector<Segment>& wanted) {
  if (map.layers.empty() || !possible(map, wanted)) return std::nullopt;
  std::vector<std::map<int, std::size_t>> counts;
  for (const LabelVolume& layer : map.layers) counts.push_back(layer.label_counts());
  std::vector<Claim> claims;
  for (const Segment& segment : wanted) claims.push_back({&segment, counts[segment.layer][segment.number]});
  std::stable_sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) { return a.voxels > b.voxels; });

  LabelMap out;
  out.segments = map.segments;
  out.modality = map.modality, out.table = map.table, out.notes = map.notes;
  LabelVolume& one = out.layers.emplace_back(map.layers.front());
  std::fill(one.labels.begin(), one.labels.end(), std::uint16_t{0});
  std::map<int, Claim*> by_number;
  for (Claim& claim : claims) {
    const std::vector<std::uint16_t>& from = map.layers[claim.segment->layer].labels;
    for (std::size_t v = 0; v < from.size(); ++v) {
      if (from[v] != claim.segment->number) continue;
      if (one.labels[v] != 0) {
        Claim& loser = *by_number[one.labels[v]];
        ++loser.lost, ++loser.to[claim.segment];
      }
      one.labels[v] = from[v];
    }
    by_number[claim.segment->number] = &claim;
  }
  for (const Claim& claim : claims) {
    if (claim.lost == 0) continue;
    const std::string share = share_words(claim.lost, claim.voxels), what = called(*claim.segment);
    if (static_cast<double>(claim.voxels - claim.lost) < kLeastLeft * static_cast<double>(claim.voxels))
      throw InputError(what + ": " + share + " of it is " + takers(claim) +
                       " too, so that no organ of a scene is left: leave one of them out, or import it by itself");
    out.notes.push_back(what + ": " + share + " of it lies in " + takers(claim) +
                        " too, and went to what is smaller; import it by itself to have it whole");
  }
  for (std::size_t layer = 0; layer < map.layers.size(); ++layer)
    for (std::size_t v = 0; v < one.labels.size(); ++v) {
      const std::uint16_t number = map.layers[layer].labels[v];
      if (one.labels[v] == 0 && number != 0 && !by_number.contains(number)) one.labels[v] = number;
    }
  const auto counted = one.label_counts();
  std::set<int> seen;
  std::erase_if(out.segments, [&](const Segment& segment) {
    const auto claim = by_number.find(segment.number);
    const bool other = claim != by_number.end() && claim->second->segment->layer != segment.layer;
    return other || !counted.contains(segment.number) || !seen.insert(segment.number).second;
  });
  for (Segment& segment : out.segments) segment.layer = 0;
  return out;
}

}  // namespace trocar
