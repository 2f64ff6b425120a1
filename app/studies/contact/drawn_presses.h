// Presses into a wall by drawn hands on drawn arms: what the studies of stability, settling and Z-width count.
//
// Stiffness, delay and grip go round in turn, so that every combination comes equally often; arm, electronics, hand,
// pose, direction (any that the arm can go comfortably) and speed are drawn. Press n of a seed is the same whatever
// their number. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "app/device_bench/wall_trial.h"

namespace trocar {

inline constexpr std::array kGrips{GripPreset::kFingertip, GripPreset::kLight, GripPreset::kNormal, GripPreset::kFirm};
constexpr const char* grip_name(GripPreset grip) {
  constexpr std::array kNames{"fingertip", "light", "normal", "firm"};
  return kNames[static_cast<std::size_t>(grip)];
}

struct PressDraw {
  std::vector<double> stiffness;        ///< N/m, in turn
  std::vector<int> extra_delay;         ///< periods that the loop knows of, in turn
  double slowest = 0.1, fastest = 0.9;  ///< m/s at touch, log-uniform
  double rate_hz = 1000;
  bool nominal = false;  ///< the arm of the documents, without tremor and flaws, in the grips as they are
};

struct DrawnPress {
  WallCase wall;
  GripPreset grip = GripPreset::kNormal;
};

std::vector<DrawnPress> drawn_presses(std::uint64_t seed, std::size_t count, const PressDraw& draw);

/// What the plant of such a study is, in words.
std::string drawn_plant_words(std::uint64_t seed, bool nominal);

}  // namespace trocar
