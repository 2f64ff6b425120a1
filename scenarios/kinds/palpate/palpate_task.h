// Palpation: what is hidden in the organ is felt for with the tip, and marked by a pinch with the tip on the tissue.
//
// There are as many marks as nodules; the last one ends the search, and so does a pinch in the start ball. A mark is a
// hit within a nodule's radius and some more of it, along the surface; each nodule is found once. Events, value in
// brackets: PLACE_PRESSED [share of the region] for the first press of each cell, minor where its force was not the
// wanted one, NODULE_FOUND [m off it], FALSE_MARK [m off the nearest that is not found], SEARCH_ENDED [share of the
// region that was pressed]. Where the organ gives way, places are compared at rest. Frame T, SI units. Deterministic.
// Thread: the tissue task's.
#pragma once

#include <array>
#include <vector>

#include "scenarios/director/exercise_task.h"
#include "scenarios/kinds/palpate/palpate_rules.h"

namespace trocar {

class PalpateTask final : public ExerciseTask {
 public:
  PalpateTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board);
  void begin(EventLog&) override {}
  void update(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return ended_; }
  std::int32_t object() const override { return ended_ ? -1 : marks_; }
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  void follow_search(const Vec3& place_T, double force_n);
  void end_press(EventLog& log);
  void set_mark(const Vec3& place_T, EventLog& log);
  void end(EventLog& log);
  double searched_share() const;
  void hints(const TaskInput& input, DirectorStatus& status) const;

  PalpateRules rules_;
  PalpateLevel level_;
  std::string display_;
  Vec3 centre_T_, start_T_;
  double start_sphere_m_, half_x_m_, half_y_m_;
  std::vector<HiddenNodule> nodules_;  ///< without decoys
  std::vector<bool> found_, searched_;
  std::vector<bool> pressed_;  ///< cells whose first press was judged
  double press_n_ = 0;         ///< most force of the press that lasts ...
  int press_cell_ = 0;         ///< ... and where it was
  int columns_ = 1, rows_ = 1;
  HoldTimer hold_;
  Vec3 hold_from_T_ = Vec3::Zero();
  bool touching_ = false, in_start_ = false, holding_ = false;
  bool let_go_ = true;  ///< since the last mark
  bool ended_ = false;
  std::array<Vec3, kMostMarks> marked_T_{};
  int marks_ = 0, hits_ = 0;
  double since_mark_s_ = 1e9;
  bool last_hit_ = false;
};

}  // namespace trocar
