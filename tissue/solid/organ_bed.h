// The bed between two organs of one solid: connective tissue that holds the one on the other until it is peeled off,
// and the contact of their surfaces, with it and without.
//
//   link       for every vertex of the second organ (part 1) that at rest lies within `reach_m` of the first (part 0),
//              facing it, with the vertex's area a. Its ends are one place at rest, hung on the cells of either organ:
//              what they are apart is delta, whatever both have turned to
//   traction   t = k (1 - d) delta: up to the strength sigma at sigma / k, from there down to nothing at 2 g / sigma,
//   so
//              that it takes the energy g per area (bilinear: Geubelle and Baylor 1998); back to the origin when it is
//              let go. k = 2 sigma^2 / g, the peak at a quarter of the whole way
//   lattice    a front is never sharper than a cell of edge h: its row lets go at once, and what it held of the softer
//              organ's modulus E, sigma^2 h / 2 E per area, is lost. So g is the tissue's energy G less that, and sigma
//              the tissue's strength, at most sqrt(E G / h), of which the cells lose half of G (a weaker bed of the
//              same energy peels as the strong one does: Turon et al. 2007). Finer or stiffer cells come to g = G
//   mode       the way that counts is sqrt(<delta_n>^2 + delta_s^2 / m): sliding off takes m g, and sqrt(m) sigma
//   release    what a link bears falls by at most sigma h / release_s in a step: none lets go at once, so no tool feels
//              a step
//   weakened   heat takes from sigma and g of a link alike; what a hook vaporises is released
//   contact    p = k_c y (y < s: y^2 / 2 s) of how far a vertex of part 1 is beyond the surface of part 0, along the
//              normal of its nearest triangle; begins at `contact_m`, for what lay nearer at rest where it lay
// All are ties of the solid's step (SoftTie), so implicit: no step is too long for their stiffness. Frame T, SI.
// Thread: tissue task. Same input, same bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tissue/solid/cut_lattice.h"
#include "tissue/solid/soft_solid.h"

namespace trocar {

/// Strength and energy of the bed of a gallbladder: 10 to 40 kPa, 20 to 60 J/m2, from memory.
struct BedOptions {
  double strength_pa = 20e3;      ///< sigma
  double energy_j_per_m2 = 40;    ///< G
  double shear_energy = 2;        ///< m; a choice
  double reach_m = 0.0035;        ///< of the gap at rest that is bed: an imported organ's voxels and smoothing
  double facing_cosine = -0.5;    ///< of both surfaces' normals: above it they do not face each other
  double release_s = 0.030;       ///< of a link from whole to free, at least
  double contact_pa_per_m = 4e7;  ///< k_c: 10 kPa press 0.25 mm in; a choice
  double contact_m = 0.0005;      ///< y = 0 there, and s
  double heat_leaves = 0.2;       ///< of sigma and G where all collagen is denatured; a choice
};

/// Whether any of part 1 faces part 0, so that there is a bed between them.
bool faces(const CutLattice& lattice, const BedOptions& options);

class OrganBed {
 public:
  struct Link {
    std::int32_t vertex = 0;               ///< of part 1
    std::int32_t below = 0;                ///< of part 0, on whose cell it hangs
    std::array<std::int32_t, 3> facing{};  ///< triangle of part 0, by vertices, whose normal is that of the link
    double area_m2 = 0;
    double furthest_m = 0;  ///< the way that counts, so far
    double damage = 0;      ///< d, 0 .. 1
    double holds = 1;       ///< traction that it bears at most now, of sigma
    double softened = 0;    ///< by heat: share of sigma and g that is gone
    bool vaporised = false;
    Vec3f apart = Vec3f::Zero();  ///< delta after the last step
    bool free() const { return holds <= 0; }
  };

  /// @param young_pa of the softer organ. @throws InputError: no place of part 1 faces part 0, an option that is none
  OrganBed(const CutLattice& lattice, const BedOptions& options, double young_pa);

  /// The lattice has been cut: the same links on the cells that there are now.
  void follow_cut(const CutLattice& lattice);
  /// Before the solid's step: its ties. @param surface as it is now
  void bind(const CutLattice& lattice, const SurfaceSnapshot& surface, SoftSolid& solid);
  /// After it: what has been damaged.
  void wear(const SoftSolid& solid, double step_s);

  /// From the next step on a link keeps this share of its strength, or less: heat. @param softened 0 .. 1
  void soften(std::size_t link, double softened);
  /// Lets go of the links that pass within the radius of a place, as the surfaces are now. @return how many
  int vaporise(const Vec3& place_T, double radius_m, const SurfaceSnapshot& surface);

  std::span<const Link> links() const { return links_; }
  std::size_t contacts() const { return contacts_; }  ///< of the last step
  /// Links that the last wear() has set free, by number.
  std::span<const std::int32_t> freed() const { return freed_; }
  double area_m2() const { return area_; }
  double free_share() const { return free_area_ / area_; }   ///< of the bed, 0 .. 1
  double damage_share() const { return damage_ / area_; }    ///< mean of d, 0 .. 1
  double taken_j() const { return taken_; }                  ///< by damage, so far
  double energy_j() const { return energy_; }                ///< held by links and contacts after the last wear()
  double strength_pa() const { return strength_; }           ///< sigma of the links, and
  double energy_j_per_m2() const { return energy_per_m2_; }  ///< g

 private:
  /// A vertex of part 1 that may touch part 0.
  struct Toucher {
    std::int32_t vertex = 0, nearest = 0;  ///< vertex of part 0, followed from step to step
    double area_m2 = 0, begins_m = 0;      ///< gap from which it is pressed
    bool near = true;                      ///< so that it is looked at in every step
  };
  struct Foot {
    std::int32_t triangle = -1;
    Vec3 place = Vec3::Zero(), normal = Vec3::UnitZ();
    Barycentric weight{};
    double gap_m = 0;  ///< along the normal, < 0 inside
  };
  double stiffness() const;                                   ///< k, Pa/m
  double left_at(double way_m) const;                         ///< of sigma, that is borne at this way at most
  double way(const Vec3f& apart, const Vec3f& normal) const;  ///< that counts
  /// Of sigma, that a link bears at most a step after it bore `holds`, once it has gone so far.
  double next_hold(const Link& link, double furthest_m, double step_s) const;
  double damage(const Link& link, double holds, double furthest_m) const;
  /// The nearest place of part 0, of the triangles round a vertex of it.
  Foot foot_round(std::int32_t vertex, const Vec3& place, const TriangleSurface& surface) const;
  void find_rings(const TriangleSurface& rest);
  void find_touchers(const CutLattice& lattice);
  void find_links(const CutLattice& lattice);
  void hang_links(const CutLattice& lattice);
  void add_contacts(const CutLattice& lattice, const SurfaceSnapshot& surface, SoftSolid& solid);

  BedOptions options_;
  double strength_ = 0, energy_per_m2_ = 0;
  std::vector<Link> links_;
  std::vector<SoftTie> hung_;  ///< of each link
  std::vector<Toucher> touchers_;
  std::vector<std::size_t> first_round_;  ///< of each vertex: from there on in:
  std::vector<std::int32_t> round_;       ///< triangles
  std::vector<std::int32_t> freed_;
  std::size_t contacts_ = 0, looks_ = 0;
  double area_ = 0, free_area_ = 0, damage_ = 0, taken_ = 0, energy_ = 0, contact_energy_ = 0;
};

}  // namespace trocar
