// A Mesa card with HostMot2 firmware that is not there: its registers, its datagrams on the loopback, and behind them
// the simulated device with its hand.
//
// It answers byte for byte as a card does and has troubles of a link and of a card for tests. The plant's clock is the
// card's: an exchange that reads the counters lets one period pass (SYNC), before the counters are latched; what was
// written to the outputs before acts from then on. Watchdog: so long without a kick, in the plant's time, and every pin
// is an input again, which switches the amplifiers off by wire; written codes and enables then change nothing until the
// pins are set up again. Thread: a thread of its own serves the socket; all other calls from one other thread. They
// lock.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "haptics/device/hostmot2/hostmot2_map.h"
#include "haptics/device/hostmot2/udp_link.h"
#include "haptics/device/simulated_daq.h"

namespace trocar {

/// What is wrong with a card, or its link; by default nothing.
struct CardTroubles {
  double loses_questions = 0, loses_answers = 0;  ///< share of the datagrams
  double repeats = 0;                             ///< share of the answers that come twice
  double swaps = 0;                               ///< share of the answers that come only after the next one
  double late_s = 0;                              ///< before each answer
  double cuts = 0;                                ///< share of the answers that end early
  double babbles = 0;         ///< share of the answers with random bytes before them, as a datagram of their own
  bool silent = false;        ///< answers nothing
  double shift_s = 0;         ///< its time is so far ahead of the device's: it is asked when it is, not at a SYNC
  bool frozen = false;        ///< time and counters stand still, everything else goes on
  bool lies = false;          ///< answers in time, of the right length, to the right question, and makes the data up
  bool no_kicks = false;      ///< the watchdog does not see that it is kicked
  int quadrature_errors = 0;  ///< channels whose next read has one, a bit each
  std::uint32_t cookie = hostmot2::kCookie;
  std::string name = hostmot2::kName;
  int encoders = 8, outputs = 8;
  std::uint64_t seed = 1;
};

class FakeHostmot2 final : public SimulatedWorld {
 public:
  /// The simulated device as this card has it: bits of its outputs, dated edges, nothing read back, no watchdog of its
  /// own.
  static SimulatedDaqConfig device_config(SimulatedDaqConfig config);
  /// @param device made of device_config(); outlives the card. @param faults those of the device, of which some are the
  /// card's. @throws EnvironmentError: no port on the loopback.
  FakeHostmot2(SimulatedDaq& device, const std::vector<InjectedFault>& faults, const hostmot2::Wiring& wiring,
               const CardTroubles& troubles = {});
  ~FakeHostmot2() override;
  FakeHostmot2(const FakeHostmot2&) = delete;
  FakeHostmot2(FakeHostmot2&&) = delete;
  FakeHostmot2& operator=(const FakeHostmot2&) = delete;
  FakeHostmot2& operator=(FakeHostmot2&&) = delete;

  std::string address() const;  ///< "127.0.0.1:40123"
  /// From the next datagram on.
  void trouble(const CardTroubles& troubles);
  /// Off and on again: registers as after power-up, the device where it is.
  void power_cycle();
  std::array<std::int32_t, kChannels> codes_in_force() const;
  bool amplifiers_enabled() const;
  /// Waits until so many datagrams have been dealt with: what is sent without a question has acted then.
  void settle(std::uint64_t datagrams) const;
  /// The device rests while it is held: for who looks at it from outside.
  std::unique_lock<std::mutex> hold() const { return std::unique_lock(mutex_); }

  void set_hand_intent(const Pose& X_BS, double jaw_opening_m) noexcept override;
  void press_clutch(bool pressed) noexcept override;
  void press_pedal(bool pressed) noexcept override;
  void press_exchange(bool pressed) noexcept override;
  void press_deadman(bool pressed) noexcept override;
  void lead_arm(const JointVector& from_jig, double seconds) noexcept override;
  HandSense sense() const noexcept override;
  void miss_sync() noexcept override;
  double time_s() const noexcept override;

 private:
  void serve();
  void deal_with(const lbp16::Datagram& question);
  void power_up();
  lbp16::Datagram answer_to(const lbp16::Datagram& question);
  std::uint32_t read_register(std::uint16_t address);
  void write_register(std::uint16_t address, std::uint32_t value);
  bool sync();
  void watch();
  bool outputs_connected() const;
  void drive();
  std::uint32_t inputs(int port) const;
  bool happens(double share) { return share > 0 && std::uniform_real_distribution<double>()(random_) < share; }
  void send(const lbp16::Datagram& answer);

  mutable std::mutex mutex_;
  SimulatedDaq& device_;
  PlantFaults faults_;  ///< those that are the card's
  hostmot2::Wiring wiring_;
  CardTroubles troubles_;
  std::mt19937_64 random_;
  UdpLink socket_;
  lbp16::Datagram held_;  ///< an answer that comes after the next one
  bool holds_ = false;

  std::vector<std::uint32_t> memory_;  ///< registers without an act of their own, by address / 4
  std::array<std::uint16_t, 4> host_words_{};
  std::array<std::uint16_t, kChannels> stamps_{};
  DaqSample latched_;
  std::array<std::int32_t, kChannels> zero_{};  ///< of the counters, at power-up
  double kicked_s_ = 0;
  bool latch_due_ = true, silent_now_ = false, enabled_ = false;
  std::uint16_t stamp_ = 0;  ///< time as it was latched

  std::atomic<std::uint64_t> dealt_with_ = 0;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

}  // namespace trocar
