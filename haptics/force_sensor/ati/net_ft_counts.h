// What a Net F/T box says of its counts: how many a newton and a newton metre have, asked over TCP.
//
// Question, 20 bytes: READCALINFO (1), zeros. Answer, 24 bytes, big-endian: 0x1234, unit of force and of torque (a byte
// each), counts per unit of force and of torque (32 bits each), six 16-bit factors that RDT records do not need.
// Source: ATI, Net F/T manual 9620-05, chapter TCP interface. Thread: any; it waits.
#pragma once

#include <cstdint>
#include <string>

namespace trocar {

inline constexpr std::uint16_t kNetFtPort = 49152, kNetFtTcpPort = 49151;

struct NetFtAddress {
  std::string host;
  std::uint16_t udp = kNetFtPort, tcp = kNetFtTcpPort;
};

/// @param box "192.168.1.1", "192.168.1.1:49152" or, with the port of its counts too, "192.168.1.1:49152:49151".
/// @throws InputError naming it.
NetFtAddress net_ft_address(const std::string& box);

struct NetFtCounts {
  double per_n = 0, per_nm = 0;
};

/// @throws InputError as net_ft_address(); EnvironmentError: no answer within wait_s, or one that cannot be.
NetFtCounts net_ft_counts(const std::string& box, double wait_s = 1);

}  // namespace trocar
