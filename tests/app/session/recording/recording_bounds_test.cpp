// Small files that claim much: what a recording takes in memory, and in time, is bounded whatever its file says.
#include <gtest/gtest.h>

#include "app/session/recording/byte_order.h"
#include "app/session/recording/chunk.h"
#include "app/session/recording/recording_header.h"
#include "app/session/recording/recording_reader.h"
#include "app/session/recording/recording_writer.h"
#include "app/session/recording/schedule.h"
#include "app/session/recording/tick_codec.h"
#include "app/session/recording/tissue_codec.h"
#include "haptics/input_error.h"
#include "tests/app/session/recording/recording_samples.h"

namespace trocar::recording_bounds_test {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

/// A recording that has no rows yet.
std::string begun() { return recording_prefix() + make_chunk(ChunkType::kHeader, encode_header({"{}", 1000, ""})); }

/// Rows of which nothing but the tick changes.
std::string resting_rows(std::uint64_t first_tick, std::size_t count) {
  std::vector<RecordedTick> rows(count);
  for (std::size_t i = 0; i < count; ++i) rows[i].tick = first_tick + i;
  return TickEncoder().encode(rows);
}

std::string error_of(const std::string& file, Reading reading, std::optional<std::uint64_t> most = std::nullopt) {
  try {
    parse_recording(file, "x.trec", reading, most);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Refused however it is read, from this chunk on.
void expect_too_much(const std::string& file, std::uint64_t most, std::size_t offset) {
  for (const Reading reading : {Reading::kStrict, Reading::kTolerant}) {
    const std::string message = error_of(file, reading, most);
    EXPECT_TRUE(message.starts_with("x.trec: holds more than a recording of its size can")) << message;
    EXPECT_NE(message.find("byte " + std::to_string(offset) + " "), std::string::npos) << message << ", not " << offset;
  }
  EXPECT_EQ(error_of(file, Reading::kStrict), "") << "as much is not too much for a whole recording";
}

/// Headers of chunks that reach to the end of the file, one in the other; none agrees with its CRC.
std::string lies(std::size_t count) {
  std::string out;
  for (std::size_t i = count; i > 0; --i) {
    bytes::put(out, static_cast<std::uint32_t>(ChunkType::kTicks));
    bytes::put(out, static_cast<std::uint32_t>((i - 1) * kChunkHeaderSize));
    bytes::put(out, std::uint32_t{0});
  }
  return out;
}

TEST(RecordingBounds, LeaveRoomForTheLongestAttempts) {
  const auto rows = [](double seconds, double rate_hz) {
    return static_cast<std::uint64_t>(seconds * rate_hz) * sizeof(RecordedTick);
  };
  constexpr double kLongest_s = 2 * 3600 + 60;
  EXPECT_GT(most_decoded(2 * 1800 * 200), rows(1800, 4000)) << "nothing moves";
  EXPECT_GT(most_decoded(2 * 60 * 200), rows(60, 4000));
  EXPECT_GT(most_decoded(2 * 7260 * 200), rows(kLongest_s, 1000));
  EXPECT_LT(most_decoded(10'000), 128 * kMiB);
  EXPECT_GT(most_decoded(2 * 3600 * 4000), rows(4200, 4000)) << "2 bytes a row of an hour, 10 minutes of waiting";
  EXPECT_GT(most_decoded(2 * 3600 * 10'000), rows(3600, 10'000));
  EXPECT_GT(most_decoded(1 << 27), rows(kLongest_s, 4000));
  for (const std::uint64_t size : {std::uint64_t{1} << 30, ~std::uint64_t{0}})
    EXPECT_EQ(most_decoded(size), std::uint64_t{1} << 32);
}

TEST(RecordingBounds, AChunkHasASecondOfRowsOfTheFastestDevice) {
  EXPECT_EQ(decode_ticks(resting_rows(1, 10'000)).size(), 10'000u);
  const std::string much = resting_rows(1, kMostChunkRows + 1);
  EXPECT_LT(much.size(), 150u);
  EXPECT_THROW(decode_ticks(much), InputError);
  const std::string file = begun() + make_chunk(ChunkType::kTicks, much);
  EXPECT_EQ(error_of(file, Reading::kStrict), "x.trec: the chunk at byte " + std::to_string(begun().size()) +
                                                  " cannot be decoded: the number of rows is out of range");
}

TEST(RecordingBounds, AWriterMakesNoChunkThatNobodyReads) {
  MemorySink sink;
  RecordingWriter writer(sink, "", 1e6);
  RecordedTick row;
  for (row.tick = 1; row.tick <= kMostChunkRows + 10; ++row.tick) writer.append(row);
  writer.close({});
  EXPECT_EQ(parse_recording(sink.bytes(), "memory").ticks.size(), kMostChunkRows + 10);
}

TEST(RecordingBounds, RowsAreSummedOverTheFile) {
  std::string file = begun();
  std::size_t third = 0;
  for (std::uint64_t i = 0; i < 4; ++i) {
    if (i == 2) third = file.size();
    file += make_chunk(ChunkType::kTicks, resting_rows(1 + i * kMostChunkRows, kMostChunkRows));
  }
  EXPECT_LT(file.size(), 4096u);
  expect_too_much(file, 4 * kMiB, third);
}

TEST(RecordingBounds, TheScheduleIsSummedToo) {
  Schedule still;
  still.steps.assign((1 << 16) + 1, 7);
  EXPECT_THROW(decode_schedule(encode_schedule(still)), InputError);
  still.steps.pop_back();
  const std::string chunk = make_chunk(ChunkType::kSchedule, encode_schedule(still));
  EXPECT_LT(chunk.size(), 200u);
  expect_too_much(begun() + chunk + chunk + chunk, kMiB + 1, begun().size() + 2 * chunk.size());
}

TEST(RecordingBounds, ShapesAreSummedTooAndHaveNoMoreNodesThanAny) {
  TissueEncoder encoder;
  std::vector<TissueKeyframe> keyframes(3);
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    keyframes[i].shaped = true;
    keyframes[i].topology = i;
    keyframes[i].nodes_T.assign(1 << 16, NodePlace::Zero());
  }
  std::vector<std::string> shapes = encoder.encode(keyframes).shapes;
  ASSERT_EQ(shapes.size(), 3u);
  std::string file = begun();
  std::size_t last = 0;
  for (const std::string& shape : shapes) {
    last = file.size();
    file += make_chunk(ChunkType::kShape, shape);
  }
  EXPECT_LT(file.size(), 4096u);
  expect_too_much(file, 2 * kMiB, last);
  shapes[0].replace(13, 4, std::string("\x01\x00\x10\x00", 4));
  try {
    decode_shape(shapes[0]);
    ADD_FAILURE() << "has 2^20 + 1 nodes";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a shape has more nodes than any has");
  }
}

TEST(RecordingBounds, KeyframesOfAChunkAreBoundedTogether) {
  const auto track = [](const std::vector<TissueKeyframe>& keyframes) {
    TissueEncoder encoder;
    const TissueEncoder::Chunks chunks = encoder.encode(keyframes);
    TissueTrack out;
    for (const std::string& shape : chunks.shapes) out.add_shape(shape);
    out.add_keyframes(chunks.keyframes);
    return out;
  };
  TissueKeyframe shaped;
  shaped.shaped = true;
  shaped.nodes_T.assign(20'000, NodePlace::Zero());
  for (const char* name : {"blood", "wet", "char", "whitening"})
    shaped.fields.push_back({name, FieldPlace::kVertices, std::vector<float>(20'000)});
  EXPECT_EQ(TissueDecoder(track(std::vector(10, shaped))).at(9)->fields.size(), 4u) << "more than any organ has";

  shaped.nodes_T.resize(1);
  shaped.fields.assign(17, {"f", FieldPlace::kVertices, std::vector<float>(kMiB)});
  const TissueTrack fields = track({shaped});
  EXPECT_LT(fields.bytes(), 2048u);
  EXPECT_THROW(TissueDecoder(fields).at(0), InputError) << "68 MiB of values";
  EXPECT_THROW(track(std::vector<TissueKeyframe>((1 << 11) + 1)), InputError);
}

TEST(RecordingBounds, WhatIsSaidOfDamageIsSummedToo) {
  std::string file = begun();
  for (int i = 0; i < 1000; ++i) file += make_chunk(ChunkType::kTicks, "");
  EXPECT_EQ(parse_recording(file, "x.trec", Reading::kTolerant).damage.size(), 1000u);
  EXPECT_NE(error_of(file, Reading::kTolerant, kMiB / 16).find("holds more than"), std::string::npos);
}

TEST(RecordingBounds, StrictlyNobodyLooksBehindAChunkThatIsThereAndWrong) {
  const std::string message = error_of(begun() + lies(100'000), Reading::kStrict);
  EXPECT_EQ(message, "x.trec: the chunk at byte " + std::to_string(begun().size()) + " does not agree with its CRC");
}

TEST(RecordingBounds, TheSearchForAWholeChunkEnds) {
  const std::string rows = make_chunk(ChunkType::kTicks, resting_rows(1, 500));
  const std::string file = begun() + rows + lies(100'000);  // all of them summed: 60 GB
  const std::string from = "damaged from byte " + std::to_string(begun().size() + rows.size()) + ":";
  const Recording read = parse_recording(file, "x.trec", Reading::kTolerant);
  EXPECT_EQ(read.ticks.size(), 500u) << "what is before the damage";
  ASSERT_EQ(read.damage.size(), 1u);
  EXPECT_TRUE(read.damage[0].starts_with(from)) << read.damage[0];
  EXPECT_FALSE(read.torn.empty());
  // The first announces more than there is, as in a file that was cut off: strictly somebody has to look.
  std::string cut = file;
  cut[begun().size() + rows.size() + 6] = '\x7f';
  EXPECT_TRUE(error_of(cut, Reading::kStrict).starts_with("x.trec: " + from)) << error_of(cut, Reading::kStrict);
}

TEST(RecordingBounds, AFewLiesAreOverlooked) {
  const std::string rows = make_chunk(ChunkType::kTicks, resting_rows(1, 500));
  const Recording read = parse_recording(begun() + lies(3) + rows, "x.trec", Reading::kTolerant);
  EXPECT_EQ(read.ticks.size(), 500u);
  EXPECT_EQ(read.damage.size(), 1u);
}

}  // namespace
}  // namespace trocar::recording_bounds_test
