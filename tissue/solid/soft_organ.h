// An organ that gives way: its surface embedded in a soft solid, pressed by the contacts that the loop has solved.
//
// One step (100 Hz). (1) Every contact that carried force in the newest tick is a spring between its place on the
// tissue and the point of the tool that presses there. Its law is that of a sphere of the tool's radius in a
// half-space (Hertz, the contact's radius at most the tool's), less the compliance that the lattice round the place
// already has (tissue.md 1.4), so that force over depth does not hang on the cells. (2) The solid steps with all of
// them, implicit: their forces are those felt. (3) What the loop gets is the surface without the dents of its own
// forces: the neighbourhood of each contact in its shape at rest, moved as its surroundings have moved; and the
// stiffness with which the clamped neighbourhood and the sub-cell law answer within a step, at most `most_stiffness`.
// At the place of the solve the loop's force then is the solved one whatever that stiffness is; it is never softer than
// the truth (tissue.md 2.4). docs/tissue.md tells why.
//
// Two organs may be parts of one: their lattices beside each other (lattice.h), their closed surfaces one behind the
// other, each part of its own material, bound by a bed (organ_bed.h) and solved together. Organs beside it that do not
// give way stop it (neighbour_contact.h).
//
// Frame T, SI. Thread: tissue task. Same input, same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "haptics/exchange/solved_contacts.h"
#include "tissue/mesh/surface/cut_tracing.h"
#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/solid/cut_lattice.h"
#include "tissue/solid/embedded_surface.h"
#include "tissue/solid/neighbour_contact.h"
#include "tissue/solid/organ_bed.h"
#include "tissue/solid/soft_solid.h"
#include "tissue/solid/stiff_ball.h"
#include "tissue/solid/tissue_material.h"
#include "tissue/surface_snapshot.h"

namespace trocar {

struct SoftOrganOptions {
  SoftSolidOptions solid;
  double tool_radius_m = 0.0025;
  double bed_n_per_m3 = 2e5;            ///< support of what faces down, per area: 5 kPa at 25 mm; a choice
  double bed_cosine = -0.2;             ///< faces whose normal's z is below it lie on the bed
  double tether_n_per_m3 = 2e3;         ///< per area of a second part: what brings it back, some N/m; a choice
  double neighbourhood_m = 0.030;       ///< radius of the clamped neighbourhood
  double most_stiffness_n_per_m = 250;  ///< K_max of the loop, in scene newtons
  std::vector<StiffBall> balls = {};    ///< in the first part: cells and the law under the tool have them
};

/// What a half-space beyond a clamped ball of radius R about a place on it adds to the place's compliance, times pi E*
/// R.
double far_share(double poisson);

/// What came of an attempt to cut.
struct OrganCut {
  CutRefusal refusal = CutRefusal::kNothingThere;
  double length_m = 0, depth_m = 0, area_m2 = 0;  ///< of the line; the greatest; of one wall
  Vec3 middle_rest_T = Vec3::Zero();              ///< of the groove's bottom
  std::int32_t first_vertex = 0;                  ///< of those that it added to the surface
};

class SoftOrgan {
 public:
  /// @param lattice over the surface at rest, of the edge that the options name.
  SoftOrgan(const Lattice& lattice, const SurfacePtr& rest_T, const TissueSolid& material,
            const SoftOrganOptions& options);
  /// Of several parts. @param materials by part. @param bed between the first two; none: they do not know each other
  /// @throws InputError: a part without a material, surfaces that do not face each other.
  SoftOrgan(const Lattice& lattice, const SurfacePtr& rest_T, std::span<const TissueSolid> materials,
            const SoftOrganOptions& options, const std::optional<BedOptions>& bed = std::nullopt);

  /// One step of options.solid.step_s.
  /// @param contacts of the newest tick; those on triangles beyond the organ's are left out
  /// @param tip_T of the tool, where it may touch next; nullptr: no tool
  /// @param more springs of this step besides the contacts': a grip. Their forces are filled in.
  void step(const SolvedContacts& contacts, const Vec3* tip_T, std::span<SoftSpring> more = {});

  /// What does not give way beside it, closed surfaces, from the next step on: it is stopped by them.
  void set_beside(const TriangleSurface& still_T) { beside_.emplace(still_T, lattice_); }
  const NeighbourContact* beside() const { return beside_ ? &*beside_ : nullptr; }  ///< nullptr: none was named

  /// Moves the bed, and what is beside it, to so far from where it lay at first.
  void carry(const Vec3& shift_T) {
    energy_ += solid_.carry(shift_T);
    if (beside_) energy_ += beside_->carry(shift_T);
  }

  /// Cuts what lies within a blade, as the organ lies now. A refused cut leaves everything as it was.
  OrganCut cut(const Blade& blade, const CutTracingOptions& options = {});
  /// All cuts so far, as playback makes them again (cut_bytes).
  std::span<const std::string> cuts() const { return cuts_; }
  /// Vertices of the surface that the last cut added.
  std::span<const VertexOrigin> added() const { return added_; }

  /// What the surface bears from the next step on: fields at its vertices. A cut carries them over.
  void wear(std::vector<ShapeField> fields) { fields_ = std::move(fields); }
  std::span<const ShapeField> fields() const { return fields_; }
  /// Where a contact of the loop lies now; nullopt: not on the organ.
  std::optional<MaterialPoint> place_of(const SolvedContacts& contacts, int contact) const;
  Vec3 rest_place(const MaterialPoint& place) const { return place_at(place, lattice_.rest()->vertices); }
  Vec3 place_T(const MaterialPoint& place) const { return place_at(place, surface_->vertices); }

  /// Near a place in T: a corner of the triangle whose first one is nearest.
  MaterialPoint nearest_place(const Vec3& place_T) const;

  std::uint64_t topology() const { return surface_->topology; }
  const SurfacePtr& rest() const { return lattice_.rest(); }
  /// Of the part that a triangle belongs to; the first one is the organ's own.
  const TissueSolid& material(std::int32_t triangle = 0) const { return part(triangle).material; }
  std::int32_t part_of(std::int32_t triangle) const {
    if (parts_.size() < 2) return 0;
    return lattice_.part_of(rest()->triangles[static_cast<std::size_t>(triangle)][0]);
  }
  OrganBed* bed() { return bed_ ? &*bed_ : nullptr; }  ///< nullptr: none
  const OrganBed* bed() const { return bed_ ? &*bed_ : nullptr; }
  NodeShares shares_of(const MaterialPoint& place) const;
  /// Of a place inside the organ at rest, or just outside; nothing where no cell is near.
  NodeShares shares_within(const Vec3& rest_T) const;
  /// How the tissue there is turned and stretched now, dx / dX; the identity where no cell is near or one is turned
  /// out.
  Mat3 gradient_within(const Vec3& rest_T) const;
  /// Where such a place is now.
  Vec3 place_T(const NodeShares& place) const;
  /// Of a spring that holds on to a place, as the loop may render it within a step, N/m.
  double loop_stiffness(const NodeShares& place, const Vec3& direction, double spring_n_per_m) const;
  const SurfacePtr& surface() const { return surface_; }   ///< as it is
  std::span<const Vec3> felt() const { return felt_; }     ///< for the loop: without the tool's own dent
  double stiffness_n_per_m() const { return stiffness_; }  ///< of that dent
  double force_n() const { return force_; }                ///< sum of the solved contact forces
  double given_j() const { return given_; }                ///< energy that the tissue has lost in this step
  const SoftSolid& solid() const { return solid_; }

 private:
  struct Pressed;
  struct Part {
    TissueSolid material;
    double relaxed_share = 1;  ///< long-term modulus over that of a step
    // The sub-cell law relaxes as the solid does: its branches hold forces s_i <- a_i (s_i + g_i / g_inf dF).
    std::array<double, 2> gain{}, keep{};  ///< g_i / g_inf; a_i
  };
  const Part& part(std::int32_t triangle) const { return parts_[static_cast<std::size_t>(part_of(triangle))]; }
  /// Takes node and share of one after the other; a node may come again.
  template <class Take>
  void each_share(const MaterialPoint& place, Take take) const;
  /// The same of all that a tool presses there with this force.
  NodeShares shares_of(const MaterialPoint& place, double force_n) const;
  /// Of the tool with a half-space, m.
  double contact_radius(double modulus_pa, double force_n) const;
  /// Plane strain modulus of a half-space as a tool that presses there feels it, Pa.
  double modulus_at(const MaterialPoint& place) const;
  Vec3 place_at(const MaterialPoint& place, std::span<const Vec3> vertices) const;
  /// Compliance of a half-space under the tool with this force, tangent, and how deep the tool is in it.
  double half_space_compliance(double modulus_pa, double force_n) const;
  double half_space_depth(double modulus_pa, double force_n) const;
  /// Of that what the lattice does not have, m/N; both together are no stiffer than the loop, which would lag behind a
  /// stiffer law by a step and swing (on 300 kPa by 1.2 N, 13 times a second). @param force_n elastic
  double sub_cell_compliance(double modulus_pa, double force_n) const;
  /// What of a contact's force its branches do not hold, N.
  double elastic_part(double force_n) const;
  void remember(std::span<const Pressed> pressed);
  std::vector<Pressed> press(const SolvedContacts& contacts) const;
  /// A place that is told in the triangles of before some cuts, in those of now. triangle -1: it is gone.
  MaterialPoint place_now(const MaterialPoint& before, const SurfaceSnapshot& old) const;
  /// A direction of the organ as it lies now, back at rest.
  Vec3 turned_to_rest(const MaterialPoint& place, const Vec3& vector_T) const;
  Mat3 mean_gradient(std::int32_t cell) const;
  /// How the neighbourhood of a place has moved as a whole, from its rest, with its part.
  Pose motion_round(const Vec3& rest_T, std::int32_t part) const;
  /// The surface with the neighbourhoods of these places at rest, carried along as a whole.
  void undo_dents(std::span<const MaterialPoint> places);
  /// Of the place within a step of the loop, m/N. Keeps what the lattice has of it for the next solve.
  double compliance_at(const Part& of, double modulus_pa, const NodeShares& place, const Vec3& direction,
                       double force_n);
  void support();           ///< springs to the outside
  double energy_j() const;  ///< of solid, bed and what presses beside it
  void find_felt(std::span<const Pressed> pressed, const Vec3* tip_T);

  std::vector<Part> parts_;
  SoftOrganOptions options_;
  CutLattice lattice_;
  EmbeddedSurface embedded_;
  SoftSolid solid_;
  std::vector<std::int32_t> part_of_node_;
  std::optional<OrganBed> bed_;
  std::optional<NeighbourContact> beside_;
  std::vector<std::string> cuts_;
  std::vector<VertexOrigin> added_;
  std::vector<ShapeField> fields_;
  SurfacePtr surface_;
  std::vector<Vec3> felt_;
  double stiffness_ = 0, force_ = 0, given_ = 0;
  double energy_ = 0;  ///< energy_j() after the last step
  struct Memory {
    std::array<double, 2> held{};          ///< N, by the branches
    double elastic_n = 0;                  ///< of the last step
    Vec3 rest_T = Vec3::Zero();            ///< place of the strongest contact, at rest
    std::int32_t part = 0;                 ///< on which it lies
    double carried(const Part& of) const;  ///< N that the next step begins with beside its own elastic force
  };
  Memory memory_;
  int looks_ = 0;  ///< of compliance_at(), on one part
  std::int32_t looked_at_ = 0;
  double longest_edge_m_ = 0;  ///< from a triangle's first corner
  double sub_cell_ = 0;        ///< compliance that the lattice already has at the last place, long-term, m/N
};

}  // namespace trocar
