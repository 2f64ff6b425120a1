// Writes an attempt's recording: two chunks of ticks a second, events with them, an END chunk when it is closed.
//
// What has been flushed survives kill -9; what a chunk holds is lost at most: half a second, and what waits for the
// recorder task (0.1 s). A writer that is destroyed without close() flushes what it holds and leaves a readable
// recording without END. Thread: recorder task (never the haptic task).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/session/recording/recorded_tick.h"
#include "app/session/recording/recording_sink.h"
#include "app/session/recording/schedule.h"
#include "app/session/recording/seal.h"
#include "app/session/recording/tick_codec.h"
#include "app/session/recording/tissue_codec.h"
#include "haptics/digest/digest.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

/// What the END chunk says.
struct RecordingEnd {
  std::uint64_t state_hash = 0;
  AttemptStatus status = AttemptStatus::kAborted;
  std::uint64_t tick_count = 0;   ///< rows in the recording; filled in by the writer
  std::uint64_t event_count = 0;  ///< filled in by the writer
  std::string summary_json;       ///< opaque here
};

std::string encode_end(const RecordingEnd& end);
/// @throws InputError saying what is wrong with the payload.
RecordingEnd decode_end(std::string_view payload);

class RecordingWriter {
 public:
  static constexpr double kChunk_s = 0.5;  ///< kill -9 may cost a second; a machine that is busy needs the other half

  /// Records to a file. @param session opaque text for the header (recording_header.h).
  /// @throws EnvironmentError naming the file, InputError for a bad rate or text.
  RecordingWriter(const std::filesystem::path& file, std::string_view session, double rate_hz, RecordingSeal seal = {});
  /// Records to a sink that outlives the writer.
  RecordingWriter(RecordingSink& sink, std::string_view session, double rate_hz, RecordingSeal seal = {});
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Takes one row; writes a chunk when half a second is full. @throws EnvironmentError as above (the readable part
  /// stays), std::invalid_argument when row.tick does not increase.
  void append(const RecordedTick& row);
  /// Takes what is new of the schedule; it goes to disk before the rows of the next chunk.
  void append_patch(const PatchSeen& patch) { schedule_.patches.push_back(patch); }
  void append_step(std::uint64_t seen_period) { schedule_.steps.push_back(seen_period); }
  /// Take what playback shows; it goes to disk before the rows of the next chunk. Periods do not decrease.
  void append_keyframe(TissueKeyframe keyframe) { keyframes_.push_back(std::move(keyframe)); }
  void append_change(TopologyEvent change) { changes_.push_back(std::move(change)); }
  /// Takes events; they go to disk with the next chunk.
  void append_events(std::span<const Event> events);
  /// Writes what is held now as chunks and synchronises.
  void flush();
  /// Flushes, writes the run report (opaque here, none when empty) and END. Nothing can be appended afterwards.
  void close(RecordingEnd end, std::string_view run_report_json = {});

  std::uint64_t tick_count() const { return tick_count_; }
  /// SHA-256 of the bytes written so far: of the whole file once closed.
  std::string sha256() const { return digest_.hex(); }

 private:
  void begin(std::string_view session, double rate_hz);
  std::string tissue_chunks();
  void write(std::string bytes);
  void require_open() const;

  std::unique_ptr<FileSink> owned_;
  RecordingSink& sink_;
  RecordingSeal seal_;
  std::string link_;  ///< hash of the last link
  TickEncoder encoder_;
  digest::Stream digest_;
  std::vector<RecordedTick> rows_;
  std::vector<Event> events_;
  Schedule schedule_;
  TissueEncoder tissue_encoder_;
  std::vector<TissueKeyframe> keyframes_;
  std::vector<TopologyEvent> changes_;
  std::size_t rows_per_chunk_ = 500;
  std::uint64_t tick_count_ = 0, event_count_ = 0, last_tick_ = 0;
  enum class State : std::uint8_t { kOpen, kClosed, kFailed } state_ = State::kOpen;
};

}  // namespace trocar
