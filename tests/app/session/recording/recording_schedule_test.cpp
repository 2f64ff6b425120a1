// The schedule of a run: its bytes, its way into a recording and out, and what stands for it in recordings without one.
#include "app/session/recording/schedule.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

#include "app/session/recording/byte_order.h"
#include "app/session/recording/chunk.h"
#include "app/session/recording/recording_reader.h"
#include "app/session/recording/recording_writer.h"
#include "tests/app/session/recording/recording_samples.h"

namespace trocar::recording_schedule_test {
namespace {

RecordedTick row(std::uint64_t tick, std::uint32_t elapsed = 1) {
  RecordedTick out;
  out.tick = tick;
  out.elapsed_periods = elapsed;
  return out;
}

/// A live run of `seconds`: steps about every 10 periods, patches seen a little later, now and then none.
Schedule drawn_schedule(unsigned seed, int seconds) {
  std::mt19937 random(seed);
  Schedule schedule;
  for (std::uint64_t step = 1; step <= 100u * static_cast<unsigned>(seconds); ++step) {
    schedule.steps.push_back(10 * step + random() % 3);
    if (random() % 20 != 0) schedule.patches.push_back({schedule.steps.back() + 1 + random() % 4, step});
  }
  return schedule;
}

TEST(Schedule, ComesBackFromItsBytes) {
  EXPECT_EQ(decode_schedule(encode_schedule({})), Schedule{});
  for (unsigned seed = 1; seed < 20; ++seed) {
    const Schedule schedule = drawn_schedule(seed, 3);
    EXPECT_EQ(decode_schedule(encode_schedule(schedule)), schedule) << "seed " << seed;
  }
  const Schedule far{{{~std::uint64_t{0} - 1, 1}, {~std::uint64_t{0}, ~std::uint64_t{0}}}, {0, 0, ~std::uint64_t{0}}};
  EXPECT_EQ(decode_schedule(encode_schedule(far)), far);
}

TEST(Schedule, AMinuteCostsAFewPercentOfTheRecording) {
  // In chunks of a second, as the writer makes them; 0.6 MiB are allowed for everything.
  std::size_t bytes = 0;
  for (unsigned second = 0; second < 60; ++second) bytes += encode_schedule(drawn_schedule(second, 1)).size();
  EXPECT_LT(bytes, 0.03 * 0.6 * 1048576);
}

TEST(Schedule, DamageIsRefused) {
  const std::string good = encode_schedule(drawn_schedule(1, 1));
  EXPECT_THROW(decode_schedule(""), InputError);
  EXPECT_THROW(decode_schedule(good.substr(0, good.size() - 1)), InputError);
  for (const std::size_t count : {0u, 4u}) {  // one entry more than the bytes hold, in either list
    std::string longer = good;
    ++longer[count];
    EXPECT_THROW(decode_schedule(longer), InputError) << count;
  }
  std::string huge = good;
  huge[3] = '\x7f';
  EXPECT_THROW(decode_schedule(huge), InputError);
}

TEST(Schedule, WhatGoesBackInTimeIsRefused) {
  EXPECT_THROW(decode_schedule(encode_schedule({{{20, 1}, {20, 2}}, {}})), InputError);
  EXPECT_THROW(decode_schedule(encode_schedule({{{20, 2}, {30, 1}}, {}})), InputError);
  EXPECT_THROW(decode_schedule(encode_schedule({{}, {20, 10}})), InputError);
}

TEST(Schedule, TravelsWithTheRowsThatNeedIt) {
  MemorySink memory;
  RecordingWriter writer(memory, "", 10);  // a chunk every 5 rows
  for (std::uint64_t tick = 1; tick <= 23; ++tick) {
    if (tick % 5 == 1) writer.append_step(tick);
    if (tick % 5 == 3) writer.append_patch({tick, tick / 5 + 1});
    writer.append(row(tick));
  }
  const std::string cut = memory.bytes();  // as a kill would leave it
  writer.close({});
  const Recording whole = parse_recording(memory.bytes(), "memory"), torn = parse_recording(cut, "torn");
  EXPECT_EQ(whole.version, kRecordingVersion);
  EXPECT_EQ(whole.schedule.steps, (std::vector<std::uint64_t>{1, 6, 11, 16, 21}));
  EXPECT_EQ(whole.schedule.patches, (std::vector<PatchSeen>{{3, 1}, {8, 2}, {13, 3}, {18, 4}, {23, 5}}));
  EXPECT_EQ(torn.ticks.size(), 20u);
  EXPECT_EQ(torn.schedule.patches.size(), 4u) << "the schedule of the rows that are there";
}

TEST(Schedule, ARepeatedScheduleChunkIsDamage) {
  MemorySink memory;
  RecordingWriter writer(memory, "", 10);
  writer.append_patch({3, 1});
  writer.append(row(3));
  writer.close({});
  std::string bytes = memory.bytes();
  const std::size_t at = bytes.find("SCHD");
  ASSERT_NE(at, std::string::npos);
  const auto chunk = chunk_at(bytes, at);
  ASSERT_TRUE(chunk);
  bytes.insert(chunk->end(), bytes.substr(at, chunk->end() - at));
  bytes = relinked(bytes);
  EXPECT_THROW(parse_recording(bytes, "twice"), InputError);
  EXPECT_EQ(parse_recording(bytes, "twice", Reading::kTolerant).damage.size(), 1u);
}

TEST(DeclaredSchedule, IsWhatLockstepKept) {
  std::vector<RecordedTick> rows;
  for (std::uint64_t i = 0; i < 27; ++i) rows.push_back(row(i + 1 + (i > 12 ? 4 : 0), i == 13 ? 5 : 1));
  const Schedule schedule = declared_schedule(rows, 10, 5);
  EXPECT_EQ(schedule.steps, (std::vector<std::uint64_t>{1, 11, 25})) << "by rows, which skip missed periods";
  EXPECT_EQ(schedule.patches, (std::vector<PatchSeen>{{6, 1}, {20, 2}, {30, 3}}));
}

TEST(LostRows, AreThoseThatTheDeviceCountedAndTheRecorderDidNot) {
  EXPECT_EQ(lost_rows({}), 0u);
  EXPECT_EQ(lost_rows(std::vector{row(1), row(2), row(7, 5), row(8)}), 0u) << "a missed period is no lost row";
  EXPECT_EQ(lost_rows(std::vector{row(1), row(4), row(7, 2)}), 3u);
  EXPECT_EQ(lost_rows(std::vector{row(1, 0), row(2, 0)}), 0u) << "a period without news is one";
}

TEST(FormatOne, IsStillRead) {
  std::ifstream file(TROCAR_SOURCE_DIR "/tests/app/data/format-1.trec", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const Recording recording = parse_recording(bytes, "format-1.trec");
  EXPECT_EQ(recording.version, 1u);
  EXPECT_EQ(recording.rate_hz, 1000);
  ASSERT_EQ(recording.ticks.size(), 21u);
  EXPECT_EQ(recording.ticks.front().tick, 1u);
  EXPECT_EQ(recording.ticks.back().loop_state, 3) << "the fault that ended it";
  EXPECT_EQ(lost_rows(recording.ticks), 0u);
  EXPECT_EQ(recording.schedule, Schedule{});
  ASSERT_TRUE(recording.end);
  EXPECT_EQ(recording.end->status, AttemptStatus::kFault);
}

TEST(Header, AChannelThatThisProgramDoesNotKnowIsNamed) {
  MemorySink memory;
  RecordingWriter writer(memory, "", 1000);
  std::string bytes = memory.bytes();
  const auto chunk = chunk_at(bytes, kRecordingPrefixSize);
  ASSERT_TRUE(chunk);
  std::string header(chunk->payload);
  header.replace(header.find("grip"), 4, "grop");
  bytes = recording_prefix() + make_chunk(ChunkType::kHeader, header);
  try {
    parse_recording(bytes, "a.trec");
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'grop'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace trocar::recording_schedule_test
