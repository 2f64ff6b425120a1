// A force/torque sensor that is not there: the driver of a real one, and at the other end of its line, byte for byte, a
// peer that says what it is given. For studies that measure on the simulated device through the real driver.
//
// One record a call, and the call waits until the driver has it: a study that runs in simulated time gives the same
// twice. Whole counts of the peer are all that is lost on the way. Thread: one; the driver has its own.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "haptics/force_sensor/ati/wrench_stream.h"

namespace trocar {

/// What the peer does with a record.
enum class PeerAct : std::uint8_t { kSays, kSaysSaturated, kStaysSilent };

class FakeSensor {
 public:
  virtual ~FakeSensor() = default;
  /// How the driver reaches it: "net-ft:127.0.0.1:40123", "serial:/dev/pts/3".
  virtual std::string words() const = 0;
  /// @return whether anybody had asked for records.
  virtual bool say(const std::array<std::int64_t, 6>& counts, bool saturated) = 0;
};

/// @param kind "net-ft" or "serial". @throws InputError: another; EnvironmentError: no loopback, no pseudo-terminal.
std::unique_ptr<FakeSensor> make_fake_sensor(const std::string& kind);

class SensorLine {
 public:
  /// @throws as make_fake_sensor().
  explicit SensorLine(const std::string& kind);
  /// One sample through the line. @param acting force N and moment N m in the sensor's axes. @return as the driver
  /// gives it, bias taken away; nothing where it does not hold: silent, saturated.
  std::optional<Wrench> pass(const Wrench& acting, PeerAct act = PeerAct::kSays);
  /// The next sample is zero.
  void bias() { stream_->bias(); }
  WrenchLink link() const { return stream_->link(); }

 private:
  WrenchStreamOptions options_;
  std::unique_ptr<FakeSensor> peer_;
  std::unique_ptr<WrenchStream> stream_;
};

}  // namespace trocar
