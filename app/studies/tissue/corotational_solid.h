// A peer of the soft solid: corotational linear tetrahedra (Mueller and Gross 2004), implicit Euler, one linearisation.
//
// As the soft solid in all but the element and what a regular lattice gives: each tetrahedron turns with the rotation R
// of its gradient, warm-started, its force is V R (2 mu e + lambda tr e) for e the symmetric part of R^T F - 1; a step
//   [(1 + h alpha) M + h^2 (K + K_support)] v = M v0 + h f(x0)
// by conjugate gradients from the last velocity, preconditioned by the diagonal. Nothing is assembled: products go
// tetrahedron by tetrahedron, eight to a vector, in the order of a space-filling curve. Thread: any.
#pragma once

#include <vector>

#include "app/studies/tissue/peer_body.h"
#include "tissue/solid/node_row.h"

namespace trocar {

struct TetrahedraGroup;

struct CorotationalOptions {
  double step_s = 0.010;
  double mass_damping_per_s = 1;
  double tolerance = 1e-2;  ///< of the residual against the right-hand side
  int most_iterations = 500;
};

class CorotationalSolid {
 public:
  CorotationalSolid(const PeerBody& body, const CorotationalOptions& options);
  ~CorotationalSolid();

  /// A spring to where the node rests, N/m; and a constant force, N. Both add.
  void hold(std::int32_t node, double stiffness_n_per_m);
  void load(std::int32_t node, const Vec3& force_n);
  void step();

  std::size_t node_count() const { return mass_.size() - 1; }
  Vec3 displacement(std::int32_t node) const;
  /// Elastic, of supports and kinetic, J.
  double energy_j() const;

 private:
  struct Turned;   ///< rotations of eight
  void prepare();  ///< rotations, elastic force and the diagonal at the present place
  void add_product(const std::vector<NodeRow>& in, std::vector<NodeRow>& out) const;
  void solve();

  CorotationalOptions options_;
  std::vector<TetrahedraGroup> groups_;
  std::vector<Turned> turned_;
  std::vector<float> mass_, support_;
  std::vector<NodeRow> displacement_, velocity_, load_, elastic_, diagonal_, inverse_;
  std::vector<NodeRow> right_, residual_, direction_, product_;
};

}  // namespace trocar
