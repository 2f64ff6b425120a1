// ATI stand-alone controller over a serial line: 38400 baud, 8N1, resolved counts as lines of text.
//
// Text and not the 13-byte binary records: a line ends where it says, so a lost byte costs a line and never shifts the
// next ones into each other, and 85 lines a second are more than the 40 of the thesis. Commands end in CR: "CD A", "CD
// R", "SA n", "QS" begins, CR alone ends, "SB" takes the bias. A line: status, three forces, three moments, with
// commas. A line that was pulled out is opened again when it is back. Source: ATI, F/T controller manual 9610-05-1001.
// Threads: as WrenchStream.
#pragma once

#include "haptics/force_sensor/ati/wrench_stream.h"

namespace trocar {

/// Counts of a line, nothing where it is none.
struct AtiLine {
  int status = 0;
  std::array<std::int64_t, 6> counts{};
};
bool read_ati_line(const std::string& line, AtiLine& into);

class AtiSerial final : public WrenchStream {
 public:
  /// @param device "/dev/ttyUSB0". @throws EnvironmentError: not there, no right to it (and what gives it), no serial
  /// line.
  AtiSerial(const std::string& device, const WrenchStreamOptions& options);
  ~AtiSerial() override;

 private:
  void listen() override;
  int open_port();
  void close_port();
  void say(const char* command);
  void begin();
  bool take_in(const char* bytes, std::size_t size);

  std::string device_;
  int port_ = -1;  ///< -1: pulled out
  std::string line_ = {};
};

/// Of the Nano25 SI-125-3: 192 counts a newton, 10560 a newton metre [F].
WrenchStreamOptions nano25_options();

}  // namespace trocar
