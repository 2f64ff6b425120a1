// ATI stand-alone controller over a serial line: 38400 baud, 8N1, resolved counts as lines of text or binary records.
//
// Text is the rule: a line ends where it says, so a lost byte costs a line and never shifts the next ones into each
// other, and 85 lines a second are more than the 40 of the thesis. Binary records (295 a second) have 13 bytes and no
// mark: AtiFrames finds where they begin. Commands end in CR: "CD A" or "CD B", "CD R", "SA n", "QS" begins, CR alone
// ends, "SB" takes the bias. A record: status, three forces, three moments. A line that was pulled out is opened again
// when it is back. Source: ATI, F/T controller manual 9610-05-1001. Threads: as WrenchStream.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "haptics/force_sensor/ati/wrench_stream.h"

namespace trocar {

/// Counts of a record.
struct AtiLine {
  int status = 0;
  std::array<std::int64_t, 6> counts{};
};
bool read_ati_line(const std::string& line, AtiLine& into);

/// Finds the binary records in a stream of bytes: status (0: sound), six 16-bit counts with the high byte first.
///
/// Where a record begins is taken for known only where one place alone fits the last two, and the last six too: all
/// sound, and no count further than kStep from the one before. From then on each record has to go on so, and is given
/// when the next one has; else the place is looked for anew. kStep is less than 256: in a frame that slipped by a byte
/// low bytes stand as high ones, so the first change of a low byte is a step beyond it; one that slipped by two has a
/// low or high byte as its status. It lives on counts that tremble, as a sensor's do: constant ones fit several places
/// and give nothing. Thread: plain value.
class AtiFrames {
 public:
  static constexpr std::int64_t kStep = 240;  ///< counts from a record to the next; 1.25 N of a Nano25 [chosen]
  /// @return a record that can be vouched for: the one before that which ends with this byte. Else nothing.
  std::optional<AtiLine> push(std::uint8_t byte);
  std::uint64_t broken() const { return broken_; }  ///< how often the place was lost

 private:
  static constexpr std::size_t kBytes = 13, kAgree = 6, kSeen = kBytes * (kAgree + 1) - 1;
  AtiLine at(std::size_t begin) const;
  bool goes_on(std::size_t begin) const;
  std::optional<AtiLine> find();

  std::array<std::uint8_t, kSeen> seen_{};  ///< the last bytes, oldest first
  std::size_t filled_ = 0;
  std::optional<std::size_t> since_ = std::nullopt;  ///< bytes since the last record; none: its place is not known
  std::uint64_t broken_ = 0;
};

enum class AtiRecords : std::uint8_t { kText, kBinary };

class AtiSerial final : public WrenchStream {
 public:
  /// @param device "/dev/ttyUSB0". @throws EnvironmentError: not there, no right to it (and what gives it), no serial
  /// line.
  AtiSerial(const std::string& device, const WrenchStreamOptions& options, AtiRecords records = AtiRecords::kText);
  ~AtiSerial() override;

 private:
  void listen() override;
  int open_port();
  void close_port();
  void say(const char* command);
  void begin();
  bool take_in(const char* bytes, std::size_t size);
  bool take_binary(const char* bytes, std::size_t size);

  std::string device_;
  AtiRecords records_;
  int port_ = -1;  ///< -1: pulled out
  std::string line_ = {};
  AtiFrames frames_;
};

/// Of the Nano25 SI-125-3: 192 counts a newton, 10560 a newton metre [F].
WrenchStreamOptions nano25_options();

}  // namespace trocar
