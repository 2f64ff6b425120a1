// The impedance of the hand that holds the simulated stylus: an intent pulls the stylus, it never sets its pose.
//
//   translation   x_tool -[k_g, b_g]- M_h -[K_h, B_h]- x_intent
//   rotation      spring and damper between the stylus and the intended orientation, about the stylus origin
//   fingers       spring and damper between the jaw and the intended opening
//   tremor        8 to 12 Hz, added between M_h and the grip
// Where the reaction is on (plant_reaction.h; off by default), a touch stiffens first the arm by reflex, then the grip
// towards GripPreset::kFirm.
// M_h is integrated semi-implicitly at the plant's sub-step. Forces are limited to what a hand can do.
// Frame W' (base, z up), SI. Thread: one owner; nothing allocates or throws after construction.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/device/plant/device_plant.h"
#include "haptics/device/plant/plant_reaction.h"
#include "haptics/quantities.h"

namespace trocar {

enum class GripPreset : std::uint8_t { kFingertip, kLight, kNormal, kFirm };

struct HandParameters {
  // Translation, per grip (k_g and b_g are design assumptions, M_h, B_h, K_h after a published arm
  // trial: .554 kg, 6.45 N s/m, 135 N/m).
  double grip_stiffness = 400;  ///< k_g, N/m
  double grip_damping = 2;      ///< b_g, N s/m
  double hand_mass = 0.4;       ///< M_h, kg
  double arm_damping = 6;       ///< B_h, N s/m
  double arm_stiffness = 130;   ///< K_h, N/m
  // Rotation: assumption. Damping ratio 1 against stylus and fingers (3e-4 kg m2).
  double turn_stiffness = 1.5;  ///< N m/rad
  double turn_damping = 0.042;  ///< N m s/rad
  // Fingers: assumption, near critical for jaw, rotor and pads.
  double finger_stiffness = 400;  ///< N/m
  double finger_damping = 6;      ///< N s/m
  double finger_limit_n = 15;
  double force_limit_n = 40;  ///< what a hand can exert on a pen, assumption
  double moment_limit_nm = 2;
  // How fast a person can want to move: keeps a leap of the intent a movement. Assumption.
  double speed_limit = 3.0;       ///< m/s
  double turn_speed_limit = 20;   ///< rad/s
  double finger_speed_limit = 1;  ///< m/s
  double tremor_m = 1e-4;         ///< amplitude of the sum over 8 to 12 Hz, each axis; 0 switches it off
  HandReaction reaction;
};

HandParameters hand_parameters(GripPreset grip);

/// Each impedance drawn log-normal (sigma 0.3) about its preset.
HandParameters draw_hand_parameters(GripPreset grip, std::uint64_t seed);

class HandModel {
 public:
  HandModel(const HandParameters& parameters, std::uint64_t tremor_seed);

  /// Wanted pose of the stylus in W' and wanted jaw opening, reached linearly over period_s or as much longer as the
  /// speed limits ask. The first call takes hold of the stylus where it is. A non-finite intent is a fault until a
  /// finite one follows; meanwhile the hand exerts nothing, and it takes hold anew afterwards.
  void set_intent(const Pose& X_BS, double jaw_opening_m, double period_s) noexcept;
  /// Lets go: no wrench until the next intent.
  void let_go() noexcept;
  void set_parameters(const HandParameters& parameters) noexcept;

  bool holding() const noexcept { return intent_ == Intent::kHolding || intent_ == Intent::kTaking; }
  bool fault() const noexcept { return intent_ == Intent::kBroken; }

  /// The impedance that acts now: that of the parameters but for what the reaction adds.
  const HandParameters& acting() const noexcept { return acting_; }
  const PlantReaction& reaction() const noexcept { return reaction_; }
  /// Load on the stylus and the jaw for the coming sub-step.
  ExternalLoad update(const StylusMotion& tool, double dt) noexcept;

 private:
  enum class Intent : std::uint8_t { kNone, kTaking, kHolding, kBroken };
  struct Wave {
    double rate, phase, amplitude;
  };
  static constexpr int kWaves = 3;  ///< sinusoids an axis

  void take_hold(const StylusMotion& tool) noexcept;
  void plan() noexcept;
  void tremble(Vec3& displacement, Vec3& velocity) const noexcept;
  Vec3 pull(const StylusMotion& tool, double share, double moving, double dt) noexcept;
  Vec3 turn(const StylusMotion& tool, double share, double moving) const noexcept;

  void react(const Vec3& force, double dt) noexcept;

  HandParameters p_, acting_;
  PlantReaction reaction_;
  std::array<std::array<Wave, kWaves>, 3> waves_;
  Intent intent_ = Intent::kNone;
  // The goal moves from `from_` by `step_` (and turn vector `turn_step_`) over period_, to the wanted pose.
  Vec3 wanted_ = Vec3::Zero();
  Eigen::Quaterniond wanted_turn_ = Eigen::Quaterniond::Identity();
  double wanted_jaw_ = 0, wanted_period_ = 1e-3;
  Vec3 from_ = Vec3::Zero(), step_ = Vec3::Zero();
  Eigen::Quaterniond from_turn_ = Eigen::Quaterniond::Identity();
  Vec3 turn_step_ = Vec3::Zero();
  double jaw_from_ = 0, jaw_step_ = 0;
  double period_ = 1e-3, elapsed_ = 0;
  Vec3 hand_ = Vec3::Zero(), hand_rate_ = Vec3::Zero();  ///< M_h
  double time_ = 0;
};

}  // namespace trocar
