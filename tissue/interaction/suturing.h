// A needle with its thread, what is stitched and tied with it, for the world: before and after the organ's step.
//
// Order of a step: the instrument's jaws and the needle, the thread, then the organ with the springs of both, then what
// the needle has cut, slid and opened by it. What changes for good is told as events; they and the nodes (add_nodes)
// are what a recording keeps (SuturePlayback). T, SI. Thread: tissue task. Same input, same bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/contact/instrument.h"
#include "haptics/exchange/solved_contacts.h"
#include "tissue/interaction/suture_thread.h"
#include "tissue/thin/rod_surface.h"
#include "tissue/tissue_shape.h"

namespace trocar {

struct SutureSetup {
  NeedleShape needle = {};
  Pose X_TN = {};  ///< where it is at first
  /// There, until it is taken, and its thread runs freely in the holes; else a driver brings it in.
  bool stands = false;
  double thread_m = 0.15;               ///< from the needle to the end
  Vec3 thread_along_T = Vec3::UnitX();  ///< how it lies at first: straight
  SutureThreadOptions thread = {};
  NeedleTissueOptions tissue = {};
  NeedleDriverOptions jaws = {};
};

/// X_IN of a needle that is held well: so far from the swage, at the tip of the jaws, across the jaws, its circle
/// across the shaft, so that rolling the shaft turns the needle as it is bent.
/// @param share of its length; one that is brought in is held at a quarter
Pose needle_in_jaws(const NeedleShape& needle, double share = 0.25);

struct SutureEvent {
  /// As recordings keep them.
  enum class Kind : std::uint8_t {
    kTaken = 0,  ///< the needle by the jaws
    kLetGo = 1,
    kPuncture = 2,    ///< its point has gone in,
    kExit = 3,        ///< and has come out
    kWithdrawn = 4,   ///< it has been drawn back out of the tissue
    kStitch = 5,      ///< it has gone through: the thread is in both holes
    kNeedleTorn = 6,  ///< it has torn out sideways
    kThrow = 7,
    kTight = 8,          ///< a throw has been drawn tight
    kUndone = 9,         ///< the knot has slipped off an end
    kPulledOut = 10,     ///< a stitch has torn out: the tissue between its holes is open
    kDrawnThrough = 11,  ///< the thread's end has slipped through a stitch
    kBroke = 12,         ///< the thread, at arc_m
    kOffNeedle = 13,     ///< the needle has come off
    kBroughtIn = 14,     ///< a needle with a new thread; what there was of another is gone
    kSnipped = 15        ///< the thread, at arc_m
  } kind = Kind::kTaken;
  Vec3 entry_rest_T = Vec3::Zero(), exit_rest_T = Vec3::Zero();  ///< of the organ at rest
  double force_n = 0, arc_m = 0;
  std::int32_t turns = 0, sense = 0;  ///< of a throw
  bool hitch = false;

  bool operator==(const SutureEvent&) const = default;
};
std::string suture_event_bytes(const SutureEvent& event);
/// Whether a change of TissueShape::changes is a suture's.
bool is_suture_event(std::string_view bytes);
/// @throws InputError: bytes that are none
SutureEvent parse_suture_event(std::string_view bytes);

struct SutureCounts {
  std::int32_t needles = 0, punctures = 0, exits = 0, stitches = 0, throws = 0, tears = 0, regrasps = 0;
};

class Suturing {
 public:
  /// @param so_far of needles before it
  Suturing(const SutureSetup& setup, const SoftOrgan& organ, const SutureCounts& so_far = {});

  /// Whether the jaws have needle or thread between them: to the organ they are a probe then.
  bool jaws_taken(const StylusState& stylus, const Tool& tool, bool present) const;
  /// Puts the needle between the jaws. @param X_IN of the needle in the instrument
  void load(const Pose& X_TI, const Pose& X_IN);

  /// For tests and scenes: as if a throw had just been drawn through.
  void tie(const Throw& made) { thread_.tie(made); }

  /// Before the organ's step. @param springs of it, to which needle and thread add theirs
  void before(const HapticState& newest, const Tool& tool, bool present, const SoftOrgan& organ,
              std::vector<SoftSpring>& springs);
  /// After it. @param springs those that before() added, their forces filled in
  void after(const HapticState& newest, const Tool& tool, bool present, std::span<const SoftSpring> springs,
             const SoftOrgan& organ);

  const SutureNeedle& needle() const { return needle_; }
  const SutureThread& thread() const { return thread_; }
  const SutureCounts& counts() const { return counts_; }
  std::span<const SutureEvent> events() const { return events_; }  ///< of the last step
  SutureState state() const;
  /// The needle is in tissue, or its thread in a stitch.
  bool sewn_in() const { return !needle_.paths().empty() || !thread_.stitches().empty(); }
  KnotKind knot() const;
  GripState grip() const;
  double slipped_m() const { return thread_.grip().slipped_m(); }
  GripBlock block() const;  ///< what the fingers feel,
  GripHold hold() const;    ///< and the hand
  /// Needle, then thread, for pictures.
  std::span<const SurfacePtr> seen() const { return seen_; }
  /// Three places of the needle, then the thread's nodes by their ids, for TissueShape.
  void add_nodes(std::vector<NodePlace>& nodes_T) const;

 private:
  /// Those of a driver; shut as long as the fingers have not closed since the needle was brought in between them.
  std::optional<DriverJaws> locked_jaws(const StylusState& stylus, const Tool& tool, bool present) const;
  void follow(const SoftOrgan& organ);
  void snip(const StylusState& stylus);
  void take_needle_events(const SoftOrgan& organ);
  void take_thread_events();
  void count(const SutureEvent& event);

  SutureSetup setup_;
  std::uint64_t topology_;
  SurfaceWalk walk_;
  double floor_m_;
  SutureNeedle needle_;
  SutureThread thread_;
  SurfacePtr tube_;
  RodSurface thread_seen_;
  std::vector<SurfacePtr> seen_;
  ThreadPull pull_;
  std::size_t of_thread_ = 0;  ///< springs of the last step
  std::vector<SutureEvent> events_;
  SutureCounts counts_;
  double blades_m_ = 0;              ///< opening of scissors in the last step, and
  std::optional<double> in_blades_;  ///< arc of the thread between them as they close
  bool new_ = true, locked_ = false;
};

/// Needle and thread from recorded nodes, since the last one was brought in.
class SuturePlayback {
 public:
  /// @param changes of the recording, those of sutures are taken
  SuturePlayback(const SutureSetup& setup, std::span<const std::string> changes);

  std::size_t nodes() const;  ///< 0: no needle has been brought in
  Pose needle_at(std::span<const NodePlace> nodes_T) const;
  /// @param nodes_T as many as nodes(), as add_nodes() told them. @return needle, then thread
  std::vector<SurfacePtr> at(std::span<const NodePlace> nodes_T) const;

 private:
  ElasticRod rod_;
  RodSurface thread_;
  SurfacePtr tube_;
  double radius_m_;
  bool there_ = false;  ///< a needle has been brought in
};

}  // namespace trocar
