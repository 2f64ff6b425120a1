// A membrane: a sheet of tissue that stretches and bends, one implicit step at a time. Peritoneum, mesentery, a flap,
// gauze.
//
// Triangles of its middle surface. Energies against the drawn shape, which is at rest: of stretch, plane stress with
// Green's strain (St. Venant and Kirchhoff), E h / (1 - nu^2) per area; of bending, D (|e|^2 / (A_1 + A_2)) theta^2 / 2
// an inner edge, D = E h^3 / (12 (1 - nu^2)), theta the change of its dihedral angle: the bending energy of an
// isotropic plate on equilateral triangles (discrete shells, Grinspun et al. 2003; the factor for such meshes is ours).
// A step is implicit Euler as that of the rod (elastic_rod.h): Newton's method with a matrix kept positive
// (Gauss-Newton, and the stress stiffness of what is pulled), a sparse direct solve, a line search; dissipative at any
// step length.
//
// A node is cut into as many as its triangles fall apart into. Numbers of triangles stay; those of new nodes follow.
// Frame T or any other, SI. Thread: tissue task; same input, same bytes. What is not finite among the inputs of a step
// counts as not there.
#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "haptics/exchange/material_point.h"
#include "haptics/quantities.h"
#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/solid/tissue_material.h"

namespace trocar {

struct SheetOptions {
  double thickness_m = 0.001;
  double young_pa = 20000;
  double poisson = 0.45;
  double density_kg_m3 = 1060;
  double mass_damping_per_s = 1;  ///< of the motion of the whole
  double bend_damping_s = 0.02;   ///< of bending, over its stiffness: what is folded does not ring (a choice)
  Vec3 gravity_m_s2 = Vec3::Zero();
  double tear_n_per_m = 300;  ///< tension at which it tears (rupture_n_per_m of the tissue)
  double overload_s = 0.020;  ///< how long that must be passed (tissue.md 3)
  double most_speed_m_s = 5;  ///< that a node carries into the next step (a choice)
  double step_s = 0.010;
  double tolerance_m = 1e-7;  ///< Newton's method stops with a correction below this
  int most_iterations = 8;

  double bending_j() const;  ///< D
};

/// A sheet of a tissue of assets/tissues.toml.
SheetOptions sheet_options(const TissueSolid& tissue, double thickness_m);

/// A flat rectangle of about equilateral triangles of this edge, corner at the origin, along x and y, up +z.
/// @throws InputError when an extent or the edge is none
TriangleSurface rectangular_sheet(double along_m, double across_m, double edge_m);

/// A spring between a place of the sheet and something outside, along one direction; as SoftSpring.
struct SheetSpring {
  MaterialPoint place;
  Vec3 direction = Vec3::UnitZ();  ///< unit
  double stiffness_n_per_m = 0;
  double stretch_m = 0;  ///< before the step, with what it leads to where it will be: force on the sheet is -k stretch
  bool pushes_only = false;  ///< a contact: without force where the stretch becomes negative
  double force_n = 0;        ///< after the step: k stretch, along -direction on the sheet
};

/// What a node hangs on.
struct SheetAnchor {
  std::int32_t node = 0;
  Vec3 position = Vec3::Zero();  ///< before the step, m
  Vec3 velocity = Vec3::Zero();  ///< over the step, m/s
  double stiffness_n_per_m = 500;
  Vec3 force = Vec3::Zero();  ///< of the sheet ON what it hangs on, after the step, N
};

/// A blade: what of the sheet's edges lies within this distance of the line is cut.
struct SheetCut {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  double reach_m = 0.003;
};

using SheetEdge = std::array<std::int32_t, 2>;  ///< nodes, the lower number first

/// Parts triangles along edges: those round a node that no longer hang together get a copy of it each, numbered on from
/// `nodes`. @return of each copy the node that it is one of
std::vector<std::int32_t> part_triangles(std::vector<std::array<std::int32_t, 3>>& triangles, std::int32_t nodes,
                                         std::span<const SheetEdge> edges);

class ElasticSheet {
 public:
  /// @param drawn manifold with or without boundary: its middle surface at rest.
  /// @throws InputError when it is no such surface or the options are no sheet's
  ElasticSheet(const TriangleSurface& drawn, const SheetOptions& options);

  /// Hangs a node on something, or says where that is now.
  void anchor(const SheetAnchor& to);
  void let_go(std::int32_t node);
  std::span<const SheetAnchor> anchors() const { return anchors_; }
  /// Of each anchor: how the sheet's force on it grows as it gives way within a step, N/m. Before the first step, and
  /// after a tear, that of the anchor itself.
  std::vector<Mat3> anchor_stiffness() const;

  /// One step. @param springs their force_n is filled in.
  void step(std::span<SheetSpring> springs = {});
  /// Static equilibrium by steps without inertia; for tests and studies. @param springs their stretch is that of the
  /// sheet's new place. @return steps taken
  int settle(std::span<SheetSpring> springs = {}, double still_m = 1e-8, int most_steps = 400);

  /// The chain of edges that runs nearest to a line, in its order; empty: none is near enough.
  std::vector<SheetEdge> chain(const SheetCut& line) const;
  /// Parts it along edges. @return length of what was cut, m; 0: nothing came apart
  double part(std::span<const SheetEdge> edges);
  double cut(const SheetCut& line) { return part(chain(line)); }
  std::span<const SheetEdge> torn() const { return torn_; }  ///< in the last step

  const SheetOptions& options() const { return options_; }
  std::span<const Vec3> position() const { return position_; }
  std::span<const Vec3> velocity() const { return velocity_; }
  std::span<const Vec3> before() const { return before_; }  ///< the last step
  std::span<const std::array<std::int32_t, 3>> triangles() const { return triangles_; }
  std::span<const std::int32_t> copied() const { return copied_; }  ///< of each node added by cuts: of which one
  std::uint64_t topology() const { return topology_; }              ///< counts the cuts and tears
  std::uint64_t held_steps() const { return held_steps_; }          ///< steps that found no finite answer: all stood
  int iterations() const { return iterations_; }                    ///< of the last step
  Vec3 place_T(const MaterialPoint& place) const;
  /// Largest principal tension of a triangle now, N/m.
  double tension_n_per_m(std::int32_t triangle) const;
  /// Displacement per newton of a place along a direction within a step, m/N, linearised at the last one; 0: unknown.
  double compliance(const MaterialPoint& place, const Vec3& direction) const;

  /// For tests and scenes: sets where the nodes are, at rest. Points that are not finite stay.
  void place(std::span<const Vec3> position);
  double energy_j() const;  ///< elastic, of anchors too, and kinetic; without gravity and springs
  Vec3 momentum() const;    ///< N s
  double mass_kg() const;
  double mean_area_m2() const;  ///< of a triangle at rest

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  struct Rest {               ///< of a triangle
    Eigen::Matrix2d inverse;  ///< of its edges in its own plane
    double area_m2 = 0, over_s = 0;
  };
  struct Hinge {  ///< an inner edge: its ends, then the corner of either side
    std::array<std::int32_t, 4> node;
    double rest_rad = 0, stiffness_j = 0, last_rad = 0;
  };
  void connect();
  void lay_out_matrix();
  /// Adds to the lower half; what lies above is left out.
  void add_block(Matrix& to, std::int32_t row, std::int32_t column, const Mat3& block) const;
  /// dx / dX of a triangle.
  Eigen::Matrix<double, 3, 2> gradient(std::size_t triangle, std::span<const Vec3> at) const;
  double stretch(std::size_t triangle, std::span<const Vec3> at, std::array<Vec3, 3>* pull, Matrix* stiffness) const;
  double objective(std::span<const SheetSpring> springs, std::span<const Vec3> at, Eigen::VectorXd* downhill,
                   Matrix* stiffness) const;
  /// @return share of the way that was gone, 0: none
  double search_line(std::span<const SheetSpring> springs, const Eigen::VectorXd& way, double slope);
  void accept(std::span<SheetSpring> springs);
  void tear();
  double stretch_of(const SheetSpring& spring, std::span<const Vec3> at) const;

  SheetOptions options_;
  std::vector<Vec3> drawn_, position_, velocity_, before_, now_, next_;
  std::vector<std::int32_t> copied_;
  std::vector<SheetEdge> torn_;
  std::vector<double> mass_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::vector<Rest> rest_;
  std::vector<Hinge> hinges_;
  std::vector<SheetAnchor> anchors_;
  std::vector<std::vector<std::int32_t>> below_;  ///< of each node: those of no lower number that it shares energy with
  Matrix matrix_;                                 ///< its lower half, in 3 x 3 blocks of nodes
  std::unique_ptr<Eigen::SimplicialLDLT<Matrix>> solver_ = std::make_unique<Eigen::SimplicialLDLT<Matrix>>();
  bool factored_ = false, statics_ = false;
  double energy_now_ = 0;
  std::uint64_t topology_ = 0, held_steps_ = 0;
  int iterations_ = 0;
};

}  // namespace trocar
