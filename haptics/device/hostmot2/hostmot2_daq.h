// Back-end of the seam for a Mesa card with HostMot2 firmware on the network: seven encoders, seven analogue outputs,
// inputs, watchdog.
//
// One exchange a period. read() sends one datagram: the codes written last, the enables, the watchdog's kick where
// write() was called since, then the reads; and waits for the answer. So codes act at the next SYNC, as the seam has
// it, and the encoders are latched within one datagram, about a microsecond apart. The card's own time stamps say how
// many periods went by and how long before that each counter last moved. The card knows no period: it latches when it
// is asked. A period's SYNC is taken to be the earliest moment at which the loop asks, and a question that comes late,
// but before the next SYNC, is that period's: what follows it at once is the next one's. A host counter goes along, is
// kept by the card and comes back: an answer to an older question is dropped and counted. What the card had kept before
// must be this program's too: else another one drives the card as well, and every DAC counts as mismatched. Where no
// answer comes in time the last counts are given once more, as one period, up to lost_in_a_row, and the next answer's
// periods are that one fewer; then nothing is news (elapsed_periods 0) and the loop faults. arm(false) goes out at
// once. A watchdog that has bitten has turned every pin into an input: it stays so until disarmed, when the pins are
// set up again; docs/real_hardware.md says how the inhibits must be wired for that to be safe. A quadrature error marks
// its channel as not valid in that read and is cleared. Thread: the haptic task's. No call allocates, locks or throws;
// read() waits wait_share of a period, and as long again for each answer that it drops, kMostStale at most.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "haptics/device/data_acquisition.h"
#include "haptics/device/hostmot2/card_inquiry.h"
#include "haptics/device/hostmot2/hostmot2_map.h"

namespace trocar {

struct Hostmot2Options {
  const char* name = "hostmot2";       ///< of the back-end
  std::string card = "192.168.1.121";  ///< the card's address as delivered [Mesa]
  double rate_hz = 1000;
  double wait_share = 0.8;    ///< of a period, for the answer [LinuxCNC hm2_eth: 80 %]
  double setup_wait_s = 0.2;  ///< for each answer while it is set up, three times
  int lost_in_a_row = 1;  ///< answers that may fail to come before nothing is news [chosen: a stale tick, then a fault]
  double watchdog_s = 0.016;
  double stamp_hz = 1e6;  ///< wanted rate of the time stamps; the nearest that the divider gives is taken
  double pdm_hz = 6e6;    ///< of the analogue outputs' modulators [regmap: about 6 MHz for the 7I33]
  hostmot2::Wiring wiring = hostmot2::standard_wiring();
};

/// What happened on the link since it was opened.
struct Hostmot2Link {
  std::uint64_t sent = 0;  ///< datagrams, of setting up too
  std::uint64_t lost = 0, stale = 0, malformed = 0, bites = 0;
  std::uint64_t foreign = 0;  ///< exchanges before which another program had asked the card
};

class Hostmot2Daq final : public DataAcquisition {
 public:
  /// Reads who the card is, sets it up with outputs at zero and inhibited, and starts its watchdog.
  /// @throws std::invalid_argument: a rate or time that no card has; InputError: address; EnvironmentError: no answer,
  /// another firmware, too few or unusual modules: each says what.
  explicit Hostmot2Daq(const Hostmot2Options& options);
  /// Outputs at zero and inhibited.
  ~Hostmot2Daq() override;
  Hostmot2Daq(const Hostmot2Daq&) = delete;
  Hostmot2Daq(Hostmot2Daq&&) = delete;
  Hostmot2Daq& operator=(const Hostmot2Daq&) = delete;
  Hostmot2Daq& operator=(Hostmot2Daq&&) = delete;

  DaqCapabilities capabilities() const noexcept override;
  DaqSample read() noexcept override;
  void write(const DacFrame& frame) noexcept override;
  void arm(bool enabled) noexcept override;

  const hostmot2::Identity& identity() const { return identity_; }
  Hostmot2Link link() const;

 private:
  bool send(const lbp16::Datagram& datagram) noexcept;
  void set_up();
  void lay_out_exchange();
  void add_pins(lbp16::Datagram& to) const;
  bool exchange() noexcept;
  DaqSample sample_of_answer() noexcept;
  std::uint32_t periods_in(double passed) noexcept;
  const hostmot2::Module& module(const hostmot2::Need& need) const;

  Hostmot2Options options_;
  hostmot2::CardInquiry card_;
  hostmot2::Identity identity_;
  hostmot2::Module watchdog_, io_, encoder_, pwm_;
  double stamp_hz_ = 0;  ///< as the divider gives it

  lbp16::Datagram question_, answer_, off_, restore_;
  std::size_t counter_at_ = 0, codes_at_ = 0, enable_at_ = 0, kick_at_ = 0;  ///< in question_
  std::size_t answer_bytes_ = 0;

  DacFrame written_;
  bool armed_ = false, fed_ = false, bitten_ = false, read_once_ = false;
  int lost_in_a_row_ = 0;
  std::array<std::uint16_t, kChannels> raw_{};
  std::array<double, kChannels> edge_age_us_{};  ///< before the last latch
  std::uint16_t stamp_ = 0;
  double late_ = 0;  ///< periods from the last SYNC to its latch, less those that lost answers stood for
  DaqSample last_;
  Hostmot2Link link_;
};

}  // namespace trocar
