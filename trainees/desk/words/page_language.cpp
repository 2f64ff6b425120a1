#include "trainees/desk/words/page_language.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "haptics/input_error.h"

namespace trocar::review {
namespace {

constexpr int kDeepestPart = 8;  ///< parts in parts
constexpr std::array<std::string_view, 12> kEnglishMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                             "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
constexpr std::array<std::string_view, 31> kUnits = {
    "B",  "rad", "rad/s", "N^2", "1/s",    "%",   "mm", "mm/s", "m",  "m/s", "s",  "N",   "N/s", "N s", "N/mm", "J",
    "Hz", "kHz", "deg",   "mL",  "mL/min", "min", "h",  "GB",   "MB", "kB",  "ms", "UTC", "kg",  "SD",  "x"};

bool digit(char c) { return c >= '0' && c <= '9'; }
bool small(char c) { return c >= 'a' && c <= 'z'; }
bool large(char c) { return c >= 'A' && c <= 'Z'; }

template <class Use>
void each_token(std::string_view text, Use use) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    use(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

std::size_t month_of(std::string_view token) {
  return static_cast<std::size_t>(std::find(kEnglishMonths.begin(), kEnglishMonths.end(), token) -
                                  kEnglishMonths.begin());
}

/// Digits and signs; a level or a number of an exercise ("L2", "EX2"), an exponent.
bool valued(std::string_view token) {
  if (token.empty()) return false;
  const std::size_t capitals = static_cast<std::size_t>(
      std::find_if_not(token.begin(), token.end(), [](char c) { return large(c); }) - token.begin());
  const bool numbered = capitals <= 2 && capitals < token.size() && digit(token[capitals]);
  for (std::size_t i = 0; i < token.size(); ++i) {
    const char c = token[i];
    const auto byte = static_cast<unsigned char>(c);
    const bool level = numbered && i < capitals;
    const bool exponent = c == 'e' && i > 0 && digit(token[i - 1]) && i + 1 < token.size();
    const bool letter = byte == 0xC3 && i + 1 < token.size() && static_cast<unsigned char>(token[i + 1]) != 0x97;
    const bool foreign = byte >= 0xC4 && byte < 0xE2;
    if (((small(c) || large(c)) && !level && !exponent) || letter || foreign) return false;
  }
  return true;
}

bool united(std::string_view token) {
  token = token.substr(0, token.find_last_not_of(",.;)") + 1);
  return std::find(kUnits.begin(), kUnits.end(), token) != kUnits.end();
}

/// "0.4", "3 / 12", "12.5 mm/s", "22 Nov 2026, 13:05": nothing to translate but signs and months.
bool numeric(std::string_view text) {
  bool all = true, some = false;
  std::size_t at = 0;
  each_token(text, [&](std::string_view token) {
    const bool value = valued(token) || token == "n/a";
    some = some || value;
    all = all && (value || united(token) || (at > 0 && month_of(token) < kEnglishMonths.size()));
    ++at;
  });
  return all && (some || at == 1);
}

/// "1.5" but not "1.5.2": a version or an address is no number.
std::string with_sign(std::string_view token, const std::string& sign) {
  std::string out;
  if (std::count(token.begin(), token.end(), '.') - (token.ends_with('.') ? 1 : 0) != 1) return std::string(token);
  for (std::size_t i = 0; i < token.size(); ++i) {
    if (token[i] == '.' && i > 0 && i + 1 < token.size() && digit(token[i - 1]) && digit(token[i + 1]))
      out += sign;
    else
      out += token[i];
  }
  return out;
}

std::string with_capital(std::string text) {
  if (text.empty()) return text;
  if (small(text[0])) text[0] = static_cast<char>(text[0] - 32);
  const auto second = text.size() > 1 ? static_cast<unsigned char>(text[1]) : 0;
  if (text.starts_with("\xC3") && second >= 0xA0 && second <= 0xBE) text[1] = static_cast<char>(second - 0x20);
  return text;
}

toml::table catalogue_in(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw InputError(path.string() + ": cannot be read");
  try {
    return toml::parse(in, path.string());
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    throw InputError(path.string(), static_cast<int>(begin.line), static_cast<int>(begin.column),
                     std::string(error.description()));
  }
}

InputError wrong_entry(const std::filesystem::path& path, const toml::node& node, const std::string& what) {
  const auto& begin = node.source().begin;
  return {path.string(), static_cast<int>(begin.line), static_cast<int>(begin.column), what};
}

std::string text_in(const std::filesystem::path& path, const toml::node& node) {
  const auto value = node.value_exact<std::string>();
  if (!value || value->empty()) throw wrong_entry(path, node, "a text is needed, not empty");
  return *value;
}

}  // namespace

bool desk_tongue(std::string_view code) {
  return std::any_of(kDeskTongues.begin(), kDeskTongues.end(), [&](const DeskTongue& one) { return one.code == code; });
}

std::vector<PageLanguage::Piece> PageLanguage::pieces_of(std::string_view text) {
  std::vector<Piece> out;
  std::array<std::size_t, 256> seen{};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('}', at);
    const bool place = text[at] == '{' && end != std::string_view::npos && (end == at + 2 || end == at + 3) &&
                       std::string_view("npt").find(text[at + 1]) != std::string_view::npos &&
                       (end == at + 2 || (digit(text[at + 2]) && text[at + 2] != '0'));
    if (place) {
      const char kind = text[at + 1];
      std::size_t& count = seen[static_cast<unsigned char>(kind)];
      ++count;
      out.push_back({kind, {}, end == at + 3 ? static_cast<std::size_t>(text[at + 2] - '1') : count - 1});
      at = end + 1;
      continue;
    }
    if (out.empty() || out.back().kind != ' ') out.push_back({});
    out.back().text += text[at++];
  }
  return out;
}

void PageLanguage::add(const std::string& key, const std::string& own) {
  Form form{key, pieces_of(key), pieces_of(own), 0, {}};
  const auto places = [](const std::vector<Piece>& pieces) {
    std::vector<std::pair<char, std::size_t>> out;
    for (const Piece& piece : pieces)
      if (piece.kind != ' ') out.emplace_back(piece.kind, piece.number);
    std::sort(out.begin(), out.end());
    return out;
  };
  const auto there = places(form.english);
  if (there != places(form.own) || std::adjacent_find(there.begin(), there.end()) != there.end())
    throw InputError("'" + own + "' has not the places of '" + key + "'");
  keys_.insert(key);
  if (there.empty()) {
    exact_.emplace(key, own);
    return;
  }
  for (std::size_t i = 0; i < form.english.size(); ++i) {
    if (i > 0 && form.english[i].kind != ' ' && form.english[i - 1].kind != ' ')
      throw InputError("'" + key + "' has two places with nothing between them");
    form.literal += form.english[i].text.size();
    if (form.english[i].text.size() > form.longest.size()) form.longest = form.english[i].text;
  }
  forms_.push_back(std::move(form));
}

PageLanguage::PageLanguage(const std::filesystem::path& folder, const std::string& code) : code_(code) {
  const std::filesystem::path file = folder / "desk" / (code + ".toml"), shared = folder / (code + ".toml");
  const toml::table root = catalogue_in(file);
  for (const auto& [name, node] : root) {
    const std::string key(name.str());
    if (key == "decimal") {
      decimal_ = text_in(file, node);
    } else if (key == "day") {
      day_ = text_in(file, node);
    } else if (key == "months" && node.is_array()) {
      for (const toml::node& month : *node.as_array()) months_.push_back(text_in(file, month));
    } else if (key == "units" && node.is_table()) {
      for (const auto& [unit, own] : *node.as_table()) {
        if (!united(unit.str())) throw wrong_entry(file, own, "'" + std::string(unit.str()) + "' is no unit");
        units_.emplace(unit.str(), text_in(file, own));
      }
    } else if (key != "words" || !node.is_table()) {
      throw wrong_entry(file, node,
                        "'" + key + "' is not known; a catalogue has decimal, day, months, units and [words]");
    }
  }
  if (decimal_.empty() || day_.find("{0}") == std::string::npos || months_.size() != kEnglishMonths.size() ||
      !root["words"].is_table())
    throw InputError(file.string(), 1, 1,
                     "decimal, day with {0} {1} {2}, twelve months and the table [words] are needed");
  for (const auto& [name, node] : *root["words"].as_table()) {
    const std::string own = text_in(file, node);
    try {
      add(std::string(name.str()), own);
    } catch (const InputError& error) {
      throw wrong_entry(file, node, error.what());
    }
  }
  const toml::table window = catalogue_in(shared);
  if (const toml::table* words = window["words"].as_table())
    for (const auto& [name, node] : *words)
      if (name.str().find('{') == std::string_view::npos)
        exact_.emplace(std::string(name.str()), text_in(shared, node));
  std::stable_sort(forms_.begin(), forms_.end(), [](const Form& a, const Form& b) { return a.literal > b.literal; });
  for (std::uint32_t i = 0; i < forms_.size(); ++i) {
    const Piece& first = forms_[i].english.front();
    if (first.kind == ' ')
      by_first_.at(static_cast<unsigned char>(first.text[0])).push_back(i);
    else
      placed_.push_back(i);
  }
}

std::string PageLanguage::number(std::string_view text) const {
  std::vector<std::string> tokens;
  each_token(text, [&](std::string_view token) { tokens.emplace_back(token); });
  std::string out;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::size_t month = i + 1 < tokens.size() && digit(tokens[i][0]) ? month_of(tokens[i + 1].substr(0, 3)) : 99;
    const auto unit = units_.find(tokens[i].substr(0, tokens[i].find_last_not_of(",.;)") + 1));
    const std::string own =
        unit == units_.end() ? with_sign(tokens[i], decimal_) : unit->second + tokens[i].substr(unit->first.size());
    if (!out.empty() && !own.starts_with("\xC2\xB0")) out += ' ';  // a degree sign stands at its number
    if (month >= kEnglishMonths.size()) {
      out += own;
      continue;
    }
    const bool year = i + 2 < tokens.size() && tokens[i + 2].size() >= 4 && digit(tokens[i + 2][3]);
    std::string day = year ? day_ : day_.substr(0, day_.find(" {2}"));
    for (const auto& [place, value] : {std::pair<std::string, std::string>{"{0}", tokens[i]},
                                       {"{1}", months_[month] + tokens[i + 1].substr(3)},
                                       {"{2}", year ? tokens[i + 2] : ""}})
      if (const std::size_t at = day.find(place); at != std::string::npos) day.replace(at, place.size(), value);
    out += day;
    i += year ? 2 : 1;
  }
  return out;
}

/// What one text led to: parts of it are asked for again and again.
struct PageLanguage::Asking {
  AskedWords* words;
  std::unordered_map<std::string, Found> parts = {};
};

bool PageLanguage::parts_known(Values& values, int depth, Asking& asking) const {
  std::vector<std::string> own;
  for (const std::string& part : values.p) {
    auto one = found(part, depth + 1, asking);
    if (!one) return false;
    own.push_back(std::move(*one));
  }
  values.p = std::move(own);
  return true;
}

/// "Not done. a.db": a sentence that is known by itself belongs to no name behind it.
bool PageLanguage::begins_with_known(std::string_view text) const {
  const std::size_t stop = text.find(". ");
  if (stop == std::string_view::npos) return false;
  const std::string said(text.substr(0, stop + 1)), capital = with_capital(said);
  for (const std::string& sentence : {said, capital})
    if (exact_.contains(sentence) || exact_.contains(sentence.substr(0, stop))) return true;
  return false;
}

/// Numbers are looked at on the way, parts when all the rest fits: they cost more.
bool PageLanguage::fits(const Form& form, std::size_t piece, std::string_view text, int depth, Values& values,
                        Asking& asking) const {
  if (piece == form.english.size()) return text.empty() && parts_known(values, depth, asking);
  const Piece& now = form.english[piece];
  if (now.kind == ' ')
    return text.starts_with(now.text) && fits(form, piece + 1, text.substr(now.text.size()), depth, values, asking);
  const bool ends = piece + 1 == form.english.size(), last = piece + 2 == form.english.size();
  const std::string_view next = ends ? std::string_view() : std::string_view(form.english[piece + 1].text);
  if (last && (text.size() <= next.size() || !text.ends_with(next))) return false;
  for (std::size_t at = ends || last ? text.size() - next.size() : text.find(next, 1);
       at != std::string_view::npos && at > 0; at = ends || last ? 0 : text.find(next, at + 1)) {
    const std::string_view value = text.substr(0, at);
    if (now.kind == 'n' && !numeric(value)) continue;
    if (now.kind == 't' && piece == 0 && begins_with_known(value)) continue;
    Values taken = values;
    (now.kind == 'n'   ? taken.n
     : now.kind == 'p' ? taken.p
                       : taken.t)
        .push_back(now.kind == 'n' ? number(value) : std::string(value));
    if (!fits(form, piece + 1, text.substr(at), depth, taken, asking)) continue;
    values = std::move(taken);
    return true;
  }
  return false;
}

/// @param literal letters that a form must say by itself to be better than what was found; then those that it says.
PageLanguage::Found PageLanguage::filled(std::string_view english, int depth, Asking& asking,
                                         std::size_t& literal) const {
  constexpr std::size_t kLongestPlaced = 400;  // longer ones are several sentences
  Found best;
  for (const auto* some : {&by_first_.at(static_cast<unsigned char>(english[0])), &placed_}) {
    if (some == &placed_ && english.size() > kLongestPlaced) break;
    for (const std::uint32_t i : *some) {
      const Form& form = forms_[i];
      if (form.literal <= literal) break;
      if (form.literal > english.size() || english.find(form.longest) == std::string_view::npos) continue;
      Values values;
      if (!fits(form, 0, english, depth, values, asking)) continue;
      if (asking.words != nullptr) asking.words->used.insert(form.key);
      std::string out;
      for (const Piece& piece : form.own)
        out += piece.kind == ' '   ? piece.text
               : piece.kind == 'n' ? values.n[piece.number]
               : piece.kind == 'p' ? values.p[piece.number]
                                   : values.t[piece.number];
      literal = form.literal;
      best = std::move(out);
      break;
    }
  }
  return best;
}

PageLanguage::Found PageLanguage::whole(const std::string& english, Asking& asking) const {
  const auto at = exact_.find(english);
  if (at == exact_.end()) return std::nullopt;
  if (asking.words != nullptr) asking.words->used.insert(at->first);
  return at->second;
}

/// As it stands and with a small first letter. @param literal as of filled().
PageLanguage::Found PageLanguage::known(std::string_view english, int depth, Asking& asking,
                                        std::size_t& literal) const {
  if (english.size() <= literal) return std::nullopt;
  std::string lower(english);
  if (large(lower[0])) lower[0] = static_cast<char>(lower[0] + 32);
  const bool capital = lower != english;
  Found out = whole(std::string(english), asking);
  if (!out && numeric(english)) out = number(english);
  if (!out && capital)
    if (auto own = whole(lower, asking)) out = with_capital(std::move(*own));
  if (out) {
    literal = english.size();
    return out;
  }
  out = filled(english, depth, asking, literal);
  if (capital)
    if (auto better = filled(lower, depth, asking, literal)) out = with_capital(std::move(*better));
  return out;
}

/// What stands between two parts: French has a space before a semicolon too.
std::string PageLanguage::joint(std::string_view english) const {
  const auto at = exact_.find(std::string(english));
  return at == exact_.end() ? std::string(english) : at->second;
}

/// All of its sentences, or parts between semicolons and commas; each must be known.
PageLanguage::Found PageLanguage::sentences(std::string_view english, int depth, Asking& asking) const {
  for (const std::string_view between : {". ", "; ", ", "}) {
    const std::size_t at = english.find(between);
    if (at == 0 || at == std::string_view::npos || at + 2 >= english.size()) continue;
    const std::size_t stop = between[0] == '.' ? 1 : 0;
    const auto first = found(english.substr(0, at + stop), depth + 1, asking);
    if (!first) continue;
    const auto rest = found(english.substr(at + 2), depth, asking);
    if (rest) return *first + joint(between.substr(stop)) + *rest;
  }
  return std::nullopt;
}

PageLanguage::Found PageLanguage::found(std::string_view english, int depth, Asking& asking) const {
  if (english.empty() || depth > kDeepestPart) return std::nullopt;
  if (const auto at = asking.parts.find(std::string(english)); at != asking.parts.end()) return at->second;
  auto out = resolved(english, depth, asking);
  asking.parts.emplace(english, out);
  return out;
}

PageLanguage::Found PageLanguage::resolved(std::string_view english, int depth, Asking& asking) const {
  std::size_t literal = 0;
  Found best;
  if (english.size() > 1 && english.ends_with('.') && !exact_.contains(std::string(english))) {
    best = known(english.substr(0, english.size() - 1), depth, asking, literal);
    if (best) *best += '.';
  }
  if (auto better = known(english, depth, asking, literal)) best = std::move(better);
  if (best) return best;
  const std::size_t from = english.find_first_not_of(",.;:() ");
  if (from == std::string_view::npos) return std::string(english);
  const std::size_t to = english.find_last_not_of(",;:() ") + 1;
  if (from > 0 || to < english.size()) {
    if (auto out = found(english.substr(from, to - from), depth, asking))
      return std::string(english.substr(0, from)) + *out + std::string(english.substr(to));
  }
  return sentences(english, depth, asking);
}

/// What is known of it, sentence by sentence.
std::string PageLanguage::said(std::string_view english, Asking& asking) const {
  if (auto out = found(english, 0, asking)) return *out;
  for (const std::string_view between : {". ", "; "}) {
    const std::size_t at = english.find(between);
    if (at == std::string_view::npos || at == 0 || at + 2 >= english.size()) continue;
    const std::size_t stop = between[0] == '.' ? 1 : 0;
    return said(english.substr(0, at + stop), asking) + joint(between.substr(stop)) +
           said(english.substr(at + 2), asking);
  }
  if (asking.words != nullptr) asking.words->unknown.emplace(english);
  return std::string(english);
}

std::string PageLanguage::words(std::string_view english, AskedWords* asked) const {
  Asking asking{asked};
  return said(english, asking);
}

PageLanguages::PageLanguages(const std::filesystem::path& folder) {
  for (const DeskTongue& one : kDeskTongues)
    if (one.code != std::string_view("en")) all_.emplace_back(folder, one.code);
}

const PageLanguage* PageLanguages::chosen(const std::string& cookie, const std::string& accept) const {
  std::string best = desk_tongue(cookie) ? cookie : "en";
  double most = 0;
  for (std::size_t from = 0; best != cookie && from < accept.size();) {
    const std::size_t to = std::min(accept.find(',', from), accept.size());
    const std::string one = accept.substr(from, to - from);
    from = to + 1;
    const std::size_t begin = std::min(one.find_first_not_of(" \t"), one.size()), weight = one.find("q=");
    const std::string tag = one.substr(begin, one.find_first_of("; \t", begin) - begin);
    std::string code = tag.substr(0, tag.find('-'));
    for (char& c : code) c = large(c) ? static_cast<char>(c + 32) : c;
    const double liked = weight == std::string::npos ? 1 : std::strtod(one.c_str() + weight + 2, nullptr);
    if (!desk_tongue(code) || !(liked > most)) continue;
    most = liked;
    best = code;
  }
  const auto at = std::find_if(all_.begin(), all_.end(), [&](const PageLanguage& one) { return one.code() == best; });
  return at == all_.end() ? nullptr : &*at;
}

}  // namespace trocar::review
