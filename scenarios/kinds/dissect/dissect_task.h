// Bleeders and hook: each strand is lifted on the hook and divided by current; then each vessel that spurts is
// coagulated.
//
// Judged is what the tissue's frame tells. Strands may be divided in any order; asked for is the first that is whole.
// A strand counts if the tip stood `lift_m` off the organ as current parted it. The vessels open when the last strand
// is divided, all at once; they are asked for one after the other. One is sealed when hardly anything comes from it;
// its time runs from when it lit. Current is counted to the object that is lit: as safe what passes through the lit
// strand in the crook, or into the tissue beside the lit vessel, up to counted_s; as unsafe what flows while the tip is
// nearer to the organ than near_m (but for forgiven_s of each object, and not beside the lit vessel), or out of view.
// What flows elsewhere is neither. A clutch changes nothing of that: the instrument stays live where it stands.
//
// Events: TARGET_LIT, TARGET_HELD (s since lit); STRAND_LIFTED (m off the organ), the first time of each strand;
// STRAND_DIVIDED (m off the organ), minor where it was too low or torn; CURRENT_USED (s, safe) and UNSAFE_CURRENT
// (s) as they come, about once a second; SPURTS (mL lost before); SEALED (mL of blood lost by all so
// far); SEALED_LATE (s allowed), once of each vessel; a critical PERFORATED (m2 cut into the organ) once. Frame T, SI.
// Deterministic. Thread: the tissue task's.
#pragma once

#include <array>
#include <bitset>
#include <span>
#include <string>

#include "scenarios/director/exercise_task.h"
#include "scenarios/kinds/dissect/dissect_rules.h"
#include "tissue/tissue_frame.h"

namespace trocar {

class DissectTask final : public ExerciseTask {
 public:
  DissectTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board);
  void begin(EventLog& log) override;
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return asked_ >= aims(); }
  std::int32_t object() const override { return finished() ? -1 : asked_; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  /// What went wrong last, as the screen tells it.
  struct Told {
    const char* message = "";
    const char* hint = "";
    double at_s = -1;
  };
  struct Current {
    double safe_s = 0, unsafe_s = 0;
  };

  int aims() const { return static_cast<int>(targets_.size()); }
  bool is_strand(int target) const { return target < rules_.strands; }
  SurfacePlace place(const TissueFrame& frame, int target) const;
  void follow_current(const TaskInput& input, EventLog& log);
  void tell_current(EventLog& log);
  void follow_strands(const TissueFrame& frame, bool live, EventLog& log);
  void follow_vessels(const TissueFrame& frame, EventLog& log);
  void finish(int target, EventLog& log);
  void ask_next(EventLog& log);
  void blame(Told told, EventLog& log);
  void describe_message(const TissueFrame& frame, DirectorStatus& status) const;

  DissectRules rules_;
  std::vector<Target> targets_;
  Vec3 centre_T_;
  std::string display_;
  std::bitset<kMostDissectAims> done_, lifted_, late_;
  int asked_ = 0, errors_ = 0;
  Current untold_;                                            ///< of the lit object
  std::array<double, kMostDissectAims> near_s_{}, safe_s_{};  ///< of each object
  bool spurting_ = false, perforated_ = false, hooked_ = false, beside_ = false, unsafe_ = false;
  double lit_at_s_ = 0, now_s_ = 0, gap_m_ = 0, cut_m2_ = -1;
  Told told_;
};

}  // namespace trocar
