// A curved needle: in the jaws of a needle driver, free, or hanging on its thread; what its point opens and passes.
//
//   held    closed jaws on the wire hold it where it lies between the pads; it is as rigid as the hand is, and what
//           tissue and thread do on it is felt. Beyond 2 mu N it slides in the pads, beyond 2 mu N times the pads'
//           lever it turns in them
//   free    a rigid body of five points of mass: springs to the tissue's places that it runs through, the thread's
//   pull,
//           gravity, and the surface that it lies on, one implicit step
//   point   on the surface it presses a spring of the organ's step. From the puncture force on, if no more than 4 mm2
//           of the needle press, the surface opens and a NeedlePath begins
// Only the point touches the surface while it is held; the wire passes where it is drawn. T and I (x hinge axis, z to
// the tip, pads meet in y = 0), SI. Thread: tissue task. Same input, same bytes.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "haptics/exchange/contact_patch.h"
#include "tissue/interaction/needle_path.h"
#include "tissue/tissue_frame.h"

namespace trocar {

struct NeedleDriverOptions {
  double pad_length_m = 0.020, pad_width_m = 0.005;  ///< as SoftGripOptions
  double friction = 0.4;                             ///< steel on hard metal; unchecked
  double catch_n = 10;                               ///< with which the closed catch presses; unchecked
  double lever_m = 0.002;                            ///< of the pads' friction against turning; unchecked
  double wire_n_per_m = 2000;                        ///< that the fingers feel (a choice)
};

/// Of the thread at the needle's end, as ElasticRod tells it of an anchor.
struct ThreadPull {
  Vec3 force = Vec3::Zero();      ///< at the end of the way, N
  Mat3 stiffness = Mat3::Zero();  ///< within a step
  Vec3 way = Vec3::Zero();        ///< that the end was expected to go
};

/// An instrument's jaws that may hold a needle; absent: let go.
struct DriverJaws {
  Pose X_TI;
  double opening_m = 0;
};

struct NeedleEvent {
  enum class Kind : std::uint8_t { kTaken, kLetGo, kPuncture, kExit, kWithdrawn, kThrough, kTorn } kind{};
  Vec3 entry_rest_T = Vec3::Zero(), end_rest_T = Vec3::Zero();  ///< of the way that it tells of
  double force_n = 0;
  std::int32_t path = -1;
  double end_arc_m = 0;  ///< of the end on the needle: behind the swage where it is negative
};

class SutureNeedle {
 public:
  SutureNeedle(const NeedleShape& shape, const Pose& X_TN, const NeedleTissueOptions& tissue = {},
               const NeedleDriverOptions& driver = {});

  /// Puts it between the jaws, held. @param X_IN of the needle in the instrument
  void load(const Pose& X_TI, const Pose& X_IN);
  void place(const Pose& X_TN);  ///< at rest
  /// From now on it stays where it is until jaws take it, as in a stand.
  void stand() { stands_ = true; }
  bool stands() const { return stands_; }
  /// In the next step, as long as it is free and in no tissue, its swage comes no further from a place than that: a
  /// taut thread is no spring that a step could stretch.
  void tether(const Vec3& place_T, double most_m) { tether_ = Tether{place_T, most_m}; }

  /// Before the organ's step. @param springs of it, to which the needle adds its own, last
  void before(const OrganView& view, const std::optional<DriverJaws>& jaws, const ThreadPull& thread,
              std::vector<SoftSpring>& springs);
  /// After it. @param springs those that before() added, their forces filled in
  void after(const OrganView& view, const std::optional<DriverJaws>& jaws, const ThreadPull& thread,
             std::span<const SoftSpring> springs);
  void follow_cut(const SoftOrgan& organ);

  const NeedleShape& shape() const { return shape_; }
  const Pose& X_TN() const { return X_TN_; }
  Vec3 swage_T() const { return X_TN_ * shape_.place(0); }
  Vec3 tip_T() const { return X_TN_ * shape_.place(shape_.length_m); }
  Vec3 swage_way() const { return swage_way_; }  ///< in the last step
  bool held() const { return state_ == GripState::kHolding || state_ == GripState::kSlipping; }
  GripState state() const { return state_; }
  double held_arc_m() const { return held_arc_; }
  std::span<const NeedlePath> paths() const { return paths_; }
  bool touching() const { return touch_.has_value(); }
  double touch_n() const { return touch_n_; }
  double touch_area_m2() const { return touch_area_; }
  const std::vector<NeedleEvent>& events() const { return events_; }  ///< of the last step
  /// Of tissue and thread on it, moment about the held place, after a step.
  Wrench load_T() const { return load_; }
  double tissue_n() const { return tissue_n_; }  ///< of the tissue alone
  GripBlock block() const { return block_; }
  GripHold hold() const { return hold_; }
  /// Between the pads.
  bool between(const Pose& X_TI, double opening_m) const { return !arcs_between(X_TI, opening_m).empty(); }

 private:
  struct Touch {
    Vec3 rest = Vec3::Zero();
    NodeShares shares;
    Vec3 normal = Vec3::UnitZ();
  };
  static constexpr std::size_t kMasses = 5;

  std::vector<double> arcs_between(const Pose& X_TI, double opening_m) const;
  void use_jaws(const std::optional<DriverJaws>& jaws);
  void find_touch(const OrganView& view);
  void add_springs(const OrganView& view, std::vector<NeedleSpring>& springs);
  void go_free(const OrganView& view, const ThreadPull& thread);
  void keep_tethered();
  void feel_touch(const OrganView& view, std::span<const NeedleSpring> springs);
  void feel_paths(const OrganView& view, std::span<const NeedleSpring> springs);
  void feel_jaws(const OrganView& view, const DriverJaws& jaws, const ThreadPull& thread);
  /// Of tissue at the needle's places, for the hand within a step.
  double loop_stiffness(const SoftOrgan& organ, const Vec3& direction, double spring_n_per_m);
  void tell(NeedleEvent::Kind kind, const NeedlePath& path, double force_n);
  double swing_m() const { return shape_.radius_m(); }
  Vec3 middle_N() const;

  NeedleShape shape_;
  NeedleTissueOptions tissue_;
  NeedleDriverOptions driver_;
  Pose X_TN_, X_IN_;
  Twist speed_;  ///< about the middle of its mass
  Vec3 swage_way_ = Vec3::Zero();
  GripState state_ = GripState::kEmpty;
  bool stands_ = false;
  double held_arc_ = 0, squeeze_n_ = 0;
  std::vector<NeedlePath> paths_;
  std::int32_t next_path_ = 0;
  std::vector<std::size_t> path_springs_;  ///< how many each path has added
  std::optional<Touch> touch_;
  std::int32_t tip_vertex_ = -1;
  std::array<std::int32_t, 3> lies_on_{-1, -1, -1};
  double touch_n_ = 0, touch_area_ = 0, tissue_n_ = 0;
  std::vector<NeedleSpring> springs_;
  std::uint64_t looks_ = 0;
  std::size_t looked_springs_ = 0;
  double looked_ = 0;
  std::vector<NeedleEvent> events_;
  Wrench load_;
  GripBlock block_;
  GripHold hold_;
  struct Tether {
    Vec3 place_T = Vec3::Zero();
    double most_m = 0;
  };
  std::optional<Tether> tether_;
};

}  // namespace trocar
