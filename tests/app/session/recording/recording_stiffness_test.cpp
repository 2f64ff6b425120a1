// Stiffness and K_max in a recording: their bytes, their way back, and recordings from before there were any.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "app/session/recording/chunk.h"
#include "app/session/recording/recording_reader.h"
#include "app/session/recording/recording_writer.h"
#include "haptics/input_error.h"
#include "tests/app/session/recording/recording_samples.h"

namespace trocar::recording_stiffness_test {
namespace {

RecordedTick row_of(double asked, double k_max) {
  TraceSample sample;
  sample.stiffness_n_per_m = asked;
  sample.k_max_n_per_m = k_max;
  return quantise(1, {}, sample, LoopState::kActive, 0);
}

/// The channels of format 2: those before stiffness and K_max.
std::span<const RecordedChannel> format_2_channels() {
  return recorded_channels().first(recorded_channels().size() - 2);
}

TEST(StiffnessChannels, KeepATenthOfANewtonAMetre) {
  const TraceSample back = dequantise(row_of(123.04, 41.27), 1000);
  EXPECT_DOUBLE_EQ(back.stiffness_n_per_m, 123.0);
  EXPECT_DOUBLE_EQ(back.k_max_n_per_m, 41.3);
}

TEST(StiffnessChannels, NothingTouchedIsZeroAndNothingKnownIsNaN) {
  EXPECT_EQ(dequantise(row_of(0, 0), 1000).k_max_n_per_m, 0);
  EXPECT_TRUE(std::isnan(dequantise(row_of(100, std::numeric_limits<double>::infinity()), 1000).k_max_n_per_m));
  EXPECT_TRUE(std::isnan(dequantise(RecordedTick{}, 1000).stiffness_n_per_m)) << "a row of an older recording";
}

TEST(StiffnessChannels, StandLastInTheSchemaSoThatOlderRowsAreABeginning) {
  const auto channels = recorded_channels();
  EXPECT_EQ(channels[channels.size() - 2].name, "stiffness");
  EXPECT_EQ(channels.back().name, "k_max");
  EXPECT_EQ(channels.back().unit, "N/m");
  EXPECT_EQ(format_2_channels().back().name, "phase");
}

TEST(StiffnessChannels, RowsWithoutThemAreDecodedByTheirOwnSchema) {
  TickEncoder encoder;
  const auto rows = realistic_ticks(1000, 3);
  const auto back = decode_ticks(encoder.encode(rows, format_2_channels()), format_2_channels());
  ASSERT_EQ(back.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    RecordedTick before = rows[i];
    before.stiffness = before.k_max = kNotRepresentable;
    ASSERT_EQ(back[i], before) << i;
  }
  EXPECT_THROW(decode_ticks(encoder.encode(rows, format_2_channels())), InputError) << "not by the newer one";
}

TEST(StiffnessChannels, CostLittle) {
  TickEncoder encoder;
  std::size_t with = 0, without = 0;
  for (unsigned second = 0; second < 10; ++second) {
    const auto all = realistic_ticks(10000, 1);
    const std::span rows(all.data() + 1000 * second, 1000);
    with += encoder.encode(rows).size();
    without += encoder.encode(rows, format_2_channels()).size();
  }
  RecordProperty("bytes_with", std::to_string(with));
  RecordProperty("bytes_without", std::to_string(without));
  EXPECT_GT(with, without);
  EXPECT_LT(static_cast<double>(with), 1.15 * static_cast<double>(without));
}

TEST(FormatTwo, IsStillRead) {
  std::ifstream file(TROCAR_SOURCE_DIR "/tests/app/data/format-2.trec", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const Recording recording = parse_recording(bytes, "format-2.trec");
  EXPECT_EQ(recording.version, 2u);
  ASSERT_FALSE(recording.ticks.empty());
  EXPECT_EQ(recording.ticks.back().loop_state, 3) << "the fault that ended it";
  for (const RecordedTick& row : recording.ticks) {
    ASSERT_EQ(row.stiffness, kNotRepresentable);
    ASSERT_EQ(row.k_max, kNotRepresentable);
  }
  ASSERT_TRUE(recording.end);
  EXPECT_EQ(recording.end->tick_count, recording.ticks.size());
  EXPECT_FALSE(recording.schedule.steps.empty()) << "formats from 2 on have a schedule";
}

TEST(FormatFive, IsWhatIsWrittenAndANewerOneIsRefused) {
  std::string bytes = small_recording(1, 100, 1);
  EXPECT_EQ(parse_recording(bytes, "now").version, 5u);
  ++bytes[kRecordingMagic.size()];
  EXPECT_THROW(parse_recording(bytes, "next"), InputError);
}

TEST(FormatThree, IsReadAsBeforeKeyframes) {
  const std::string now = small_recording(1, 100, 1);
  const Recording read = parse_recording(unlinked(now, 3), "before");
  EXPECT_EQ(read.version, 3u);
  std::string bytes = now;
  bytes[kRecordingMagic.size()] = 4;
  EXPECT_THROW(parse_recording(bytes, "told older"), InputError) << "links are of format 5";
}

TEST(FormatThree, AVersionThatItsChannelsContradictIsRefused) {
  std::string bytes = small_recording(1, 100, 1);
  bytes[kRecordingMagic.size()] = 2;
  try {
    parse_recording(bytes, "a.trec");
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("recording format 2, but its channels"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace trocar::recording_stiffness_test
