// Still organs beside one that gives way: it comes to rest against their surfaces and slides along them.
//
//   touches    a vertex of the organ (area a) that is deeper in a neighbour than it was at rest, where both surfaces
//              face each other. What touches or crosses at rest, as segmented organs do, is not pushed apart. It begins
//              `slack_m` below that, so that organs that only lie side by side cost nothing
//   pressure   p = k y of the way y beyond that, from the nearest place of the neighbour's surface outwards: an energy
//              k a y^2 / 2 of the place alone, so a closed path gives none. No friction: serosa is wet
//   one-sided  a spring of a step for what is in, and for what will be at its present speed: foreseen, so nothing
//              strikes a step too late. What parts is held back for that step at most. To let go of what is in but
//              moves out would let every second step through: its speed is no foresight, the spring is too stiff
//   motion     neighbours move together by what carry() says, and are where they will be at the end of the step
// Springs are ties of the solid's step (SoftTie) with one place, so implicit: no step is too long for their stiffness.
// Left out: what is slender, or reaches into the organ (ducts and vessels, which would give way themselves), and pairs
// of a vertex with a neighbour that it lies deep in at rest. Only the organ's vertices touch.
//
// How far a vertex is from touching anything is kept until it may have gone that far: only those are looked at.
// Frame T, SI. Thread: tissue task. Same input, same bytes.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "tissue/mesh/surface/nearest_surface.h"
#include "tissue/solid/cut_lattice.h"
#include "tissue/solid/soft_solid.h"

namespace trocar {

struct NeighbourOptions {
  double stiffness_pa_per_m = 4e6;  ///< k: 2 kPa press 0.5 mm in; a choice: stiffer, solves take longer
  double slack_m = 0.0001;          ///< a choice
  double deep_m = 0.005;            ///< of a crossing at rest that is no voxels' work
  double slender_m = 0.005;         ///< twice volume over area, the radius of a tube: less is left out
  double facing_cosine = 0.2;       ///< of both surfaces' normals: above it they do not face each other
};

class NeighbourContact {
 public:
  /// @param still_T the neighbours' closed surfaces as they lie at first, any number in one
  /// @param lattice of the organ
  NeighbourContact(const TriangleSurface& still_T, const CutLattice& lattice, const NeighbourOptions& options = {});

  std::size_t neighbours() const { return bodies_.size(); }  ///< closed pieces that are touched; 0: never any cost

  /// The lattice has been cut: vertices were added.
  void follow_cut(const CutLattice& lattice);
  /// Moves the neighbours to so far from where they lay at first. @return the work that this does on the organ, J
  double carry(const Vec3& shift_T);
  /// Before the solid's step: adds its ties behind those that are there. @param surface as it is now
  void press(const CutLattice& lattice, const SurfaceSnapshot& surface, SoftSolid& solid);
  /// After it: what they have borne.
  void bear(const SoftSolid& solid);

  std::size_t contacts() const { return touching_; }    ///< vertices that were pressed in the last step
  std::size_t looked_at() const { return looked_at_; }  ///< vertices whose distance it measured
  const Vec3& force_T() const { return force_; }        ///< on the organ, N
  double energy_j() const { return energy_; }           ///< held after the last step

 private:
  struct Body {
    TriangleSurface surface;
    NearestSurface nearest;
    std::vector<Vec3> normal;  ///< of its vertices
    Eigen::AlignedBox3d box;
  };
  struct Foot {
    double gap_m = 0;             ///< < 0 inside
    Vec3 normal = Vec3::UnitZ();  ///< along which it grows
    std::size_t triangle = 0;
  };
  /// Of a vertex, relative to the neighbours.
  struct Watched {
    Vec3 seen = Vec3::Zero();  ///< where it was when it was looked at, and
    double clear_m = 0;        ///< how far it was from touching then
    std::size_t guess = 0;     ///< a triangle of the body looked at last
    double area_m2 = 0;
  };
  struct Pressed {
    Vec3 normal;
    double stiffness = 0, depth_m = 0;
  };
  static Foot foot_on(const Body& body, const Vec3& place, std::size_t guess);
  void add_bodies(const TriangleSurface& still_T, const TriangleSurface& organ);
  void watch(const CutLattice& lattice, std::size_t first);
  void find_rings(const TriangleSurface& rest);
  /// Gap of a vertex at which a body begins to press it.
  double begins_m(std::size_t vertex, std::size_t body) const;
  bool faces_away(std::size_t vertex, const Vec3& normal, const TriangleSurface& surface) const;
  /// Looks for what presses a vertex. @param ahead its way in this step
  void look(std::size_t vertex, const Vec3& place, const Vec3& ahead, const Lattice& lattice,
            const TriangleSurface& surface, std::vector<SoftTie>& ties);

  NeighbourOptions options_;
  std::vector<Body> bodies_;
  std::vector<Watched> watched_;
  /// Gap at rest of a vertex that lay in a body; -infinity: deep.
  std::map<std::pair<std::size_t, std::size_t>, double> crossing_;
  std::vector<std::size_t> first_round_;  ///< of each vertex: from there on in:
  std::vector<std::int32_t> round_;       ///< triangles
  std::vector<Pressed> pressed_;          ///< by the last ties of the solid
  std::size_t first_tie_ = 0, looks_ = 0, touching_ = 0, looked_at_ = 0;
  Vec3 shift_ = Vec3::Zero(), force_ = Vec3::Zero();
  double energy_ = 0;
};

}  // namespace trocar
