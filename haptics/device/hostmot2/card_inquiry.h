// Questions to a Mesa card one register at a time, before a loop begins: who it is, and what stands in it.
//
// Reads only, but for the host's own counter that goes along with every question: it begins anywhere, so that two
// programs' are told apart. One program of a computer has a card at a time. Thread: one at a time.
#pragma once

#include <cstdint>
#include <string>

#include "haptics/device/hostmot2/hostmot2_map.h"
#include "haptics/device/hostmot2/udp_link.h"

namespace trocar::hostmot2 {

/// A datagram begins with the host's counter, and ends its answer to it with the same number.
void add_counter(lbp16::Datagram& to, std::uint32_t counter);
void add_counter_read(lbp16::Datagram& to);
inline constexpr int kMostStale = 8;  ///< answers to older questions that are dropped while one is waited for

class CardInquiry {
 public:
  /// @param card address, with or without a port. @param wait_s for each answer, three times. @throws as UdpLink;
  /// EnvironmentError: another program has the card, or another part of this one.
  CardInquiry(const std::string& card, double wait_s);

  /// One register. @throws EnvironmentError: no answer.
  std::uint32_t ask(std::uint16_t address);
  /// @throws EnvironmentError: no answer, other firmware, one that describes itself in an unknown way.
  Identity identify();

  UdpLink& link() { return link_; }
  const std::string& name() const { return name_; }  ///< "card 192.168.1.121"
  std::uint32_t& counter() { return counter_; }
  std::uint64_t asked() const { return asked_; }  ///< datagrams sent

 private:
  std::string name_;
  double wait_s_;
  UdpLink link_;
  PeerClaim claim_;
  std::uint32_t counter_;
  std::uint64_t asked_ = 0;
};

}  // namespace trocar::hostmot2
