#include "tests/app/session/recording/recording_samples.h"

#include <cmath>
#include <numbers>
#include <random>

#include "app/session/recording/chunk.h"
#include "app/session/recording/recording_writer.h"
#include "app/session/recording/seal.h"

namespace trocar {
namespace {

constexpr double kPi = std::numbers::pi;

/// Normal deviate by Box and Muller.
double normal(std::mt19937_64& random) {
  const double u = (static_cast<double>(random() >> 11) + 1) * 0x1p-53;
  const double v = static_cast<double>(random() >> 11) * 0x1p-53;
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * kPi * v);
}

/// Joint angles of a wandering hand: three slow sines and 9 Hz tremor a joint, rad.
std::array<double, kChannels> joint_angles(double t) {
  std::array<double, kChannels> angles{};
  for (int joint = 0; joint < kChannels; ++joint) {
    angles[joint] = 0.25 * std::sin(2 * kPi * (0.13 + 0.04 * joint) * t + joint) +
                    0.08 * std::sin(2 * kPi * (0.57 + 0.06 * joint) * t) + 0.0003 * std::sin(2 * kPi * 9 * t + joint);
  }
  return angles;
}

DaqSample encoders(double t) {
  constexpr double kCountsPerRadian = 2000 * 14.5 / (2 * kPi);
  DaqSample sample;
  const auto angles = joint_angles(t);
  for (int joint = 0; joint < kChannels; ++joint) {
    sample.counts[joint] = static_cast<std::int32_t>(std::floor(angles[joint] * kCountsPerRadian));
  }
  sample.digital_in = kDeadman;
  return sample;
}

TraceSample trace_sample(const DaqSample& input, double t, std::mt19937_64& random) {
  constexpr double kRadians = 2 * kPi / (2000 * 14.5);
  const auto angle = [&](int joint) { return input.counts[joint] * kRadians; };
  TraceSample sample;
  sample.tip_T = Vec3(0.2 * std::sin(angle(0)) + 0.1 * angle(3), 0.2 * std::sin(angle(1)), 0.15 * angle(2));
  sample.shaft_T = Vec3(std::sin(angle(4)), std::sin(angle(5)), -1).normalized();
  sample.contact = std::fmod(t, 4.0) < 2.0;
  if (sample.contact) {
    const double press = 0.8 * std::sin(kPi * std::fmod(t, 4.0) / 2);
    sample.force_T = press * Vec3(0.1, 0.2, 0.97) + 0.01 * Vec3(normal(random), normal(random), normal(random));
    sample.rendered_n = sample.force_T.norm() * 0.9;
    sample.stiffness_n_per_m = 123;  // as a run shows it: the spring steady, K_max by pose and direction
    sample.k_max_n_per_m = 120 + 75 * std::sin(2 * kPi * 0.3 * t) + 0.2 * normal(random);
  }
  sample.jaw_opening_m = 0.01 + 0.02 * angle(6);
  sample.grip_n = std::fmod(t, 20.0) > 18 ? 1 + 0.01 * normal(random) : 0;
  return sample;
}

}  // namespace

std::vector<RecordedTick> realistic_ticks(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<RecordedTick> rows;
  rows.reserve(count);
  for (std::size_t tick = 0; tick < count; ++tick) {
    const double t = static_cast<double>(tick) * 1e-3;
    const DaqSample input = encoders(t);
    rows.push_back(quantise(tick, input, trace_sample(input, t, random), LoopState::kActive, 2));
  }
  return rows;
}

std::vector<RecordedTick> arbitrary_ticks(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto any = [&] { return static_cast<std::int32_t>(random()); };
  std::vector<RecordedTick> rows(count);
  std::uint64_t tick = 0;
  for (RecordedTick& row : rows) {
    row.tick = tick += 1 + random() % 3;
    for (auto& value : row.counts) value = any();
    for (auto* vector : {&row.tip, &row.shaft, &row.force}) *vector = {any(), any(), any()};
    row.elapsed_periods = static_cast<std::uint32_t>(random());
    row.digital_in = static_cast<std::uint32_t>(random());
    row.rendered = any();
    row.grip = any();
    row.jaw_opening = any();
    for (auto* byte : {&row.valid, &row.flags, &row.loop_state, &row.phase})
      *byte = static_cast<std::uint8_t>(random());
    row.stiffness = any();
    row.k_max = any();
  }
  return rows;
}

std::vector<Event> sample_events() {
  return {{0.1, "TARGET_HELD", Severity::kInfo, 3, 1.0 / 3.0, "N", Vec3(0.1, -0.2, 0.3)},
          {std::nextafter(0.2, 1.0), "EXCESS_FORCE", Severity::kMajor, -1, 4.25, "N", Vec3(1e-300, 0, -0.0)}};
}

std::string small_recording(int seconds, int rate, std::uint64_t seed) {
  MemorySink sink;
  RecordingWriter writer(sink, R"({"exercise":"surface-touch"})", rate);
  const auto rows = realistic_ticks(static_cast<std::size_t>(seconds * rate), seed);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    writer.append(rows[i]);
    if (i == rows.size() / 2) writer.append_events(sample_events());
  }
  writer.close({0x0123456789abcdef, AttemptStatus::kCompleted, 0, 0, R"({"score":81})"});
  return sink.bytes();
}

std::string relinked(const std::string& recording) {
  std::string out, link, since = recording.substr(0, kRecordingPrefixSize);
  for (auto chunk = chunk_at(recording, kRecordingPrefixSize); chunk; chunk = chunk_at(recording, chunk->end())) {
    if (chunk->type != ChunkType::kLink) {
      since += recording.substr(chunk->offset, chunk->end() - chunk->offset);
      continue;
    }
    link = make_link(link, since, std::nullopt);
    out += since + make_chunk(ChunkType::kLink, link);
    since.clear();
  }
  return out + since;
}

std::string unlinked(const std::string& recording, char version) {
  std::string out = recording.substr(0, kRecordingPrefixSize);
  out[kRecordingMagic.size()] = version;
  for (auto chunk = chunk_at(recording, kRecordingPrefixSize); chunk; chunk = chunk_at(recording, chunk->end()))
    if (chunk->type != ChunkType::kLink) out += recording.substr(chunk->offset, chunk->end() - chunk->offset);
  return out;
}

}  // namespace trocar
