// A UDP socket with one peer on the network: a card, a force sensor's box, or a fake of one.
//
// Thread: one at a time. send() and receive() neither allocate, lock nor throw.
#pragma once

#include <cstdint>
#include <string>

#include "haptics/device/hostmot2/lbp16.h"

namespace trocar {

class UdpLink {
 public:
  /// @param address "192.168.1.121" or "192.168.1.121:27181". @param name of the peer in words, for messages. @throws
  /// InputError: no such address; EnvironmentError: no socket, no way to it.
  UdpLink(const std::string& address, const std::string& name);
  /// Of a peer: listens on the loopback, on a free port, and answers whoever sent last.
  static UdpLink on_loopback();
  ~UdpLink();
  UdpLink(UdpLink&& other) noexcept;
  UdpLink(const UdpLink&) = delete;
  UdpLink& operator=(const UdpLink&) = delete;
  UdpLink& operator=(UdpLink&&) = delete;

  std::uint16_t port() const noexcept;  ///< own
  std::string peer() const;             ///< "192.168.1.121:27181"
  bool send(const lbp16::Datagram& datagram) noexcept;
  /// The next datagram that fits. @param wait_s 0: what is there already. @return false: none came, or the peer is
  /// gone.
  bool receive(lbp16::Datagram& into, double wait_s) noexcept;

 private:
  UdpLink() = default;
  int socket_ = -1;
  bool connected_ = true;
  std::uint32_t peer_address_ = 0;  ///< of the loopback's, network order
  std::uint16_t peer_port_ = 0;
};

/// While it lives no other program of this computer has one on the same peer, however either ends.
class PeerClaim {
 public:
  /// @param name of the peer in words. @throws EnvironmentError: there is one already.
  PeerClaim(const UdpLink& link, const std::string& name);
  ~PeerClaim();
  PeerClaim(const PeerClaim&) = delete;
  PeerClaim(PeerClaim&&) = delete;
  PeerClaim& operator=(const PeerClaim&) = delete;
  PeerClaim& operator=(PeerClaim&&) = delete;

 private:
  int socket_ = -1;
};

}  // namespace trocar
