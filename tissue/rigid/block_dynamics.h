// Free blocks or rings on a board with pegs: they fall, land without bouncing, tip over, hang on pegs, are pushed by
// the instrument and come to rest.
//
// Sequential impulses (Catto, Iterative dynamics with temporal coherence, GDC 2005) on the contact points of a
// sub-step, Coulomb friction by a clamped tangential impulse, overlap removed at a limited speed. The instrument and a
// held block are kinematic: they push with at most stiffness times overlap, so a block pinned against the board yields
// like foam. Frame T, SI units. Deterministic. Thread: tissue task.
#pragma once

#include <vector>

#include "tissue/rigid/rigid_body.h"
#include "tissue/rigid/rigid_scene.h"

namespace trocar {

/// A part of the instrument that pushes: a capsule and the rigid motion that carries it.
struct Pusher {
  CapsuleShape shape;
  Vec3 velocity_T = Vec3::Zero(), spin_T = Vec3::Zero(), about_T = Vec3::Zero();
  int spares = -1;  ///< index of a body that it does not push
};

struct BlockDynamicsSettings {
  double floor_z_m = 0;  ///< height of the board and of the table round it
  double friction = 0.6, peg_friction = 0.2;
  double push_stiffness_n_per_m = 300;  ///< of a block against what pushes it
  std::vector<PegPost> pegs = {};
};

class BlockDynamics {
 public:
  explicit BlockDynamics(const BlockDynamicsSettings& settings) : settings_(settings) {}

  /// Advances all free bodies. @param pushers where they are at the END of the step.
  void step(std::vector<RigidBody>& bodies, const std::vector<Pusher>& pushers, double dt_s);

 private:
  struct Joint {
    int a = -1, b = -1;  ///< bodies; b < 0: the floor or a pusher
    RigidContact contact;
    Vec3 other_T = Vec3::Zero();  ///< velocity of what is not a body
    double friction = 0;
    double most = 0, pushed = 0;  ///< limit and sum of the normal impulse, N s
    Vec3 rubbed = Vec3::Zero();   ///< sum of the tangential impulse
  };
  void collect(std::vector<RigidBody>& bodies, const std::vector<Pusher>& pushers, double ahead_s, double dt_s);
  void collect_pushes(RigidBody& body, int index, const std::vector<Pusher>& pushers, double ahead_s, double dt_s);
  void collect_pegs(const RigidBody& body, int index);
  void collect_pair(std::vector<RigidBody>& bodies, int a, int b, double dt_s);
  void solve(std::vector<RigidBody>& bodies, Joint& joint, double dt_s) const;
  void settle(RigidBody& body, int index, double dt_s) const;

  BlockDynamicsSettings settings_;
  std::vector<Joint> joints_;
};

}  // namespace trocar
