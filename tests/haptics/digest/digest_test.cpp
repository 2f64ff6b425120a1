// SHA-256 against the published examples.
#include "haptics/digest/digest.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::digest_test {
namespace {

TEST(Digest, MatchesThePublishedExamples) {  // FIPS 180-2, appendix B; the empty message from NIST's example values
  EXPECT_EQ(digest::of_bytes("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest::of_bytes(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest::of_bytes("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(Digest, AStreamMayBeAskedOnTheWay) {
  digest::Stream stream;
  stream.update("a");
  EXPECT_EQ(stream.hex(), digest::of_bytes("a"));
  stream.update("bc");
  EXPECT_EQ(stream.hex(), digest::of_bytes("abc"));
}

TEST(Digest, OfAFileEqualsThatOfItsBytesAcrossBlocks) {
  const test::TemporaryFolder folder;
  const std::string bytes(200001, 'x');
  folder.write("a", bytes);
  EXPECT_EQ(digest::of_file(folder / "a"), digest::of_bytes(bytes));
  EXPECT_CONTAINS(test::message_of<InputError>([&] { digest::of_file(folder / "missing"); }), "missing");
  EXPECT_EQ(digest::of_readable_file(folder / "a"), digest::of_bytes(bytes));
  EXPECT_EQ(digest::of_readable_file(folder / "missing"), "");
}

}  // namespace
}  // namespace trocar::digest_test
