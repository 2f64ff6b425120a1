// The container of a recording: magic and format version, then chunks {type, length, CRC-32, payload}.
//
// File = "TROCREC\n", u32 version, then chunks. Chunk = u32 type, u32 payload length, u32 CRC-32 (IEEE 802.3, over
// type, length and payload), payload. All numbers little-endian. Nothing is ever rewritten, so a crash costs the tail
// only.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trocar {

inline constexpr std::string_view kRecordingMagic = "TROCREC\n";
inline constexpr std::uint32_t kRecordingVersion = 5;
inline constexpr std::uint32_t kOldestReadable =
    1;  ///< 1: without schedule, fewer channels, state hash formed otherwise
inline constexpr std::uint32_t kOldestVerifiable = 2;    ///< 2: without the channels of stiffness and K_max
inline constexpr std::uint32_t kFirstWithStiffness = 3;  ///< 3: without keyframes
inline constexpr std::uint32_t kFirstWithLinks = 5;      ///< 4: chunks that hold together by nothing, of nobody
inline constexpr std::size_t kRecordingPrefixSize = 12;  ///< magic and version
inline constexpr std::size_t kChunkHeaderSize = 12;
inline constexpr std::uint32_t kMaxChunkPayload = 1u << 26;  ///< 64 MiB: a longer length is damage

/// The four letters read in a hex dump.
enum class ChunkType : std::uint32_t {
  kHeader = 0x52444548,     // "HEDR"
  kTicks = 0x4b434954,      // "TICK"
  kEvents = 0x53545645,     // "EVTS"
  kSchedule = 0x44484353,   // "SCHD"
  kShape = 0x50414853,      // "SHAP"
  kKeyframes = 0x4659454b,  // "KEYF"
  kTopology = 0x4f504f54,   // "TOPO"
  kRunReport = 0x54504352,  // "RCPT"
  kLink = 0x4b4e494c,       // "LINK"
  kEnd = 0x21444e45,        // "END!"
};

struct Chunk {
  ChunkType type = ChunkType::kHeader;
  std::size_t offset = 0;    ///< of the chunk's first byte in the file
  std::string_view payload;  ///< into the file's bytes
  std::size_t end() const { return offset + kChunkHeaderSize + payload.size(); }
};

/// Magic and version, as a file begins.
std::string recording_prefix();

/// Header, CRC and payload of one chunk. @throws InputError when the payload exceeds kMaxChunkPayload.
std::string make_chunk(ChunkType type, std::string_view payload);

/// The chunk at `offset`, when it is whole, of a known type and its CRC agrees.
std::optional<Chunk> chunk_at(std::string_view file, std::size_t offset);

/// True when the file is long enough for the chunk that the header at `offset` announces.
bool chunk_fits(std::string_view file, std::size_t offset);

/// Looks for whole chunks: where reading can go on after damage. It gives up once it has summed four times the file:
/// of headers that lie about their length each would have it sum up the rest.
class ChunkSearch {
 public:
  explicit ChunkSearch(std::string_view file) : file_(file), left_(4 * std::uint64_t{file.size()}) {}
  /// Offset of the next whole chunk at or after `from`.
  std::optional<std::size_t> next(std::size_t from);
  bool gave_up() const { return gave_up_; }

 private:
  std::string_view file_;
  std::uint64_t left_;  ///< bytes that it may still sum
  bool gave_up_ = false;
};

}  // namespace trocar
