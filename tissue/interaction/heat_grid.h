// Where an organ is warm: a sparse grid of cubes in its shape at rest, in blocks of 8 x 8 x 8 that exist only where
// heat is or has done damage.
//
// A cube belongs to the tissue when its middle lies inside the closed surface at rest (crossings of columns,
// mesh/surface/column_samples.h). Cube (i, j, k) reaches from edge (i, j, k) to edge (i + 1, j + 1, k + 1). A block in
// which nothing is tissue has no storage. Frame T at rest, m. Thread: tissue task. Blocks are visited by their index:
// same input, same bytes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "tissue/surface_snapshot.h"

namespace trocar {

enum class HeatCell : std::uint8_t { kOutside, kTissue, kVaporised };

struct HeatBlock {
  static constexpr int kEdge = 8, kCells = kEdge * kEdge * kEdge;
  using Index = std::array<int, 3>;

  /// Of the block beside a side: -x +x -y +y -z +z.
  static Index beside_index(Index index, std::size_t side) {
    index[side / 2] += side % 2 == 0 ? -1 : 1;
    return index;
  }
  static std::size_t cell(int i, int j, int k) { return static_cast<std::size_t>(i + kEdge * (j + kEdge * k)); }

  Index index{};                       ///< of the block: its first cube is 8 times it
  std::array<HeatBlock*, 6> beside{};  ///< -x +x -y +y -z +z; nullptr: none, or no tissue
  std::array<HeatCell, kCells> state{};
  std::array<bool, kCells> skin{};                 ///< beside a cube that is no tissue
  std::array<double, kCells> rise_k{};             ///< above the body's temperature
  std::array<double, kCells> water{};              ///< share that is left of the tissue's water
  std::array<float, kCells> conductivity{};        ///< W/(m K), 0 outside
  std::array<float, kCells> capacity{};            ///< J/K of the cube, as `water` has it
  std::array<double, kCells> next_k{};             ///< rise after the step
  std::array<float, kCells> damage{}, collagen{};  ///< Arrhenius integrals of cells and of collagen
  std::array<float, kCells> charred{};             ///< share
  std::vector<std::int32_t> watchers;              ///< vertices of the surface whose look these cubes decide
  double hottest_k = 0;                            ///< most of rise_k
  bool awake = false;                              ///< takes part in the steps
  bool wanted = false;                             ///< heat came to it in this step
  bool looks_different = false;                    ///< since the vertices were last looked at
};

struct HeatCube {
  HeatBlock* block = nullptr;
  std::size_t cell = 0;
};

class HeatGrid {
 public:
  /// @param edge_m of a cube
  explicit HeatGrid(double edge_m) : edge_m_(edge_m) {}

  /// @param rest_T closed. Blocks that exist keep their cubes until examine().
  void set_surface(SurfacePtr rest_T);
  const TriangleSurface& surface() const { return *rest_T_; }

  double edge_m() const { return edge_m_; }
  double volume_m3() const { return edge_m_ * edge_m_ * edge_m_; }  ///< of a cube
  /// The cube in which a coordinate lies.
  int cube_at(double coordinate_m) const { return static_cast<int>(std::floor(coordinate_m / edge_m_)); }
  Vec3 middle(int i, int j, int k) const { return edge_m_ * Vec3(i + 0.5, j + 0.5, k + 0.5); }
  Vec3 middle(const HeatBlock& block, std::size_t cell) const;

  /// nullptr: not there, or nothing in it is tissue.
  HeatBlock* find(const HeatBlock::Index& index) const;
  /// The block, made if need be. @param fresh set when it was made. @return nullptr: nothing in it is tissue.
  HeatBlock* need(const HeatBlock::Index& index, bool& fresh);
  /// Tells again which cubes are tissue: of a block over which the surface has changed. What is vaporised stays so.
  void examine(HeatBlock& block) const;
  void free(HeatBlock& block);
  void clear() { blocks_.clear(); }
  /// Forgets which blocks have nothing in them: the surface has changed.
  void forget_empty();
  /// One cube is tissue no more.
  void vaporise(HeatBlock& block, std::size_t cell);
  /// The cube beside a side (-x +x -y +y -z +z) of a cube. Its block may be none.
  HeatCube beside(HeatBlock& block, std::size_t cell, std::size_t side) const;

  /// All with tissue in them, by index.
  template <typename Visit>
  void for_blocks(Visit visit) const {
    for (const auto& [index, block] : blocks_)
      if (block) visit(*block);
  }
  /// Blocks that a box touches, there or not. @param visit (index)
  template <typename Visit>
  void for_indices(const Vec3& low, const Vec3& high, Visit visit) const {
    HeatBlock::Index from{}, to{};
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = block_of(cube_at(low[axis]));
      to[axis] = block_of(cube_at(high[axis]));
    }
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i) visit(HeatBlock::Index{i, j, k});
  }
  /// Cubes of the blocks that are there whose middle lies within a box. @param visit (block, cell, middle)
  template <typename Visit>
  void for_cells(const Vec3& low, const Vec3& high, Visit visit) const {
    for_indices(low, high, [&](const HeatBlock::Index& index) {
      HeatBlock* const block = find(index);
      if (block == nullptr) return;
      std::array<int, 3> from{}, to{};
      for (int axis = 0; axis < 3; ++axis) {
        const int first = HeatBlock::kEdge * index[axis];
        from[axis] = std::max(0, static_cast<int>(std::ceil(low[axis] / edge_m_ - 0.5)) - first);
        to[axis] = std::min(HeatBlock::kEdge - 1, static_cast<int>(std::floor(high[axis] / edge_m_ - 0.5)) - first);
      }
      for (int k = from[2]; k <= to[2]; ++k)
        for (int j = from[1]; j <= to[1]; ++j)
          for (int i = from[0]; i <= to[0]; ++i)
            visit(*block, HeatBlock::cell(i, j, k),
                  middle(i + HeatBlock::kEdge * index[0], j + HeatBlock::kEdge * index[1],
                         k + HeatBlock::kEdge * index[2]));
    });
  }
  /// Mean between the middles of the cubes round a place, of tissue and, if asked for, of what is vaporised; wider
  /// where there is none next to it. @param value (block, cell). @return `none` where nothing is
  template <typename Value>
  double mean_round(const Vec3& place, double none, bool with_vaporised, Value value) const {
    for (const double width : {1.0, 2.0}) {
      double sum = 0, weights = 0;
      const Vec3 reach = Vec3::Constant(width * edge_m_);
      for_cells(place - reach, place + reach, [&](const HeatBlock& block, std::size_t cell, const Vec3& at) {
        if (block.state[cell] == HeatCell::kOutside) return;
        if (block.state[cell] == HeatCell::kVaporised && !with_vaporised) return;
        const double weight = (1 - (at - place).array().abs() / reach[0]).max(0.0).prod();
        sum += weight * value(block, cell);
        weights += weight;
      });
      if (weights > 0) return sum / weights;
    }
    return none;
  }
  std::size_t blocks() const;  ///< with tissue in them

 private:
  static int block_of(int cube) {
    return cube >= 0 ? cube / HeatBlock::kEdge : -((HeatBlock::kEdge - 1 - cube) / HeatBlock::kEdge);
  }
  TriangleSurface over(const HeatBlock& block) const;
  void join(HeatBlock& block);

  double edge_m_;
  SurfacePtr rest_T_;
  std::vector<std::array<double, 4>> extent_;  ///< of every triangle: x low and high, y low and high
  std::map<HeatBlock::Index, std::unique_ptr<HeatBlock>> blocks_;  ///< nullptr: nothing in it is tissue
};

}  // namespace trocar
