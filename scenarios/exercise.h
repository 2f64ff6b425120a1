// An exercise as read from TOML: geometry rules, forces, cues, limits and the rubric. Immutable after loading.
//
// Loaded by exercise_loader.h (errors carry line and column). Lengths m, forces N, times s, angles rad inside; the file
// uses _mm and _deg keys. Frame T.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "haptics/exchange/contact_patch.h"
#include "haptics/quantities.h"
#include "scenarios/scoring/rubric.h"

namespace trocar {

enum class Mapping : std::uint8_t { kDirect, kFulcrum };

/// What one level changes.
struct ExerciseLevel {
  std::string name;                    ///< "L1"
  Mapping mapping = Mapping::kDirect;
  double motion_scale = 1;             ///< scene metres per device metre
  double force_scale = 1;              ///< kappa; "auto" is resolved by the session and is negative here
  double band_low_n = 0, band_high_n = 0;
  std::string force_display = "always";  ///< always | band | after
};

/// How targets are laid out on the organ.
struct TargetLayout {
  int count = 0;
  double radius_m = 0;                 ///< of a disc
  double region_x_m = 0, region_y_m = 0;  ///< extent of the board region in T
  double relief_m = 0;                 ///< targets lie within +- this height of the region's centre
  double min_spacing_m = 0;
  double max_slope_rad = 0;            ///< between the surface normal and the approach axis (T's z)
  double wrong_place_m = 0;            ///< first contact further than this outside the disc is a wrong place
};

/// The grip event that ends the exercise.
struct GripTask {
  double block_thickness_m = 0, block_stiffness_n_per_m = 0;
  double low_n = 0, high_n = 0, hold_s = 0;
  double excess_n = 0;                 ///< GRIP_EXCESS above this
};

struct Exercise {
  std::string id, title, version;      ///< "surface-touch"
  std::string number;                  ///< "E02"
  std::string goal;                    ///< one line for briefing and report
  double time_limit_s = 0;
  double start_sphere_m = 0, start_hold_s = 0;  ///< radius; time in it: READY -> ARMED -> RUN
  Vec3 start_above_m = Vec3::Zero();   ///< start sphere's centre relative to the region's centre
  TargetLayout layout;
  double hold_s = 0;                   ///< time in band that completes a target
  ContactMaterial surface;
  double soft_force_n = 0, hard_force_n = 0, critical_force_n = 0;
  double retract_height_m = 0;         ///< of the ideal path between targets
  GripTask grip;
  std::vector<ExerciseLevel> levels;
  Rubric rubric;
  std::filesystem::path file;
  std::string text;                    ///< the file's bytes: embedded in recordings, hashed as the rubric's version
};

}  // namespace trocar
