// Whatever happens to the file, no crash and no silent wrong row: cut at every byte, bytes flipped, chunks lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "app/session/recording/byte_order.h"
#include "app/session/recording/chunk.h"
#include "app/session/recording/recording_reader.h"
#include "haptics/input_error.h"
#include "tests/app/session/recording/recording_samples.h"

namespace trocar::recording_damage_test {
namespace {

/// Offsets at which chunks begin.
std::vector<std::size_t> chunk_offsets(const std::string& file) {
  std::vector<std::size_t> offsets;
  for (std::size_t offset = kRecordingPrefixSize; offset < file.size();) {
    const auto chunk = chunk_at(file, offset);
    if (!chunk) throw std::logic_error("sample recording is damaged");
    offsets.push_back(offset);
    offset = chunk->end();
  }
  return offsets;
}

/// True when every row read is a row that was written.
bool rows_are_true(const Recording& read, const Recording& truth) {
  return std::all_of(read.ticks.begin(), read.ticks.end(), [&](const RecordedTick& row) {
    return row.tick < truth.ticks.size() && truth.ticks[row.tick] == row;
  });
}

std::string error_of(const std::string& file, Reading reading) {
  try {
    parse_recording(file, "x.trec", reading);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RecordingDamage, CutAtEveryByteKeepsEveryWholeChunk) {
  const std::string file = small_recording(3, 40, 1);
  const Recording truth = parse_recording(file, "whole");
  const auto offsets = chunk_offsets(file);
  const std::size_t header_end = offsets[1];
  for (std::size_t size = 0; size < file.size(); ++size) {
    const std::string cut = file.substr(0, size);
    if (size < header_end) {
      EXPECT_NE(error_of(cut, Reading::kTolerant), "") << "cut at " << size;
      continue;
    }
    const Recording read = parse_recording(cut, "cut", Reading::kStrict);
    EXPECT_TRUE(rows_are_true(read, truth)) << "cut at " << size;
    EXPECT_FALSE(read.torn.empty()) << "cut at " << size;
    EXPECT_FALSE(read.end) << "cut at " << size;
    std::size_t whole = 0;
    for (const std::size_t offset : offsets) {
      const auto chunk = chunk_at(file, offset);
      whole += chunk->type == ChunkType::kTicks && chunk->end() <= size ? 20 : 0;
    }
    EXPECT_EQ(read.ticks.size(), whole) << "cut at " << size;
  }
}

TEST(RecordingDamage, EveryFlippedByteIsNoticed) {
  const std::string file = small_recording(3, 20, 2);
  const Recording truth = parse_recording(file, "whole");
  for (std::size_t i = 0; i < file.size(); ++i) {
    std::string bad = file;
    bad[i] = static_cast<char>(bad[i] ^ (1 << (i % 8)));
    if (error_of(bad, Reading::kStrict).empty()) {
      // Only a length that now points beyond the file looks like a cut; it must say so and lose END.
      const Recording read = parse_recording(bad, "flipped", Reading::kStrict);
      EXPECT_FALSE(read.torn.empty()) << "byte " << i;
      EXPECT_TRUE(rows_are_true(read, truth)) << "byte " << i;
    }
  }
}

TEST(RecordingDamage, RandomDamageNeverYieldsAWrongRowInTolerantMode) {
  const std::string file = small_recording(4, 30, 3);
  const Recording truth = parse_recording(file, "whole");
  std::mt19937_64 random(99);
  for (int trial = 0; trial < 3000; ++trial) {
    std::string bad = file;
    const int flips = 1 + static_cast<int>(random() % 4);
    for (int flip = 0; flip < flips; ++flip) bad[random() % bad.size()] = static_cast<char>(random());
    if (random() % 3 == 0) bad.resize(random() % bad.size());
    if (random() % 4 == 0) bad.insert(random() % (bad.size() + 1), std::string(random() % 20, '\x5a'));
    try {
      const Recording read = parse_recording(bad, "damaged", Reading::kTolerant);
      EXPECT_TRUE(rows_are_true(read, truth)) << "trial " << trial;
      const bool complete = read.ticks.size() == truth.ticks.size() && read.end;
      EXPECT_TRUE(complete || !read.damage.empty() || !read.torn.empty()) << "trial " << trial;
    } catch (const InputError&) {
      continue;  // prefix or header damaged: refused with a message
    }
  }
}

TEST(RecordingDamage, RandomBytesInsideAValidContainerAreRefused) {
  std::mt19937_64 random(7);
  const std::string file = small_recording(1, 20, 4);
  const std::size_t header_end = chunk_offsets(file)[1];
  for (int trial = 0; trial < 2000; ++trial) {
    const Chunk ticks = *chunk_at(file, header_end);
    std::string payload(ticks.payload);
    for (int flip = 0; flip < 3; ++flip) payload[random() % payload.size()] = static_cast<char>(random());
    if (payload == ticks.payload) continue;
    // The CRC is right, the content is not: the decoder is on its own and must not crash.
    const std::string bad = file.substr(0, header_end) + make_chunk(ChunkType::kTicks, payload);
    const Recording read = parse_recording(bad, "hostile", Reading::kTolerant);
    EXPECT_FALSE(read.torn.empty());
    EXPECT_TRUE(read.ticks.size() <= (1u << 20));
  }
}

TEST(RecordingDamage, StrictReaderNamesTheOffsetOfABadCrc) {
  std::string file = small_recording(3, 40, 5);
  const std::size_t second = chunk_offsets(file)[2];
  file[second + kChunkHeaderSize + 3] ^= 1;
  const std::string message = error_of(file, Reading::kStrict);
  EXPECT_NE(message.find("x.trec"), std::string::npos) << message;
  EXPECT_NE(message.find("byte " + std::to_string(second)), std::string::npos) << message;
}

TEST(RecordingDamage, TolerantReaderGoesOnBehindTheDamageAndSaysWhatIsMissing) {
  std::string file = small_recording(4, 40, 6);
  file[chunk_offsets(file)[4] + 6] ^= 1;  // the length of the second half second
  const Recording read = parse_recording(file, "x.trec", Reading::kTolerant);
  EXPECT_EQ(read.ticks.size(), 140u);
  EXPECT_EQ(read.ticks[20].tick, 40u);
  ASSERT_TRUE(read.end);
  ASSERT_EQ(read.damage.size(), 3u);
  EXPECT_NE(read.damage[1].find("does not hold together"), std::string::npos) << read.damage[1];
  EXPECT_NE(read.damage[2].find("160 ticks, 140 were read"), std::string::npos) << read.damage[2];
}

TEST(RecordingDamage, ALostOrRepeatedChunkIsNoticed) {
  const std::string file = small_recording(3, 40, 7);
  const auto offsets = chunk_offsets(file);
  const std::string lost = file.substr(0, offsets[2]) + file.substr(offsets[3]);
  EXPECT_NE(error_of(lost, Reading::kStrict).find("does not hold together"), std::string::npos);
  const std::string repeated = file.substr(0, offsets[4]) + file.substr(offsets[2]);
  EXPECT_NE(error_of(repeated, Reading::kStrict).find("repeats ticks"), std::string::npos);
  EXPECT_NE(error_of(file + "x", Reading::kStrict).find("after the END"), std::string::npos);
}

TEST(RecordingDamage, OtherFilesAndNewerFormatsAreRefusedByName) {
  EXPECT_EQ(error_of("", Reading::kTolerant), "x.trec: is not a recording of trocar");
  EXPECT_EQ(error_of("SQLite format 3\0 and more", Reading::kTolerant), "x.trec: is not a recording of trocar");
  std::string newer = small_recording(1, 10, 8);
  newer[kRecordingMagic.size()] = 9;
  EXPECT_EQ(error_of(newer, Reading::kTolerant), "x.trec: has recording format 9, this program reads formats 1 to 5");
  EXPECT_THROW(read_recording("/nonexistent/x.trec"), InputError);
  EXPECT_THROW(read_recording("/"), InputError);
}

TEST(ByteReader, RefusesToReadPastTheEnd) {
  bytes::Reader reader("abc");
  EXPECT_EQ(reader.take<std::uint16_t>(), 0x6261);
  EXPECT_THROW(reader.take<std::uint16_t>(), InputError);
}

}  // namespace
}  // namespace trocar::recording_damage_test
