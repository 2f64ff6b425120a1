#include "app/session/recording/chunk.h"

#include <zlib.h>

#include "app/session/recording/byte_order.h"

namespace trocar {
namespace {

struct ChunkHeader {
  std::uint32_t type, length, crc;
};

std::optional<ChunkHeader> header_at(std::string_view file, std::size_t offset) {
  if (offset > file.size() || file.size() - offset < kChunkHeaderSize) return std::nullopt;
  bytes::Reader reader(file.substr(offset, kChunkHeaderSize));
  ChunkHeader header{};
  header.type = reader.take<std::uint32_t>();
  header.length = reader.take<std::uint32_t>();
  header.crc = reader.take<std::uint32_t>();
  return header;
}

bool known_type(std::uint32_t type) {
  switch (static_cast<ChunkType>(type)) {
    case ChunkType::kHeader:
    case ChunkType::kTicks:
    case ChunkType::kEvents:
    case ChunkType::kRunReport:
    case ChunkType::kSchedule:
    case ChunkType::kShape:
    case ChunkType::kKeyframes:
    case ChunkType::kTopology:
    case ChunkType::kLink:
    case ChunkType::kEnd:
      return true;
  }
  return false;
}

/// A header of which all but the CRC is right.
std::optional<ChunkHeader> likely_header_at(std::string_view file, std::size_t offset) {
  const auto header = header_at(file, offset);
  if (!header || !known_type(header->type) || header->length > kMaxChunkPayload || !chunk_fits(file, offset)) {
    return std::nullopt;
  }
  return header;
}

std::uint32_t crc_of(std::string_view type_and_length, std::string_view payload) {
  uLong crc = crc32(0, nullptr, 0);
  crc = crc32_z(crc, reinterpret_cast<const Bytef*>(type_and_length.data()), type_and_length.size());
  crc = crc32_z(crc, reinterpret_cast<const Bytef*>(payload.data()), payload.size());
  return static_cast<std::uint32_t>(crc);
}

}  // namespace

std::string recording_prefix() {
  std::string prefix(kRecordingMagic);
  bytes::put(prefix, kRecordingVersion);
  return prefix;
}

std::string make_chunk(ChunkType type, std::string_view payload) {
  if (payload.size() > kMaxChunkPayload) throw InputError("recording: a chunk of more than 64 MiB is not allowed");
  std::string chunk;
  chunk.reserve(kChunkHeaderSize + payload.size());
  bytes::put(chunk, static_cast<std::uint32_t>(type));
  bytes::put(chunk, static_cast<std::uint32_t>(payload.size()));
  const std::uint32_t crc = crc_of(chunk, payload);
  bytes::put(chunk, crc);
  chunk += payload;
  return chunk;
}

bool chunk_fits(std::string_view file, std::size_t offset) {
  const auto header = header_at(file, offset);
  return header && header->length <= file.size() - offset - kChunkHeaderSize;
}

std::optional<Chunk> chunk_at(std::string_view file, std::size_t offset) {
  const auto header = likely_header_at(file, offset);
  if (!header) return std::nullopt;
  const Chunk chunk{static_cast<ChunkType>(header->type), offset,
                    file.substr(offset + kChunkHeaderSize, header->length)};
  if (crc_of(file.substr(offset, 8), chunk.payload) != header->crc) return std::nullopt;
  return chunk;
}

std::optional<std::size_t> ChunkSearch::next(std::size_t from) {
  for (std::size_t offset = from; !gave_up_ && offset + kChunkHeaderSize <= file_.size(); ++offset) {
    const auto header = likely_header_at(file_, offset);
    if (!header) continue;
    const std::uint64_t summed = kChunkHeaderSize + header->length;
    gave_up_ = summed > left_;
    if (gave_up_) break;
    left_ -= summed;
    if (chunk_at(file_, offset)) return offset;
  }
  return std::nullopt;
}

}  // namespace trocar
