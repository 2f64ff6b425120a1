// Hands drawn by seed press, slide and turn a probe on an organ that gives way, in six degrees of freedom and with
// friction, while the tissue's steps come late, stall and are lost: what `trocar study multirate` and its test count.
//
// The device is a rigid body about the tip, held by a hand (haptics/device/plant/hand_model.h) that goes on whatever
// the tissue does. Trial n of a seed is the same whatever their number. Frame T, SI. Thread: any.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/studies/tissue/soft_bench.h"
#include "haptics/device/plant/hand_model.h"

namespace trocar {

struct DrawnContact {
  GripPreset grip = GripPreset::kNormal;  ///< in turn
  HandParameters hand;
  double mass_kg = 0.2, inertia_kg_m2 = 3e-4;  ///< of the device at the tip, alike in all directions
  double young_pa = 5000, mu_static = 0.1;     ///< of the organ; it slides at half of mu_static
  double x_m = 0, y_m = 0;                     ///< of the middle of the way
  double tilt_rad = 0, tilt_round_rad = 0;     ///< of the shaft from the vertical; about which axis
  double depth_m = 0.008;                      ///< that the hand wants to be beyond touch
  Vec3 slide_m = Vec3::Zero();                 ///< half the way to and fro, across the vertical
  double slide_hz = 0.5, turn_hz = 0.7;        ///< of the slide; of the turns
  double twist_rad = 0, sway_rad = 0;          ///< about the shaft; across it
  double loss = 0.1;                           ///< share of the patches that never arrive
  std::vector<std::pair<int, int>> stall;      ///< first tick and length, 10 to 100 ms
  std::uint64_t seed = 1;                      ///< of lateness, loss and tremor
};

/// @param stiff on tissue of 20 to 50 kPa, else 2 to 20 kPa: 2.5 times that at once.
DrawnContact drawn_contact(std::uint64_t seed, std::size_t n, bool stiff = false);

struct DrawnContactOptions {
  int rows = 60;  ///< of the organ's triangles from pole to pole
  double cell_m = 0.010;
  double encoder_m = 0;  ///< of one count of the tip's place; 0: ideal
};

struct DrawnContactMeasures {
  double energy_out_j = 0;    ///< most that the hand has got back beyond what it had put in
  double put_in_j = 0;        ///< that it has lost in the end
  double most_n = 0;          ///< largest force
  double most_step_n = 0;     ///< largest change of it in a tick
  double stall_growth_n = 0;  ///< most that the springs' force grew in a stall beyond stiffness times the tool's way
  double slipping = 0;        ///< share of the ticks in contact
  double turned_rad = 0;      ///< furthest that the tool was from where it began
  bool finite = true;
};

DrawnContactMeasures run_drawn_contact(const DrawnContact& draw, const DrawnContactOptions& options);

}  // namespace trocar
