// A recording says whose it is and holds together: what is exchanged, left out, added or moved shows.
#include <gtest/gtest.h>

#include "app/session/recording/chunk.h"
#include "app/session/recording/recording_reader.h"
#include "haptics/input_error.h"

namespace trocar::recording_seal_test {
namespace {

class RecordingSealed : public ::testing::Test {
 protected:
  std::string attempt(const std::string& uuid = "a-1") const {
    return R"({"attempt":")" + uuid + R"(","key":")" + key_.public_key() + R"("})";
  }
  /// Three pieces of a second, and the END.
  static std::string recorded(const RecordingSeal& seal, std::uint32_t flags = 0) {
    MemorySink memory;
    RecordingWriter writer(memory, "session", 20, seal);
    RecordedTick row;
    for (int i = 0; i < 30; ++i) {
      row.tick = static_cast<std::uint64_t>(i);
      row.flags = static_cast<decltype(row.flags)>(flags);
      writer.append(row);
    }
    writer.close({7, AttemptStatus::kCompleted, 0, 0, ""});
    return memory.bytes();
  }
  static std::vector<Chunk> chunks(const std::string& file) {
    std::vector<Chunk> out;
    for (std::size_t at = kRecordingPrefixSize; at < file.size(); at = out.back().end())
      out.push_back(chunk_at(file, at).value());
    return out;
  }
  static std::string refusal(const std::string& file) {
    try {
      parse_recording(file, "x.trec");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  const SigningKey key_ = SigningKey::make();
};

TEST_F(RecordingSealed, SaysWhoseItIsAndBySignatureWhoMadeIt) {
  const Recording read = parse_recording(recorded({attempt(), key_}), "x.trec");
  EXPECT_EQ(read.attempt, attempt());
  EXPECT_EQ(read.signed_by, key_.public_key());
  ASSERT_TRUE(read.end);
  EXPECT_EQ(read.ticks.size(), 30u);
}

TEST_F(RecordingSealed, OfNoAttemptItHasLinksAndNoSignatureAndEqualRunsGiveEqualFiles) {
  EXPECT_EQ(recorded({}), recorded({}));
  const Recording read = parse_recording(recorded({}), "x.trec");
  EXPECT_EQ(read.attempt + read.signed_by, "");
}

TEST_F(RecordingSealed, WithAnotherAttemptInItsHeaderItDoesNotHold) {
  std::string file = recorded({attempt("a-1"), key_});
  const std::string other = recorded({attempt("b-2"), key_});
  const std::size_t header_end = chunks(file).front().end();
  file.replace(0, header_end, other.substr(0, chunks(other).front().end()));
  EXPECT_NE(refusal(file).find("does not hold together"), std::string::npos) << refusal(file);
}

TEST_F(RecordingSealed, APieceLeftOutDoublesOrOfAnotherRecordingShows) {
  const std::string file = recorded({attempt(), key_}), other = recorded({attempt(), key_}, 1);
  const std::vector<Chunk> parts = chunks(file);
  ASSERT_EQ(parts[2].type, ChunkType::kTicks);
  ASSERT_EQ(parts[3].type, ChunkType::kLink);
  std::string less = file;
  less.erase(parts[2].offset, parts[3].end() - parts[2].offset);
  EXPECT_NE(refusal(less), "");
  std::string exchanged = file;
  const std::vector<Chunk> from = chunks(other);
  exchanged.replace(parts[2].offset, parts[3].end() - parts[2].offset,
                    other.substr(from[2].offset, from[3].end() - from[2].offset));
  EXPECT_NE(refusal(exchanged).find("does not hold together"), std::string::npos);
  EXPECT_NE(refusal(file + file.substr(parts.back().offset)), "") << "nothing follows the last link";
}

/// Somebody who knows the format makes every link again, but has no key.
TEST_F(RecordingSealed, MadeAgainWithoutTheKeyItIsSignedByNobody) {
  EXPECT_EQ(parse_recording(recorded({attempt(), SigningKey::make()}), "x.trec").signed_by, "");
  EXPECT_EQ(parse_recording(recorded({attempt(), std::nullopt}), "x.trec").signed_by, "");
}

TEST_F(RecordingSealed, CutBehindItsEndItHasNone) {
  const std::string file = recorded({attempt(), key_});
  const std::vector<Chunk> parts = chunks(file);
  ASSERT_EQ(parts[parts.size() - 2].type, ChunkType::kEnd);
  for (std::size_t size = parts.back().offset; size < file.size(); ++size) {
    const Recording read = parse_recording(file.substr(0, size), "x.trec");
    EXPECT_FALSE(read.end) << size;
    EXPECT_FALSE(read.torn.empty()) << size;
    EXPECT_EQ(read.ticks.size(), 30u) << size;
    EXPECT_EQ(read.signed_by, key_.public_key()) << "up to the link before";
  }
}

}  // namespace
}  // namespace trocar::recording_seal_test
