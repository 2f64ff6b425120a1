#include "tissue/imaging/labels/label_table_file.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <utility>
#include <vector>

#include "haptics/input_error.h"
#include "tissue/imaging/labels/segment.h"

namespace trocar {

struct OwnLabelTable::Contents {
  std::string name, text;  ///< the names of the entries lie in `text`
  std::vector<LabelName> entries;
  LabelTable table;
};

namespace {

constexpr std::size_t kMostTableBytes = std::size_t{1} << 20;

struct Word {
  std::string_view text;
  int column = 1;
};

struct Line {
  std::string_view text;
  int number = 0;
};

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // the mark that spreadsheets put in front
  for (int number = 1; !text.empty(); ++number) {
    const auto end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
    const auto first = line.find_first_not_of(" \t");
    if (first != std::string_view::npos && line[first] != '#') lines.push_back({line, number});
  }
  return lines;
}

/// Parts between separators; quotation marks hold a part together and are left out. Blanks in a row are one separator.
std::vector<Word> words_of(std::string_view line, char separator) {
  std::vector<Word> words;
  const auto is_gap = [&](char letter) {
    return separator == ' ' ? letter == ' ' || letter == '\t' : letter == separator;
  };
  for (std::size_t place = 0; place < line.size();) {
    if (separator == ' ' && is_gap(line[place])) {
      ++place;
      continue;
    }
    std::size_t end = place;
    for (bool quoted = false; end < line.size() && (quoted || !is_gap(line[end])); ++end)
      quoted = quoted != (line[end] == '"');
    std::string_view word = line.substr(place, end - place);
    const auto first = word.find_first_not_of(" \t\""), last = word.find_last_not_of(" \t\"");
    const std::size_t shift = first == std::string_view::npos ? 0 : first;
    word = first == std::string_view::npos ? std::string_view() : word.substr(first, last - first + 1);
    words.push_back({word, static_cast<int>(place + shift) + 1});
    place = end + 1;
  }
  return words;
}

bool is_whole(std::string_view text, int& number) {
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return !text.empty() && error == std::errc() && stop == text.data() + text.size();
}

struct Entry {
  Word number, name;
};

/// Where the number and the name of a line stand.
struct Columns {
  std::size_t number = 0, name = 1;
};

/// By the words of a heading; those of a table without one where it has no such words.
/// @throws InputError when one of three columns or more would have to be guessed
Columns columns_of(const Line& heading, const std::vector<Word>& words, const std::string& file) {
  const auto place_of = [&](std::initializer_list<std::string_view> known) {
    for (const std::string_view one : known)
      for (std::size_t n = 0; n < words.size(); ++n)
        if (folded_name(words[n].text) == one) return n;
    return words.size();
  };
  Columns found{place_of({"number", "index", "label_value", "labelvalue", "value", "id", "key", "label", "idx"}),
                place_of({"name", "label_name", "labelname", "structure", "organ", "region", "class", "label"})};
  if (found.number < words.size() && found.name < words.size() && found.number != found.name) return found;
  if (words.size() > 2)
    throw InputError(file, heading.number, 1, "which columns are number and name? Call them \"number\" and \"name\"");
  return {};
}

/// ITK-SNAP: eight columns, the name last and in quotation marks. 3D Slicer: number, name, colour.
std::vector<Word> columns_in(const Line& line, const std::string& file) {
  const char separator = line.text.find('\t') != std::string_view::npos && line.text.find(',') == std::string_view::npos
                             ? '\t'
                         : line.text.find(',') != std::string_view::npos ? ','
                                                                         : ' ';
  std::vector<Word> words = words_of(line.text, separator);
  if (separator == '\t' && words.size() < 2) words = words_of(line.text, ' ');
  if (words.size() < 2) throw InputError(file, line.number, 1, "\"number,name\" is wanted");
  if (separator == ' ' && words.size() >= 8 && line.text.ends_with('"')) return {words.front(), words.back()};
  return words;
}

void check_name(const Word& name, int line, const std::string& file) {
  if (name.text.empty()) throw InputError(file, line, name.column, "no name behind the number");
  if (name.text.size() > 80) throw InputError(file, line, name.column, "a name of more than 80 letters");
  for (const char letter : name.text)
    if (static_cast<unsigned char>(letter) < ' ' || letter == 0x7f)
      throw InputError(file, line, name.column, "a name with a control character");
}

void keep(std::vector<LabelName>& entries, int number, const Entry& entry, int line, const std::string& file) {
  for (const LabelName& other : entries) {
    if (other.number == number)
      throw InputError(file, line, entry.number.column, "number " + std::to_string(number) + " is given twice");
    if (other.name == entry.name.text)
      throw InputError(file, line, entry.name.column, "name \"" + std::string(entry.name.text) + "\" is given twice");
  }
  entries.push_back({number, entry.name.text});
}

}  // namespace

const LabelTable& OwnLabelTable::table() const { return contents_->table; }

OwnLabelTable parse_label_table(std::string_view text, const std::string& file) {
  auto contents = std::make_shared<OwnLabelTable::Contents>();
  contents->name = std::filesystem::path(file).filename().string();
  contents->text = std::string(text.substr(0, kMostTableBytes + 1));
  if (text.size() > kMostTableBytes) throw InputError(file + ": larger than 1 MiB: no label table");
  bool first = true;
  Columns columns;
  for (const Line& line : lines_of(contents->text)) {
    const std::vector<Word> words = columns_in(line, file);
    int number = 0;
    const bool numberless =
        std::none_of(words.begin(), words.end(), [&](const Word& word) { return is_whole(word.text, number); });
    if (std::exchange(first, false) && numberless &&
        words.front().text.find_first_of("0123456789") == std::string_view::npos) {
      columns = columns_of(line, words, file);
      continue;
    }
    if (words.size() <= std::max(columns.number, columns.name))
      throw InputError(file, line.number, 1, "\"number,name\" is wanted");
    const Entry entry{words[columns.number], words[columns.name]};
    if (!is_whole(entry.number.text, number) || number < 0 || number > 65535)
      throw InputError(file, line.number, entry.number.column, "no label number from 0 to 65535");
    check_name(entry.name, line.number, file);
    if (number != 0) keep(contents->entries, number, entry, line.number, file);
  }
  if (contents->entries.empty()) throw InputError(file + ": no entry \"number,name\"");
  contents->table = {contents->name, contents->entries, true};
  OwnLabelTable table;
  table.contents_ = std::move(contents);
  return table;
}

OwnLabelTable read_label_table(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) throw InputError(path.string() + ": no such file");
  std::ifstream in(path, std::ios::binary);
  std::string text(kMostTableBytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw InputError(path.string() + ": cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parse_label_table(text, path.string());
}

OwnLabelTable label_table_or_file(const std::string& name) {
  const std::vector<std::string> known = label_table_names();
  const bool built_in = std::find(known.begin(), known.end(), name) != known.end();
  std::error_code error;
  if (!built_in && std::filesystem::is_regular_file(name, error)) return read_label_table(name);
  auto contents = std::make_shared<OwnLabelTable::Contents>();
  try {
    contents->table = label_table(name);
  } catch (const InputError& unknown) {
    throw InputError(std::string(unknown.what()) + "; nor is it a file");
  }
  OwnLabelTable table;
  table.contents_ = std::move(contents);
  return table;
}

}  // namespace trocar
