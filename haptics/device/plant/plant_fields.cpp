#include "haptics/device/plant/plant_fields.h"

namespace trocar {
namespace {

using P = PlantParameters;

constexpr PlantNumber kNumbers[] = {
    {"arm", "gravity_m_s2", 0, 20, "weights below are given in newtons", [](P& p) -> double& { return p.gravity; }},
    {"arm", "link1_m", 0.05, 0.5, "[T] Table 2.3", [](P& p) -> double& { return p.link1; }},
    {"arm", "link2_m", 0.05, 0.5, "[T] Table 2.3", [](P& p) -> double& { return p.link2; }},
    {"arm", "leg_stop", 0, 0.5, "sine of the angle at which legs meet: assumption",
     [](P& p) -> double& { return p.leg_stop; }},
    {"arm", "platform_inertia_kg_m2", 1e-7, 0.1, "platform and legs: assumption",
     [](P& p) -> double& { return p.platform_inertia; }},
    {"wrist_motors", "mass_kg", 1e-4, 10, "[T] Table 4.1, 3.21 N",
     [](P& p) -> double& { return p.platform_masses[0].mass; }},
    {"link1", "mass_kg", 1e-4, 10, "[T] Table 4.1, 0.20 N", [](P& p) -> double& { return p.platform_masses[1].mass; }},
    {"elbow_motor", "mass_kg", 1e-4, 10, "[T] Table 4.1, 1.61 N",
     [](P& p) -> double& { return p.platform_masses[2].mass; }},
    {"stylus", "mass_kg", 1e-3, 5, "[T] Table 4.1, 0.76 N: link 2 and stylus",
     [](P& p) -> double& { return p.stylus_mass; }},
    {"jaw", "mass_kg", 1e-4, 1, "jaw and finger pads: assumption", [](P& p) -> double& { return p.jaw_mass; }},
    {"jaw", "jig_opening_m", 0, 0.1, "the jig's block between the jaws: assumption",
     [](P& p) -> double& { return p.jig_jaw_opening; }},
    {"electronics", "bus_v", 1, 100, "[T] the motor's nominal voltage; the supply an assumption",
     [](P& p) -> double& { return p.bus_voltage; }},
    {"electronics", "dac_full_scale_v", 0.1, 50, "[T]", [](P& p) -> double& { return p.dac_full_scale; }},
    {"electronics", "amplifier_tau_s", 1e-6, 0.05, "[M] bandwidth 2 kHz",
     [](P& p) -> double& { return p.amplifier_time_constant; }},
    {"electronics", "current_limit_a", 0.01, 100, "[T] peak of the amplifier",
     [](P& p) -> double& { return p.current_limit; }},
    {"electronics", "counts_per_turn", 1, 1e6, "[T] 500 lines, four edges a line",
     [](P& p) -> double& { return p.counts_per_turn; }},
};

constexpr PlantVector kVectors[] = {
    {"wrist_motors", "at_home_m", -1, 1, "[T] Table 4.1, in W' at home",
     [](P& p) -> Vec3& { return p.platform_masses[0].position_home; }},
    {"link1", "at_home_m", -1, 1, "[T] Table 4.1, in W' at home",
     [](P& p) -> Vec3& { return p.platform_masses[1].position_home; }},
    {"elbow_motor", "at_home_m", -1, 1, "[T] Table 4.1, in W' at home",
     [](P& p) -> Vec3& { return p.platform_masses[2].position_home; }},
    {"stylus", "com_m", -0.5, 0.5, "[T] at the stylus origin, stylus axes", [](P& p) -> Vec3& { return p.stylus_com; }},
    {"stylus", "inertia_kg_m2", -0.1, 0.1, "Ixx Iyy Izz about the centre of mass: assumption, a 12 cm pen",
     [](P& p) -> Vec3& { return p.stylus_inertia; }},
    {"stylus", "products_kg_m2", -0.1, 0.1, "Ixy Ixz Iyz, elements of the tensor",
     [](P& p) -> Vec3& { return p.stylus_products; }},
};

constexpr double kFarCount = 4294967296.0;

constexpr ChannelNumber kJoint[] = {
    {"torque_constant_n_m_per_a", 1e-4, 1, "[T]; 0.0234 in the public table [F]",
     [](P& p, int i) -> double& { return p.channel[i].torque_constant; }},
    {"resistance_ohm", 0.01, 1000, "[F][T] at ambient temperature",
     [](P& p, int i) -> double& { return p.channel[i].resistance; }},
    {"rotor_inertia_kg_m2", 1e-9, 1e-3, "[F] 10.3 g cm2",
     [](P& p, int i) -> double& { return p.channel[i].rotor_inertia; }},
    {"ratio", 0.01, 10, "[T] joint over motor angle", [](P& p, int i) -> double& { return p.channel[i].ratio; }},
    {"amplifier_a_per_v", -10, 10, "[C] 10 V is 100 mN m at the motor; negative: leads swapped",
     [](P& p, int i) -> double& { return p.channel[i].amplifier_gain; }},
    {"dac_gain", 0.1, 10, "true over nominal; 1 % error is an assumption",
     [](P& p, int i) -> double& { return p.channel[i].dac_gain; }},
    {"dac_offset_v", -5, 5, "5 mV is an assumption", [](P& p, int i) -> double& { return p.channel[i].dac_offset; }},
    {"encoder_offset_counts", -kFarCount, kFarCount, "counter at motor angle zero",
     [](P& p, int i) -> double& { return p.channel[i].encoder_offset_counts; }},
    {"coulomb_n_m", 0, 2, "[C] no-load current, twice for cable and bearings: assumption",
     [](P& p, int i) -> double& { return p.channel[i].friction.coulomb; }},
    {"viscous_n_m_s_per_rad", 0, 10, "0.002 to 0.01: assumption",
     [](P& p, int i) -> double& { return p.channel[i].friction.viscous; }},
    {"stribeck_ratio", 1, 10, "breakaway over Coulomb: assumption",
     [](P& p, int i) -> double& { return p.channel[i].friction.stribeck_ratio; }},
    {"stribeck_rad_per_s", 1e-4, 10, "assumption",
     [](P& p, int i) -> double& { return p.channel[i].friction.stribeck_speed; }},
    {"bristle_rad", 1e-6, 0.1, "assumption, standard LuGre",
     [](P& p, int i) -> double& { return p.channel[i].friction.bristle_length; }},
    {"bristle_inertia_kg_m2", 0, 1, "critical bristle damping for it: assumption",
     [](P& p, int i) -> double& { return p.channel[i].friction.damping_inertia; }},
    {"stop_lower_rad", -10, 10, "[T] Table 2.4", [](P& p, int i) -> double& { return p.channel[i].stop.lower; }, true},
    {"stop_upper_rad", -10, 10, "[T] Table 2.4", [](P& p, int i) -> double& { return p.channel[i].stop.upper; }, true},
    {"stop_n_m_per_rad", 0, 1e5, "hard rubber: assumption",
     [](P& p, int i) -> double& { return p.channel[i].stop.stiffness; }},
    {"stop_n_m_s_per_rad", 0, 1e3, "assumption", [](P& p, int i) -> double& { return p.channel[i].stop.damping; }},
    {"jig_error_rad", -0.2, 0.2, "how far the jig misses: 0.05 deg is an assumption",
     [](P& p, int i) -> double& { return p.jig_error[i]; }},
};

constexpr ChannelNumber kPinch[] = {
    {"torque_constant_n_m_per_a", 1e-4, 1, "assumption, as the joints'",
     [](P& p, int i) -> double& { return p.channel[i].torque_constant; }},
    {"resistance_ohm", 0.01, 1000, "assumption", [](P& p, int i) -> double& { return p.channel[i].resistance; }},
    {"rotor_inertia_kg_m2", 1e-9, 1e-3, "assumption",
     [](P& p, int i) -> double& { return p.channel[i].rotor_inertia; }},
    {"pulley_m", 1e-4, 0.1, "m of opening a motor radian: assumption",
     [](P& p, int i) -> double& { return p.channel[i].ratio; }},
    {"amplifier_a_per_v", -10, 10, "as the joints'",
     [](P& p, int i) -> double& { return p.channel[i].amplifier_gain; }},
    {"dac_gain", 0.1, 10, "true over nominal", [](P& p, int i) -> double& { return p.channel[i].dac_gain; }},
    {"dac_offset_v", -5, 5, "5 mV is an assumption", [](P& p, int i) -> double& { return p.channel[i].dac_offset; }},
    {"encoder_offset_counts", -kFarCount, kFarCount, "counter at motor angle zero",
     [](P& p, int i) -> double& { return p.channel[i].encoder_offset_counts; }},
    {"coulomb_n", 0, 20, "assumption", [](P& p, int i) -> double& { return p.channel[i].friction.coulomb; }},
    {"viscous_n_s_per_m", 0, 1e3, "assumption", [](P& p, int i) -> double& { return p.channel[i].friction.viscous; }},
    {"stribeck_ratio", 1, 10, "assumption",
     [](P& p, int i) -> double& { return p.channel[i].friction.stribeck_ratio; }},
    {"stribeck_m_per_s", 1e-5, 1, "assumption",
     [](P& p, int i) -> double& { return p.channel[i].friction.stribeck_speed; }},
    {"bristle_m", 1e-8, 1e-2, "assumption",
     [](P& p, int i) -> double& { return p.channel[i].friction.bristle_length; }},
    {"bristle_mass_kg", 0, 10, "assumption",
     [](P& p, int i) -> double& { return p.channel[i].friction.damping_inertia; }},
    {"stop_lower_m", -0.1, 0.2, "assumption", [](P& p, int i) -> double& { return p.channel[i].stop.lower; }},
    {"stop_upper_m", -0.1, 0.2, "assumption", [](P& p, int i) -> double& { return p.channel[i].stop.upper; }},
    {"stop_n_per_m", 0, 1e7, "assumption", [](P& p, int i) -> double& { return p.channel[i].stop.stiffness; }},
    {"stop_n_s_per_m", 0, 1e5, "assumption", [](P& p, int i) -> double& { return p.channel[i].stop.damping; }},
};

constexpr PlantNumber kOptions[] = {
    {"encoder", "missed_per_edge", 0, 1, "chance that an edge is not counted: assumption",
     [](P& p) -> double& { return p.options.encoder.missed_per_edge; }},
    {"encoder", "limit_hz", 0, 1e9, "[M] lines a second, 100e3 for the HEDS-5540; 0: any",
     [](P& p) -> double& { return p.options.encoder.limit_hz; }},
    {"encoder", "index", 0, 1, "[T] appendix: the third channel; 1 is wired",
     [](P& p) -> double& { return p.options.encoder.index; }},
    {"encoder", "uneven_counts", 0, 0.4, "most that an edge lies off its even place, counts: assumption",
     [](P& p) -> double& { return p.options.encoder.uneven_counts; }},
    {"beam", "beam_deg", 1, 180, "[T] appendix, SE5455: between half intensities",
     [](P& p) -> double& { return p.options.beam.beam_deg; }},
    {"beam", "acceptance_deg", 1, 180, "[T] appendix, SD5600",
     [](P& p) -> double& { return p.options.beam.acceptance_deg; }},
    {"beam", "bore_m", 1e-4, 0.05, "bore of the coupler: assumption",
     [](P& p) -> double& { return p.options.beam.bore_m; }},
    {"beam", "margin", 0, 100, "light through the coupler over the threshold: assumption",
     [](P& p) -> double& { return p.options.beam.margin; }},
    {"beam", "hysteresis", 0, 0.9, "[T] appendix: 0.05 to 0.30 of the threshold",
     [](P& p) -> double& { return p.options.beam.hysteresis; }},
    {"beam", "ambient", 0, 100, "light past the coupler, thresholds",
     [](P& p) -> double& { return p.options.beam.ambient; }},
    {"beam", "noise", 0, 10, "SD of the light, thresholds", [](P& p) -> double& { return p.options.beam.noise; }},
    {"beam", "jig_play_rad", 0, 0.2, "that the jig holds joints 1 to 5 elsewhere each time: assumption",
     [](P& p) -> double& { return p.options.jig_play; }},
    {"pinch_drive", "backlash_m", 0, 0.01, "of the slide between its gears: assumption",
     [](P& p) -> double& { return p.options.pinch.backlash; }},
    {"pinch_drive", "counts_per_m", 0, 1e8, "of a potentiometer, digitised; 0: the motor's encoder",
     [](P& p) -> double& { return p.options.pinch.counts_per_m; }},
    {"pinch_drive", "noise_counts", 0, 100, "SD of the potentiometer's reading: assumption",
     [](P& p) -> double& { return p.options.pinch.noise_counts; }},
    {"pinch_drive", "dead_every_m", 0, 0.1, "between worn places of the track; 0: none",
     [](P& p) -> double& { return p.options.pinch.dead_every; }},
    {"pinch_drive", "dead_wide_m", 0, 0.01, "of each", [](P& p) -> double& { return p.options.pinch.dead_wide; }},
    {"pinch_drive", "driver_lag_s", 0, 0.1, "of the servo driver's current: assumption",
     [](P& p) -> double& { return p.options.pinch.driver_lag; }},
    {"heat", "winding_to_case_k_per_w", 0.01, 100, "[M]",
     [](P& p) -> double& { return p.options.heat.winding_to_case; }},
    {"heat", "case_to_air_k_per_w", 0.01, 1000, "[M]", [](P& p) -> double& { return p.options.heat.case_to_air; }},
    {"heat", "winding_time_s", 0.1, 1e4, "[M]", [](P& p) -> double& { return p.options.heat.winding_time; }},
    {"heat", "case_time_s", 1, 1e5, "[M]", [](P& p) -> double& { return p.options.heat.case_time; }},
    {"heat", "copper_per_k", 0, 0.02, "[M]", [](P& p) -> double& { return p.options.heat.copper_per_k; }},
    {"heat", "ambient_c", -40, 80, "degrees Celsius, where resistance_ohm holds",
     [](P& p) -> double& { return p.options.heat.ambient_c; }},
    {"heat", "start_c", -40, 155, "degrees Celsius, winding and case at first",
     [](P& p) -> double& { return p.options.heat.start_c; }},
};

constexpr ChannelNumber kCable[] = {
    {"stiffness_n_m_per_rad", 0, 1e4, "50 to 200: assumption; 0 is rigid",
     [](P& p, int i) -> double& { return p.options.cable[i].stiffness; }},
    {"damping_n_m_s_per_rad", 0, 10, "assumption", [](P& p, int i) -> double& { return p.options.cable[i].damping; }},
    {"friction_on_motor", 0, 1, "[C] share of the joint's friction that is the motor's",
     [](P& p, int i) -> double& { return p.options.cable[i].friction_on_motor; }},
};

}  // namespace

std::span<const PlantNumber> plant_numbers() { return kNumbers; }
std::span<const PlantVector> plant_vectors() { return kVectors; }
std::span<const ChannelNumber> joint_numbers() { return kJoint; }
std::span<const ChannelNumber> pinch_numbers() { return kPinch; }
std::span<const PlantNumber> option_numbers() { return kOptions; }
std::span<const ChannelNumber> cable_numbers() { return kCable; }

}  // namespace trocar
