#include "scenarios/kinds/operation/stage_task.h"

#include <utility>

namespace trocar {
StageTask::StageTask(const Exercise& operation, const StageRange& range, std::unique_ptr<ExerciseTask> part)
    : range_(range),
      instruments_(operation.instruments),
      instrument_(operation.stages[static_cast<std::size_t>(range.stage)].instrument),
      part_(std::move(part)) {}

/// @param from of the log's events: those before are not this part's
void StageTask::number_events(EventLog& log, std::size_t from) const {
  for (std::size_t i = from; i < log.events.size(); ++i)
    if (log.events[i].object >= 0) log.events[i].object += range_.first_object;
}

void StageTask::begin(EventLog& log) {
  log.add(event_type::kStageBegun, Severity::kInfo, range_.stage);
  const std::size_t from = log.events.size();
  part_->begin(log);
  number_events(log, from);
}

void StageTask::keep_watch(const TaskInput& input, EventLog& log) {
  if (!input.tissue) return;
  const TissueFrame own = frame_of(range_, *input.tissue);
  const std::size_t from = log.events.size();
  part_->keep_watch({input.stylus, &own, input.dt_s, input.too_hard}, log);
  number_events(log, from);
}

void StageTask::update(const TaskInput& input, EventLog& log) {
  told_ = input.tissue != nullptr;
  if (told_) seen_ = frame_of(range_, *input.tissue);
  const std::size_t from = log.events.size();
  part_->update({input.stylus, told_ ? &seen_ : nullptr, input.dt_s, input.too_hard}, log);
  number_events(log, from);
}

std::int32_t StageTask::object() const {
  const std::int32_t own = part_->object();
  return own < 0 ? own : own + range_.first_object;
}

void StageTask::describe(const TaskInput& input, DirectorStatus& status) const {
  const auto before = status.done;
  const int mistakes = range_.stage > 0 ? status.wrong_places : 0;
  status.done.reset();
  status.wrong_places = 0;
  status.demand.instrument.reset();
  part_->describe({input.stylus, input.tissue && told_ ? &seen_ : nullptr, input.dt_s, input.too_hard}, status);
  status.done = before | (status.done << static_cast<std::size_t>(range_.first_object));
  status.targets_done = static_cast<int>(status.done.count());
  status.wrong_places += mistakes;
  if (status.target_index >= 0) status.target_index += range_.first_object;
  if (finished() || status.demand.instrument) return;
  if (instruments_[static_cast<std::size_t>(input.stylus.instrument)] == instrument_) return;
  status.cue = Cue::kExchange;
  status.demand.instrument = instrument_;
  say_take(status, instrument_);
}

}  // namespace trocar
