// The thread behind a needle: it runs through the holes of stitches, is tied, and tears out.
//
// An ElasticRod whose first point hangs on the needle. Every hole is a ring on a place of the tissue (rod_ring.h): the
// rod slides through it with friction by the metre of tissue and by what presses at the edge, and the organ feels force
// and stiffness. A knot is two rings in one place that goes with both limbs; its throws decide what it holds before a
// limb slips through. Pulled harder than the tissue between its holes bears for 20 ms, a stitch tears out.
// The surface of the organ and the instrument's shaft push the thread away; it does not touch itself. T, SI. Thread:
// tissue task. Same input, same bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "haptics/contact/instrument.h"
#include "tissue/interaction/needle_path.h"
#include "tissue/interaction/suture_needle.h"
#include "tissue/thin/elastic_rod.h"
#include "tissue/thin/rod_grip.h"
#include "tissue/thin/rod_ring.h"
#include "tissue/thin/throws.h"

namespace trocar {

struct SutureThreadOptions {
  double radius_m = 0.00011;     ///< USP 3-0: 0.200 to 0.249 mm across
  double young_pa = 1e9;         ///< E A of 38 N: polypropylene; unchecked
  double density_kg_m3 = 1300;   ///< unchecked
  double spacing_m = 0.004;      ///< between nodes
  double swage_n = 6.7;          ///< that the needle comes off at, USP mean of 3-0; unchecked
  double break_n = 17.4;         ///< that the thread breaks at, USP knot pull of 3-0; unchecked
  double friction_n_per_m = 15;  ///< of a metre in tissue; unchecked
  double edge_friction = 0.15;   ///< of what presses at a hole's edge; unchecked
  double ring_n_per_m = 1000;    ///< of a hole's edge and of a knot (a choice)
  double damping_per_s = 10;     ///< of the motion of the whole: it does not fly about (a choice)
  KnotHold knot = {};
};

struct StitchHole {
  Vec3 rest_T = Vec3::Zero(), at_T = Vec3::Zero();
  NodeShares shares;
  RodRing ring;
  bool threaded = false;
};

struct Stitch {
  std::int32_t path = 0;   ///< of the needle that made it
  StitchHole entry, exit;  ///< the exit is not threaded while the needle is in it
  double load_n = 0, over_s = 0;

  double bridge_m() const { return (exit.rest_T - entry.rest_T).norm(); }
};

struct Knot {
  std::vector<Throw> throws;
  RodRing of_long, of_tail;
  bool tight = false;
};

struct ThreadEvent {
  enum class Kind : std::uint8_t { kThrow, kTight, kUndone, kPulledOut, kDrawnThrough, kBroke, kOffNeedle } kind{};
  Throw made;                                                   ///< kThrow
  Vec3 entry_rest_T = Vec3::Zero(), end_rest_T = Vec3::Zero();  ///< of the stitch
  double force_n = 0, arc_m = 0;
};

class SutureThread {
 public:
  /// @param path_T from the needle on
  SutureThread(std::span<const Vec3> path_T, const SutureThreadOptions& options, const NeedleTissueOptions& tissue,
               double step_s);

  struct Around {
    Vec3 swage_T, swage_way;         ///< of the needle, after and in its step
    std::optional<DriverJaws> jaws;  ///< that may hold the thread
    const Tool* tool = nullptr;      ///< whose shaft is in the way, with
    Pose X_TI;
  };
  /// Steps the thread, before the organ's step. @param springs of it
  void step(const OrganView& view, const Around& around, std::vector<SoftSpring>& springs);
  void follow_cut(const SoftOrgan& organ);

  /// The swage has gone into tissue, and has come out of it on the other side.
  void enter(const SoftOrgan& organ, const NeedlePath& path);
  void come_out(const SoftOrgan& organ, const NeedleEvent& event);
  /// The needle's way is no more: neither is its stitch, unless it came out.
  void drop(std::int32_t path);

  /// A throw has been drawn through on the last stitch: where its limbs are nearest. Without one, nothing.
  void tie(const Throw& made);
  /// Cuts the thread through.
  /// @return where; nullopt: too near to a cut or an end
  std::optional<double> sever(double arc_m) { return rod_.sever(arc_m); }

  const ElasticRod& rod() const { return rod_; }
  std::span<const Stitch> stitches() const { return stitches_; }
  const std::optional<Knot>& knot() const { return knot_; }  ///< of the last stitch
  const ThrowWatch& watch() const { return watch_; }
  const RodGrip& grip() const { return grip_; }
  /// Where the thread is held first on its way from the needle: in a hole, by jaws. nullopt: nowhere, or it is off.
  struct Held {
    Vec3 place_T = Vec3::Zero();
    double arc_m = 0;
  };
  std::optional<Held> held_first() const;
  ThreadPull pull() const;                                            ///< on the needle
  const std::vector<ThreadEvent>& events() const { return events_; }  ///< of the last step
  bool between(const Pose& X_TI, double opening_m) const;

 private:
  std::vector<Vec3> limb(Limb limb) const;  ///< of the last stitch, outwards
  bool tied_round(const Stitch& stitch) const { return stitch.entry.threaded && stitch.exit.threaded; }
  double tension_at(double arc_m) const;
  void push_off_organ(const OrganView& view, std::vector<RodSpring>& springs);
  void push_off_shaft(const Around& around, std::vector<RodSpring>& springs) const;
  void add_knot(std::vector<RodSpring>& springs);
  void feel_stitches(const OrganView& view, std::span<const RodSpring> of_holes, std::vector<SoftSpring>& springs);
  void feel_knot(std::span<const RodSpring> springs);
  void watch_throws(const Around& around);
  void take_rod_events();

  SutureThreadOptions options_;
  NeedleTissueOptions tissue_;
  ElasticRod rod_;
  RodGrip grip_;
  std::vector<Stitch> stitches_;
  std::optional<Knot> knot_;
  ThrowWatch watch_;
  std::vector<std::int32_t> vertex_;  ///< of the surface, near each node
  std::vector<ThreadEvent> events_;
};

}  // namespace trocar
