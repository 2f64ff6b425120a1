// Keyframes come back within their quanta, from any place of the file alike, and take little room.
#include "app/session/recording/tissue_codec.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <random>

#include "app/session/recording/recording_reader.h"
#include "haptics/input_error.h"
#include "tests/app/session/recording/recording_samples.h"
#include "tests/app/session/recording/waving_world.h"

namespace trocar::tissue_codec_test {
namespace {

using test::block_of_nodes, test::waved;

constexpr std::uint64_t kEvery = 50;   // periods: 20 Hz
constexpr std::size_t kPerChunk = 10;  // of half a second
constexpr double kNearly = 1e-7;       // m: rounding of a float at 0.3 m, thrice
constexpr double kWithin = 0.5 * kNodeQuantum + kNearly;

TissueKeyframe plain(std::size_t n) {
  TissueKeyframe k;
  k.period = 1 + kEvery * n;
  const double t_s = 1e-3 * static_cast<double>(k.period);
  k.status.phase = n > 10 ? Phase::kRun : Phase::kReady;
  k.status.run_time_s = std::sqrt(t_s);
  k.status.position_error_m = 0.01 * std::sin(9 * t_s);
  k.status.message = n % 30 > 20 ? "Well held: " + std::to_string(n) : "";
  k.tissue.stamp = 5 * n;
  k.tissue.t_s = t_s;
  k.instrument.R_TI = Eigen::AngleAxisd(0.3 * std::sin(t_s), Vec3(1, 2, -1).normalized()).toRotationMatrix();
  k.instrument.winding_c = 30 + std::sin(t_s);
  return k;
}

TissueKeyframe shaped(std::size_t n, std::vector<NodePlace> nodes_T) {
  TissueKeyframe k = plain(n);
  k.shaped = true;
  k.topology = 3;
  k.nodes_T = std::move(nodes_T);
  return k;
}

std::vector<TissueKeyframe> waving(std::size_t count, std::size_t nodes, double noise_m = 0) {
  const std::vector<NodePlace> rest = block_of_nodes(nodes);
  std::vector<TissueKeyframe> out;
  for (std::size_t n = 0; n < count; ++n)
    out.push_back(shaped(n, waved(rest, 1e-3 * static_cast<double>(kEvery * n), noise_m)));
  return out;
}

struct Encoded {
  TissueTrack track;
  std::vector<std::string> keyframes;
  std::size_t bytes = 0;
};

Encoded encoded(const std::vector<TissueKeyframe>& keyframes, std::size_t per_chunk = kPerChunk) {
  TissueEncoder encoder;
  Encoded out;
  for (std::size_t i = 0; i < keyframes.size(); i += per_chunk) {
    const auto chunks = encoder.encode(std::span(keyframes).subspan(i, std::min(per_chunk, keyframes.size() - i)));
    for (const std::string& shape : chunks.shapes) {
      out.track.add_shape(shape);
      out.bytes += shape.size();
    }
    out.track.add_keyframes(chunks.keyframes);
    out.keyframes.push_back(chunks.keyframes);
    out.bytes += chunks.keyframes.size();
  }
  return out;
}

void expect_near(const TissueKeyframe& was, const TissueKeyframe& is) {
  ASSERT_EQ(was.period, is.period);
  ASSERT_EQ(was.shaped, is.shaped);
  EXPECT_EQ(was.topology, is.topology);
  ASSERT_EQ(was.nodes_T.size(), is.nodes_T.size());
  for (std::size_t i = 0; i < was.nodes_T.size(); ++i)
    ASSERT_LE((was.nodes_T[i] - is.nodes_T[i]).cwiseAbs().maxCoeff(), kWithin) << i;
  ASSERT_EQ(was.fields.size(), is.fields.size());
  for (std::size_t f = 0; f < was.fields.size(); ++f) {
    EXPECT_EQ(was.fields[f].name, is.fields[f].name);
    EXPECT_EQ(was.fields[f].place, is.fields[f].place);
    ASSERT_EQ(was.fields[f].value.size(), is.fields[f].value.size());
    for (std::size_t i = 0; i < was.fields[f].value.size(); ++i)
      ASSERT_NEAR(was.fields[f].value[i], is.fields[f].value[i], 0.5 / kFieldSteps + 1e-6);
  }
  EXPECT_TRUE(runs_on(was.status, is.status));
  EXPECT_EQ(was.status.run_time_s, is.status.run_time_s);
  EXPECT_EQ(was.status.position_error_m, is.status.position_error_m);
  EXPECT_EQ(was.tissue.stamp, is.tissue.stamp);
  EXPECT_NEAR((was.instrument.R_TI - is.instrument.R_TI).norm(), 0, 1e-6);
  EXPECT_NEAR(was.instrument.winding_c, is.instrument.winding_c, 1e-5);
}

TEST(TissueCodec, AWaveComesBackWithinHalfAQuantum) {
  auto keyframes = waving(95, 300);
  for (std::size_t n = 0; n < keyframes.size(); ++n)
    keyframes[n].fields = {{"blood", FieldPlace::kNodes, std::vector<float>(300, n > 40 ? 0.37f : 0.0f)},
                           {"wet", FieldPlace::kVertices, std::vector<float>(20 + n / 50, 1.0f)}};
  const Encoded file = encoded(keyframes);
  ASSERT_EQ(file.track.size(), keyframes.size());
  TissueDecoder decoder(file.track);
  for (std::size_t n = 0; n < keyframes.size(); ++n) expect_near(keyframes[n], *decoder.at(n));
}

TEST(TissueCodec, EveryFieldOfAMomentComesBack) {
  TissueKeyframe k = plain(12);
  k.status.done.set(31);
  k.status.done.set(2);
  k.status.cue = Cue::kCarry;
  k.status.target_index = -1;
  k.status.hint = "Gr\xc3\xbcner Ring, ein Wort mehr";
  k.status.demand.R_TI = k.instrument.R_TI;
  k.status.demand.band = {0.1, 1.0 / 3.0};
  k.status.demand.object.X_TO.p = Vec3(0.1, -0.2, 1.0 / 3.0);
  k.status.demand.foam_count = 2;
  k.status.demand.foam[1] = {150, 0.5, 1.5};
  k.status.grip = {0.01, 333};
  k.status.exposure = 0.75;
  k.status.horizon_rad = -0.125;
  k.status.shown_symbol = 2;
  k.status.mark_count = 2;
  k.status.marks_T[1] = Vec3(0.25, -0.125, 0.5);
  k.tissue.object_count = 2;
  k.tissue.object[1].X_TO = {k.instrument.R_TI, Vec3(0.01, 0.02, 0.03)};
  k.tissue.object[1].crushed = true;
  k.tissue.object[1].colour = 3;
  k.tissue.grip = GripState::kSlipping;
  k.tissue.grip_object = 1;
  k.tissue.pair_count = 1;
  k.tissue.pair[0].a = kPartyJaw;
  k.tissue.pair[0].force_n = 0.125;
  k.tissue.mark_count = 1;
  k.tissue.mark[0] = {TissueMarkKind::kChar, Vec3(0.25, 0.5, -0.5), 0.0078125, 0.5};
  k.tissue.smoke_per_m = 2;
  k.tissue.surgery.cuts = 2;
  k.tissue.surgery.refusal = 3;
  k.tissue.surgery.blood_ml = 1.5;
  k.tissue.surgery.cut_m = 0.0078125;
  k.tissue.surgery.refused_s = 12.5;
  k.tissue.clip_count = 2;
  k.tissue.clip[1] = {k.instrument.R_TI, Vec3(0.03, 0.02, 0.01)};
  k.tissue.drop_count = kMaxDropsSeen;
  k.tissue.drop.back() = {Vec3(0.125, 0.25, 0.5), 0.0009765625};
  k.instrument.fault = {FaultCode::kOverheat, 4, 123456789012345, 101.5};
  k.instrument.port_held = true;
  k.instrument.contact_point_T = Vec3(0.5, 0.25, 0.125);
  const Encoded file = encoded({plain(0), k, plain(13)});
  const TissueKeyframe is = *TissueDecoder(file.track).at(1);
  EXPECT_EQ(is.status.done, k.status.done);
  EXPECT_EQ(is.status.cue, Cue::kCarry);
  EXPECT_EQ(is.status.target_index, -1);
  EXPECT_EQ(is.status.hint, k.status.hint);
  EXPECT_EQ(is.status.demand.R_TI, k.status.demand.R_TI);
  EXPECT_EQ(is.status.demand.band, k.status.demand.band);
  EXPECT_LT((is.status.demand.object.X_TO.p - k.status.demand.object.X_TO.p).norm(), 1e-7);
  EXPECT_EQ(is.status.demand.foam[1].high_n, 1.5);
  EXPECT_EQ(is.status.grip.stiffness_n_per_m, 333);
  EXPECT_EQ(is.status.exposure, 0.75);
  EXPECT_EQ(is.status.horizon_rad, -0.125);
  EXPECT_EQ(is.status.shown_symbol, 2);
  ASSERT_EQ(is.status.mark_count, 2);
  EXPECT_EQ(is.status.marks_T[1], k.status.marks_T[1]);
  EXPECT_EQ(is.tissue.object_count, 2);
  EXPECT_LT((is.tissue.object[1].X_TO.R - k.instrument.R_TI).norm(), 1e-6);
  EXPECT_TRUE(is.tissue.object[1].crushed);
  EXPECT_EQ(is.tissue.object[1].colour, 3);
  EXPECT_EQ(is.tissue.grip, GripState::kSlipping);
  EXPECT_EQ(is.tissue.pair[0].a, std::int32_t{kPartyJaw});
  EXPECT_EQ(is.tissue.pair[0].force_n, 0.125);
  EXPECT_EQ(is.tissue.mark[0], k.tissue.mark[0]);
  EXPECT_EQ(is.tissue.smoke_per_m, 2);
  EXPECT_EQ(is.tissue.surgery, k.tissue.surgery);
  EXPECT_EQ(is.tissue.clip_count, 2);
  EXPECT_LT((is.tissue.clip[1].R - k.instrument.R_TI).norm(), 1e-6);
  EXPECT_LT((is.tissue.clip[1].p - k.tissue.clip[1].p).norm(), 1e-8);
  EXPECT_EQ(is.tissue.drop_count, kMaxDropsSeen);
  EXPECT_EQ(is.tissue.drop.back().place_T, k.tissue.drop.back().place_T);
  EXPECT_EQ(is.tissue.drop.back().radius_m, k.tissue.drop.back().radius_m);
  EXPECT_EQ(is.instrument.fault.tick, 123456789012345u);
  EXPECT_EQ(is.instrument.fault.value, 101.5);
  EXPECT_TRUE(is.instrument.port_held);
  EXPECT_EQ(is.instrument.contact_point_T, k.instrument.contact_point_T);
  EXPECT_EQ(TissueDecoder(file.track).at(2)->tissue.object_count, 0);
  EXPECT_EQ(TissueDecoder(file.track).at(2)->tissue.clip_count, 0);
  EXPECT_EQ(TissueDecoder(file.track).at(2)->status.shown_symbol, -1);
  EXPECT_EQ(TissueDecoder(file.track).at(2)->status.mark_count, 0);
}

TEST(TissueCodec, ASeekGivesWhatPlayingFromTheStartGives) {
  auto keyframes = waving(400, 60);
  for (std::size_t n = 3; n < keyframes.size(); n += 7) {
    keyframes[n] = plain(n);
    ++keyframes[n].period;
  }
  const Encoded file = encoded(keyframes);
  TissueDecoder straight(file.track);
  std::vector<std::shared_ptr<const TissueKeyframe>> all;
  for (std::size_t n = 0; n < keyframes.size(); ++n) all.push_back(straight.at(n));
  std::mt19937_64 random(1);
  TissueDecoder jumping(file.track);
  for (int i = 0; i < 300; ++i) {
    const std::size_t n = random() % keyframes.size();
    TissueDecoder fresh(file.track);
    for (TissueDecoder* decoder : {&jumping, &fresh}) {
      const auto is = decoder->at(n);
      ASSERT_EQ(is->nodes_T, all[n]->nodes_T) << n;
      ASSERT_EQ(is->status.run_time_s, all[n]->status.run_time_s);
    }
    const std::uint64_t period = random() % keyframes.back().period;
    const auto before = file.track.at_or_before(period, true), after = file.track.after(period, true);
    if (before) {
      EXPECT_LE(file.track.period(*before), period);
      EXPECT_TRUE(all[*before]->shaped);
    }
    if (after) {
      EXPECT_GT(file.track.period(*after), period);
    }
    if (before && after) {
      EXPECT_LE(*after - *before, 2u) << "of three neighbours two are shaped";
    }
  }
}

TEST(TissueCodec, ANewTopologyBeginsAnewInTheMiddleOfAChunk) {
  auto keyframes = waving(40, 200);
  const auto other = waving(80, 350);
  for (std::size_t n = 25; n < keyframes.size(); ++n) {
    keyframes[n].nodes_T = other[n].nodes_T;
    keyframes[n].topology = 4;
  }
  const Encoded file = encoded(keyframes);
  for (const std::size_t n : {39U, 26U, 25U, 24U, 0U}) expect_near(keyframes[n], *TissueDecoder(file.track).at(n));
}

TEST(TissueCodec, TissueAtRestCostsNextToNothing) {
  auto resting = waving(1, 1700);
  for (std::size_t n = 1; n < 1200; ++n) {
    resting.push_back(resting.front());
    resting.back().period += kEvery * n;
  }
  const std::vector<NodePlace> at = resting.front().nodes_T;
  const Encoded file = encoded(resting);
  EXPECT_LT(file.bytes, 40'000u) << "a minute, the shape itself included";
  EXPECT_EQ(TissueDecoder(file.track).at(1199)->nodes_T, at) << "and stands exactly where it stood";
}

TEST(TissueCodec, AMinuteOf1700MovingNodesIsWithinItsBudget) {
  constexpr double kMiB = 1 << 20;
  for (const double noise_m : {0.0, 1e-5}) {
    for (const std::size_t nodes : {1700U, 3500U}) {
      const auto keyframes = waving(1200, nodes, noise_m);
      const auto begin = std::chrono::steady_clock::now();
      const Encoded file = encoded(keyframes);
      const auto made = std::chrono::steady_clock::now();
      TissueDecoder decoder(file.track);
      for (std::size_t n = 0; n < keyframes.size(); ++n) decoder.at(n);
      const auto read = std::chrono::steady_clock::now();
      TissueDecoder(file.track).at(799);
      const auto sought = std::chrono::steady_clock::now();
      const auto ms = [](auto time) { return std::chrono::duration<double, std::milli>(time).count(); };
      std::printf(
          "%zu nodes, noise %g mm: %.2f MiB a minute, encoded in %.0f ms, decoded in %.0f ms, sought in %.1f ms\n",
          nodes, 1e3 * noise_m, static_cast<double>(file.bytes) / kMiB, ms(made - begin), ms(read - made),
          ms(sought - read));
      if (nodes == 1700) {
        EXPECT_LT(static_cast<double>(file.bytes), 3 * kMiB);
      }
    }
  }
}

TEST(TissueCodec, ChangesOfTopologyAreKeptToTheByte) {
  const std::vector<TopologyEvent> changes = {{5, std::string("\0cut\xff", 5)}, {5, ""}, {1u << 30, "clip"}};
  TissueTrack track;
  track.add_changes(encode_changes(std::span(changes).first(1)));
  track.add_changes(encode_changes(std::span(changes).subspan(1)));
  EXPECT_EQ(track.changes(), changes);
  EXPECT_THROW(decode_changes(encode_changes(changes) + "x"), InputError);
}

TEST(TissueCodec, WhatBuildsUponALostChunkIsRefusedUntilTheNextIndependentOne) {
  const auto keyframes = waving(100, 50);
  const Encoded file = encoded(keyframes);
  ASSERT_EQ(file.keyframes.size(), 10u);
  TissueEncoder encoder;
  const std::string shape = encoder.encode(std::span(keyframes).first(kPerChunk)).shapes.at(0);
  TissueTrack track;
  EXPECT_THROW(track.add_keyframes(file.keyframes[0]), InputError) << "its shape is lost";
  track.add_shape(shape);
  EXPECT_THROW(track.add_shape(shape), InputError);
  track.add_keyframes(file.keyframes[0]);
  EXPECT_THROW(track.add_keyframes(file.keyframes[0]), InputError) << "repeated";
  track.add_keyframes(file.keyframes[1]);
  EXPECT_THROW(track.add_keyframes(file.keyframes[3]), InputError);
  track.add_keyframes(file.keyframes[4]);
  ASSERT_EQ(track.size(), 30u);
  expect_near(keyframes[45], *TissueDecoder(track).at(25));
}

TEST(TissueCodec, DamageIsAnErrorAndNeverMore) {
  auto keyframes = waving(10, 40);
  for (auto& k : keyframes) k.fields = {{"char", FieldPlace::kVertices, std::vector<float>(30, 0.5f)}};
  TissueEncoder encoder;
  const auto chunks = encoder.encode(keyframes);
  std::mt19937_64 random(2);
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string shape = chunks.shapes.at(0), payload = chunks.keyframes;
    std::string& hit = i % 4 == 0 ? shape : payload;
    hit[random() % hit.size()] ^= static_cast<char>(1 << (random() % 8));
    if (i % 3 == 0) hit.resize(random() % hit.size());
    try {
      TissueTrack track;
      track.add_shape(shape);
      track.add_keyframes(payload);
      TissueDecoder decoder(track);
      for (std::size_t n = 0; n < track.size(); ++n) decoder.at(n);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 2000);
}

TEST(TissueRecording, IsReadableUpToItsLastWholeChunkAndOthersAreAsBefore) {
  MemorySink sink;
  std::vector<std::size_t> ends;
  {
    RecordingWriter writer(sink, "{}", 1000);
    const auto keyframes = waving(100, 80);
    const auto rows = realistic_ticks(5001, 3);
    std::size_t next = 0;
    for (const RecordedTick& row : rows) {
      for (; next < keyframes.size() && keyframes[next].period <= row.tick; ++next)
        writer.append_keyframe(keyframes[next]);
      if (row.tick == 2000) writer.append_change({2000, "cut"});
      writer.append(row);
      if (ends.empty() || ends.back() != sink.bytes().size()) ends.push_back(sink.bytes().size());
    }
    writer.close({});
  }
  const Recording whole = parse_recording(sink.bytes(), "whole");
  ASSERT_EQ(whole.tissue.size(), 100u);
  EXPECT_EQ(whole.tissue.changes(), (std::vector<TopologyEvent>{{2000, "cut"}}));
  EXPECT_EQ(whole.torn, "");
  TissueDecoder all(whole.tissue);
  for (std::size_t i = 2; i < ends.size(); ++i) {
    const Recording torn = parse_recording(sink.bytes().substr(0, ends[i] - 7), "torn");
    EXPECT_NE(torn.torn, "");
    ASSERT_FALSE(torn.ticks.empty());
    const auto last = torn.tissue.at_or_before(torn.ticks.back().tick, true);
    ASSERT_TRUE(last);
    EXPECT_LE(torn.ticks.back().tick - torn.tissue.period(*last), kEvery) << "keyframes come before their rows";
    EXPECT_EQ(TissueDecoder(torn.tissue).at(*last)->nodes_T, all.at(*last)->nodes_T);
  }
  std::string hit = sink.bytes();
  hit[ends[4] + 40] ^= 1;
  const Recording damaged = parse_recording(hit, "damaged", Reading::kTolerant);
  EXPECT_FALSE(damaged.damage.empty());
  EXPECT_EQ(TissueDecoder(damaged.tissue).at(damaged.tissue.size() - 1)->nodes_T, all.at(99)->nodes_T);
  EXPECT_THROW(parse_recording(hit, "damaged"), InputError);
  EXPECT_TRUE(parse_recording(small_recording(2, 100, 1), "plain").tissue.empty());
}

}  // namespace
}  // namespace trocar::tissue_codec_test
