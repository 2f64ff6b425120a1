#include "tests/structure/function_lengths.h"

#include <regex>
#include <sstream>

#include "tests/structure/source_text.h"

namespace trocar {
namespace {

enum class Block { kScope, kFunction, kOther };

std::string squeezed(const std::string& text) {
  std::istringstream words(text);
  std::string out;
  for (std::string word; words >> word;) out += (out.empty() ? "" : " ") + word;
  return out;
}

/// Without "template <...>", attributes, alignas and access labels in front: what says which kind of head it is.
std::string bare_head(std::string head) {
  static const std::regex kAccess(R"(^(public|private|protected)\s*:(?!:)\s*)");
  static const std::regex kPrefix(R"(^(\[\[[^\]]*\]\]|inline|static|constexpr|typedef|export|friend)\s*)");
  for (std::string before; before != head;) {
    before = head;
    head = std::regex_replace(head, kAccess, "");
    head = std::regex_replace(head, kPrefix, "");
    if (!head.starts_with("template")) continue;
    int depth = 0;
    for (std::size_t i = head.find('<'); i < head.size(); ++i) {
      depth += head[i] == '<' ? 1 : head[i] == '>' ? -1 : 0;
      if (depth == 0) {
        head = squeezed(head.substr(i + 1));
        break;
      }
    }
  }
  return head;
}

/// What the brace after `head` opens. @param in_parentheses the brace stands inside an argument list.
Block kind_of(const std::string& written, bool in_parentheses) {
  static const std::regex kScope(
      R"(^(namespace\b|extern " *"\s*$|(class|struct|union)\b(\s*alignas\([^)]*\))?[^()=]*$))");
  static const std::regex kAfterParameters(
      R"((const|noexcept(\([^()]*\))?|override|final|mutable|try|&&?|->[\w\s:<>,*&]+|\s)*$)");
  static const std::regex kInitialiserList(R"(\)\s*(noexcept\s*)?:(?!:))");
  static const std::regex kLambdaWithoutParameters(R"([=(,]\s*\[[^\]]*\]$)");
  const std::string head = bare_head(written);
  if (head.empty() || std::regex_search(head, std::regex(R"(^enum\b)"))) return Block::kOther;
  if (!in_parentheses && std::regex_search(head, kScope)) return Block::kScope;
  if (std::regex_search(head, kLambdaWithoutParameters)) return Block::kFunction;
  if (std::regex_search(head, kInitialiserList)) {
    return head.back() == ')' || head.back() == '}' ? Block::kFunction : Block::kOther;
  }
  const std::size_t close = head.rfind(')');
  if (close == std::string::npos) return Block::kOther;
  return std::regex_match(head.substr(close + 1), kAfterParameters) ? Block::kFunction : Block::kOther;
}

class Scanner {
 public:
  explicit Scanner(const std::string& text) : text_(text), code_(blank_literals(text, true)) {}

  std::vector<FunctionLength> run() {
    for (std::size_t i = 0; i < code_.size(); ++i) {
      const char c = code_[i];
      if (c == '{')
        i = open(i);
      else if (c == '}' || (c == ';' && parentheses_ == 0))
        begin_ = i + 1;
      else if (c == '(')
        ++parentheses_;
      else if (c == ')')
        --parentheses_;
    }
    return std::move(found_);
  }

 private:
  std::size_t closing(std::size_t open) const {
    int depth = 0;
    for (std::size_t i = open; i < code_.size(); ++i) {
      depth += code_[i] == '{' ? 1 : code_[i] == '}' ? -1 : 0;
      if (depth == 0) return i;
    }
    return code_.size() - 1;
  }

  /// @return where to go on: into a scope, behind anything else.
  std::size_t open(std::size_t at) {
    const std::size_t first = code_.find_first_not_of(" \t\r\n", begin_);
    switch (kind_of(squeezed(code_.substr(begin_, at - begin_)), parentheses_ > 0)) {
      case Block::kScope:
        begin_ = at + 1;
        return at;
      case Block::kFunction: {
        const std::size_t end = closing(at), line = line_of(code_, first);
        found_.push_back({squeezed(text_.substr(first, at - first)), line, line_of(code_, end) - line + 1});
        if (parentheses_ == 0) begin_ = end + 1;
        return end;
      }
      case Block::kOther:
        break;
    }
    return closing(at);
  }

  const std::string& text_;
  std::string code_;
  std::vector<FunctionLength> found_;
  std::size_t begin_ = 0;  ///< where the head of the next brace begins
  int parentheses_ = 0;
};

}  // namespace

std::vector<FunctionLength> function_lengths(const std::string& text) { return Scanner(text).run(); }

}  // namespace trocar
