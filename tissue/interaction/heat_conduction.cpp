#include "tissue/interaction/heat_conduction.h"

#include <Eigen/Core>

namespace trocar {
namespace {

using HeatRow = Eigen::Array<float, HeatBlock::kEdge, 1>;  ///< cubes along x
using HeatRowDouble = Eigen::Array<double, HeatBlock::kEdge, 1>;

/// Rise, conductivity and whether it is tissue (1 or 0), of a block and one cube round it.
struct HeatPadded {
  static constexpr int kEdge = HeatBlock::kEdge + 2;
  std::array<float, kEdge * kEdge * kEdge> rise{}, conductivity{}, tissue{};

  static std::size_t at(int i, int j, int k) { return static_cast<std::size_t>(i + kEdge * (j + kEdge * k)); }
  void copy(const HeatBlock& block, std::size_t from, std::size_t to) {
    rise[to] = static_cast<float>(block.rise_k[from]);
    conductivity[to] = block.conductivity[from];
    tissue[to] = block.state[from] == HeatCell::kTissue ? 1.0f : 0.0f;
  }
  explicit HeatPadded(const HeatBlock& block) {
    constexpr int e = HeatBlock::kEdge;
    for (int k = 0; k < e; ++k)
      for (int j = 0; j < e; ++j)
        for (int i = 0; i < e; ++i) copy(block, HeatBlock::cell(i, j, k), at(i + 1, j + 1, k + 1));
    for (std::size_t side = 0; side < block.beside.size(); ++side)
      if (block.beside[side] != nullptr) copy_side(*block.beside[side], side);
  }
  void copy_side(const HeatBlock& beside, std::size_t side) {
    constexpr int e = HeatBlock::kEdge;
    const int from = side % 2 == 0 ? e - 1 : 0, to = side % 2 == 0 ? 0 : e + 1;
    for (int v = 0; v < e; ++v)
      for (int u = 0; u < e; ++u) {
        if (side / 2 == 0) copy(beside, HeatBlock::cell(from, u, v), at(to, u + 1, v + 1));
        if (side / 2 == 1) copy(beside, HeatBlock::cell(u, from, v), at(u + 1, to, v + 1));
        if (side / 2 == 2) copy(beside, HeatBlock::cell(u, v, from), at(u + 1, v + 1, to));
      }
  }
};

HeatRow heat_row(const float* first) { return Eigen::Map<const HeatRow>(first); }

}  // namespace

/// Eight cubes at a time. What passes between two cubes is the same number from either.
HeatLoss conduct(HeatBlock& block, const ConductionTerms& terms, double dt) {
  constexpr int kEdge = HeatBlock::kEdge, kRow = HeatPadded::kEdge;
  constexpr std::array<std::ptrdiff_t, 6> kBeside{-1, 1, -kRow, kRow, -kRow * kRow, kRow * kRow};
  const HeatPadded padded(block);
  const auto blood_w_per_k = static_cast<float>(terms.blood_w_per_k),
             gas_w_per_k = static_cast<float>(terms.gas_w_per_k);
  const auto half_edge = static_cast<float>(terms.edge_m / 2);
  HeatRow perfused = HeatRow::Zero(), to_gas = HeatRow::Zero();
  for (int k = 0; k < kEdge; ++k)
    for (int j = 0; j < kEdge; ++j) {
      const std::size_t c = HeatBlock::cell(0, j, k), p = HeatPadded::at(1, j + 1, k + 1);
      const HeatRow rise = heat_row(&padded.rise[p]), conducts = heat_row(&padded.conductivity[p]),
                    tissue = heat_row(&padded.tissue[p]);
      HeatRow flow = HeatRow::Zero(), open = HeatRow::Constant(6);
      for (const std::ptrdiff_t n : kBeside) {
        const HeatRow beside = heat_row(&padded.tissue[p] + n);
        flow += (heat_row(&padded.conductivity[p] + n) * tissue + conducts * beside) *
                (heat_row(&padded.rise[p] + n) - rise);
        open -= beside;
      }
      const HeatRow flows = (1 - heat_row(&block.damage[c])).max(0.0f);
      const HeatRow skin = Eigen::Map<const Eigen::Array<bool, kEdge, 1>>(&block.skin[c]).cast<float>();
      const HeatRow blood = blood_w_per_k * tissue * flows * rise, gas = gas_w_per_k * tissue * skin * open * rise;
      const HeatRow warms = static_cast<float>(dt) * (half_edge * flow - blood - gas) / heat_row(&block.capacity[c]);
      Eigen::Map<HeatRowDouble>(&block.next_k[c]) =
          Eigen::Map<const HeatRowDouble>(&block.rise_k[c]) + warms.cast<double>();
      perfused += blood;
      to_gas += gas;
    }
  return {dt * perfused.cast<double>().sum(), dt * to_gas.cast<double>().sum()};
}

}  // namespace trocar
