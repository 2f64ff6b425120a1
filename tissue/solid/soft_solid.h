// A soft solid on a lattice of equal cubes: corotational B-bar hexahedra with relaxation, one implicit step at a time.
//
// Each cell turns with the rotation R of its mean gradient F (Mueller 2016, warm-started). Against a change of shape
// its force is R K (R^T x - X), K the deviatoric part of cube_element.h; against one of volume that of kappa V (det F -
// 1)^2 / 2, which in the small is the B-bar dilatation: with the trace instead, a squeeze by 30 % loses 8 % of the
// volume, and a cell under the tool goes soft. Both scaled by fill and strain stiffening. Two Prony branches a cell
// hold a strain e_i
// <- a_i (e_i + g_i / g_inf du), a_i = tau_i / (tau_i + h), that answers as strain does: unconditionally stable and
// dissipative. Strains and not forces, so that stiffening leaves nothing behind on a closed path. A step is implicit
// Euler with one linearisation,
//   [(1 + h alpha) M + h^2 (K_alg + K_support + sum k J^T J)] v = M v0 + h f(x0),  x = x0 + h v,
// by conjugate gradients, from the last velocity and as much of its last change as would have been right a step ago,
// preconditioned on ever coarser lattices (node_levels.h). Nothing is assembled: products go cell by cell, eight cells
// a vector, in the Walsh basis (cell_lanes.h); the solver divides all by h^2. The same operations in the same order on
// every machine: float without contraction, sums by component, no library's exponential.
//
// Positions in the frame that the nodes came in, m; SI. Thread: tissue task; same input, same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "haptics/quantities.h"
#include "tissue/solid/node_levels.h"
#include "tissue/solid/tissue_material.h"

namespace trocar {

using Vec3f = Eigen::Vector3f;

struct SoftCell {
  std::array<std::int32_t, 8> node{};  ///< corners: bits 1 = +x, 2 = +y, 4 = +z
  double fill = 1;                     ///< share of the cube that is tissue, > 0
  std::int32_t material = 0;           ///< index into the materials
  double stiffness = 1;                ///< over that of its material, > 0
};

struct SoftSolidOptions {
  double edge_m = 0.010;
  double step_s = 0.010;
  double mass_damping_per_s = 1;  ///< alpha: of the motion of the whole
  double tolerance = 1e-2;        ///< of the residual against the right-hand side
  int most_iterations = 60;
};

/// A cell after a cut: one that was there, with other corners or another fill, or a new one.
struct SoftCellChange {
  std::int32_t number = 0;  ///< new ones count up from cell_count()
  std::int32_t parent = 0;  ///< whose state it begins with
  std::array<std::int32_t, 8> node{};
  double fill = 0;
};

/// A place on or in the solid as shares of its nodes.
struct NodeShares {
  std::vector<std::int32_t> node;
  std::vector<float> share;  ///< sum 1
};

/// A spring between a place of the solid and something outside, along one direction: contact, friction, grip.
struct SoftSpring {
  NodeShares place;
  Vec3 direction = Vec3::UnitZ();  ///< unit
  double stiffness_n_per_m = 0;
  double stretch_m = 0;  ///< before the step, with what it leads to where it will be: force on the solid is -k stretch
  bool pushes_only = false;  ///< a contact: without force where the stretch becomes negative
  double force_n = 0;        ///< after the step: k stretch, along -direction on the solid
};

/// A bond between two places of the solid: what it pulls with now, and how that grows as they part. Cheaper than the
/// three springs that it stands for, and it stays from step to step.
struct SoftTie {
  static constexpr std::size_t kNodes = 16;  ///< eight of each place
  std::array<std::int32_t, kNodes> node{};
  /// > 0 of the one place, < 0 of the other, sum 0; sum 1: what is outside holds the one; all 0: no bond
  std::array<float, kNodes> share{};
  Vec3f normal = Vec3f::UnitZ();  ///< unit
  float all_n_per_m = 0;          ///< in every direction, and
  float along_n_per_m = 0;        ///< along the normal besides
  Vec3f force_n = Vec3f::Zero();  ///< on the one place, its opposite on the other: before the step, then after it
};

class SoftSolid {
 public:
  /// @param nodes rest positions. @throws InputError: a cell that is no cube of the edge, a material that is none.
  SoftSolid(std::span<const Vec3> nodes, std::span<const SoftCell> cells, std::span<const TissueSolid> materials,
            const SoftSolidOptions& options);
  ~SoftSolid();
  SoftSolid(SoftSolid&&) noexcept;

  /// Adds a spring to where the node rests, the same in every direction. N/m
  void hold(std::int32_t node, double stiffness_n_per_m);
  /// Moves what all supports rest on to so far from where it was at first. @return the work that this does, J
  double carry(const Vec3& shift);
  /// Constant force on a node, N; zero again by the opposite.
  void load(std::int32_t node, const Vec3& force_n);

  /// Doubles nodes and cells where tissue is severed. Positions, velocities, strain and what relaxes are carried over;
  /// mass, supports and loads are shared. What the severed halves held each other with, the tension at rest
  /// (TissueSolid::residual_strain), draws them apart from now on.
  /// @param node_parent of each new node, whose number follows the last one's.
  void sever(std::span<const std::int32_t> node_parent, std::span<const SoftCellChange> cells);

  /// One step. @param springs their force_n is filled in.
  void step(std::span<SoftSpring> springs = {});
  /// Between places of the solid, from the next step on.
  std::vector<SoftTie>& ties() { return ties_; }
  const std::vector<SoftTie>& ties() const { return ties_; }
  /// What the places of a tie are apart now, m.
  Vec3f apart(const SoftTie& tie) const;
  /// Of all solves of the last step.
  int iterations() const { return iterations_; }
  /// Static equilibrium by steps without inertia; for tests and studies. @return steps taken
  int settle(std::span<SoftSpring> springs = {}, double still_m = 1e-7, int most_steps = 200);

  std::size_t node_count() const { return rest_.size() - 1; }
  std::size_t cell_count() const { return cells_.size(); }
  std::span<const Vec3f> rest() const { return {rest_.data(), node_count()}; }
  std::span<const Vec3f> position() const { return {position_.data(), node_count()}; }
  std::span<const Vec3f> velocity() const { return {velocity_.data(), node_count()}; }
  /// For tests and scenes: sets where everything is, at rest.
  void place(std::span<const Vec3f> position);
  const SoftSolidOptions& options() const { return options_; }

  /// Elastic energy, that of the supports and, with velocity, kinetic energy, J; without relaxing branches.
  double energy_j() const;
  /// Elastic force on every node at the present place, N: long-term part and what the branches hold.
  std::vector<Vec3f> elastic_force() const;
  double mass_kg() const;
  double volume_m3() const;  ///< of the cells as they are, by fill

  /// Displacement per newton of a place in a direction when only the nodes within `radius` of it may move: the clamped
  /// neighbourhood, never softer than the truth. @param inertia as the step sees it, else static
  /// @return m/N along the direction
  double compliance(const NodeShares& place, const Vec3& direction, double radius_m, bool inertia) const;
  /// About what a place resists with while all other nodes stand, N/m: from the diagonal, so never softer than the
  /// truth. 0 where no cell is.
  double held_stiffness(const NodeShares& place) const;

 private:
  struct Group;    ///< eight cells, as the matrix knows them
  struct History;  ///< of the same
  /// Tension at rest that a severed node no longer has from its other half.
  struct Release {
    std::size_t node = 0, lane = 0;  ///< lane of a cell that it turns with
    Vec3f force = Vec3f::Zero();     ///< N, at rest
  };

  void add_groups();  ///< for all cells
  void find_levels();
  void resize_rows();  ///< what is computed anew in every step
  void fill_lane(std::size_t cell);
  void copy_lane(std::size_t from, std::size_t to);
  Vec3f turned(const Release& release) const;
  void spread_cells();  ///< masses, and what groups a node has
  void release();
  void prepare();  ///< rotations, relaxation, elastic force and the factors of the matrix at the present place
  void prepare_groups();
  /// out += K in, of these groups.
  void add_product(std::span<const NodeRow> in, std::span<NodeRow> out, std::span<const std::int32_t> groups) const;
  /// out += K in and what springs give, all of the matrix but what shift_ has of it.
  void add_stiffness(std::span<const SoftSpring> springs, const std::vector<bool>& active,
                     const std::vector<NodeRow>& in, std::vector<NodeRow>& out) const;
  void add_ties(const std::vector<NodeRow>& in, std::vector<NodeRow>& out) const;
  void predict();  ///< the guess that the solve begins with
  void set_right(std::span<const SoftSpring> springs, const std::vector<bool>& active);
  void set_inverse(std::span<const SoftSpring> springs, const std::vector<bool>& active);
  void solve(std::span<SoftSpring> springs, const std::vector<bool>& active);
  void set_diagonal();
  float inertia() const;  ///< (1 + h alpha) / h^2: of a kilogram in the step's matrix, N/m

  SoftSolidOptions options_;
  std::vector<Vec3f> rest_, position_, velocity_, elastic_, load_;  ///< last, a node for lanes without a cell
  Vec3f carried_ = Vec3f::Zero();                                   ///< of what the supports rest on
  std::vector<float> mass_, support_;                               ///< of each node
  std::vector<SoftCell> cells_;
  std::vector<std::array<std::int32_t, 3>> places_;  ///< of each cell in the lattice
  std::vector<TissueSolid> materials_;
  std::vector<std::size_t> lane_;   ///< of each cell: its group's number times the lanes and its own in it
  std::vector<std::int32_t> root_;  ///< of each node: of which it was severed
  std::vector<Release> released_;
  std::vector<SoftTie> ties_;
  std::vector<Group> groups_;
  std::vector<History> histories_;
  std::vector<std::int32_t> all_groups_;
  std::vector<std::vector<std::int32_t>> groups_of_node_;
  std::vector<float> stiffness_diagonal_, shift_;  ///< of the step's matrix: of the cells, and inertia and supports
  NodeLevels levels_;
  std::vector<Vec3f> guess_, velocity_next_, velocity_before_, change_;
  std::vector<NodeRow> right_, residual_, direction_, product_, solution_;
  std::vector<float> inverse_;       ///< of the diagonal with springs
  std::vector<float> tie_diagonal_;  ///< of the last step
  int iterations_ = 0;
  bool statics_ = false;  ///< settle(): without inertia
};

}  // namespace trocar
