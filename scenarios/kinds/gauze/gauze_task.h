// Gauze circle cut: the line is cut from the edge in, then all round, by snips of scissors.
//
// Judged is what the tissue's frame tells of each closing: where on the gauze, as it was spread, the blades have cut.
// Asked for is the first place of the line that no cut has come past; cuts elsewhere count as much. Time in the clutch
// counts as any other. Done once the whole line is cut past.
//
// Events: TARGET_LIT, TARGET_HELD (s since lit) of each step that is cut past; SNIP (what it adds to the area between
// cut and line, share of what the line encloses); a minor OFF_LINE (what it adds outside the band, share of the line);
// a minor PULLED_HARD (N) each time that the instrument pulls or presses the gauze beyond the limit, told again once it
// has eased off to 0.8 of it; a critical GAUZE_TORN once. Frame T, SI. Deterministic. Thread: the tissue task's.
#pragma once

#include <bitset>
#include <string>
#include <vector>

#include "scenarios/director/exercise_task.h"
#include "scenarios/kinds/gauze/cut_line.h"
#include "tissue/tissue_frame.h"

namespace trocar {

class GauzeTask final : public ExerciseTask {
 public:
  GauzeTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board);
  void begin(EventLog& log) override;
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return line_.closed(); }
  std::int32_t object() const override { return finished() ? -1 : asked_; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  /// What went wrong last, as the screen tells it.
  struct Told {
    const char* message = "";
    const char* hint = "";
    double at_s = -1;
  };

  void judge(const SheetCutSeen& cut, EventLog& log);
  void follow_pull(const TaskInput& input, EventLog& log);
  void ask_next(EventLog& log);
  double step_m() const { return (line_.way_in_m() + line_.round_m()) / static_cast<double>(targets_.size()); }
  Vec3 line_T(const TissueFrame* frame, double arc_m) const;

  GauzeRules rules_;
  GauzeBoard board_;
  ExerciseLevel level_;
  std::vector<Target> targets_;
  CutLine line_;
  ThresholdMonitor pulls_;
  std::bitset<32> done_;
  std::int32_t asked_ = 0, cuts_ = -1, tears_ = -1, off_count_ = 0;
  double next_arc_m_ = 0, roll_rad_ = 0;  ///< of the cut that is asked for: its middle, and how the blades are rolled
  Mat3 R_TI_ = Mat3::Identity();
  bool torn_ = false;
  double lit_at_s_ = 0, now_s_ = 0;
  Told told_;
};

}  // namespace trocar
