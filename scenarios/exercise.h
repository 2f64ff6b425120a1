// An exercise as read from TOML: its kind, geometry rules, forces, limits, levels and rubrics. Immutable after loading.
//
// What every kind has stands in Exercise itself, what one kind asks for in a struct of its own (only that of `kind` is
// filled). A level holds the final values: its own keys over those of the level that it is `like`.
// Loaded by exercise_loader.h (errors carry line and column). Lengths m, forces N, times s, angles rad inside; the file
// uses _mm and _deg keys. Frame T.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "haptics/contact/instrument.h"
#include "haptics/exchange/contact_patch.h"
#include "haptics/quantities.h"
#include "scenarios/kinds/grasp/grasp_rules.h"
#include "scenarios/kinds/reach/reach_rules.h"
#include "scenarios/kinds/touch/touch_rules.h"
#include "scenarios/scoring/rubric.h"
#include "tissue/interaction/breathing.h"
#include "tissue/solid/tissue_table.h"
#include "tissue/thin/duct_setup.h"

namespace trocar {

/// What each kind is: scenarios/kinds/kind.h.
enum class ExerciseKind : std::uint8_t {
  kReach,
  kTouch,
  kGrasp,
  kCamera,
  kWire,
  kPalpate,
  kRetract,
  kPegs,
  kFind,
  kClip,
  kGauze,
  kNeedle,
  kDissect,
  kOperation
};

/// What only one kind has, of the whole exercise or of a level: its room, scenarios/kinds/<kind>/<kind>_rules.h,
/// derives from this and own_rules() reads it there.
struct KindRules {};

enum class Mapping : std::uint8_t { kDirect, kFulcrum };
constexpr const char* mapping_name(Mapping mapping) { return mapping == Mapping::kFulcrum ? "fulcrum" : "direct"; }

/// A wanted force, N.
struct WantedForce {
  double low_n = 0, high_n = 0;
  bool operator==(const WantedForce&) const = default;
};

/// Other anchors of one sub-score at one level.
struct LevelAnchors {
  std::string subscore;
  double full_at = 0, zero_at = 0;
};

/// What a level is for hands at mouse, keys or pad, which feel nothing: its assists, and anchors of its own.
struct PointerLevel {
  bool glide = false;        ///< over organ or board the tip keeps its height, until a person says otherwise
  double expert_time_s = 0;  ///< muE of time anchors; 0: as with the device
  Rubric rubric;
};

/// What one level asks for.
struct ExerciseLevel {
  std::string name;  ///< "L1", "L2", "L3" or "exam"
  Mapping mapping = Mapping::kDirect;
  Vec3 port_m = Vec3::Zero();            ///< fulcrum only: the pivot, relative to the region's centre
  double instrument_length_m = 0.300;    ///< fulcrum only: handle to tip
  double motion_scale = 1;               ///< scene metres per device metre
  double force_scale = 1;                ///< kappa; "auto" is resolved by the session and is negative here
  std::string force_display = "always";  ///< always | band (only outside the limits) | after (not during the run)
  bool guides = true;                    ///< guide lines from the tip to what is asked for
  bool exam = false;                     ///< a trainee meets each board once
  double time_limit_s = 0;
  double expert_time_s = 0;                ///< muE of the rubric's time anchors; 0 when they need none
  double band_low_n = 0, band_high_n = 0;  ///< touch: lowest and highest wanted force
  std::vector<WantedForce> bands;          ///< touch: one, or several dealt out to the discs
  double position_tolerance_m = 0, angle_tolerance_rad = 0;  ///< reach
  std::vector<LevelAnchors> anchors;                         ///< in place of the rubric's
  GraspLevel grasp;                                          ///< grasp
  std::shared_ptr<const KindRules> own;                      ///< what only its kind has; nullptr: nothing
  std::vector<ExerciseLevel> stages;                         ///< operation: of each of its stages
  Rubric rubric;                                             ///< with this level's anchors
  PointerLevel pointer;
};

/// What helps a hand at mouse, keys or pad at a level, as attempts keep it: "height" where the tip keeps its height by
/// itself, "plumb" where a line falls from it to what lies below; separated by a space, empty without.
inline std::string pointer_assists(const ExerciseLevel& level) {
  if (!level.pointer.glide) return level.guides ? "plumb" : "";
  return level.guides ? "height plumb" : "height";
}

/// Where the objects of a board may lie; what only discs on an organ have is marked.
struct TargetLayout {
  int count = 0;
  double radius_m = 0;                    ///< disc
  double region_x_m = 0, region_y_m = 0;  ///< extent of the board region in T
  double relief_m = 0;                    ///< objects lie within +- this height of the region's centre
  double min_spacing_m = 0;
  double max_slope_rad = 0;  ///< disc: between the surface normal and the approach axis (T's z)
  double wrong_place_m = 0;  ///< disc: first contact further than this outside is a wrong place
};

/// A duct or vessel beside the organ; only where the organ gives way.
struct DuctPlan {
  std::string name;          ///< "cystic duct"
  std::string material;      ///< of assets/tissues.toml
  std::string organ;         ///< material of the organs that have it; others go without
  std::vector<Vec3> path_m;  ///< from the region's centre, axes of T; what its ends hang on moves them there
  double outer_radius_m = 0, wall_m = 0;
  std::array<DuctHold, 2> ends{};
  DuctContent content = DuctContent::kNothing;
};

/// A sheet of tissue on the organ, hung on it along its first edge; only where the organ gives way.
struct SheetPlan {
  std::string name;                    ///< "flap"
  std::string material;                ///< of assets/tissues.toml
  std::string organ;                   ///< material of the organs that have it; others go without
  Eigen::Vector2d corner_m, along_m;   ///< in T's xy: an end of the hinge, and the way to its other end
  double across_m = 0;                 ///< extent from the hinge, to the left of that way
  double thickness_m = 0, edge_m = 0;  ///< edge: of its triangles
};

/// A neighbour of the organ that gives way with it, bound to it until it is peeled off; only where the organ gives way.
struct BedPlan {
  std::string organ;      ///< material of the organs that have it; others go without
  std::string neighbour;  ///< name of the organ of the scene that is bound
  std::string material;   ///< of the neighbour, of assets/tissues.toml
  double strength_pa = 0, energy_j_per_m2 = 0, reach_m = 0;
};

/// How the organ lies, as an assistant holds it: turned from where a patient on the back has it, another organ of the
/// scene in the middle.
struct LiePlan {
  Vec3 turned_rad = Vec3::Zero();  ///< about the axes of T, x first
  std::string middle;              ///< name of that one; where it is not there, the organ lies as ever
};

/// A curved needle with its thread, that a needle driver brings in; only where the organ gives way.
struct SuturePlan {
  double needle_m = 0.026;  ///< along its arc
  double circle = 0.5;      ///< share of a whole circle
  double thread_m = 0.15;
};

/// An earlier version of the exercise's file, whose passes count as this one's if they are from before a day: the old
/// file could be run again at any time.
struct FormerRubric {
  std::string sha256;
  std::string until;  ///< "2026-11-26", UTC
};

struct Exercise;

/// A part of an operation: an exercise of another kind, at a place of its own in the same region.
struct ExerciseStage {
  std::string name;                          ///< in metrics, "<name>/<metric>"
  Vec3 at_m = Vec3::Zero();                  ///< of its region's centre from the operation's, along x and y of T
  InstrumentKind instrument;                 ///< to be in hand as it begins
  std::shared_ptr<const Exercise> exercise;  ///< without levels and rubric
};

struct Exercise {
  ExerciseKind kind = ExerciseKind::kTouch;
  std::string id, title, version;  ///< "surface-touch"
  std::string number;              ///< "E02"
  std::vector<FormerRubric> former_rubrics = {};
  std::string goal;                             ///< one line for briefing and report
  double time_limit_s = 0;                      ///< unless the level names its own
  double start_sphere_m = 0, start_hold_s = 0;  ///< radius; time in it: READY -> ARMED -> RUN
  Vec3 start_above_m = Vec3::Zero();            ///< start sphere's centre relative to the region's centre
  /// That can be taken in hand, the first at the start; at least one.
  std::vector<InstrumentKind> instruments = {InstrumentKind::kProbe};
  TargetLayout layout;
  PenRules pens;                      ///< reach
  double hold_s = 0;                  ///< time in band, or in pose, that completes a target
  double counted_hold_s = 0;          ///< touch, grasp: of the time in one object's band so much counts
  double rise_s = 0.5;                ///< after the first touch of an object, in which a force below the band is free
  ContactMaterial surface;            ///< touch: of the organ
  std::string tissue = kStillTissue;  ///< touch: one of kTissueWords, unless the run says otherwise
  double soft_force_n = 0, hard_force_n = 0, critical_force_n = 0;
  double retract_height_m = 0;           ///< of the ideal path between targets
  GripTask grip;                         ///< touch
  GraspRules grasp;                      ///< grasp
  std::shared_ptr<const KindRules> own;  ///< what only its kind has; nullptr: nothing
  std::vector<DuctPlan> ducts;
  std::vector<SheetPlan> sheets;
  Breathing breathing;  ///< only where the organ gives way
  std::optional<BedPlan> bed;
  std::optional<SuturePlan> suture;
  std::optional<LiePlan> lie;
  std::vector<ExerciseStage> stages;  ///< operation: in their order
  bool is_stage = false;              ///< of an operation: surface, tissue and start are that one's
  std::vector<ExerciseLevel> levels;
  Rubric rubric;  ///< of the first level
  std::filesystem::path file;
  std::string text;  ///< the file's bytes: embedded in recordings, hashed as the rubric's version

  /// Whether an attempt graded by that rubric is one at this exercise. One by an edited file is not, whatever id it
  /// bears. @param started_utc ISO 8601
  bool names(const std::string& rubric_sha256, const std::string& started_utc) const {
    return rubric_sha256 == rubric.sha256 ||
           std::any_of(former_rubrics.begin(), former_rubrics.end(), [&](const FormerRubric& former) {
             return former.sha256 == rubric_sha256 && started_utc < former.until;
           });
  }
};

/// What only its kind has, of an exercise or a level. @pre it is of that kind, and read
template <class Rules, class Of>
const Rules& own_rules(const Of& of) {
  return static_cast<const Rules&>(*of.own);
}

}  // namespace trocar
