// A small exercise of its own for the tests of commands: they do not depend on the numbers of the shipped ones.
#pragma once

#include <string>

namespace trocar::testing_support {

inline constexpr const char* kSmallTask = R"(id = "small-touch"
kind = "touch"
number = "E90"
version = "4"
title = "Small touch"
goal = "Touch two discs."
time_limit_s = 3
hold_s = 1.0
[start]
radius_mm = 10
hold_s = 0.2
above_mm = [0, 0, 45]
[targets]
count = 2
diameter_mm = 6
region_mm = [60, 50]
relief_mm = 20
min_spacing_mm = 14
max_slope_deg = 40
wrong_place_mm = 2
retract_mm = 12
[surface]
stiffness_n_per_m = 150
damping_s_per_m = 0.5
)";

inline constexpr const char* kSmallRubric = R"([rubric]
pass_at = 75
proficient_at = 85
expert_at = 92
gate_cap = 59
critical_cap = 49
unfinished_cap = 49
[[rubric.subscores]]
name = "time"
metric = "time_s"
weight = 1.0
full_at_expert_times = 0.7
zero_at_expert_times = 3.0
)";

/// Two discs amid the liver, three seconds; L1 and an exam.
inline std::string small_exercise(const std::string& mapping = "mapping = \"direct\"", double hard_n = 1.5) {
  return kSmallTask + std::string(R"([force]
soft_n = 0.9
hard_n = )") +
         std::to_string(hard_n) + R"(
critical_n = 40
[grip]
block_thickness_mm = 8
block_stiffness_n_per_m = 300
low_n = 0.73
high_n = 1.20
excess_n = 2.5
hold_s = 1.0
[[levels]]
name = "L1"
)" + mapping +
         R"(
motion_scale = 1.0
force_scale = "auto"
band_n = [0.4, 0.8]
force_display = "always"
expert_time_s = 10
[[levels]]
name = "exam"
like = "L1"
force_display = "after"
)" + kSmallRubric;
}

}  // namespace trocar::testing_support
