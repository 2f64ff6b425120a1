// A duct, a small vessel or a thread: an elastic rod that stretches, bends and twists, one implicit step at a time.
//
// Nodes in a row, segments between them (Bergou et al. 2008, 2010): a place each node, a turn about its own axis each
// segment. Energies: of stretch E A l w(strain), of bend and twist (rod_bend.h) against the drawn shape, so that a
// drawn bow is at rest. Two Prony branches each, held as strains like those of soft_solid.h. A step is implicit Euler:
// the next places minimise inertia + energy by Newton's method with a matrix kept positive (Gauss-Newton, and the
// stress stiffness of what is pulled), a direct solve of a band and a line search: dissipative at any step length.
// The rod is drawn stretched by `pre_strain`; where it is cut or torn both ends run back by it.
//
// A place on the rod is an arc: metres along it as it was drawn. It stays the same when the rod is cut or stretched;
// at a cut it names the side behind it. Frame T or any other, SI. Thread: tissue task; same input, same bytes. What is
// not finite among the inputs of a step counts as not there.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "haptics/quantities.h"
#include "tissue/solid/tissue_material.h"
#include "tissue/thin/band_matrix.h"
#include "tissue/thin/rod_bend.h"

namespace trocar {

struct RodOptions {
  double outer_radius_m = 0.0015;      ///< cystic duct 2 to 4 mm wide (unchecked)
  double wall_m = 0.0005;              ///< outer_radius_m: a thread, without lumen (unchecked)
  double young_pa = 350000;            ///< long-term
  double poisson = 0.49;               ///< of the twist only
  double density_kg_m3 = 1040;         ///< of the wall
  double content_kg_m3 = 1000;         ///< bile, blood
  double stiffening = 4;               ///< c of E exp(c strain) in tension
  double most_stiffening = 8;          ///< times E, beyond which it no longer grows
  std::array<PronyBranch, 2> prony{};  ///< instantaneous = young / (1 - sum of shares)
  double pre_strain = 0.10;            ///< of the drawn shape along the axis (unchecked)
  double avulsion_n = 4.5;             ///< pull at which an end comes off its anchor, 3 to 6 N (unchecked)
  double tear_over_avulsion = 1.3;     ///< pull at which it tears between, over that; ends go first (a choice)
  double overload_s = 0.020;           ///< how long a limit must be passed (tissue.md 3)
  double mass_damping_per_s = 1;       ///< of the motion of the whole
  Vec3 gravity_m_s2 = Vec3::Zero();
  double most_speed_m_s = 5;      ///< that a node carries into the next step: what jumps does not fly off (a choice)
  double least_segment_m = 2e-4;  ///< a cut leaves no segment shorter than that
  double step_s = 0.010;
  double tolerance_m = 1e-7;  ///< Newton's method stops with a correction below this
  int most_iterations = 4;

  double inner_radius_m() const { return outer_radius_m - wall_m; }
};

/// A rod of a tissue of assets/tissues.toml. The pull at which it comes off is rupture_n_per_m over its round.
RodOptions rod_options(const TissueSolid& tissue, double outer_radius_m, double wall_m);

/// Points at about equal distances along a path. @param spacing_m > 0. @return at least two
std::vector<Vec3> evenly_spaced(std::span<const Vec3> path, double spacing_m);

enum class RodEnd : std::uint8_t { kStart, kFinish };

/// What an end of the rod hangs on.
struct RodAnchor {
  Vec3 position = Vec3::Zero();      ///< before the step, m
  Vec3 velocity = Vec3::Zero();      ///< over the step, m/s
  Mat3 rotation = Mat3::Identity();  ///< of what it hangs on, since the rod was drawn
  double stiffness_n_per_m = 2000;   ///< of the anchorage (a choice)
  bool clamped = true;               ///< its direction is held too, else it is a joint
};

/// A spring between a place of the rod's axis and something outside, along one direction; as SoftSpring.
struct RodSpring {
  double arc_m = 0;
  Vec3 direction = Vec3::UnitZ();  ///< unit
  double stiffness_n_per_m = 0;
  double stretch_m = 0;  ///< before the step, with what it leads to where it will be: force on the rod is -k stretch
  bool pushes_only = false;  ///< a contact: without force where the stretch becomes negative
  double force_n = 0;        ///< after the step: k stretch, along -direction on the rod
};

struct RodNode {
  std::int32_t id = 0;  ///< stays; nodes of a cut get the next ones
  double arc_m = 0;
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero();
  Vec3 drawn = Vec3::Zero();  ///< where it was drawn
  double mass_kg = 0;
  double hold_n_per_m = 0;  ///< of a spring to where it was drawn
};

struct RodSegment {
  bool whole = true;  ///< false: the gap of a cut
  double arc_from_m = 0, arc_to_m = 0;
  double rest_m = 0;  ///< length without force
  SegmentFrame frame;
  double tension_n = 0;  ///< of the last step, < 0 compressed; with what the branches hold
};

/// A piece of the rod that hangs together, by index of its nodes.
struct RodPart {
  std::size_t first = 0, last = 0;
  bool anchored_first = false, anchored_last = false;
};

struct RodEvent {
  enum class Kind : std::uint8_t { kAvulsed, kTorn } kind = Kind::kTorn;
  double arc_m = 0, pull_n = 0;
};

class ElasticRod {
 public:
  /// @param path at least two points no nearer than 1e-6 m to their neighbours: the nodes, as drawn.
  /// @throws InputError when it is no such path or the options are no rod's
  ElasticRod(std::span<const Vec3> path, const RodOptions& options);

  /// Hangs an end on something, or says where that is now. Not finite: as it was. An end that came off stays off.
  void anchor(RodEnd end, const RodAnchor& to);
  void let_go(RodEnd end);
  bool anchored(RodEnd end) const { return hung(end).on; }
  /// Of the rod ON what the end hangs on, after the step: N, and N m about the end's node.
  Wrench anchor_load(RodEnd end) const { return {hung(end).force, hung(end).moment}; }
  /// How far the anchor was expected to go in the step: the load is that at the end of this way, m.
  Vec3 anchor_way(RodEnd end) const { return options_.step_s * hung(end).to.velocity; }
  /// How much that force grows with the anchor's displacement within a step, N/m, symmetric, positive: what holds the
  /// rod feels it as a spring of this stiffness, so that the two may step in turn. Zero without an anchor.
  Mat3 anchor_stiffness(RodEnd end) const;

  /// Adds a spring from the nodes between two arcs to where they were drawn, N/m each: fat and mesentery round it.
  void hold(double from_m, double to_m, double stiffness_n_per_m);
  void free(double from_m, double to_m);
  /// Between two arcs the rod no longer bends and carries a mass: a clip. @return a number to take it away again by
  int splint(double from_m, double to_m, double mass_kg);
  void take_splint(int number);

  /// One step. @param springs their force_n is filled in.
  void step(std::span<RodSpring> springs = {});
  /// Static equilibrium by steps without inertia; for tests and studies. @return steps taken
  int settle(std::span<RodSpring> springs = {}, double still_m = 1e-8, int most_steps = 400);

  /// Cuts it through at the nearest place to this arc that leaves no sliver.
  /// @return where; nothing where it is cut already or too short to be cut
  std::optional<double> sever(double arc_m);

  const RodOptions& options() const { return options_; }
  std::span<const RodNode> nodes() const { return nodes_; }
  std::span<const RodSegment> segments() const { return segments_; }  ///< i between nodes i and i + 1
  const std::vector<RodPart>& parts() const { return parts_; }
  std::uint64_t topology() const { return topology_; }             ///< counts the cuts
  const std::vector<RodEvent>& events() const { return events_; }  ///< of the last step
  std::uint64_t held_steps() const { return held_steps_; }         ///< steps that found no finite answer: all stood
  int iterations() const { return iterations_; }                   ///< of the last step
  double length_m() const { return nodes_.back().arc_m; }          ///< as drawn

  /// Of the whole segment at an arc, the nearest one where there is a gap. @return index
  std::size_t segment_at(double arc_m) const;
  Vec3 place_at(double arc_m) const;
  Vec3 velocity_at(double arc_m) const;
  /// Material frame of the segment there: columns d1, d2, t.
  Mat3 frame_at(double arc_m) const;
  /// Displacement per newton of a place along a direction within a step, m/N, linearised at the last one.
  double compliance(double arc_m, const Vec3& direction) const;

  /// For tests and scenes: sets where the nodes are, at rest. Points that are not finite stay.
  void place(std::span<const Vec3> position);
  /// Elastic energy, of branches and supports too, and kinetic, J; without gravity and springs.
  double energy_j() const;
  /// Sum of the nodes' momenta, N s.
  Vec3 momentum() const;
  double mass_kg() const;

 private:
  struct Hung {
    RodAnchor to;
    bool on = false, off_for_good = false;
    SegmentFrame drawn;  ///< of the segment at that end
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    double over_s = 0;
  };
  /// A bend between two segments, or between a segment and what its end hangs on.
  struct Bend {
    std::size_t node = 0;
    bool from_anchor = false, to_anchor = false;
    BendStrain rest = BendStrain::Zero(), last = BendStrain::Zero();
    std::array<BendStrain, 2> branch{BendStrain::Zero(), BendStrain::Zero()};
    Vec3 stiffness = Vec3::Zero();  ///< of the components, J
  };
  struct Splint {
    int number = 0;
    double from_m = 0, to_m = 0, mass_kg = 0;
  };
  struct Memory {
    std::array<double, 2> branch{};  ///< of the stretch of a segment
    double last = 0, over_s = 0;
  };
  /// What is tried as the next state.
  struct Trial {
    std::vector<Vec3> place;
    std::vector<double> turn;
    std::vector<SegmentFrame> frame;
    std::vector<BendStrain> bend;
    double objective = 0;
  };
  struct Branches {  ///< of the material, for one step
    std::array<double, 2> gain{}, keep{};
  };

  Hung& hung(RodEnd end) { return hung_[static_cast<std::size_t>(end)]; }
  const Hung& hung(RodEnd end) const { return hung_[static_cast<std::size_t>(end)]; }
  std::size_t end_node(RodEnd end) const { return end == RodEnd::kStart ? 0 : nodes_.size() - 1; }
  double axial_stiffness() const;  ///< E A, N
  double bend_stiffness() const;   ///< E I, N m2
  double twist_stiffness() const;  ///< G J, N m2
  SegmentFrame anchor_frame(RodEnd end) const;
  Vec3 anchor_target(RodEnd end) const;
  void renew();  ///< masses, bends and parts, after the topology or a splint has changed
  void renew_masses();
  void renew_bends();
  std::pair<SegmentFrame, SegmentFrame> sides(const Bend& bend, const Trial& trial) const;
  double segment_mass(std::size_t segment) const;
  double inertia_scale() const;
  double kept(std::size_t branch) const { return statics_ ? 0 : branches_.keep[branch]; }

  void evaluate(std::span<const RodSpring> springs, Trial& trial) const;
  double inertia_objective(const Trial& trial) const;
  double spring_objective(std::span<const RodSpring> springs, const Trial& trial) const;
  double spring_stretch(const RodSpring& spring, const Trial& trial) const;
  void assemble(std::span<const RodSpring> springs, const Trial& trial);
  void add_inertia(const Trial& trial);
  void add_stretch(const Trial& trial);
  void add_bends(const Trial& trial);
  void add_anchors(const Trial& trial);
  void add_springs(std::span<const RodSpring> springs, const Trial& trial);
  double axial_force(std::size_t segment, double strain) const;
  BendStrain bend_stress(const Bend& bend, const BendStrain& strain) const;
  /// Makes next_ of now_ and a share of a way.
  void go(std::span<const RodSpring> springs, const std::vector<double>& way, double share);
  bool search_line(std::span<const RodSpring> springs, const std::vector<double>& way, double slope);
  void accept(std::span<RodSpring> springs);
  void stand_still(std::span<RodSpring> springs);
  void feel_anchors();
  void give_way();
  std::pair<std::size_t, double> spread(double arc_m) const;  ///< segment and share of its second node

  RodOptions options_;
  Branches branches_;
  std::vector<RodNode> nodes_;
  std::vector<RodSegment> segments_;
  std::vector<Memory> memory_;  ///< of segments
  std::vector<double> spin_;    ///< of segments about their axis, rad/s
  std::vector<Bend> bends_;
  std::vector<RodPart> parts_;
  std::array<Hung, 2> hung_;
  std::vector<Splint> splints_;
  std::vector<RodEvent> events_;
  std::uint64_t topology_ = 0, held_steps_ = 0;
  std::int32_t next_id_ = 0;
  int next_splint_ = 1, iterations_ = 0;
  bool statics_ = false, factored_ = false;
  Trial now_, next_;
  BandMatrix matrix_;
  std::vector<double> right_;
};

}  // namespace trocar
