// Functions stop at 50 lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "tests/structure/function_lengths.h"
#include "tests/structure/source_text.h"
#include "tests/structure/source_tree.h"

namespace trocar::function_length_test {
namespace {

constexpr std::size_t kLongestFunction = 50;

struct Found {
  FunctionLength function;
  std::string path;
};

/// Longest first.
std::vector<Found> all_functions(const std::vector<SourceFile>& files) {
  std::vector<Found> out;
  for (const SourceFile& file : files) {
    if (!file.cpp()) continue;
    for (FunctionLength& function : function_lengths(file.text)) out.push_back({std::move(function), file.path});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Found& a, const Found& b) { return a.function.lines > b.function.lines; });
  return out;
}

std::string described(const Found& found) {
  return found.path + ":" + std::to_string(found.function.line) + ": " + std::to_string(found.function.lines) +
         " lines: " + found.function.head.substr(0, 80);
}

std::string body(std::size_t lines) {
  std::string text;
  for (std::size_t i = 0; i < lines; ++i) text += "  step();\n";
  return text;
}

std::vector<std::string> heads(const std::string& text) {
  std::vector<std::string> out;
  for (const FunctionLength& function : function_lengths(text)) out.push_back(function.head);
  return out;
}

using Heads = std::vector<std::string>;

TEST(BlankLiterals, LeavesStructureOnly) {
  EXPECT_EQ(blank_literals("a(\"}\"); // }\nb", true), "a(\" \");     \nb");
  EXPECT_EQ(blank_literals("x = '{'; y = 1'000;", true), "x = ' '; y = 1'000;");
  EXPECT_EQ(blank_literals("/* {\n */ c", true), "    \n    c");
  EXPECT_EQ(blank_literals("\"\\\"{\" d", true), "\"   \" d");
  EXPECT_EQ(blank_literals("R\"x(\" { )\" )x\" e", true).find('{'), std::string::npos);
  EXPECT_EQ(blank_literals("#define OPEN {\\\n  {\nf", true), "               \n   \nf");
  EXPECT_EQ(blank_literals("#if 1\n", false), "#if 1\n");
}

TEST(FunctionLengths, CountsHeadAndBody) {
  const auto found = function_lengths("// comment {\nint f(int a,\n      int b) {\n  return a + b;\n}\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].line, 2u);
  EXPECT_EQ(found[0].lines, 4u);
  EXPECT_EQ(found[0].head, "int f(int a, int b)");
}

TEST(FunctionLengths, WalksIntoNamespacesAndClasses) {
  EXPECT_EQ(heads("namespace a {\nnamespace {\nclass C final : public B {\n public:\n  int f() const { return 1; }\n"
                  "  C& operator==(int) & noexcept override { return *this; }\n};\nstruct D { void g() {} "
                  "};\n}\n}\nvoid h() {}\n"),
            (Heads{"public: int f() const", "C& operator==(int) & noexcept override", "void g()", "void h()"}));
}

TEST(FunctionLengths, TellsConstructorsFromTheirInitialisers) {
  EXPECT_EQ(
      heads("A::A(int x) : a_{x}, b_(x), c_{{1, 2}} {\n  f();\n}\nA::~A() = default;\nint z{3};\nint t[] = {1, 2};\n"
            "enum class E : int { kA, kB };\nvoid g(P p = {}) {}\n"),
      (Heads{"A::A(int x) : a_{x}, b_(x), c_{{1, 2}}", "void g(P p = {})"}));
}

TEST(FunctionLengths, SeesTemplatesTrailingTypesTestsAndLambdas) {
  EXPECT_EQ(heads("template <typename T, int N = 3>\nauto f(T t) -> std::vector<T> {\n}\nTEST(Suite, Name) {\n}\n"
                  "const auto g = [](int i) { return i; };\nconst int k = call([&] {\n  return 1;\n});\nvoid h() try "
                  "{\n} catch (...) {\n}\n"),
            (Heads{"template <typename T, int N = 3> auto f(T t) -> std::vector<T>", "TEST(Suite, Name)",
                   "const auto g = [](int i)", "const int k = call([&]", "void h() try", "catch (...)"}));
}

TEST(FunctionLengths, LambdasInsideCountAsPartOfTheirFunction) {
  const auto found = function_lengths("void f() {\n  auto g = [] {\n    h();\n  };\n}\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].lines, 5u);
}

TEST(FunctionLengths, AMadeUpFunctionOfOneLineTooManyIsTheWorst) {
  const std::string text = "namespace n {\nvoid fits() {\n" + body(kLongestFunction - 2) +
                           "}\nclass C {\n  void sprawls() {\n" + body(kLongestFunction - 1) + "  }\n};\n}\n";
  const auto found = all_functions({{"app/made_up.cpp", text}, {"app/notes.cmake", "f() {" + body(99) + "}"}});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].function.head, "void sprawls()");
  EXPECT_EQ(found[0].function.lines, kLongestFunction + 1);
  EXPECT_EQ(found[1].function.lines, kLongestFunction);
}

TEST(FunctionLengths, TheLoopsTickIsSeen) {
  for (const Found& found : all_functions(source_tree())) {
    if (found.function.head.find("HapticLoop::tick(") != std::string::npos) return;
  }
  FAIL() << "the scanner has lost HapticLoop::tick, so it proves nothing";
}

TEST(FunctionLengths, NoFunctionIsLongerThan50Lines) {
  const auto found = all_functions(source_tree());
  ASSERT_GT(found.size(), 1500u) << "the scanner no longer sees most of the functions";
  std::cout << found.size() << " functions; the longest:\n";
  for (std::size_t i = 0; i < 5; ++i) std::cout << "  " << described(found[i]) << '\n';
  for (const Found& one : found) {
    if (one.function.lines > kLongestFunction) ADD_FAILURE() << described(one);
  }
}

}  // namespace
}  // namespace trocar::function_length_test
