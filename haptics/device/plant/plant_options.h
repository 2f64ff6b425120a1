// What the simulated device can have beyond its plain model. Everything is off by default: a plant without options
// behaves to the bit as if this header were not there.
//
//   cable     the capstan cable of a joint as a spring: the rotor becomes a state of its own (plant_cable.h)
//   encoder   edges that the counter does not see, and uneven ones (plant_encoder.h)
//   jitter    further whole periods between write and DAC, drawn anew each SYNC (simulated_daq.h)
//   beam      the infrared light of the jig: angles, threshold, ambient light, noise (infrared_beam.h)
//   heat      windings and cases warm up, copper resists more (plant_heat.h)
// Marks of the values as in plant_parameters.h. Units: SI, radians, temperatures in degrees Celsius.
// Thread: plain values, any thread.
#pragma once

#include <array>

#include "haptics/quantities.h"

namespace trocar {

inline constexpr double kNominalCable = 100;  ///< N m/rad at the joint, 50 to 200: assumption

/// Cable between a motor's pinion and its joint, seen at the joint.
struct CableParameters {
  double stiffness = 0;            ///< N m/rad; 0: rigid
  double damping = 0.02;           ///< N m s/rad: assumption
  double friction_on_motor = 0.5;  ///< share of the joint's friction that rubs on the motor's side (brushes) [C]
};

struct EncoderFlaws {
  double missed_per_edge = 0;  ///< chance that the counter does not see an edge
  double limit_hz = 0;         ///< lines a second that the encoder can follow, 100 kHz [M]; 0: any
  double index = 0;            ///< 1: the third channel is wired and marks one count a turn [T appendix, HEDS-5540]
  double uneven_counts = 0;    ///< most that an edge lies off its even place, counts: assumption
};

/// One motor as two nodes, winding and case.
struct HeatParameters {
  bool on = false;
  double winding_to_case = 3.1;  ///< K/W [M]
  double case_to_air = 14;       ///< K/W [M]
  double winding_time = 12.4;    ///< s [M]
  double case_time = 612;        ///< s [M]
  double copper_per_k = 0.0039;  ///< 1/K [M]
  double ambient_c = 25;         ///< also where the resistance is the stated one
  double start_c = 25;           ///< winding and case at first
};

/// Infrared pair of the jig and the coupler on the handle (infrared_beam.h): always there, ideal by default.
struct InfraredParameters {
  double beam_deg = 20;        ///< between the half-intensity points of the emitter [T appendix, SE5455]
  double acceptance_deg = 12;  ///< likewise of the receiver [T appendix, SD5600]
  double bore_m = 0.004;       ///< of the coupler: assumption
  double margin = 2;           ///< light through the coupler over the receiver's threshold: assumption
  double hysteresis = 0.15;    ///< share of the threshold, 0.05 to 0.30 [T appendix]
  double ambient = 0;          ///< light past the coupler, in thresholds
  double noise = 0;            ///< SD of the light at the receiver, in thresholds
};

/// What the pinch's other designs have beyond a pulley on the motor (plant_pinch.h). All zero: a pulley.
struct PinchOptions {
  double backlash = 0;      ///< m of the slide between the flanks of its gears
  double counts_per_m = 0;  ///< of a potentiometer on the slide, digitised; 0: the encoder on the motor
  double noise_counts = 0;  ///< SD of that reading
  double dead_every = 0;    ///< m between worn places, where the wiper stands off and the reading stays
  double dead_wide = 0;     ///< m
  double driver_lag = 0;    ///< s, of the servo driver's current
};

struct PlantOptions {
  std::array<CableParameters, kArmJoints> cable{};
  EncoderFlaws encoder;
  int jitter_periods = 0;  ///< most; 0 to 2 ms is the reference's assumption
  HeatParameters heat;
  InfraredParameters beam;
  PinchOptions pinch;
  double jig_play = 0;  ///< rad: most that the jig holds joints 1 to 5 elsewhere each time
};

}  // namespace trocar
