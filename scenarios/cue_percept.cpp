#include "scenarios/cue_percept.h"

namespace trocar {

void show_cue(const DirectorStatus& status, const Board& board, const Exercise& exercise, const ExerciseLevel& level,
              Percept& percept) {
  percept.cue = status.cue;
  percept.target_index = status.target_index;
  percept.target_T = board.start_T;
  percept.target_normal_T = Vec3::UnitZ();
  percept.target_radius_m = exercise.start_sphere_m;
  percept.band_low_n = level.band_low_n;
  percept.band_high_n = level.band_high_n;
  if (status.target_index >= 0) {
    const Target& target = board.targets[static_cast<std::size_t>(status.target_index)];
    percept.target_T = target.centre_T;
    percept.target_normal_T = target.normal_T;
    percept.target_radius_m = target.radius_m;
  }
  if (status.cue == Cue::kGrip) {
    percept.band_low_n = exercise.grip.low_n;
    percept.band_high_n = exercise.grip.high_n;
  }
}

}  // namespace trocar
