#include "haptics/toml_keys.h"

#include <algorithm>

#include "haptics/input_error.h"

namespace trocar {
namespace {

/// Past the string or comment that begins at `at`, else `at`. One without an end goes to where the parser refuses it.
std::size_t past_text(std::string_view toml, std::size_t at) {
  const auto up_to = [&](std::string_view end, std::size_t from) {
    return std::min(toml.find(end, from), toml.size());
  };
  const char quote = toml[at];
  if (quote == '#') return up_to("\n", at);
  if (quote != '"' && quote != '\'') return at;
  const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
  const bool lines = toml.substr(at, 3) == three;
  for (std::size_t i = at + (lines ? 3 : 1); i < toml.size(); ++i) {
    if (quote == '"' && toml[i] == '\\')
      ++i;
    else if (!lines && (toml[i] == quote || toml[i] == '\n'))
      return i + 1;
    else if (lines && toml.substr(i, 3) == three)
      return std::min(toml.find_first_not_of(quote, i), toml.size());  // up to two more belong to the string
  }
  return toml.size();
}

}  // namespace

void require_short_keys(std::string_view toml, const std::string& name) {
  constexpr std::string_view kBetweenKeys = "=,\n[]{}";
  int dots = 0;
  for (std::size_t at = 0; at < toml.size();) {
    if (const std::size_t past = past_text(toml, at); past != at) {
      at = past;
      continue;
    }
    if (kBetweenKeys.find(toml[at]) != std::string_view::npos) dots = 0;
    if (toml[at] == '.' && ++dots >= kMostKeyParts) {
      const std::string_view before = toml.substr(0, at);
      const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
      throw InputError(name, static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
                       static_cast<int>(at - line_begin) + 1,
                       "a key of more than " + std::to_string(kMostKeyParts) + " parts");
    }
    ++at;
  }
}

}  // namespace trocar
