#include "tissue/imaging/sha256.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar {
namespace {

// The published examples of FIPS 180-4.
TEST(Sha256, MatchesThePublishedExamples) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(Sha256, OfAFileIsThatOfItsBytesAcrossBlocks) {
  test::TemporaryFolder folder;
  const std::string bytes(200'001, 'x');
  EXPECT_EQ(sha256_file(folder.write("large", bytes)), sha256_hex(bytes));
}

TEST(Sha256, NamesTheFileThatIsMissing) {
  EXPECT_CONTAINS(test::message_of<InputError>([] { sha256_file("no/such/file"); }), "no/such/file");
}

}  // namespace
}  // namespace trocar
