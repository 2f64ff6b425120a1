// A peer of the soft solid: extended position based dynamics on linear tetrahedra, neo-Hookean, in substeps.
//
// Macklin, Mueller and Chentanez 2016 (compliances 1 / (k h^2)), Macklin et al. 2019 (small steps, one pass each),
// Macklin and Mueller 2021 (the material): two constraints a tetrahedron,
//   C_D = sqrt(tr F^T F), compliance 1 / (mu V),   C_H = det F - 1 - mu / lambda', compliance 1 / (lambda' V),
// with lambda' = lambda + mu, so that in the small it is Hooke's law. Both are solved together, a 2 x 2 system: one
// after the other, the two pull an unloaded body to and fro. Gauss-Seidel by colours of tetrahedra that share no node,
// eight to a vector. Thread: any.
#pragma once

#include <vector>

#include "app/studies/tissue/peer_body.h"
#include "tissue/solid/node_row.h"

namespace trocar {

struct TetrahedraGroup;

struct XpbdOptions {
  double step_s = 0.010;
  int substeps = 20;
  double mass_damping_per_s = 1;
};

class XpbdSolid {
 public:
  XpbdSolid(const PeerBody& body, const XpbdOptions& options);
  ~XpbdSolid();

  /// A spring to where the node rests, N/m; and a constant force, N. Both add.
  void hold(std::int32_t node, double stiffness_n_per_m);
  void load(std::int32_t node, const Vec3& force_n);
  void step();

  std::size_t node_count() const { return inverse_mass_.size() - 1; }
  Vec3 displacement(std::int32_t node) const;
  /// Elastic, of supports and kinetic, J.
  double energy_j() const;

 private:
  void substep();

  XpbdOptions options_;
  std::vector<TetrahedraGroup> groups_;
  std::vector<float> inverse_mass_, support_;
  std::vector<NodeRow> displacement_, before_, velocity_, load_;  ///< fourth of a displacement: inverse mass
};

}  // namespace trocar
