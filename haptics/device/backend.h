// A back-end: the device behind the seam, with what comes along with it. Session, commands and checks hold one of these
// and no class of a particular device.
//
// Made by make_backend() (haptics/device/backends). Thread: whoever owns it; its parts say their own.
#pragma once

#include <functional>
#include <memory>

#include "haptics/device/data_acquisition.h"
#include "haptics/device/simulated_world.h"
#include "haptics/force_sensor/force_sensor.h"

namespace trocar {

class WrenchStream;  // haptics/force_sensor/ati/wrench_stream.h

/// What a back-end lets its owner do with time.
struct BackendAbilities {
  bool pause = false;  ///< everything behind the seam stands still while nobody reads
  bool pace = false;   ///< reads set the pace: a run in lockstep is as quick as the machine is
  bool index = false;  ///< tells of the encoders' marks (index_mark.h), where they are wired
};

struct Backend {
  std::unique_ptr<DataAcquisition> daq;
  std::unique_ptr<ForceSensor> sensor = {};  ///< at the stylus; nullptr: none
  WrenchStream* stream = nullptr;            ///< `sensor`, where it is a real one; it speaks in its own axes
  SimulatedWorld* world = nullptr;           ///< plant and hand, part of `daq`; nullptr: a person holds a real device
  BackendAbilities can = {};
  /// Waits for the board's own clock, in the haptic thread, before a read; false: it tells of none now, the caller
  /// keeps the time. Empty: there is none. Neither allocates nor throws.
  std::function<bool()> await_sync = {};
};

}  // namespace trocar
