#include "app/window/words/translator.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>

#include <toml++/toml.h>

#include "haptics/input_error.h"

namespace trocar {
namespace {

InputError error_at(const std::string& file, const toml::node& node, const std::string& what) {
  const auto& begin = node.source().begin;
  return InputError(file, static_cast<int>(begin.line), static_cast<int>(begin.column), what);
}

toml::table parsed(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file.string() + ": cannot be read; choose another language or put the catalogue there");
  try {
    return toml::parse(in, file.string());
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    throw InputError(file.string(), static_cast<int>(begin.line), static_cast<int>(begin.column),
                     std::string(error.description()));
  }
}

std::string text_of(const std::string& file, const toml::node& node, const std::string& key) {
  const auto value = node.value<std::string>();
  if (!node.is_string() || value->empty()) throw error_at(file, node, "'" + key + "' must be a text, not empty");
  return *value;
}

std::set<int> counts_of(const std::string& file, const toml::node& node) {
  std::set<int> out;
  const toml::array* all = node.as_array();
  for (std::size_t i = 0; all && i < all->size(); ++i)
    if (const auto count = (*all)[i].value_exact<std::int64_t>(); count && *count >= 0 && *count < 1000)
      out.insert(static_cast<int>(*count));
  if (!all || out.empty() || out.size() != all->size())
    throw error_at(file, node, "'singular' must be a list of counts, such as [0, 1]");
  return out;
}

/// One digit in braces at `at`, or none.
std::optional<int> place_at(std::string_view text, std::size_t at) {
  if (at + 2 >= text.size() || text[at] != '{' || text[at + 2] != '}') return std::nullopt;
  if (!std::isdigit(static_cast<unsigned char>(text[at + 1]))) return std::nullopt;
  return text[at + 1] - '0';
}

std::string put_in(std::string_view form, const std::vector<std::string>& values) {
  std::string out;
  for (std::size_t at = 0; at < form.size();) {
    const auto place = place_at(form, at);
    if (place && static_cast<std::size_t>(*place) < values.size()) {
      out += values[static_cast<std::size_t>(*place)];
      at += 3;
    } else {
      out += form[at++];
    }
  }
  return out;
}

/// Values with which `form` gives `text`; each place takes as little as it can.
std::optional<std::vector<std::string>> values_in(std::string_view form, std::string_view text) {
  std::vector<std::string> values;
  std::size_t at = 0, end = 0;
  for (std::size_t i = 0; i < form.size();) {
    const auto place = place_at(form, i);
    if (!place) {
      if (at >= text.size() || text[at++] != form[i++]) return std::nullopt;
      continue;
    }
    i += 3;
    std::size_t stop = i;
    while (stop < form.size() && !place_at(form, stop)) ++stop;
    const std::string_view next = form.substr(i, stop - i);
    end = stop == form.size() && !next.empty()
              ? (text.ends_with(next) ? text.size() - next.size() : std::string_view::npos)
          : next.empty() ? text.size()
                         : text.find(next, at + 1);
    if (end == std::string_view::npos || end <= at) return std::nullopt;
    values.resize(std::max(values.size(), static_cast<std::size_t>(*place) + 1));
    values[static_cast<std::size_t>(*place)] = text.substr(at, end - at);
    at = end;
  }
  return at == text.size() ? std::optional(values) : std::nullopt;
}

/// Points between digits become the sign of the language.
std::string with_decimals(std::string text, const std::string& sign) {
  const auto digit = [&](std::size_t i) { return std::isdigit(static_cast<unsigned char>(text[i])) != 0; };
  for (std::size_t i = 1; i + 1 < text.size(); ++i)
    if (text[i] == '.' && digit(i - 1) && digit(i + 1)) text.replace(i, 1, sign);
  return text;
}

bool plain_code(const std::string& language) {
  return !language.empty() &&
         std::all_of(language.begin(), language.end(), [](unsigned char c) { return std::isalpha(c) || c == '-'; });
}

/// Letters that a form says by itself: the more, the surer the match.
std::size_t own_text(const std::string& form) { return form.size() - 3 * places(form).size(); }

constexpr int kDeepest = 3;                 // sentences in sentences
constexpr std::size_t kMostMissing = 1000;  // a sentence with a running number must not fill the memory
constexpr std::size_t kSaysLittle = 6;

/// "0.4", "3 / 12", "12.5 mm/s": a number with at most a unit.
bool numeric(std::string_view text) {
  const auto count = [&](auto is) {
    return std::count_if(text.begin(), text.end(), [&](unsigned char c) { return is(c) != 0; });
  };
  const auto letters = count([](int c) { return std::isalpha(c); }),
             digits = count([](int c) { return std::isdigit(c); });
  return digits > 0 && letters <= 4 && !std::isalpha(static_cast<unsigned char>(text.front()));
}

/// A form such as "{0} of {1}" would fit half of all sentences: it is for numbers only.
bool bare(const std::string& form) { return place_at(form, 0) && own_text(form) <= kSaysLittle; }

}  // namespace

std::vector<int> places(std::string_view sentence) {
  std::vector<int> out;
  for (std::size_t at = 0; at < sentence.size(); ++at)
    if (const auto place = place_at(sentence, at)) out.push_back(*place);
  std::sort(out.begin(), out.end());
  return out;
}

Translator::Translator(const std::filesystem::path& folder, const std::string& language) : language_(language) {
  if (language == "en") return;
  if (!plain_code(language)) throw InputError("language '" + language + "': give a code such as en, fr or de");
  const std::filesystem::path path = folder / (language + ".toml");
  const std::string file = path.string();
  const toml::table root = parsed(path);
  for (const auto& [name, node] : root) {
    const std::string key(name.str());
    if (key == "name") {
      text_of(file, node, key);
    } else if (key == "decimal") {
      decimal_ = text_of(file, node, key);
    } else if (key == "singular") {
      singular_ = counts_of(file, node);
    } else if (key != "words" || !node.is_table()) {
      throw error_at(file, node,
                     "'" + key + "' is not known; a catalogue has name, decimal, singular and the table [words]");
    }
  }
  if (!root["words"].is_table()) throw InputError(file, 1, 1, "the table [words] is missing");
  for (const auto& [name, node] : *root["words"].as_table()) {
    const std::string key(name.str()), value = text_of(file, node, key);
    if (places(key) != places(value))
      throw error_at(file, node, "'" + value + "' has not the places {0}, {1} of '" + key + "'");
    translations_.emplace(key, value);
    if (!places(key).empty()) forms_.push_back(key);
  }
  std::stable_sort(forms_.begin(), forms_.end(),
                   [](const auto& a, const auto& b) { return own_text(a) > own_text(b); });
}

void Translator::note_missing(std::string_view english) const {
  if (missing_.size() < kMostMissing) missing_.emplace(english);
}

std::string Translator::operator()(std::string_view english) const {
  if (language_ == "en") return std::string(english);
  const auto found = translations_.find(english);
  if (found != translations_.end()) return found->second;
  note_missing(english);
  return std::string(english);
}

std::string Translator::name(std::string_view english) const {
  const auto found = translations_.find(english);
  return found != translations_.end() ? found->second : std::string(english);
}

std::string Translator::operator()(std::string_view english, const std::vector<std::string>& values) const {
  return put_in((*this)(english), values);
}

std::optional<std::string> Translator::filled(std::string_view english, int depth) const {
  for (const std::string& form : forms_) {
    auto values = values_in(form, english);
    if (!values || (bare(form) && !std::all_of(values->begin(), values->end(), numeric))) continue;
    for (std::string& value : *values) value = found(value, depth + 1).value_or(value);
    return put_in(translations_.at(form), *values);
  }
  return std::nullopt;
}

std::optional<std::string> Translator::found(std::string_view english, int depth) const {
  if (const auto whole = translations_.find(english); whole != translations_.end()) return whole->second;
  if (depth < kDeepest)
    if (auto sentence = filled(english, depth)) return sentence;
  return numeric(english) ? std::optional(with_decimals(std::string(english), decimal_)) : std::nullopt;
}

std::string Translator::made(std::string_view english) const {
  if (language_ == "en" || english.empty()) return std::string(english);
  if (auto sentence = found(english, 0)) return *sentence;
  note_missing(english);
  return std::string(english);
}

std::string Translator::made_number(std::string_view english) const {
  return numeric(english) ? with_decimals(std::string(english), decimal_) : std::string(english);
}

std::string Translator::number(double value, int decimals) const {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return with_decimals(text, decimal_);
}

std::vector<Language> languages(const std::filesystem::path& folder) {
  std::vector<Language> out;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() != ".toml") continue;
    const toml::table root = parsed(path);
    const auto name = root["name"].value<std::string>();
    if (!name) throw InputError(path.string(), 1, 1, "'name' is missing: the language's own name for itself");
    out.push_back({path.stem().string(), *name});
  }
  std::sort(out.begin(), out.end(), [](const Language& a, const Language& b) { return a.code < b.code; });
  out.insert(out.begin(), {"en", "English"});
  return out;
}

}  // namespace trocar
