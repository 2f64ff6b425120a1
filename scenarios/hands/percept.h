// What a person at the exercise perceives: what the screen asks for and shows, and what the fingers feel.
//
// Frame: theatre T (what a person sees on the screen). Plain values; must not allocate.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "haptics/contact/instrument.h"
#include "haptics/quantities.h"

namespace trocar {

/// What the exercise asks for at this moment, as the screen shows it.
/// kOrient: bring the tip to the target and turn the instrument as it shows; kPick, kCarry, kPlace: take the object at
/// the target, bring it there, set it down there. kSearch: feel for what is hidden, mark it by a long pinch. kTake,
/// kLift, kLower: take tissue at the target, lift it towards the goal and hold it there, let it down. kRead: read the
/// symbol that is to be seen and tell it by touching its like. kClip, kSever: set a clip across what runs through the
/// target, divide it there. kSnip: cut along the line from the target towards the goal. kTakeNeedle: grasp the needle,
/// which is the object; kDrive: drive it in at the target and out at the goal; kPull: draw it through. kHook: lift the
/// strand at the target on the hook towards the goal and divide it; kSeal: coagulate what bleeds at the target.
/// kExchange: take the instrument that is asked for.
enum class Cue : std::uint8_t {
  kNone,
  kWait,
  kReach,
  kPress,
  kGrip,
  kRelease,
  kFinished,
  kOrient,
  kPick,
  kCarry,
  kPlace,
  kSearch,
  kTake,
  kLift,
  kLower,
  kRead,
  kClip,
  kSever,
  kSnip,
  kTakeNeedle,
  kDrive,
  kPull,
  kHook,
  kSeal,
  kExchange
};

/// An object that the exercise is about, as it is seen on the screen.
struct SeenObject {
  Pose X_TO;  ///< centre, axes along the edges
  Vec3 size_m = Vec3::Zero();
  bool slipping = false;  ///< it creeps through the jaws
};

/// What the briefing taught about one kind of foam.
struct FoamLore {
  double stiffness_n_per_m = 0;  ///< how it feels between the jaws
  double low_n = 0, high_n = 0;  ///< wanted grip
};
inline constexpr int kMostFoams = 4;
inline constexpr int kMostAnswers = 4;

/// What a person senses: delayed and noisy, nothing of the world that is not on the screen or in the fingers.
struct Percept {
  double t_s = 0;
  bool device_ready = false;         ///< the loop is active and holds the stylus weight
  Vec3 tip_T = Vec3::Zero();         ///< seen position of the instrument tip (delayed, noisy), m
  Mat3 R_TI = Mat3::Identity();      ///< seen orientation of the instrument
  Vec3 felt_force_T = Vec3::Zero();  ///< handle on fingers, taken to the tip: tissue, friction, inertia (noisy), N
  double felt_grip_n = 0;            ///< pinch on the fingers, its friction included (noisy), N
  double jaw_opening_m = 0;          ///< seen opening of the jaws (delayed, noisy), m
  InstrumentKind instrument = InstrumentKind::kProbe;  ///< in hand, as the screen says
  Cue cue = Cue::kNone;
  std::int32_t target_index = -1;        ///< which target is lit; changes when the next one lights
  Vec3 target_T = Vec3::Zero();          ///< centre of the lit target (m)
  Vec3 target_normal_T = Vec3::UnitZ();  ///< outward surface normal at the target
  double target_radius_m = 0;
  bool target_oriented = false;            ///< the orientation below is asked for
  Mat3 target_R_TI = Mat3::Identity();     ///< wanted orientation of the instrument
  double target_angle_rad = 0;             ///< its tolerance
  double band_low_n = 0, band_high_n = 0;  ///< wanted force as shown on the force bar
  double shown_force_n = 0;                ///< reading of the force bar; NaN when the bar is hidden
  double shown_grip_n = 0;     ///< kPick, kCarry, kPlace: reading of the grip bar; NaN when the bar is hidden
  SeenObject object;           ///< kPick, kCarry, kPlace: the lit object (delayed)
  Vec3 goal_T = Vec3::Zero();  ///< there: where it shall stand; kLift: to where the tissue shall come
  std::optional<InstrumentKind> asked_instrument = {};  ///< to be in hand, as the screen asks; none: any
  int shown_symbol = -1;                                ///< which symbol is to be seen now (delayed); -1: none
  std::array<Vec3, kMostAnswers> answers_T = {};        ///< where each symbol is told
  double shown_share = 0;                 ///< kLift: how much of what lies behind is to be seen, 0 to 1 (delayed)
  std::array<FoamLore, kMostFoams> foam;  ///< there: learnt before the start
  std::int32_t foam_count = 0;
};

}  // namespace trocar
