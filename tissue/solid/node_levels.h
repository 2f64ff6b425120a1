// Ever coarser lattices over the nodes of a soft solid: a preconditioner whose iterations hardly grow with the number
// of cells.
//
// The nodes of a level are those grid points of twice the spacing between which the finer level's nodes lie; a finer
// node takes equal shares of the one, two, four or eight round it (trilinear, P). With a scalar D_l for every node of
// every level,
//   z = sum over levels of P_1 .. P_l D_l^-1 P_l^T .. P_1^T r
// is multilevel diagonal scaling (Bramble, Pasciak, Xu 1990; Zhang 1992): symmetric and positive definite whatever the
// D_l > 0, so conjugate gradients may use it, and without any coarser matrix. The diagonal of the stiffness goes down
// with the spacing as that of an element does, edge^3 / edge^2; that of masses and springs to the outside is their sum.
// What is isotropic stays so however the tissue turned.
//
// A cut goes through all levels (Dick, Georgii, Westermann 2011): a coarser cell is what hangs together of the finer
// ones in its place, and neighbours share corners where finer cells of theirs share a node. So both lips of a cut have
// coarser nodes of their own. Sums in fixed order. Thread: that of the solid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tissue/solid/node_row.h"

namespace trocar {

/// A cube of a lattice: several may have one place.
struct PlacedCell {
  std::array<std::int32_t, 3> place{};  ///< >= 0
  std::array<std::int32_t, 8> node{};   ///< corners: bits 1 = +x, 2 = +y, 4 = +z
};

class NodeLevels {
 public:
  explicit NodeLevels(std::span<const PlacedCell> cells = {}, std::size_t node_count = 0);

  /// Without springs. @param stiffness, outside: of each node, the diagonal of what cells give and that of all else.
  /// N/m
  void set_diagonals(std::span<const float> stiffness, std::span<const float> outside);
  /// Forgets the springs.
  void reset();
  /// A spring more, to the outside.
  void add_spring(std::span<const std::int32_t> node, std::span<const float> share, float stiffness);

  /// Takes the residual r to all coarser levels. @return what they add to r . z
  double coarsen(std::span<const NodeRow> residual);
  /// direction <- z + beta direction, where z = inverse r + what coarsen() left on the coarser levels;
  /// product <- shift direction.
  void advance(std::span<const float> inverse, std::span<const NodeRow> residual, float beta,
               std::span<const float> shift, std::span<NodeRow> direction, std::span<NodeRow> product);

 private:
  /// A finer node as its coarser one sees it: share 2^-halvings.
  struct Child {
    std::uint32_t node : 30, halvings : 2;
  };
  struct Level {
    std::vector<std::int32_t> first_parent, parent;  ///< of finer node i: from first_parent[i] to first_parent[i + 1]
    std::vector<std::int32_t> first_child;
    std::vector<Child> child;
    std::vector<float> stiffness, outside, inverse;
    std::vector<NodeRow> value;
  };
  /// @return the coarser cells, with the numbers of the level's nodes
  static std::vector<PlacedCell> find_parents(std::span<const PlacedCell> cells, std::size_t node_count, Level& level);
  static void find_children(Level& level);
  static void coarsen_onto(Level& level, const NodeRow* finer);

  std::vector<Level> levels_;
};

}  // namespace trocar
