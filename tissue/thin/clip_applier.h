// The clip applier: jaws with a loaded clip, which closes round a duct or is refused for a reason.
//
//   loaded --closing on--> engaged --shut--> placed, or refused --opened wide--> loaded, or empty
// Judged is what lies between the jaws when they shut, the duct flat as it will then be; "something else" counts if it
// was there at any moment since they began to close, because shutting jaws push it out. A refused clip stays in the
// jaws; forced, it closes all the same: on part of the duct, or on nothing and is lost. Frame I of rod_in_jaws.h. SI.
// Thread: tissue task.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/thin/clip.h"
#include "tissue/thin/rod_in_jaws.h"

namespace trocar {

enum class ClipRefusal : std::uint8_t {
  kNone,
  kMagazineEmpty,
  kNothingBetween,
  kSomethingElse,
  kAngle,
  kNotWhole,
  kTipHidden,
  kNotShut,
};

/// In words, for the trainee.
std::string_view sentence(ClipRefusal refusal);

struct ClipApplierOptions {
  ClipOptions clip = {};
  int magazine = 20;                 ///< clips, with the one in the jaws (unchecked)
  double engaged_opening_m = 0.005;  ///< jaws closed so far have begun (unchecked)
  double shut_opening_m = 0.0005;    ///< beyond both walls of what is between: shut (unchecked)
  double reopened_m = 0.001;         ///< opened by so much again: given up (a choice)
  double least_tip_m = 0.001;        ///< of the tips beyond the far wall: they are to be seen (a choice)
  double most_angle_rad = 0.349;     ///< 20 degrees from straight across
};

/// What the applier can close on or must not.
struct ClipSurroundings {
  struct Rod {
    const ElasticRod* rod = nullptr;
    std::span<const double> clips = {};  ///< arcs of those that are on it
  };
  std::span<const Rod> rods = {};
  const TriangleSurface* organ_T = nullptr;  ///< nullptr: none near
};

struct ClipVerdict {
  ClipRefusal refusal = ClipRefusal::kNone;
  std::int32_t rod = -1;  ///< index among the surroundings' rods; -1: none
  double arc_m = 0;
  double width_share = 0;   ///< of the rod's flat width between the jaws
  double tip_beyond_m = 0;  ///< of the tips beyond its far wall
  double angle_rad = 0;     ///< from straight across
};

/// What a clip at this place would be told, whatever the magazine holds; jaws this far open.
ClipVerdict judge_clip(const Pose& X_TI, double opening_m, const ClipSurroundings& round,
                       const ClipApplierOptions& options);

struct ClipOutcome {
  ClipVerdict verdict;
  bool placed = false;  ///< hand verdict.rod, arc and width share to that rod's ClipSet
  bool lost = false;    ///< closed on nothing
};

class ClipApplier {
 public:
  enum class Phase : std::uint8_t { kLoaded, kEngaged, kShut, kEmpty };

  explicit ClipApplier(const ClipApplierOptions& options = {});

  /// One step. @param forced also closes a clip that is refused
  /// @return what became of the clip, once in each closing
  std::optional<ClipOutcome> step(const Pose& X_TI, double opening_m, const ClipSurroundings& round,
                                  bool forced = false);

  Phase phase() const { return phase_; }
  int left() const { return left_; }                       ///< with the one in the jaws
  const ClipVerdict& verdict() const { return verdict_; }  ///< of now, while engaged
  const ClipApplierOptions& options() const { return options_; }

 private:
  ClipOutcome shut(bool forced);

  ClipApplierOptions options_;
  Phase phase_ = Phase::kLoaded;
  int left_ = 0;
  double least_opening_m_ = 0;
  bool something_else_ = false;
  ClipVerdict verdict_;
};

}  // namespace trocar
