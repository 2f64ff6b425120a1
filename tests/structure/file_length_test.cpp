// Files stop at 400 lines, and the tests keep pace with the source.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/structure/source_text.h"
#include "tests/structure/source_tree.h"

namespace trocar::file_length_test {
namespace {

constexpr std::size_t kLongestFile = 400;
constexpr double kTestLinesPerSourceLine = 0.80;  // the aim is 0.9; this is what has been reached

std::vector<std::string> too_long(const std::vector<SourceFile>& files) {
  std::vector<std::string> out;
  for (const SourceFile& file : files) {
    const std::size_t lines = count_lines(file.text);
    if (lines > kLongestFile) out.push_back(file.path + ": " + std::to_string(lines) + " lines");
  }
  return out;
}

double test_share(const std::vector<SourceFile>& files) {
  double tests = 0, sources = 0;
  for (const SourceFile& file : files) {
    if (file.cpp()) (file.test() ? tests : sources) += static_cast<double>(count_lines(file.text));
  }
  return tests / sources;
}

std::string lines(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += "x\n";
  return text;
}

TEST(SourceText, CountsLinesAsAnEditorDoes) {
  EXPECT_EQ(count_lines(""), 0u);
  EXPECT_EQ(count_lines("a"), 1u);
  EXPECT_EQ(count_lines("a\n"), 1u);
  EXPECT_EQ(count_lines("a\n\nb"), 3u);
}

TEST(FileLength, AMadeUpFileOfOneLineTooManyIsNamed) {
  EXPECT_TRUE(too_long({{"app/fits.cpp", lines(kLongestFile)}}).empty());
  const auto found = too_long({{"app/fits.cpp", lines(kLongestFile)}, {"app/sprawls.cpp", lines(kLongestFile + 1)}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], "app/sprawls.cpp: 401 lines");
}

TEST(FileLength, TheTreeThatIsReadIsTheWholeTree) {
  std::size_t sources = 0, tests = 0;
  bool loop = false, shader = false, itself = false;
  for (const SourceFile& file : source_tree()) {
    ASSERT_FALSE(file.text.empty()) << file.path;
    if (file.cpp()) ++(file.test() ? tests : sources);
    loop |= file.path == "haptics/haptic_loop.cpp";
    shader |= file.path == "assets/shaders/tissue.frag";
    itself |= file.path == "tests/structure/file_length_test.cpp";
  }
  EXPECT_TRUE(loop && shader && itself);
  EXPECT_GT(sources, 200u);
  EXPECT_GT(tests, 80u);
}

TEST(FileLength, NoFileIsLongerThan400Lines) {
  for (const std::string& offender : too_long(source_tree())) ADD_FAILURE() << offender;
}

TEST(TestShare, CountsTestsAgainstSources) {
  EXPECT_DOUBLE_EQ(
      test_share({{"app/a.cpp", lines(40)}, {"tests/app/a_test.cpp", lines(30)}, {"tests/a.cmake", lines(9)}}), 0.75);
}

TEST(TestShare, TestsKeepPaceWithTheSource) {
  const double share = test_share(source_tree());
  std::cout << "test lines per source line: " << share << '\n';
  EXPECT_GE(share, kTestLinesPerSourceLine);
}

}  // namespace
}  // namespace trocar::file_length_test
