// A hand as read from TOML: the skill of a simulated person, fixed waypoints, or nothing at all.
//
// Strict: unknown keys, wrong types, numbers out of range or not finite are refused with line and column.
// Lengths m, times s inside; the file uses _mm keys. Thread: loading only.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "haptics/contact/instrument.h"
#include "haptics/quantities.h"

namespace trocar {

/// What tells people apart.
struct HandSkill {
  double speed_factor = 1;        ///< multiplies every movement time
  double aim_lateral_m = 0;       ///< SD of the end point across the approach, at 60 mm of travel
  double aim_depth_m = 0;         ///< SD along the approach
  double aim_angle_rad = 0;       ///< SD of the turn about each axis, at 30 deg of turn
  double settle_share = 0.6;      ///< of a pose's tolerance: nearer than this is good enough
  double tremor_m = 0;            ///< RMS of the 9 Hz tremor of the intent
  double pause_s = 0;             ///< between seeing the next target and moving
  double force_bias = 1;          ///< first force aimed at / middle of the band
  double force_cv = 0;            ///< coefficient of variation of the force aimed at
  double path_bulge = 0;          ///< sideways deviation / distance
  int max_corrections = 0;        ///< looks and corrections before touching
  double hover_m = 0;             ///< height over the target at which the reach ends
  double approach_speed_mps = 0;  ///< from there to the tissue, before speed_factor
  double reaction_s = 0.17;       ///< voluntary reaction 150-200 ms
  double population_cv = 0;       ///< spread between persons: each parameter times a log-normal of this CV
};

/// One minimum-jerk move of a fixed script: straight, or round a line along the shaft.
struct ScriptedMove {
  Vec3 to_m = Vec3::Zero();        ///< goal of the tip
  bool relative_to_ready = false;  ///< to_m counts from where the tip was when the device became ready; else from T
  /// The tip goes round the line through this place along the shaft by the move's roll, and `to_m` is not read.
  std::optional<Vec3> about_m = {};
  double roll_rad = 0;  ///< by which the instrument is turned about its shaft over the move
  double seconds = 0;   ///< duration of the move
  double hold_s = 0;    ///< rest at its end
  double jaw_m = 0.02;  ///< jaw opening at its end
  bool clutch = false;  ///< made with the clutch held: the stylus moves, the instrument stays
  bool pedal = false;   ///< made with the pedal held down
  /// Is taken in hand before the move begins; none: the one that is there. One that the exercise has not is asked for
  /// kMostInstruments times.
  std::optional<InstrumentKind> instrument = {};
};

/// Numbers of a skill that lie between those of two other skills when the skill does; max_corrections is counted.
inline constexpr std::array kSkillNumbers{
    &HandSkill::speed_factor, &HandSkill::aim_lateral_m, &HandSkill::aim_depth_m, &HandSkill::aim_angle_rad,
    &HandSkill::settle_share, &HandSkill::tremor_m,      &HandSkill::pause_s,     &HandSkill::force_bias,
    &HandSkill::force_cv,     &HandSkill::path_bulge,    &HandSkill::hover_m,     &HandSkill::approach_speed_mps,
    &HandSkill::reaction_s,   &HandSkill::population_cv};

/// A person who gets better: every number of the skill goes from one hand's to another's, e^(-(n - 1) / attempts) of
/// the way left at attempt n.
struct Learning {
  std::string from, to;  ///< hands of the same folder
  double attempts = 8;   ///< time constant
};

/// Many people between two hands: person k is meant by NAME#k (scenarios/hands/population.h).
struct Population {
  std::string from, to;  ///< hands of the same folder: latent skill 0 and 1
  double spread_cv = 0;  ///< of every number of a person's skill about what the latent skill makes it
};

/// Somebody's hand with a trick (scenarios/hands/cheating_hand.h).
struct Cheat {
  enum class Trick : std::uint8_t { kClutch, kDwell } trick = Trick::kClutch;
  std::string of;    ///< skilled hand of the same folder
  double for_s = 0;  ///< how long the trick is played each time
};

enum class HandKind : std::uint8_t { kSkilled, kWaypoints, kLearner, kPopulation, kCheat, kIdle };

struct HandScript {
  std::string name;
  HandKind kind = HandKind::kIdle;
  HandSkill skill;
  std::vector<ScriptedMove> moves;
  Learning learning;
  Population population;
  Cheat cheat;
};

/// @throws InputError "FILE:LINE:COLUMN: message".
HandScript load_hand_script(const std::filesystem::path& file);
HandScript parse_hand_script(const std::string& text, const std::string& file);

/// Skill of a learner at an attempt (1 is the first).
HandSkill learned_skill(const HandSkill& from, const HandSkill& to, double attempts, int attempt);

/// Names of the scripts of a folder, sorted. @throws InputError when it cannot be read.
std::vector<std::string> list_hands(const std::filesystem::path& hands_dir);

}  // namespace trocar
