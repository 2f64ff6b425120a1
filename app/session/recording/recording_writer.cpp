#include "app/session/recording/recording_writer.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "app/session/recording/byte_order.h"
#include "app/session/recording/chunk.h"
#include "app/session/recording/event_codec.h"
#include "app/session/recording/recording_header.h"

namespace trocar {

std::string encode_end(const RecordingEnd& end) {
  std::string payload;
  bytes::put(payload, end.state_hash);
  bytes::put(payload, static_cast<std::uint8_t>(end.status));
  bytes::put(payload, end.tick_count);
  bytes::put(payload, end.event_count);
  return payload + end.summary_json;
}

RecordingEnd decode_end(std::string_view payload) {
  bytes::Reader reader(payload);
  RecordingEnd end;
  end.state_hash = reader.take<std::uint64_t>();
  const auto status = reader.take<std::uint8_t>();
  if (status > static_cast<std::uint8_t>(AttemptStatus::kVoid)) throw InputError("the status is unknown");
  end.status = static_cast<AttemptStatus>(status);
  end.tick_count = reader.take<std::uint64_t>();
  end.event_count = reader.take<std::uint64_t>();
  end.summary_json = std::string(reader.rest());
  return end;
}

RecordingWriter::RecordingWriter(const std::filesystem::path& file, std::string_view session, double rate_hz,
                                 RecordingSeal seal)
    : owned_(std::make_unique<FileSink>(file)), sink_(*owned_), seal_(std::move(seal)) {
  begin(session, rate_hz);
}

RecordingWriter::RecordingWriter(RecordingSink& sink, std::string_view session, double rate_hz, RecordingSeal seal)
    : sink_(sink), seal_(std::move(seal)) {
  begin(session, rate_hz);
}

void RecordingWriter::begin(std::string_view session, double rate_hz) {
  const std::string header = encode_header({std::string(session), rate_hz, seal_.attempt});
  rows_per_chunk_ = static_cast<std::size_t>(std::clamp(std::round(kChunk_s * rate_hz), 1.0, double{kMostChunkRows}));
  rows_.reserve(rows_per_chunk_);
  write(recording_prefix() + make_chunk(ChunkType::kHeader, header));
}

RecordingWriter::~RecordingWriter() {
  if (state_ != State::kOpen) return;
  try {
    flush();
  } catch (const std::exception&) {
    // The recording ends at its last whole chunk; the reader reports that END is missing.
    state_ = State::kFailed;
  }
}

void RecordingWriter::append(const RecordedTick& row) {
  require_open();
  if (tick_count_ > 0 && row.tick <= last_tick_) throw std::invalid_argument("recorded ticks must increase");
  last_tick_ = row.tick;
  ++tick_count_;
  rows_.push_back(row);
  if (rows_.size() >= rows_per_chunk_) flush();
}

void RecordingWriter::append_events(std::span<const Event> events) {
  require_open();
  events_.insert(events_.end(), events.begin(), events.end());
  event_count_ += events.size();
}

void RecordingWriter::flush() {
  require_open();
  std::string chunks;
  if (!schedule_.patches.empty() || !schedule_.steps.empty()) {
    chunks += make_chunk(ChunkType::kSchedule, encode_schedule(schedule_));
  }
  chunks += tissue_chunks();
  if (!rows_.empty()) chunks += make_chunk(ChunkType::kTicks, encoder_.encode(rows_));
  if (!events_.empty()) chunks += make_chunk(ChunkType::kEvents, encode_events(events_));
  rows_.clear();
  events_.clear();
  schedule_ = {};
  if (!chunks.empty()) write(std::move(chunks));
}

std::string RecordingWriter::tissue_chunks() {
  std::string chunks;
  if (!changes_.empty()) chunks += make_chunk(ChunkType::kTopology, encode_changes(changes_));
  if (!keyframes_.empty()) {
    const TissueEncoder::Chunks encoded = tissue_encoder_.encode(keyframes_);
    for (const std::string& shape : encoded.shapes) chunks += make_chunk(ChunkType::kShape, shape);
    chunks += make_chunk(ChunkType::kKeyframes, encoded.keyframes);
  }
  changes_.clear();
  keyframes_.clear();
  return chunks;
}

void RecordingWriter::close(RecordingEnd end, std::string_view run_report_json) {
  flush();
  end.tick_count = tick_count_;
  end.event_count = event_count_;
  const std::string run_report = run_report_json.empty() ? "" : make_chunk(ChunkType::kRunReport, run_report_json);
  write(run_report + make_chunk(ChunkType::kEnd, encode_end(end)));
  state_ = State::kClosed;
}

void RecordingWriter::write(std::string chunks) {
  const std::string link = make_link(link_, chunks, seal_.key);
  link_ = link.substr(0, kLinkHashSize);
  chunks += make_chunk(ChunkType::kLink, link);
  try {
    sink_.append(chunks);
    sink_.sync();
  } catch (const EnvironmentError&) {
    state_ = State::kFailed;
    throw;
  }
  digest_.update(chunks);
}

void RecordingWriter::require_open() const {
  if (state_ == State::kClosed) throw std::logic_error("the recording is closed");
  if (state_ == State::kFailed) throw EnvironmentError("the recording has failed before; nothing can be added to it");
}

}  // namespace trocar
