#include "app/session/recording/recording_reader.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "app/session/recording/byte_order.h"
#include "app/session/recording/chunk.h"
#include "app/session/recording/event_codec.h"
#include "app/session/recording/recording_header.h"
#include "app/session/recording/seal.h"
#include "trainees/files/owner_file.h"

namespace trocar {
namespace {

constexpr std::size_t kDamage = 160;  // bytes that a message of damage takes, nearly

class Parser {
 public:
  Parser(std::string_view file, const std::string& name, Reading reading, std::uint64_t most)
      : file_(file), name_(name), strict_(reading == Reading::kStrict), most_(most), search_(file) {}

  Recording parse() {
    check_prefix();
    std::size_t offset = read_header();
    while (offset < file_.size()) {
      if (const auto chunk = chunk_at(file_, offset)) {
        accept(*chunk);
        if (held() > most_) refuse_more(offset);
        offset = chunk->end();
      } else if (const auto next = next_chunk(offset)) {
        report(offset, "does not agree with its CRC; " + std::to_string(*next - offset) + " bytes are lost");
        offset = *next;
      } else {
        reject_tail(offset);
        break;
      }
    }
    check_links();
    check_end();
    recording_.sha256 = digest::of_bytes(file_);
    return std::move(recording_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

  void note(const std::string& damage) {
    if (strict_) fail(damage);
    recording_.damage.push_back(damage);
  }

  void report(std::size_t offset, const std::string& what) {
    note("the chunk at byte " + std::to_string(offset) + " " + what);
  }

  /// Bytes that what was read takes in memory, nearly.
  std::uint64_t held() const {
    const Recording& r = recording_;
    return r.ticks.size() * sizeof(RecordedTick) + r.events.size() * sizeof(Event) +
           r.schedule.patches.size() * sizeof(PatchSeen) + r.schedule.steps.size() * sizeof(std::uint64_t) +
           r.tissue.bytes() + r.damage.size() * kDamage;
  }

  [[noreturn]] void refuse_more(std::size_t offset) const {
    fail("holds more than a recording of its size can: from the chunk at byte " + std::to_string(offset) +
         " on more than " + std::to_string(most_ >> 20) + " MiB");
  }

  /// Where reading goes on after a chunk that cannot be read. Strictly nowhere once it is certain that there is damage;
  /// a chunk that the file is too short for may be where it was cut off.
  std::optional<std::size_t> next_chunk(std::size_t damaged) {
    if (strict_ && chunk_fits(file_, damaged)) return std::nullopt;
    return search_.next(damaged + 1);
  }

  void check_prefix() {
    if (file_.substr(0, kRecordingMagic.size()) != kRecordingMagic || file_.size() < kRecordingPrefixSize) {
      fail("is not a recording of trocar");
    }
    bytes::Reader reader(file_.substr(kRecordingMagic.size()));
    recording_.version = reader.take<std::uint32_t>();
    if (recording_.version < kOldestReadable || recording_.version > kRecordingVersion) {
      fail("has recording format " + std::to_string(recording_.version) + ", this program reads formats " +
           std::to_string(kOldestReadable) + " to " + std::to_string(kRecordingVersion));
    }
  }

  std::size_t read_header() {
    const auto chunk = chunk_at(file_, kRecordingPrefixSize);
    if (!chunk || chunk->type != ChunkType::kHeader) fail("its header (byte 12) is damaged or cut off");
    try {
      RecordingHeader header = decode_header(chunk->payload);
      recording_.session = std::move(header.session);
      recording_.attempt = std::move(header.attempt);
      recording_.rate_hz = header.rate_hz;
      channels_ = std::move(header.channels);
      check_channels();
    } catch (const InputError& error) {
      fail(error.what());
    }
    return chunk->end();
  }

  /// The version stands outside every CRC; the channels are inside one.
  void check_channels() const {
    const bool stiffness = std::ranges::find(channels_, "k_max", &RecordedChannel::name) != channels_.end();
    if (stiffness == (recording_.version >= kFirstWithStiffness)) return;
    throw InputError("says recording format " + std::to_string(recording_.version) +
                     ", but its channels are not of that format");
  }

  /// Takes over one whole chunk.
  void accept(const Chunk& chunk) {
    if (chunk.type == ChunkType::kLink && recording_.version < kFirstWithLinks)
      return report(chunk.offset, "is of a newer format than the file says");
    if (recording_.end && (chunk.type != ChunkType::kLink || sealed()))
      return report(chunk.offset, "stands after the END");
    if (chunk.type == ChunkType::kLink) return accept_link(chunk);
    try {
      switch (chunk.type) {
        case ChunkType::kHeader:
          return report(chunk.offset, "is a second header");
        case ChunkType::kTicks:
          return accept_ticks(chunk);
        case ChunkType::kEvents:
          return accept_events(chunk);
        case ChunkType::kRunReport:
          recording_.run_report_json = std::string(chunk.payload);
          return;
        case ChunkType::kSchedule:
          return accept_schedule(chunk);
        case ChunkType::kShape:
          return recording_.tissue.add_shape(chunk.payload);
        case ChunkType::kKeyframes:
          return recording_.tissue.add_keyframes(chunk.payload);
        case ChunkType::kTopology:
          return recording_.tissue.add_changes(chunk.payload);
        case ChunkType::kLink:  // above
          return;
        case ChunkType::kEnd:
          recording_.end = decode_end(chunk.payload);
          ended_at_ = chunk.end();
          return;
      }
    } catch (const InputError& error) {
      report(chunk.offset, std::string("cannot be decoded: ") + error.what());
    }
  }

  void accept_ticks(const Chunk& chunk) {
    const std::vector<RecordedTick> rows = decode_ticks(chunk.payload, channels_);
    if (!recording_.ticks.empty() && rows.front().tick <= recording_.ticks.back().tick) {
      return report(chunk.offset, "repeats ticks that came before");
    }
    recording_.ticks.insert(recording_.ticks.end(), rows.begin(), rows.end());
  }

  void accept_events(const Chunk& chunk) {
    std::vector<Event> events = decode_events(chunk.payload);
    recording_.events.insert(recording_.events.end(), std::make_move_iterator(events.begin()),
                             std::make_move_iterator(events.end()));
  }

  void accept_schedule(const Chunk& chunk) {
    const Schedule part = decode_schedule(chunk.payload);
    Schedule& whole = recording_.schedule;
    const bool follows = whole.patches.empty() || part.patches.empty() ||
                         (part.patches.front().period > whole.patches.back().period &&
                          part.patches.front().stamp > whole.patches.back().stamp);
    if (!follows) return report(chunk.offset, "repeats a schedule that came before");
    whole.patches.insert(whole.patches.end(), part.patches.begin(), part.patches.end());
    whole.steps.insert(whole.steps.end(), part.steps.begin(), part.steps.end());
  }

  void accept_link(const Chunk& chunk) {
    const std::string_view said = chunk.payload.substr(0, kLinkHashSize), signature = chunk.payload.substr(said.size());
    if (make_link(link_, file_.substr(linked_to_, chunk.offset - linked_to_), std::nullopt) != said)
      report(chunk.offset, "does not hold together with what is before it: something was changed, added or left out");
    link_ = said;
    linked_to_ = chunk.end();
    signature_ = signature;
  }

  /// Whether nothing may follow the END.
  bool sealed() const { return recording_.version < kFirstWithLinks || linked_to_ >= ended_at_; }

  /// The last link holds all before it.
  void check_links() {
    if (recording_.end && !sealed()) {
      recording_.end.reset();
      if (recording_.torn.empty()) recording_.torn = "its END is in no link: the attempt was cut off";
    }
    const std::string key = attempt_field(recording_.attempt, "key");
    if (!key.empty() && signature_holds(key, link_text(link_), signature_)) recording_.signed_by = key;
  }

  /// Nothing whole follows, or nobody looked: either the file was cut off, or this chunk is damaged.
  void reject_tail(std::size_t offset) {
    const std::string bytes = std::to_string(file_.size() - offset) + " bytes";
    if (recording_.end && sealed()) return report(offset, "stands after the END (" + bytes + ")");
    if (search_.gave_up())
      return note("damaged from byte " + std::to_string(offset) + ": too much of the last " + bytes +
                  " looks like chunks and is none");
    if (strict_ && chunk_fits(file_, offset)) return report(offset, "does not agree with its CRC");
    if (chunk_fits(file_, offset)) return report(offset, "does not agree with its CRC; " + bytes + " are lost");
    recording_.torn = "cut off at byte " + std::to_string(offset) + ": the last " + bytes + " are not a whole chunk";
  }

  void check_end() {
    if (!recording_.end) {
      if (recording_.torn.empty()) recording_.torn = "ends without an END chunk: the attempt was cut off";
      return;
    }
    const RecordingEnd& end = *recording_.end;
    const auto compare = [&](const char* what, std::uint64_t said, std::size_t read) {
      if (said == read) return;
      note(std::string("END speaks of ") + std::to_string(said) + " " + what + ", " + std::to_string(read) +
           " were read");
    };
    compare("ticks", end.tick_count, recording_.ticks.size());
    compare("events", end.event_count, recording_.events.size());
  }

  std::string_view file_;
  const std::string& name_;
  bool strict_;
  std::uint64_t most_;  ///< bytes in memory
  ChunkSearch search_;
  std::vector<RecordedChannel> channels_;
  std::string link_;                          ///< hash of the last link
  std::string_view signature_;                ///< of the last link
  std::size_t linked_to_ = 0, ended_at_ = 0;  ///< ends of the last link and of the END
  Recording recording_;
};

std::string bytes_of(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw InputError(file.string() + ": no such recording");
  if (std::filesystem::file_size(file, error) > kLargestRecording)
    throw InputError(file.string() + ": is larger than any recording");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file.string() + ": no such recording");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

std::uint64_t most_decoded(std::uint64_t file_bytes) {
  // Rows of a hand that moves take 20 to 60 times what they take in the file; where nothing moves, half a second at
  // 4 kHz (0.2 MB) costs 250 bytes or more.
  constexpr std::uint64_t kTimesMoving = 64, kTimesResting = 2048, kAnyway = std::uint64_t{1} << 26;
  // Rest: half an hour at 4 kHz, or two hours at 1 kHz (an exercise ends after 2 x 3600 s and a minute), have 0.8 GB.
  constexpr std::uint64_t kMostResting = std::uint64_t{1} << 30;
  // The longest attempt at 4 kHz has 3.3 GB of rows.
  constexpr std::uint64_t kEver = std::uint64_t{1} << 32;
  const std::uint64_t file = std::min(file_bytes, kEver / kTimesMoving);
  return std::min({kEver, kAnyway + kTimesResting * file, kMostResting + kTimesMoving * file});
}

Recording read_recording(const std::filesystem::path& file, Reading reading) {
  return parse_recording(bytes_of(file), file.string(), reading);
}

bool recording_begins(const std::filesystem::path& file) { return chunk_fits(bytes_of(file), kRecordingPrefixSize); }

Recording parse_recording(std::string_view bytes, const std::string& name, Reading reading,
                          std::optional<std::uint64_t> most) {
  return Parser(bytes, name, reading, most.value_or(most_decoded(bytes.size()))).parse();
}

}  // namespace trocar
