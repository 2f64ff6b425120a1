// Chunks, sinks and the END record on their own.
#include <gtest/gtest.h>

#include <cmath>

#include "app/session/recording/byte_order.h"
#include "app/session/recording/chunk.h"
#include "app/session/recording/recording_header.h"
#include "app/session/recording/recording_reader.h"
#include "app/session/recording/tick_codec.h"
#include "haptics/input_error.h"
#include "tests/app/session/recording/recording_samples.h"

namespace trocar::recording_container_test {
namespace {

TEST(Chunk, HasTypeLengthCrcAndPayloadInThatOrder) {
  const std::string chunk = make_chunk(ChunkType::kTicks, "123456789");
  ASSERT_EQ(chunk.size(), kChunkHeaderSize + 9);
  EXPECT_EQ(chunk.substr(0, 4), "TICK");
  EXPECT_EQ(chunk.substr(4, 4), std::string("\x09\0\0\0", 4));
  EXPECT_EQ(chunk.substr(12), "123456789");
}

TEST(Chunk, TypesReadAsFourLetters) {
  EXPECT_EQ(make_chunk(ChunkType::kHeader, "").substr(0, 4), "HEDR");
  EXPECT_EQ(make_chunk(ChunkType::kEvents, "").substr(0, 4), "EVTS");
  EXPECT_EQ(make_chunk(ChunkType::kEnd, "").substr(0, 4), "END!");
}

TEST(Chunk, IsReadWhereItStands) {
  const std::string file = "junk" + make_chunk(ChunkType::kEnd, "abc") + make_chunk(ChunkType::kEvents, "");
  const auto chunk = chunk_at(file, 4);
  ASSERT_TRUE(chunk);
  EXPECT_EQ(chunk->type, ChunkType::kEnd);
  EXPECT_EQ(chunk->payload, "abc");
  EXPECT_EQ(chunk->end(), 4 + kChunkHeaderSize + 3);
  EXPECT_TRUE(chunk_at(file, chunk->end()));
  EXPECT_FALSE(chunk_at(file, 3));
  EXPECT_FALSE(chunk_at(file, file.size()));
  EXPECT_FALSE(chunk_at(file, file.size() + 100));
  ChunkSearch search(file);
  EXPECT_EQ(search.next(0), 4u);
  EXPECT_EQ(search.next(5), chunk->end());
  EXPECT_FALSE(search.next(chunk->end() + 1));
  EXPECT_FALSE(search.gave_up());
}

TEST(Chunk, EveryByteIsUnderTheCrc) {
  const std::string good = make_chunk(ChunkType::kTicks, "payload");
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ (1 << bit));
      EXPECT_FALSE(chunk_at(bad, 0)) << "byte " << i << " bit " << bit;
    }
  }
}

TEST(Chunk, AnUnknownTypeIsNotAChunk) {
  EXPECT_FALSE(chunk_at(make_chunk(static_cast<ChunkType>(0x58585858), "x"), 0));
}

TEST(Chunk, FitsOnlyWhenTheFileIsLongEnough) {
  const std::string chunk = make_chunk(ChunkType::kTicks, "payload");
  EXPECT_TRUE(chunk_fits(chunk, 0));
  EXPECT_FALSE(chunk_fits(chunk.substr(0, chunk.size() - 1), 0));
  EXPECT_FALSE(chunk_fits(chunk.substr(0, 5), 0));
}

TEST(ByteOrder, IsLittleEndianAndExact) {
  std::string out;
  bytes::put(out, std::uint32_t{0x01020304});
  EXPECT_EQ(out, std::string("\x04\x03\x02\x01"));
  for (const double value : {0.1, -0.0, 1e-310, std::numeric_limits<double>::infinity()}) {
    std::string text;
    bytes::put_double(text, value);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(bytes::Reader(text).take_double()), std::bit_cast<std::uint64_t>(value));
  }
}

TEST(RecordingEnd, KeepsHashStatusCountsAndSummary) {
  RecordingEnd end{0xFEDCBA9876543210, AttemptStatus::kVoid, 12, 3, "{\"a\": 1}"};
  const RecordingEnd back = decode_end(encode_end(end));
  EXPECT_EQ(back.state_hash, end.state_hash);
  EXPECT_EQ(back.status, end.status);
  EXPECT_EQ(back.tick_count, 12u);
  EXPECT_EQ(back.event_count, 3u);
  EXPECT_EQ(back.summary_json, end.summary_json);
  std::string bad = encode_end(end);
  bad[8] = 17;
  EXPECT_THROW(decode_end(bad), InputError);
  EXPECT_THROW(decode_end("short"), InputError);
}

TEST(RecordingHeader, RefusesWhatIsNotItsJson) {
  EXPECT_THROW(decode_header("{"), InputError);
  EXPECT_THROW(decode_header("{}"), InputError);
  EXPECT_THROW(decode_header("[1, 2]"), InputError);
  std::string header = encode_header({"", 1000});
  header.replace(header.find("1000.0"), 6, "-1.000");
  EXPECT_THROW(decode_header(header), InputError);
}

TEST(RecordingWriter, WritesAChunkEachHalfSecondWhateverTheRate) {
  for (const int rate : {2, 10, 1000, 4000}) {
    MemorySink sink;
    RecordingWriter writer(sink, "", rate);
    const std::size_t empty = sink.bytes().size();
    RecordedTick row;
    for (int i = 0; i < rate / 2 - 1; ++i, ++row.tick) writer.append(row);
    EXPECT_EQ(sink.bytes().size(), empty) << rate;
    writer.append(row);
    const std::size_t one = sink.bytes().size();
    EXPECT_GT(one, empty) << rate;
    const std::size_t link = chunk_at(sink.bytes(), empty)->end();
    EXPECT_EQ(chunk_at(sink.bytes(), link)->type, ChunkType::kLink) << rate;
    EXPECT_EQ(chunk_at(sink.bytes(), link)->end(), one) << rate;
  }
}

TEST(RecordingWriter, AnEmptyRecordingIsWhole) {
  MemorySink sink;
  RecordingWriter writer(sink, "", 1000);
  writer.close({});
  const Recording recording = parse_recording(sink.bytes(), "memory");
  EXPECT_TRUE(recording.ticks.empty() && recording.events.empty());
  EXPECT_TRUE(recording.end && recording.torn.empty());
}

TEST(RecordingWriter, TheRunReportStandsBeforeTheEnd) {
  MemorySink sink;
  RecordingWriter writer(sink, "", 1000);
  writer.close({}, "{\"ticks\": 1}");
  const Recording recording = parse_recording(sink.bytes(), "memory");
  EXPECT_EQ(recording.run_report_json, "{\"ticks\": 1}");
  EXPECT_TRUE(recording.end);
  MemorySink without;
  RecordingWriter(without, "", 1000).close({});
  EXPECT_EQ(parse_recording(without.bytes(), "memory").run_report_json, "");
}

TEST(RecordingWriter, EventsGoOutWithTheNextChunk) {
  MemorySink sink;
  RecordingWriter writer(sink, "", 1000);
  writer.append_events(sample_events());
  EXPECT_TRUE(parse_recording(sink.bytes(), "memory").events.empty());
  writer.flush();
  EXPECT_EQ(parse_recording(sink.bytes(), "memory").events.size(), 2u);
  writer.append_events(sample_events());
  writer.close({});
  EXPECT_EQ(parse_recording(sink.bytes(), "memory").events.size(), 4u);
}

TEST(TickCodec, TicksMayBeMissingBetweenRows) {
  std::vector<RecordedTick> rows(4);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].tick = 10 * i * i + (std::uint64_t{1} << 40);
  EXPECT_EQ(decode_ticks(TickEncoder().encode(rows)), rows);
  EXPECT_THROW(decode_ticks(TickEncoder().encode({})), InputError);
  EXPECT_THROW(decode_ticks(""), InputError);
}

TEST(TickCodec, RefusesSizesThatAFileCannotHave) {
  std::string payload = TickEncoder().encode(realistic_ticks(10, 1));
  payload[3] = '\x7f';  // two thousand million rows
  EXPECT_THROW(decode_ticks(payload), InputError);
  payload = TickEncoder().encode(realistic_ticks(10, 1));
  payload[7] = '\x7f';
  EXPECT_THROW(decode_ticks(payload), InputError);
}

}  // namespace
}  // namespace trocar::recording_container_test
