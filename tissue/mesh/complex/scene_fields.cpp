#include "tissue/mesh/complex/scene_fields.h"

#include <algorithm>
#include <utility>

namespace trocar {
namespace {

constexpr float kNear = 0.02F,
                kTouching = 0.12F;  ///< second largest broad field: from where on, and where fully, slits are closed
constexpr float kLeastSum = 1e-3F;  ///< with less of sharp field at a sample the broad one gives the shares

/// Calls visit(sample of the field, sample of the common grid) for the samples of a field that lie in the grid.
template <typename Visit>
void for_samples(const RegionField& f, const std::array<int, 3>& size, Visit visit) {
  std::size_t own = 0;
  for (int k = f.first[2]; k < f.first[2] + f.field.size[2]; ++k)
    for (int j = f.first[1]; j < f.first[1] + f.field.size[1]; ++j)
      for (int i = f.first[0]; i < f.first[0] + f.field.size[0]; ++i, ++own) {
        if (i < 0 || j < 0 || k < 0 || i >= size[0] || j >= size[1] || k >= size[2]) continue;
        visit(own, static_cast<std::size_t>(i) + static_cast<std::size_t>(size[0]) *
                                                     (static_cast<std::size_t>(j) +
                                                      static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k)));
      }
}

/// What the organs have together at the samples of the common grid.
struct Together {
  std::vector<float> sum, broad_sum, largest, second;  ///< the last two of the broad fields

  Together(const std::vector<RegionField>& fields, const std::vector<ScalarField>& broad,
           const std::array<int, 3>& size) {
    const auto count =
        static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
    for (std::vector<float>* values : {&sum, &broad_sum, &largest, &second}) values->assign(count, 0);
    for (std::size_t n = 0; n < fields.size(); ++n)
      for_samples(fields[n], size, [&](std::size_t own, std::size_t common) {
        const float value = broad[n].values[own];
        sum[common] += fields[n].field.values[own], broad_sum[common] += value;
        if (value > largest[common])
          second[common] = std::exchange(largest[common], value);
        else
          second[common] = std::max(second[common], value);
      });
  }
};

}  // namespace

void close_slits(std::vector<RegionField>& fields, const std::vector<ScalarField>& broad,
                 const std::array<int, 3>& size) {
  const Together all(fields, broad, size);
  for (std::size_t n = 0; n < fields.size(); ++n)
    for_samples(fields[n], size, [&](std::size_t own, std::size_t common) {
      const float weight = std::clamp((all.second[common] - kNear) / (kTouching - kNear), 0.0F, 1.0F);
      if (!(weight > 0) || !(all.broad_sum[common] > 0)) return;
      float& value = fields[n].field.values[own];
      const float share =
          all.sum[common] > kLeastSum ? value / all.sum[common] : broad[n].values[own] / all.broad_sum[common];
      value += weight * (share * all.broad_sum[common] - value);
    });
}

}  // namespace trocar
