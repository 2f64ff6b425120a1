#include "tests/app/window/words/sentence_scan.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>

#include "app/window/words/translator.h"

namespace trocar {
namespace {

char unescaped(char c) {
  switch (c) {
    case 'n':
      return '\n';
    case 't':
      return '\t';
    default:
      return c;
  }
}

bool blank(const std::string& code, std::size_t from, std::size_t to) {
  return std::all_of(code.begin() + static_cast<std::ptrdiff_t>(from), code.begin() + static_cast<std::ptrdiff_t>(to),
                     [](unsigned char c) { return std::isspace(c); });
}

/// One past a comment that begins at i, or i.
std::size_t past_comment(const std::string& code, std::size_t i) {
  if (code.compare(i, 2, "//") == 0) return std::min(code.find('\n', i), code.size());
  if (code.compare(i, 2, "/*") == 0) return std::min(code.find("*/", i + 2), code.size() - 2) + 2;
  return i;
}

std::size_t past_raw(const std::string& code, std::size_t quote, std::string& text) {
  const std::size_t open = code.find('(', quote);
  const std::string end = ")" + code.substr(quote + 1, open - quote - 1) + "\"";
  const std::size_t close = code.find(end, open);
  text = code.substr(open + 1, close - open - 1);
  return close + end.size();
}

std::size_t past_plain(const std::string& code, std::size_t quote, std::string& text) {
  std::size_t i = quote + 1;
  for (; i < code.size() && code[i] != '"'; ++i) text += code[i] == '\\' ? unescaped(code[++i]) : code[i];
  return i + 1;
}

/// One past the first argument of a call whose bracket opens before `from`.
std::size_t past_argument(const std::string& code, std::size_t from) {
  int depth = 0;
  for (std::size_t i = from; i < code.size(); ++i) {
    if (code[i] == '"') {
      std::string skipped;
      i = past_plain(code, i, skipped) - 1;
    } else if (std::string_view("([{").find(code[i]) != std::string_view::npos) {
      ++depth;
    } else if (std::string_view(")]}").find(code[i]) != std::string_view::npos) {
      if (--depth < 0) return i;
    } else if (code[i] == ',' && depth == 0) {
      return i;
    }
  }
  return code.size();
}

std::vector<std::string> within(const std::vector<Literal>& all, std::size_t from, std::size_t to) {
  std::vector<std::string> out;
  for (const Literal& one : all)
    if (one.at >= from && one.at < to) out.push_back(one.text);
  return out;
}

}  // namespace

std::vector<Literal> literals_of(const std::string& code) {
  std::vector<Literal> out;
  std::size_t last_end = std::string::npos;
  for (std::size_t i = 0; i < code.size();) {
    if (const std::size_t past = past_comment(code, i); past != i) {
      if (last_end != std::string::npos && blank(code, last_end, i)) last_end = past;
      i = past;
    } else if (code[i] == '\'' && i > 0 && !std::isalnum(static_cast<unsigned char>(code[i - 1]))) {
      i += code[i + 1] == '\\' ? 4 : 3;
    } else if (code[i] == '"') {
      Literal one{"", i};
      const std::size_t end = i > 0 && code[i - 1] == 'R' ? past_raw(code, i, one.text) : past_plain(code, i, one.text);
      if (last_end != std::string::npos && blank(code, last_end, i))
        out.back().text += one.text;
      else
        out.push_back(one);
      i = last_end = end;
    } else {
      ++i;
    }
  }
  return out;
}

std::vector<std::string> words_asked(const std::string& code) {
  static const std::regex kCall(R"(\b(?:words(?:\(\))?|words_|w)\s*\()");
  const std::vector<Literal> all = literals_of(code);
  std::vector<std::string> out;
  for (std::sregex_iterator it(code.begin(), code.end(), kCall), end; it != end; ++it) {
    const auto from = static_cast<std::size_t>(it->position() + it->length());
    for (std::string& text : within(all, from, past_argument(code, from))) out.push_back(std::move(text));
  }
  return out;
}

std::vector<std::string> sentences_said(const std::string& code) {
  static const std::regex kSaid(R"((?:\bsay\(status,)|(?:toast_ = ))");
  const std::vector<Literal> all = literals_of(code);
  std::vector<std::string> out;
  for (std::sregex_iterator it(code.begin(), code.end(), kSaid), end; it != end; ++it) {
    const auto from = static_cast<std::size_t>(it->position() + it->length());
    for (std::string& text : within(all, from, code.find(';', from))) out.push_back(std::move(text));
  }
  return out;
}

std::vector<std::string> own_pieces(const std::string& sentence) {
  std::vector<std::string> out(1);
  for (std::size_t i = 0; i < sentence.size(); ++i) {
    if (!places(sentence.substr(i, 3)).empty()) {
      out.emplace_back();
      i += 2;
    } else {
      out.back() += sentence[i];
    }
  }
  for (std::string& piece : out) {
    const auto from = piece.find_first_not_of(' '), to = piece.find_last_not_of(' ');
    piece = from == std::string::npos ? "" : piece.substr(from, to - from + 1);
  }
  std::erase_if(out, [](const std::string& piece) {
    return std::none_of(piece.begin(), piece.end(), [](unsigned char c) { return std::isalpha(c); });
  });
  return out;
}

std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder,
                                               const std::vector<std::string>& suffixes) {
  std::vector<std::filesystem::path> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (std::find(suffixes.begin(), suffixes.end(), entry.path().extension()) != suffixes.end())
      out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace trocar
