#include "app/picture/maps/heat_field.h"

#include <algorithm>
#include <cmath>

namespace trocar {

std::size_t HeatField::Hash::operator()(const Key& key) const {
  std::size_t out = 0;
  for (const std::int32_t part : key) out = out * 1000003U ^ static_cast<std::size_t>(static_cast<std::uint32_t>(part));
  return out;
}

HeatField::Key HeatField::key_of(const Vec3& place_T, double size) const {
  constexpr double kFarthest = 1e6;  // blocks: beyond it nothing is told apart
  Key key{};
  for (int i = 0; i < (flat_ ? 2 : 3); ++i)
    key[static_cast<std::size_t>(i)] =
        static_cast<std::int32_t>(std::clamp(std::floor(place_T[i] / size), -kFarthest, kFarthest));
  return key;
}

HeatField::HeatField(const Trace& trace, HeatOf of, bool flat) : of_(of), flat_(flat) {
  std::unordered_map<Key, Cell, Hash> gathered;
  const double period_s = 1 / trace.rate_hz;
  for (const TraceSample& sample : trace.samples) {
    const double force_n = sample.force_T.norm();
    if (!sample.tip_T.allFinite() || (of == HeatOf::kForce && (!sample.contact || !std::isfinite(force_n)))) continue;
    Cell& cell = gathered[key_of(sample.tip_T, kCell)];
    cell.sum_T += sample.tip_T;
    cell.ticks += 1;
    cell.value = of == HeatOf::kTime ? cell.value + period_s : std::max(cell.value, force_n);
  }
  cells_.reserve(gathered.size());
  for (auto& [key, cell] : gathered) {
    cell.sum_T /= cell.ticks;
    near_[key_of(cell.sum_T, kReach)].push_back(static_cast<std::uint32_t>(cells_.size()));
    cells_.push_back(cell);
  }
}

double HeatField::at(const Vec3& place_T) const {
  const Key middle = key_of(place_T, kReach);
  double out = 0;
  const int deep = flat_ ? 0 : 1;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -deep; z <= deep; ++z) {
        const auto block = near_.find({middle[0] + x, middle[1] + y, middle[2] + z});
        if (block == near_.end()) continue;
        for (const std::uint32_t index : block->second) {
          const Cell& cell = cells_[index];
          Vec3 way = cell.sum_T - place_T;
          if (flat_) way.z() = 0;
          if (way.squaredNorm() >= kReach * kReach) continue;
          out = of_ == HeatOf::kTime ? out + cell.value : std::max(out, cell.value);
        }
      }
  return out;
}

}  // namespace trocar
