#include "tissue/organ/ply_check.h"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <vector>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::uint64_t kMostElements = 20'000'000;
constexpr std::uint64_t kMaxCorners = 64;  ///< of one polygon

struct Property {
  std::size_t count_bytes = 0;  ///< 0 when it is no list
  std::size_t bytes = 0;        ///< of one value
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  bool ascii = false;
  bool big_endian = false;
  std::size_t size = 0;  ///< bytes up to the data
  std::vector<Element> elements;
};

std::size_t bytes_of(const std::string& type) {
  for (const auto& [name, bytes] : {std::pair("char", 1),
                                    {"uchar", 1},
                                    {"int8", 1},
                                    {"uint8", 1},
                                    {"short", 2},
                                    {"ushort", 2},
                                    {"int16", 2},
                                    {"uint16", 2},
                                    {"int", 4},
                                    {"uint", 4},
                                    {"int32", 4},
                                    {"uint32", 4},
                                    {"float", 4},
                                    {"float32", 4},
                                    {"double", 8},
                                    {"float64", 8}})
    if (type == name) return static_cast<std::size_t>(bytes);
  return 0;
}

/// Reads the header's lines one by one.
class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  Header parse() {
    if (next() != "ply") refuse("\"ply\" expected");
    for (std::string line = next(); line != "end_header"; line = next()) keyword(line);
    if (!format_seen_) refuse("the header names no format");
    header_.size = offset_;
    return std::move(header_);
  }

 private:
  std::string next() {
    const std::size_t end = bytes_.substr(0, std::min(bytes_.size(), offset_ + 1024)).find('\n', offset_);
    ++number_;
    if (end == std::string_view::npos) refuse("the header does not end");
    std::string line(bytes_.substr(offset_, end - offset_));
    if (line.ends_with('\r')) line.pop_back();
    offset_ = end + 1;
    return line;
  }

  void keyword(const std::string& line) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "comment" || word == "obj_info") return;
    if (word == "format") return format(words);
    if (word == "element") return element(words);
    if (word == "property" && !header_.elements.empty()) return property(words);
    refuse("\"" + word + "\" is not expected here");
  }

  void format(std::istringstream& words) {
    std::string form;
    words >> form;
    header_.ascii = form == "ascii";
    header_.big_endian = form == "binary_big_endian";
    if (!header_.ascii && !header_.big_endian && form != "binary_little_endian") refuse("unknown format " + form);
    format_seen_ = true;
  }

  void element(std::istringstream& words) {
    Element element;
    if (!(words >> element.name >> element.count) || element.count > kMostElements)
      refuse("element count is no number up to 20 million");
    header_.elements.push_back(element);
  }

  void property(std::istringstream& words) {
    Property property;
    std::string type, count_type;
    words >> type;
    if (type == "list") {
      words >> count_type >> type;
      property.count_bytes = bytes_of(count_type);
      if (property.count_bytes == 0 || property.count_bytes > 4 || count_type.starts_with("float"))
        refuse("no whole number counts this list");
    }
    property.bytes = bytes_of(type);
    if (property.bytes == 0) refuse("unknown type " + type);
    header_.elements.back().properties.push_back(property);
  }

  [[noreturn]] void refuse(const std::string& what) const { throw InputError(file_, number_, 1, what); }

  std::string_view bytes_;
  std::string file_;
  Header header_;
  std::size_t offset_ = 0;
  int number_ = 0;
  bool format_seen_ = false;
};

[[noreturn]] void ply_ends_early(const Element& element, std::uint64_t index, const std::string& file) {
  throw InputError(file + ": the file ends at " + element.name + " " + std::to_string(index) + " of " +
                   std::to_string(element.count));
}

std::uint64_t list_length(std::string_view raw, bool big_endian) {
  std::uint64_t length = 0;
  for (std::size_t n = 0; n < raw.size(); ++n)
    length = length << 8 | static_cast<unsigned char>(raw[big_endian ? n : raw.size() - 1 - n]);
  return length;
}

void check_binary(std::string_view data, const Header& header, const std::string& file) {
  std::size_t offset = 0;
  for (const Element& element : header.elements)
    for (std::uint64_t index = 0; index < element.count; ++index)
      for (const Property& property : element.properties) {
        std::uint64_t values = 1;
        if (property.count_bytes > 0) {
          if (data.size() - offset < property.count_bytes) ply_ends_early(element, index, file);
          values = list_length(data.substr(offset, property.count_bytes), header.big_endian);
          if (values > kMaxCorners)
            throw InputError(file + ": " + element.name + " " + std::to_string(index) + " lists " +
                             std::to_string(values) + " values");
          offset += property.count_bytes;
        }
        if (data.size() - offset < values * property.bytes) ply_ends_early(element, index, file);
        offset += values * property.bytes;
      }
}

/// One line an element, with at least one number for each of its properties; a list's length is checked too.
void check_line(const std::string& line, const Element& element, std::uint64_t index, const std::string& file) {
  std::istringstream words(line);
  double value = 0;
  for (const Property& property : element.properties) {
    if (!(words >> value)) ply_ends_early(element, index, file);
    if (property.count_bytes == 0) continue;
    if (!(value >= 0 && value <= static_cast<double>(kMaxCorners)))
      throw InputError(file + ": " + element.name + " " + std::to_string(index) + ": bad list length");
    for (auto left = static_cast<std::uint64_t>(value); left > 0; --left)
      if (!(words >> value)) ply_ends_early(element, index, file);
  }
}

void check_ascii(std::string_view data, const Header& header, const std::string& file) {
  std::istringstream lines{std::string(data)};
  std::string line;
  for (const Element& element : header.elements)
    for (std::uint64_t index = 0; index < element.count; ++index) {
      if (!std::getline(lines, line)) ply_ends_early(element, index, file);
      check_line(line, element, index, file);
    }
}

}  // namespace

void check_ply(std::string_view bytes, const std::string& file) {
  const Header header = HeaderParser(bytes, file).parse();
  for (const Element& element : header.elements)
    if (element.properties.empty()) throw InputError(file + ": element " + element.name + " has no property");
  const std::string_view data = bytes.substr(header.size);
  header.ascii ? check_ascii(data, header, file) : check_binary(data, header, file);
}

}  // namespace trocar
