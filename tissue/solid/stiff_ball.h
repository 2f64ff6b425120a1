// Balls of stiffer tissue in an organ that gives way: they are felt, and nothing of the surface shows them.
//
// A cell that holds a share f of a ball becomes as stiff as a mixture of spheres in what is round them (Mori and Tanaka
// 1973, volume kept: E / E_0 = 1 + f (r - 1) / (1 + 2/5 (1 - f) (r - 1)) for spheres r times as stiff). Under the tool,
// nearer than cells can tell, a half-space under a point force bears it by a stress along the radius alone,
// 3 F cos(angle) / (2 pi d^2) (Boussinesq, volume kept), so its energy lies in cos^2 / d^4: the share of it in a ball,
// times 1 - 1/r, is what the ball takes from the compliance, to the first order. Within 4 a / pi of a contact of radius
// a nothing lies: so the force's energy is that of the contact. Frame of the lattice, m. Thread: any.
#pragma once

#include <span>

#include "tissue/solid/lattice.h"

namespace trocar {

struct StiffBall {
  Vec3 centre_m = Vec3::Zero();
  double radius_m = 0;
  double ratio = 1;  ///< of its stiffness to that of what is round it, > 0
};

/// Stiffness of a mixture over that of what is round the spheres. @param share of the spheres in it, 0 .. 1
double mixed_stiffness(double share, double ratio);

/// Of a cell over that of its material: 1 but in the first part, where balls reach into it.
double cell_stiffness(const Lattice& lattice, const LatticeCell& cell, std::span<const StiffBall> balls);

/// Of a half-space over that of what it is made of, as a contact feels it. @param inward unit, into the half-space
double stiffer_under(const Vec3& place, const Vec3& inward, double contact_radius_m, std::span<const StiffBall> balls);

}  // namespace trocar
