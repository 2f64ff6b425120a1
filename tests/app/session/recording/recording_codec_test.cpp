// The recording keeps what it promises: exact input, quantised trace, exact events, small files.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/session/recording/event_codec.h"
#include "app/session/recording/recording_header.h"
#include "app/session/recording/recording_reader.h"
#include "app/session/recording/tick_codec.h"
#include "haptics/input_error.h"
#include "tests/app/session/recording/recording_samples.h"

namespace trocar::recording_codec_test {
namespace {

TEST(Quantise, RoundsToTheNearestQuantumAndDecodesWithinHalf) {
  TraceSample sample;
  sample.tip_T = Vec3(0.0123456, -0.0000004, 1.9999996);
  sample.shaft_T = Vec3(0.6, -0.48, 0.64);
  sample.force_T = Vec3(1.2344, -0.0006, 0);
  sample.rendered_n = 2.9995;
  sample.grip_n = 0.4994;
  sample.jaw_opening_m = 0.0100006;
  const RecordedTick row = quantise(7, DaqSample{}, sample, LoopState::kActive, 2);
  EXPECT_EQ(row.tip, (std::array<std::int32_t, 3>{12346, 0, 2000000}));
  EXPECT_EQ(row.force, (std::array<std::int32_t, 3>{1234, -1, 0}));
  EXPECT_EQ(row.jaw_opening, 10001);
  const TraceSample back = dequantise(row, 1000);
  EXPECT_DOUBLE_EQ(back.t_s, 0.007);
  EXPECT_LE((back.tip_T - sample.tip_T).cwiseAbs().maxCoeff(), 0.5e-6 * (1 + 1e-9));
  EXPECT_LE((back.force_T - sample.force_T).cwiseAbs().maxCoeff(), 0.5e-3 * (1 + 1e-9));
  EXPECT_LE(std::abs(back.rendered_n - sample.rendered_n), 0.5e-3 * (1 + 1e-9));
  // Each component is off by at most half a quantum: the direction by at most sqrt(3)/2 quanta.
  EXPECT_LE((back.shaft_T - sample.shaft_T).norm(), std::sqrt(3.0) / 2 * 1e-4 * 1.01);
  EXPECT_NEAR(back.shaft_T.norm(), 1, 1e-15);
}

TEST(Quantise, DecodedValuesAreDecimalFractionsAndStayPut) {
  for (const RecordedTick& row : realistic_ticks(3000, 5)) {
    const TraceSample sample = dequantise(row, 1000);
    RecordedTick again = quantise(row.tick, device_input(row), sample, LoopState::kActive, row.phase);
    again.shaft = row.shaft;  // brought back to unit length, so it may move by a quantum
    ASSERT_EQ(again, row);
  }
  RecordedTick row;
  row.tip = {12346, 0, 0};
  EXPECT_EQ(dequantise(row, 1000).tip_T.x(), 0.012346);
}

TEST(Quantise, WhatCannotBeRepresentedBecomesNotANumberNeverAClampedNumber) {
  TraceSample sample;
  sample.tip_T = Vec3(std::numeric_limits<double>::quiet_NaN(), 3000, -3000);
  sample.rendered_n = std::numeric_limits<double>::infinity();
  const RecordedTick row = quantise(0, DaqSample{}, sample, LoopState::kFault, 0);
  const TraceSample back = dequantise(row, 1000);
  EXPECT_TRUE(back.tip_T.array().isNaN().all());
  EXPECT_TRUE(std::isnan(back.rendered_n));
}

TEST(Quantise, KeepsDeviceInputAndFlagsExactly) {
  DaqSample input;
  input.counts = {INT32_MIN, INT32_MAX, -1, 0, 1, 42, -42};
  input.valid = 0x5F;
  input.elapsed_periods = 3;
  input.digital_in = kDeadman | kHomeBeam;
  TraceSample sample;
  sample.contact = sample.passivity_active = true;
  const RecordedTick row = quantise(1, input, sample, LoopState::kHomed, 4);
  EXPECT_EQ(row.flags, kFlagContact | kFlagPassivityActive);
  EXPECT_EQ(row.loop_state, 1);
  EXPECT_EQ(row.phase, 4);
  const DaqSample back = device_input(row);
  EXPECT_EQ(back.counts, input.counts);
  EXPECT_EQ(back.valid, input.valid);
  EXPECT_EQ(back.elapsed_periods, input.elapsed_periods);
  EXPECT_EQ(back.digital_in, input.digital_in);
  const TraceSample flags = dequantise(row, 1000);
  EXPECT_TRUE(flags.contact && flags.passivity_active && !flags.saturated);
}

TEST(Quantise, KeepsThePedalAndTheInstrumentInHand) {
  TraceSample sample;
  sample.contact = true;
  EXPECT_EQ(quantise(1, {}, sample, LoopState::kActive, 4).flags, kFlagContact) << "unused they leave a row as it was";
  for (std::int32_t instrument = 0; instrument < 16; ++instrument) {
    sample.instrument = instrument;
    sample.pedal = instrument % 3 == 0;
    const TraceSample back = dequantise(quantise(1, {}, sample, LoopState::kActive, 4), 1000);
    EXPECT_EQ(back.instrument, instrument);
    EXPECT_EQ(back.pedal, sample.pedal);
    EXPECT_TRUE(back.contact && !back.saturated);
  }
}

TEST(TickCodec, ReturnsArbitraryRowsExactly) {
  TickEncoder encoder;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto rows = arbitrary_ticks(1 + seed * 37, seed);
    EXPECT_EQ(decode_ticks(encoder.encode(rows)), rows) << "seed " << seed;
  }
}

TEST(TickCodec, SurvivesCountersThatWrap) {
  std::vector<RecordedTick> rows(5);
  std::uint32_t counter = 0x7FFFFFFE;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].tick = i;
    rows[i].counts.fill(static_cast<std::int32_t>(counter++));
  }
  ASSERT_LT(rows.back().counts[0], 0);
  EXPECT_EQ(decode_ticks(TickEncoder().encode(rows)), rows);
}

TEST(TickCodec, ConstantColumnsCostNextToNothing) {
  std::vector<RecordedTick> rows(1000);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].tick = 5000 + i;
  EXPECT_LT(TickEncoder().encode(rows).size(), 100u);
}

TEST(TickCodec, RefusesTicksThatDoNotIncrease) {
  std::vector<RecordedTick> rows(3);
  rows[0].tick = rows[1].tick = rows[2].tick = 9;
  const std::string payload = TickEncoder().encode(rows);
  EXPECT_THROW(decode_ticks(payload), InputError);
}

TEST(EventCodec, KeepsDoublesToTheBit) {
  const auto events = sample_events();
  const auto back = decode_events(encode_events(events));
  ASSERT_EQ(back.size(), events.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back[i].t_s), std::bit_cast<std::uint64_t>(events[i].t_s));
    EXPECT_EQ(back[i].type, events[i].type);
    EXPECT_EQ(back[i].severity, events[i].severity);
    EXPECT_EQ(back[i].object, events[i].object);
    EXPECT_EQ(back[i].value, events[i].value);
    EXPECT_EQ(back[i].unit, events[i].unit);
    EXPECT_EQ(back[i].tip_T, events[i].tip_T);
  }
  EXPECT_TRUE(std::signbit(back[1].tip_T.z()));
}

TEST(RecordingHeader, CarriesTheSessionsTextByteForByte) {
  const std::string text = "{\"toml\": \"a = \\\"1\\\"\\n\", \"unit\": \"\xC2\xB5m\"}\n";
  const RecordingHeader back = decode_header(encode_header({text, 4000}));
  EXPECT_EQ(back.session, text);
  EXPECT_EQ(back.rate_hz, 4000);
  EXPECT_THROW(encode_header({"\xFF\xFE", 1000}), InputError);
  EXPECT_THROW(encode_header({"", 0}), InputError);
  EXPECT_THROW(encode_header({"", std::nan("")}), InputError);
}

TEST(RecordedTick, ARecordingWithoutTheCommandedForceSaysSo) {
  std::vector<RecordedChannel> older(recorded_channels().begin(), recorded_channels().end());
  std::erase_if(older, [](const RecordedChannel& channel) { return channel.name == "commanded"; });
  ASSERT_EQ(older.size(), recorded_channels().size() - 1);
  // A file of those channels only: the column of the commanded force cut out of a header.
  std::string header = encode_header({"", 1000});
  const std::string entry = R"({"name":"commanded","quantum":0.001,"unit":"N"},)";
  ASSERT_NE(header.find(entry), std::string::npos);
  header.erase(header.find(entry), entry.size());
  EXPECT_EQ(decode_header(header).channels.size(), older.size());
  EXPECT_TRUE(std::isnan(dequantise(RecordedTick{}, 1000).commanded_n)) << "not recorded is not zero";
  TraceSample sample;
  sample.commanded_n = 0.123;
  EXPECT_NEAR(dequantise(quantise(1, {}, sample, LoopState::kActive, 0), 1000).commanded_n, 0.123, 0.5e-3);
}

TEST(RecordingHeader, NamesEveryChannelWithUnitAndQuantum) {
  const std::string header = encode_header({"", 1000});
  EXPECT_NE(header.find(R"({"name":"tip_x","quantum":1e-06,"unit":"m"})"), std::string::npos);
  EXPECT_NE(header.find(R"({"name":"force_z","quantum":0.001,"unit":"N"})"), std::string::npos);
  EXPECT_EQ(recorded_channels().size(), 29u);
  std::string other = header;
  other.replace(other.find("tip_x"), 5, "tip_q");
  EXPECT_THROW(decode_header(other), InputError);
}

TEST(Recording, ComesBackAsItWasWritten) {
  const auto rows = realistic_ticks(2500, 3);
  MemorySink sink;
  RecordingWriter writer(sink, "session", 1000);
  for (const RecordedTick& row : rows) writer.append(row);
  writer.append_events(sample_events());
  writer.close({77, AttemptStatus::kTimeout, 0, 0, "{}"});
  const Recording recording = parse_recording(sink.bytes(), "memory");
  EXPECT_EQ(recording.session, "session");
  EXPECT_EQ(recording.rate_hz, 1000);
  EXPECT_EQ(recording.ticks, rows);
  EXPECT_EQ(recording.events.size(), 2u);
  ASSERT_TRUE(recording.end);
  EXPECT_EQ(recording.end->state_hash, 77u);
  EXPECT_EQ(recording.end->status, AttemptStatus::kTimeout);
  EXPECT_EQ(recording.end->tick_count, 2500u);
  EXPECT_EQ(recording.end->summary_json, "{}");
  EXPECT_EQ(recording.torn, "");
  EXPECT_EQ(recording.sha256, writer.sha256());
}

TEST(Recording, EqualInputGivesEqualBytes) {
  EXPECT_EQ(small_recording(2, 200, 11), small_recording(2, 200, 11));
  EXPECT_NE(small_recording(2, 200, 11), small_recording(2, 200, 12));
}

TEST(Recording, RebuiltTraceEqualsTheLiveOneToTheBit) {
  const auto rows = realistic_ticks(1500, 8);
  const Trace live = rebuild_trace(rows, 1000);
  MemorySink sink;
  RecordingWriter writer(sink, "", 1000);
  for (const RecordedTick& row : rows) writer.append(row);
  writer.close({});
  const Recording recording = parse_recording(sink.bytes(), "memory");
  const Trace again = rebuild_trace(recording.ticks, recording.rate_hz);
  ASSERT_EQ(again.samples.size(), live.samples.size());
  for (std::size_t i = 0; i < live.samples.size(); ++i) {
    ASSERT_EQ(again.samples[i].t_s, live.samples[i].t_s);
    ASSERT_EQ(again.samples[i].tip_T, live.samples[i].tip_T);
    ASSERT_EQ(again.samples[i].shaft_T, live.samples[i].shaft_T);
    ASSERT_EQ(again.samples[i].force_T, live.samples[i].force_T);
  }
}

TEST(Recording, AMinuteAtAKilohertzStaysWithinItsBudget) {
  MemorySink sink;
  RecordingWriter writer(sink, "{}", 1000);
  for (const RecordedTick& row : realistic_ticks(60000, 1)) writer.append(row);
  writer.close({});
  const double mebibytes = static_cast<double>(sink.bytes().size()) / (1 << 20);
  RecordProperty("mebibytes_per_minute", std::to_string(mebibytes));
  EXPECT_LE(mebibytes, 0.6);
}

TEST(Recording, RefusesMisuse) {
  MemorySink sink;
  RecordingWriter writer(sink, "", 1000);
  RecordedTick row;
  row.tick = 5;
  writer.append(row);
  EXPECT_THROW(writer.append(row), std::invalid_argument);
  writer.close({});
  row.tick = 6;
  EXPECT_THROW(writer.append(row), std::logic_error);
}

}  // namespace
}  // namespace trocar::recording_codec_test
