// A stage of an operation: the part of a run that its kind makes, told and telling in the numbers of the whole.
//
// What it is told of ducts, places and vessels is its own only: what is done to another stage's is judged once that
// stage has begun. Events: STAGE_BEGUN (number of the stage) before those of the part; objects count through all
// stages. Before the first object an instrument is asked for, where another is in hand. Frame T, SI. Deterministic.
// Thread: the tissue task's.
#pragma once

#include <memory>

#include "scenarios/director/exercise_task.h"
#include "scenarios/kinds/operation/stage_range.h"

namespace trocar {

class StageTask final : public ExerciseTask {
 public:
  StageTask(const Exercise& operation, const StageRange& range, std::unique_ptr<ExerciseTask> part);
  void begin(EventLog& log) override;
  void update(const TaskInput& input, EventLog& log) override;
  void keep_watch(const TaskInput& input, EventLog& log) override;
  bool finished() const override { return part_->finished(); }
  std::int32_t object() const override;
  void describe(const TaskInput& input, DirectorStatus& status) const override;

 private:
  void number_events(EventLog& log, std::size_t from) const;

  StageRange range_;
  std::vector<InstrumentKind> instruments_;
  InstrumentKind instrument_;
  std::unique_ptr<ExerciseTask> part_;
  TissueFrame seen_;
  bool told_ = false;  ///< seen_ is of the last period
};

}  // namespace trocar
