#include "scenarios/kinds/operation/stage_range.h"

#include <algorithm>

#include "scenarios/kinds/dissect/dissect_layout.h"

namespace trocar {

std::vector<StageRange> stage_ranges(const Exercise& operation, const Board& board) {
  std::vector<StageRange> out;
  StageRange range;
  for (std::size_t i = 0; i < operation.stages.size(); ++i) {
    const Board& own = board.stages[i];
    range.stage = static_cast<int>(i);
    range.objects = static_cast<int>(own.targets.size());
    range.ducts = static_cast<int>(own.ducts_T.size());
    range.vessels = static_cast<int>(bleeders_of(*operation.stages[i].exercise, own).size());
    out.push_back(range);
    range.first_object += range.objects;
    range.first_duct += range.ducts;
    range.first_vessel += range.vessels;
  }
  return out;
}

const StageRange* stage_with(const std::vector<StageRange>& ranges, int object) {
  for (const StageRange& range : ranges)
    if (object >= range.first_object && object < range.first_object + range.objects) return &range;
  return nullptr;
}

TissueFrame frame_of(const StageRange& range, const TissueFrame& whole) {
  TissueFrame own = whole;
  own.place_count = std::clamp(whole.place_count - range.first_object, 0, range.objects);
  std::copy_n(whole.place.begin() + range.first_object, own.place_count, own.place.begin());
  own.wound_count = std::clamp(whole.wound_count - range.first_vessel, 0, range.vessels);
  std::copy_n(whole.wound.begin() + range.first_vessel, own.wound_count, own.wound.begin());
  const auto own_duct = [&](std::int32_t duct) {
    const std::int32_t number = duct - range.first_duct;
    return duct >= 0 && number >= 0 && number < range.ducts ? number : -1;
  };
  own.touched_duct = own_duct(whole.touched_duct);
  own.duct_mark_count = 0;
  for (std::int32_t i = 0; i < whole.duct_mark_count; ++i) {
    DuctMark mark = whole.duct_mark[static_cast<std::size_t>(i)];
    mark.duct = own_duct(mark.duct);
    if (mark.duct >= 0) own.duct_mark[static_cast<std::size_t>(own.duct_mark_count++)] = mark;
  }
  return own;
}

DirectorStatus status_of(const StageRange& range, const DirectorStatus& whole) {
  DirectorStatus own = whole;
  own.done >>= static_cast<std::size_t>(range.first_object);
  for (auto i = static_cast<std::size_t>(range.objects); i < own.done.size(); ++i) own.done.reset(i);
  own.targets_done = static_cast<int>(own.done.count());
  own.target_index = whole.target_index >= range.first_object && whole.target_index < range.first_object + range.objects
                         ? whole.target_index - range.first_object
                         : -1;
  return own;
}

}  // namespace trocar
