// Clip and cut: both structures are named by touch, each is clipped twice and once, and cut between.
//
// Judged is what the tissue's frame tells: clips and cuts by their place along a duct, angle, width and tips; nothing
// asks what was meant. A clip counts once both are named, if it shuts the whole width, lies straight across, shows its
// tips, keeps its distance from the clips that are there and from what must be spared; and three of each structure do.
// It belongs to the nearest free place that was asked for; one that does not count spends that place: nothing is asked
// for there any more, but a good clip beside it still fills it. Clips may be set and structures cut in any order; which
// is asked for next is the first that is missing. A clip that comes off counts no longer; of one on what must be spared
// nobody is told here. Once all is done, and other parts of the run follow, clips are still watched. Naming: the closed
// grasper touches the structure for a time; while clutch or port stand the instrument still no time counts.
//
// Events: TARGET_LIT, TARGET_HELD (s since lit) of each step; NAMED (s of touch); WRONG_STRUCTURE: another than asked
// was touched so long (index of the duct), critical when a clip or cut lies on what must be spared (m along it);
// CLIP_SET (deg off straight across) of the step that it fills; CLIP_WASTED: a clip that does not count, or came off
// (m along), or a closing that the applier refused; DIVIDED (m off the middle between the clips beside it), minor where
// it is nearer to one than it should; a critical CUT_TOO_SOON (clips that were on before and beyond it, in tenths:
// 2.1 are two and one) for a cut, a nick or a tear without enough of them; a critical BLEEDING (mL) once. Frame T, SI.
// Deterministic. Thread: the tissue task's.
#pragma once

#include <array>
#include <bitset>
#include <span>
#include <string>
#include <vector>

#include "scenarios/director/exercise_task.h"
#include "scenarios/kinds/clip/clip_rules.h"
#include "tissue/tissue_frame.h"

namespace trocar {

class ClipTask final : public ExerciseTask {
 public:
  ClipTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board);
  void begin(EventLog& log) override;
  void update(const TaskInput& input, EventLog& log) override;
  void keep_watch(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return asked_ >= kClipAims; }
  std::int32_t object() const override { return finished() ? -1 : asked_; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  /// A clip or an opening that has been judged. @c aim the step that it fills; -1: none
  struct Known {
    DuctMark mark;
    int aim = -1;
  };
  /// What went wrong last, as the screen tells it.
  struct Told {
    const char* message = "";
    const char* hint = "";
    double at_s = -1;
  };

  void ask_next(EventLog& log);
  void finish_step(int aim, EventLog& log);
  bool in_hand(const StylusState& stylus, InstrumentKind kind) const;
  void follow_touch(const TaskInput& input, EventLog& log);
  void follow_refusals(const SurgeryState& surgery, EventLog& log);
  void follow_losses(std::span<const DuctMark> marks, EventLog& log);
  void follow_marks(std::span<const DuctMark> marks, EventLog& log);
  void judge_clip(const DuctMark& clip, EventLog& log);
  void judge_opening(const DuctMark& opening, std::span<const DuctMark> marks, EventLog& log);
  Told fault_of(const DuctMark& clip) const;
  int nearest_free(const DuctMark& clip, const std::bitset<kClipAims>& taken) const;
  void blame(Told told, EventLog& log);
  void describe_message(const StylusState& stylus, double now_s, DirectorStatus& status) const;

  ClipRules rules_;
  std::vector<InstrumentKind> instruments_;
  std::vector<Target> targets_;
  std::array<double, kClipStructures> parent_radius_m_{};  ///< of what each comes from
  std::string display_;
  HoldTimer naming_, astray_;
  std::bitset<kClipAims> done_, spent_;
  std::array<bool, kClipStructures> divided_{};
  std::vector<Known> known_;
  int asked_ = 0, errors_ = 0;
  std::int32_t refusals_ = -1;
  bool touches_asked_ = false, strayed_ = false, bled_ = false;
  double lit_at_s_ = 0, now_s_ = 0;
  Told told_;
};

}  // namespace trocar
