// LBP16, the protocol of Mesa's Ethernet cards: datagrams of commands that read or write memory spaces of the card.
//
// A command is a 16-bit word, low byte first: bit 15 write, 14 an address follows, 13 info area, 12..10 space, 9..8
// size of a datum (8 to 64 bits), 7 the address goes on by a datum each, 6..0 number of data; then the address (16
// bit), then what is written. The card answers a datagram with the data of its reads, in their order, and nothing else.
// Port 27181. Source: Mesa Electronics, manuals of the cards (7I80, 7I92), chapter LBP16. Golden vector: elbpcom(1).
// Thread: plain values, any thread; no call allocates or throws.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace trocar::lbp16 {

inline constexpr std::uint16_t kPort = 27181;
inline constexpr std::size_t kMostBytes = 1400;  ///< of a datagram [chosen: below an Ethernet frame's 1472]

enum class Space : std::uint8_t {
  kHostmot2 = 0,  ///< registers of the firmware, 32 bit
  kTimers = 4     ///< 16 bit; 0x10 to 0x16 keep what the host writes
};
enum class Size : std::uint8_t { k8 = 0, k16 = 1, k32 = 2, k64 = 3 };
constexpr std::size_t bytes_of(Size size) { return std::size_t{1} << static_cast<int>(size); }

struct Command {
  bool write = false;
  Space space = Space::kHostmot2;
  Size size = Size::k32;
  bool increment = true;
  std::uint8_t count = 1;
  std::uint16_t address = 0;

  constexpr std::size_t data_bytes() const { return count * bytes_of(size); }
  bool operator==(const Command&) const = default;
};

constexpr std::uint16_t word_of(const Command& c) {
  return static_cast<std::uint16_t>((c.write ? 0x8000 : 0) | 0x4000 | static_cast<int>(c.space) << 10 |
                                    static_cast<int>(c.size) << 8 | (c.increment ? 0x80 : 0) | (c.count & 0x7F));
}

/// Bytes of a datagram, low byte first. What does not fit is left out and remembered.
class Datagram {
 public:
  const std::uint8_t* data() const { return bytes_.data(); }
  std::uint8_t* data() { return bytes_.data(); }
  std::size_t size() const { return size_; }
  bool fits() const { return fits_; }
  void clear() { size_ = 0, fits_ = true; }
  void resize(std::size_t size) { size_ = size < kMostBytes ? size : kMostBytes; }

  void add(std::uint64_t value, std::size_t bytes) {
    if (size_ + bytes > kMostBytes) {
      fits_ = false;
      return;
    }
    for (std::size_t i = 0; i < bytes; ++i) bytes_[size_++] = static_cast<std::uint8_t>(value >> 8 * i);
  }
  void add(const Command& command) {
    add(word_of(command), 2);
    add(command.address, 2);
  }
  /// A command that writes one 32-bit register, with its value. @return where the value stands.
  std::size_t write32(std::uint16_t address, std::uint32_t value) {
    add(Command{.write = true, .address = address});
    add(value, 4);
    return size_ - 4;
  }
  void set32(std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes_[at + i] = static_cast<std::uint8_t>(value >> 8 * i);
  }
  std::uint64_t value(std::size_t at, std::size_t bytes) const {
    std::uint64_t out = 0;
    for (std::size_t i = 0; i < bytes && at + i < size_; ++i) out |= std::uint64_t{bytes_[at + i]} << 8 * i;
    return out;
  }
  std::uint32_t value32(std::size_t at) const { return static_cast<std::uint32_t>(value(at, 4)); }

 private:
  std::array<std::uint8_t, kMostBytes> bytes_{};
  std::size_t size_ = 0;
  bool fits_ = true;
};

/// The command at a place of a datagram, as a card reads it. Nothing: cut off, or without an address.
inline std::optional<Command> command_at(const Datagram& from, std::size_t at) {
  if (at + 4 > from.size()) return std::nullopt;
  const auto word = static_cast<std::uint16_t>(from.value(at, 2));
  if (!(word & 0x4000) || (word & 0x2000)) return std::nullopt;
  Command out;
  out.write = word & 0x8000;
  out.space = static_cast<Space>(word >> 10 & 7);
  out.size = static_cast<Size>(word >> 8 & 3);
  out.increment = word & 0x80;
  out.count = word & 0x7F;
  out.address = static_cast<std::uint16_t>(from.value(at + 2, 2));
  return out;
}

}  // namespace trocar::lbp16
