#include "trainees/files/csv_rows.h"

#include <algorithm>
#include <array>

#include "haptics/input_error.h"
#include "haptics/utf8.h"

namespace trocar {
namespace {

/// What Windows-1252 has at 0x80..0x9F; 0: nothing.
constexpr std::array<unsigned, 32> kWindows = {0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                               0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0,      0x017D, 0,
                                               0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                               0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};

void append_utf8(std::string& out, unsigned c) {
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xC0U | c >> 6);
    out += static_cast<char>(0x80U | (c & 0x3FU));
  } else {
    out += static_cast<char>(0xE0U | c >> 12);
    out += static_cast<char>(0x80U | (c >> 6 & 0x3FU));
    out += static_cast<char>(0x80U | (c & 0x3FU));
  }
}

std::string from_windows(std::string_view bytes, const std::string& name) {
  std::string out;
  int line = 1;
  for (const char byte : bytes) {
    unsigned c = static_cast<unsigned char>(byte);
    if (c >= 0x80 && c < 0xA0) c = kWindows[c - 0x80];
    if (c == 0) throw InputError(name, line, 1, "is neither UTF-8 nor Windows-1252: save it as \"CSV UTF-8\"");
    append_utf8(out, c);
    if (byte == '\n') ++line;
  }
  return out;
}

char separator_of(std::string_view text) {
  std::array<std::pair<char, int>, 3> counts = {{{',', 0}, {';', 0}, {'\t', 0}}};
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (!quoted && (c == '\n' || c == '\r')) break;
    for (auto& [separator, count] : counts) count += !quoted && c == separator ? 1 : 0;
  }
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

class CsvReader {
 public:
  CsvReader(std::string_view text, std::string name, char separator, int line)
      : text_(text), name_(std::move(name)), separator_(separator), line_(line) {}

  std::vector<CsvRow> rows() {
    std::vector<CsvRow> out;
    while (at_ < text_.size()) {
      CsvRow row{line_, {}};
      do row.fields.push_back(field());
      while (take(separator_));
      end_line();
      const bool empty =
          std::all_of(row.fields.begin(), row.fields.end(), [](const std::string& field) { return field.empty(); });
      if (!empty) out.push_back(std::move(row));
    }
    return out;
  }

 private:
  bool take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool ended() const { return at_ >= text_.size() || text_[at_] == '\n' || text_[at_] == '\r'; }
  InputError fault(int line, const std::string& what) const {
    return InputError(name_, line, static_cast<int>(at_ - begin_) + 1, what);
  }

  void end_line() {
    if (!take('\r')) {
      if (take('\n')) next_line();
      return;
    }
    take('\n');
    next_line();
  }
  void next_line() {
    ++line_;
    begin_ = at_;
  }

  std::string field() {
    if (take('"')) return quoted_field();
    const std::size_t from = at_;
    while (!ended() && text_[at_] != separator_) {
      if (text_[at_] == '"') throw fault(line_, "a quote inside a field: quote the whole field and double the quote");
      if (text_[at_] == '\0') throw fault(line_, "holds a zero byte: it is no text");
      ++at_;
    }
    return std::string(text_.substr(from, at_ - from));
  }

  std::string quoted_field() {
    const int opened = line_, column = static_cast<int>(at_ - begin_);
    std::string out;
    for (;;) {
      if (at_ >= text_.size()) throw InputError(name_, opened, column, "a quote is opened and never closed");
      const char c = text_[at_++];
      if (c == '"' && !take('"')) break;
      out += c;
      if (c == '\n' || (c == '\r' && (at_ >= text_.size() || text_[at_] != '\n'))) next_line();
    }
    if (!ended() && text_[at_] != separator_) throw fault(line_, "text behind a closing quote");
    return out;
  }

  std::string_view text_;
  std::string name_;
  char separator_;
  int line_;
  std::size_t at_ = 0, begin_ = 0;
};

}  // namespace

CsvRows read_csv(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    throw InputError(name, 1, 1, "is UTF-16: save it as \"CSV UTF-8\"");
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  CsvRows out;
  std::string recoded;
  if (!is_utf8(bytes)) {
    recoded = from_windows(bytes, name);
    bytes = recoded;
    out.recoded = true;
  }
  int line = 1;
  out.separator = separator_of(bytes);
  if (bytes.starts_with("sep=") && bytes.size() > 4) {
    out.separator = bytes[4];
    bytes.remove_prefix(
        std::min(bytes.find('\n') == std::string_view::npos ? bytes.size() : bytes.find('\n') + 1, bytes.size()));
    line = 2;
  }
  out.rows = CsvReader(bytes, name, out.separator, line).rows();
  return out;
}

}  // namespace trocar
