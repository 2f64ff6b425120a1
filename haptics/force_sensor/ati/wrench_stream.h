// A real force/torque sensor that talks of its own accord: a thread listens, the sensor's task takes the newest record.
//
// What a peer says is turned into newtons in the sensor's own axes, dated by the host's clock at its arrival, and
// marked: not sound where the peer reports saturation or an error. How the sensor sits on the device, and the weight
// that hangs on it, are its reader's (SensorMount in haptics/device/device_model.h). A sensor that says nothing for
// silent_s is not valid from then on, and is asked to begin anew. Threads: one of its own; sample() the sensor task's;
// it waits for nothing.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>

#include "haptics/exchange/latest.h"
#include "haptics/force_sensor/force_sensor.h"

namespace trocar {

/// CLOCK_MONOTONIC, ns.
std::int64_t monotonic_ns();

struct WrenchStreamOptions {
  double rate_hz = 40;         ///< at which the task takes samples
  double lag_s = 0.15;         ///< of the sensor with its filter, for comparison with delivered forces [T: measured]
  double silent_s = 0.2;       ///< without a record: not valid, and asked again [chosen]
  double counts_per_n = 1e6;   ///< as the box or calibration sheet says [M: Net F/T's usual]
  double counts_per_nm = 1e6;  ///< likewise
  std::string counts_from = "what is usual";  ///< who says so
  std::string counts_doubt = {};              ///< what speaks against it; empty: nothing
  std::int64_t (*now_ns)() = monotonic_ns;    ///< that dates records and tells their age
  double most_n = 125;                        ///< beyond it a record is not sound [F: Nano25 SI-125-3, across]
  double most_nm = 3;                         ///< likewise
};

struct WrenchRecord {
  std::uint64_t number = 0;       ///< of records taken in, from 1
  Vec3 force_n = Vec3::Zero();    ///< axes of the sensor, bias taken away
  Vec3 moment_nm = Vec3::Zero();  ///< about the sensor's origin, likewise
  std::int64_t arrived_ns = 0;    ///< CLOCK_MONOTONIC
  bool sound = false;
};

/// How a sensor's counts become newtons.
struct WrenchCounts {
  double per_n = 0, per_nm = 0;
  std::string from = {}, doubt = {};  ///< as WrenchStreamOptions has them
};

/// "1000000 counts a N and 1000000 a N m, from the box".
std::string counts_words(const WrenchCounts& counts);

/// What happened on the way since it was opened.
struct WrenchLink {
  std::uint64_t records = 0, lost = 0, out_of_order = 0, malformed = 0, unsound = 0;
  std::uint64_t begun = 0;  ///< how often it was asked to begin: at first, and at each silence
  /// How often records stopped although the sensor was there, unbroken: it went on as soon as it was asked.
  std::uint64_t taken_away = 0;
  WrenchCounts counts = {};
};

/// "1000 records, 12 lost, 0 broken, 0 saturated or in error; asked to begin once", and what that may mean.
std::string link_words(const WrenchLink& link);

class WrenchStream : public ForceSensor {
 public:
  ForceSample sample(const Vec3& acting) override;
  const ForceSensorConfig& config() const override { return config_; }
  std::size_t delay() const override;
  WrenchLink link() const;
  /// The newest record, and whether it still holds: sound, and no older than silent_s. The sensor task's, as sample().
  std::pair<WrenchRecord, bool> newest();
  /// Takes the present force as zero, from the next record on: torque off and the arm still, the caller's care.
  void bias() { bias_due_ = true; }

 protected:
  explicit WrenchStream(const WrenchStreamOptions& options);
  /// To be called last by the constructor of the class that listens, and stop() first by its destructor.
  void start() {
    thread_ = std::thread([this] { listen(); });
  }
  void stop();
  bool ends() const { return ends_; }
  virtual void listen() = 0;
  /// Counts of one record, three forces and three moments. @param sound as the peer says.
  void take(const std::array<std::int64_t, 6>& counts, bool sound);
  void count(std::uint64_t WrenchLink::*what, std::uint64_t by = 1);
  const WrenchStreamOptions& options() const { return options_; }

 private:
  WrenchStreamOptions options_;
  ForceSensorConfig config_;
  Latest<WrenchRecord> newest_;
  std::uint64_t taken_ = 0, sampled_ = 0;
  Vec3 zero_ = Vec3::Zero(), zero_moment_ = Vec3::Zero();
  std::atomic<bool> bias_due_ = false, ends_ = false;
  std::array<std::atomic<std::uint64_t>, 7> counters_{};
  std::thread thread_;
};

}  // namespace trocar
