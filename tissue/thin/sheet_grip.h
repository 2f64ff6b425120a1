// The jaws on a sheet: it is squeezed between the pads, held, slips and is let go. As RodGrip (rod_grip.h), by up to
// six places of the sheet.
//
// Frames T and I (x hinge axis, z to the tip, pads meet in y = 0). SI. Thread: tissue task. Let go, nothing is left.
#pragma once

#include <span>
#include <vector>

#include "haptics/exchange/contact_patch.h"
#include "tissue/thin/elastic_sheet.h"
#include "tissue/tissue_frame.h"

namespace trocar {

struct SheetGripOptions {
  double pad_length_m = 0.020, pad_width_m = 0.005;  ///< as SoftGripOptions
  double friction = 0.6;                             ///< pads on wet tissue, as RodGripOptions
  double hold_n_per_m = 600;                         ///< of all springs together
  double most_loop_n_per_m = 250;                    ///< of the hold in the loop, as SoftOrganOptions
  double most_stiffness_n_per_m = 2000;              ///< of what is squeezed (a choice: fingers feel it hard)
  double least_thickness_m = 0.0008;  ///< that pads hold: thinner tissue folds between their teeth (a choice)
};

/// Triangles of a sheet whose middle lies between jaws as they are, this much beyond them.
std::vector<std::int32_t> triangles_between(const ElasticSheet& sheet, const Pose& X_TI, double length_m,
                                            double width_m, double opening_m, double beyond_m);

class SheetGrip {
 public:
  explicit SheetGrip(const SheetGripOptions& options = {}) : options_(options) {}

  /// Before the step: what the jaws have now, and the springs by which they hold on.
  void reach(const Pose& X_TI, double opening_m, const ElasticSheet& sheet, std::vector<SheetSpring>& springs);
  /// After the step. @param springs those that reach() added, their forces filled in
  void feel(const Pose& X_TI, std::span<const SheetSpring> springs, const ElasticSheet& sheet);
  void let_go();

  GripState state() const { return state_; }
  double slipped_m() const { return slipped_m_; }
  GripBlock block() const { return block_; }
  GripHold hold() const { return hold_; }

 private:
  struct Place {
    MaterialPoint on;
    Vec3 point_I = Vec3::Zero();
  };
  void take(const Pose& X_TI, const ElasticSheet& sheet, std::span<const std::int32_t> between);
  bool on_pads(const Vec3& point_I) const;

  SheetGripOptions options_;
  GripState state_ = GripState::kEmpty;
  std::vector<Place> places_;
  GripBlock block_;
  GripHold hold_;
  double squeeze_n_ = 0, slipped_m_ = 0;
};

}  // namespace trocar
