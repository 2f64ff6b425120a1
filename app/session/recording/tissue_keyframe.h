// A moment of an attempt as the recording keeps it for playback: what pictures and displays need and rows of the loop
// lack, with the nodes of the tissue that deforms. Nobody solves again to see it.
//
// Keyframes come at a fixed rate, and wherever something changes that has no values in between (the cue, a contact, a
// grip); those have no shape of their own. Frame T, SI units. Thread: any, plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "haptics/exchange/tick_record.h"
#include "scenarios/director/director.h"
#include "tissue/tissue_frame.h"
#include "tissue/tissue_shape.h"

namespace trocar {

/// What a row does not say of the instrument and its device.
struct InstrumentDetail {
  Mat3 R_TI = Mat3::Identity();
  bool contact = false, tip_contact = false, clutched = false, port_held = false, armed = false;
  Fault fault;
  Vec3 contact_point_T = Vec3::Zero(), contact_normal_T = Vec3::UnitZ();
  double depth_m = 0, depth_in_port_m = 0, winding_c = 0, rendered_grip_n = 0;
};

InstrumentDetail detail_of(const TickRecord& record);

struct TissueKeyframe {
  std::uint64_t period = 0;  ///< of the tick whose state the tissue step saw
  InstrumentDetail instrument;
  DirectorStatus status;
  TissueFrame tissue;
  bool shaped = false;  ///< the rest is of this moment, else empty
  std::uint64_t topology = 0;
  std::vector<NodePlace> nodes_T;
  std::vector<ShapeField> fields;
};

/// A change of topology, kept exactly as the world told it.
struct TopologyEvent {
  std::uint64_t period = 0;
  std::string bytes;
  bool operator==(const TopologyEvent&) const = default;
};

/// When keyframes are made.
struct KeyframeRule {
  double rate_hz = 20;  ///< of shapes, > 0
  bool always = false;  ///< also where nothing deforms, so that a long attempt opens at once
};

/// Nothing lies between the two but numbers that run from one to the other.
bool runs_on(const DirectorStatus& a, const DirectorStatus& b);
bool runs_on(const TissueFrame& a, const TissueFrame& b);

}  // namespace trocar
