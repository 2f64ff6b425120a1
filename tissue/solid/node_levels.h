// Ever coarser lattices over the nodes of a soft solid: a preconditioner whose iterations do not grow with the number
// of cells.
//
// The nodes of a level are those grid points of twice the spacing between which the finer level's nodes lie; a finer
// node takes from the up to eight round it (trilinear, P). With a scalar for every node of every level, D_l,
//   z = sum over levels of P_1 .. P_l D_l^-1 P_l^T .. P_1^T r
// is multilevel diagonal scaling (Bramble, Pasciak, Xu 1990; Zhang 1992): symmetric and positive definite whatever the
// D_l > 0, so conjugate gradients may use it, and with no product of any coarser matrix. D_l of the stiffness goes down
// with the spacing as that of an element does, h E from h^3 / h^2; of masses and springs to the outside it is their
// sum. What is isotropic stays so however the tissue turned, and nodes doubled by a cut share their place, and so all
// coarser ones. Sums in fixed order. Thread: that of the solid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tissue/solid/node_row.h"

namespace trocar {

class NodeLevels {
 public:
  /// @param place grid point of each node, >= 0; several may share one.
  explicit NodeLevels(std::span<const std::array<std::int32_t, 3>> place = {});

  /// @param stiffness, outside: of each node, the diagonal of what cells give and that of all else. N/m
  void set_diagonals(std::span<const float> stiffness, std::span<const float> outside);
  /// Forgets the springs.
  void reset();
  /// A spring more, to the outside.
  void add_spring(std::span<const std::int32_t> node, std::span<const float> share, float stiffness);
  /// Takes the residual to all coarser levels. @return what they add to r . z
  double restrict(std::span<const NodeRow> residual);
  /// direction <- z + beta direction, z with the finest level's own part.
  void advance(std::span<const NodeRow> finest, float beta, std::span<NodeRow> direction);

 private:
  struct Link {
    std::int32_t node;
    float share;
  };
  /// Rows of links: those of i from first[i] to first[i + 1].
  struct Links {
    std::vector<std::int32_t> first;
    std::vector<Link> link;
  };
  struct Level {
    Links parents;   ///< of the finer level's nodes, here
    Links children;  ///< the same by the nodes here
    std::vector<float> stiffness, outside, inverse;
    std::vector<NodeRow> value;
  };
  void restrict_level(std::span<const NodeRow> finer, Level& level);

  std::vector<Level> levels_;
};

}  // namespace trocar
