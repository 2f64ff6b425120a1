// Every number of the plant by name: where a plant file has it, between which bounds it is believed, where its nominal
// value comes from. The file is read and written by these tables, and the check of a plant goes by them.
//
// Bounds are wide of what such a device could be, to catch a slip of unit; a lower bound above 0 says that the value
// must be positive, a lower bound of 0 that it may not be negative. Sources: marks of plant_parameters.h.
// SI, radians. Thread: constant tables, any thread.
#pragma once

#include <span>

#include "haptics/device/plant/plant_parameters.h"

namespace trocar {

struct PlantNumber {
  const char *table, *key;
  double low, high;
  const char* source;
  double& (*at)(PlantParameters&);
};

struct PlantVector {
  const char *table, *key;
  double low, high;  ///< of each element
  const char* source;
  Vec3& (*at)(PlantParameters&);
};

/// One number of a channel; a stop without end is written as the word "none".
struct ChannelNumber {
  const char* key;
  double low, high;
  const char* source;
  double& (*at)(PlantParameters&, int channel);
  bool endless = false;
};

inline constexpr const char* kJointTables[kArmJoints] = {"th1", "th2", "th3", "th4", "th5", "th6"};
inline constexpr const char* kPinchTable = "pinch";

/// Tables arm, wrist_motors, link1, elbow_motor, stylus, jaw, electronics.
std::span<const PlantNumber> plant_numbers();
std::span<const PlantVector> plant_vectors();
/// Of th1 to th6 (rad, N m), and of the pinch (m, N).
std::span<const ChannelNumber> joint_numbers();
std::span<const ChannelNumber> pinch_numbers();
/// Tables encoder, beam, pinch_drive and heat: a table that is there switches its option on.
std::span<const PlantNumber> option_numbers();
/// Of the cable of one joint.
std::span<const ChannelNumber> cable_numbers();

}  // namespace trocar
