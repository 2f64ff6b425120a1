// The arm, the electronics and the hand of one trial, drawn: what a study does not know of the device it is done on.
//
// Beyond draw_everything() (plant_parameters.h): cables of 50 to 200 N m/rad, one stiffness a joint, a tenth apart; 0
// to 2 periods of jitter that nobody tells the loop; edges that the counters miss, 1e-7 to 1e-5 of them; windings that
// warm up; a hand drawn about its grip, with tremor. Spreads are assumptions (docs/plant.md). Thread: any.
#pragma once

#include <cstdint>

#include "haptics/device/simulated_daq.h"

namespace trocar {

/// A device without tremor whose amplifiers, friction and masses are those of its documents.
SimulatedDaqConfig nominal_device(GripPreset grip = GripPreset::kNormal);

/// @param seed of this trial: arm, hand, tremor, jitter and missed edges.
SimulatedDaqConfig drawn_device(std::uint64_t seed, GripPreset grip);

/// Seed of trial `n` of a study: apart for every study seed and trial.
std::uint64_t trial_seed(std::uint64_t study_seed, std::uint64_t n);

}  // namespace trocar
