// ATI Net F/T over UDP (RDT protocol): 36-byte records, big-endian, at the box's own rate.
//
// Request: 0x1234, command (2: records until further notice, 0: stop, 0x42: bias), count. Record: sequence of records,
// of the sensor, status, three forces, three moments as 32-bit counts. A gap of the sequence is counted, a record that
// is older than the newest is dropped, a status other than 0 makes a record unsound. The box talks to the one that
// asked last: records that stop and go on at the first question, with the sensor's own sequence unbroken, went to
// another (WrenchLink::taken_away). Source: ATI, Net F/T manual
// 9610-05-1022, chapter RDT. Threads: as WrenchStream.
#pragma once

#include "haptics/device/hostmot2/udp_link.h"
#include "haptics/force_sensor/ati/wrench_stream.h"

namespace trocar {

class NetFt final : public WrenchStream {
 public:
  /// @param box as net_ft_address() takes it. @throws as that and UdpLink.
  NetFt(const std::string& box, const WrenchStreamOptions& options);
  ~NetFt() override;

 private:
  void listen() override;
  void ask(std::uint16_t command);
  bool take_in(const lbp16::Datagram& datagram);

  UdpLink link_;
  bool first_ = true;                         ///< the next record's sequence is its beginning
  bool stopped_ = false;                      ///< asked just now, for the first time since the last record
  std::uint32_t sequence_ = 0, sensors_ = 0;  ///< of the last record; of the sensor in it, which no question resets
};

}  // namespace trocar
