#include "tissue/organ/toml_table.h"

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "haptics/input_error.h"
#include "haptics/toml_keys.h"

namespace trocar {

struct TomlTable::Document {
  toml::table root;
};

/// What needs toml++'s types.
struct TomlTable::Access {
  static const toml::table& of(const TomlTable& self) { return *static_cast<const toml::table*>(self.table_); }

  [[noreturn]] static void refuse(const TomlTable& self, const toml::source_region& place, const std::string& what) {
    throw InputError(self.file_, static_cast<int>(place.begin.line), static_cast<int>(place.begin.column), what);
  }

  static const toml::node& required(TomlTable& self, std::string_view key) {
    self.known_.emplace(key);
    const toml::node* node = of(self).get(key);
    if (node == nullptr) refuse(self, of(self).source(), "key \"" + std::string(key) + "\" is missing");
    return *node;
  }

  template <typename T>
  static T value(TomlTable& self, std::string_view key, const std::string& kind) {
    const toml::node& node = required(self, key);
    const auto found = node.value<T>();
    if (!found || (!std::is_same_v<T, double> && !node.value_exact<T>()))
      refuse(self, node.source(), std::string(key) + " must be " + kind);
    return *found;
  }

  static const toml::array& array(TomlTable& self, std::string_view key) {
    const toml::node& node = required(self, key);
    if (!node.is_array()) refuse(self, node.source(), std::string(key) + " must be an array");
    return *node.as_array();
  }

  template <typename T>
  static std::vector<T> list(TomlTable& self, std::string_view key, const std::string& kind) {
    std::vector<T> values;
    for (const toml::node& node : array(self, key)) {
      const auto found = node.value<T>();
      if (!found) refuse(self, node.source(), std::string(key) + " holds " + kind);
      values.push_back(*found);
    }
    return values;
  }
};

TomlTable::TomlTable(std::shared_ptr<const Document> document, const void* table, std::string file)
    : document_(std::move(document)), table_(table), file_(std::move(file)) {}

TomlTable TomlTable::parse(const std::string& text, const std::string& file) {
  require_short_keys(text, file);
  try {
    const auto document = std::make_shared<const Document>(Document{toml::parse(text, file)});
    return {document, &document->root, file};
  } catch (const toml::parse_error& error) {
    const auto& place = error.source().begin;
    throw InputError(file, static_cast<int>(place.line), static_cast<int>(place.column),
                     std::string(error.description()));
  }
}

std::string TomlTable::text(std::string_view key) { return Access::value<std::string>(*this, key, "text"); }
bool TomlTable::boolean(std::string_view key) { return Access::value<bool>(*this, key, "true or false"); }

double TomlTable::number(std::string_view key) {
  const double real = Access::value<double>(*this, key, "a number");
  if (!std::isfinite(real)) refuse(key, std::string(key) + " is not finite");
  return real;
}

std::size_t TomlTable::count(std::string_view key) {
  const auto number = Access::value<std::int64_t>(*this, key, "a whole number");
  if (number < 0) refuse(key, std::string(key) + " is negative");
  return static_cast<std::size_t>(number);
}

int TomlTable::integer(std::string_view key) {
  const std::size_t number = count(key);
  if (number > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    refuse(key, std::string(key) + " is too large");
  return static_cast<int>(number);
}

bool TomlTable::has(std::string_view key) const { return Access::of(*this).contains(key); }

TomlTable TomlTable::table(std::string_view key) {
  const toml::node& node = Access::required(*this, key);
  if (!node.is_table()) Access::refuse(*this, node.source(), std::string(key) + " must be a table");
  return {document_, node.as_table(), file_};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  std::vector<TomlTable> tables;
  for (const toml::node& node : Access::array(*this, key)) {
    if (!node.is_table()) Access::refuse(*this, node.source(), std::string(key) + " holds tables");
    tables.push_back({document_, node.as_table(), file_});
  }
  return tables;
}

std::vector<std::string> TomlTable::texts(std::string_view key) {
  return Access::list<std::string>(*this, key, "texts");
}
std::vector<double> TomlTable::numbers(std::string_view key) { return Access::list<double>(*this, key, "numbers"); }

void TomlTable::expect(std::string_view key, std::string_view wanted) {
  if (text(key) != wanted) refuse(key, std::string(key) + " must be \"" + std::string(wanted) + "\"");
}

void TomlTable::finish() const {
  for (const auto& [key, node] : Access::of(*this))
    if (!known_.contains(std::string(key.str())))
      Access::refuse(*this, key.source(), "unknown key \"" + std::string(key.str()) + "\"");
}

void TomlTable::refuse(std::string_view key, const std::string& what) const {
  const toml::node* node = Access::of(*this).get(key);
  Access::refuse(*this, node ? node->source() : Access::of(*this).source(), what);
}

void TomlWriter::add(const std::string& key, const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += "\n  " + quoted(text) + ",";
  raw(key, "[" + list + (list.empty() ? "]" : "\n]"));
}

std::string TomlWriter::quoted(const std::string& text) {
  const auto control = [](unsigned char letter) { return letter < 0x20 || letter == 0x7f; };
  std::ostringstream out;
  if (std::any_of(text.begin(), text.end(), control)) {  // one line whatever is in it
    out << '"' << std::hex << std::setfill('0');
    for (const char letter : text) {
      if (control(static_cast<unsigned char>(letter)))
        out << "\\u" << std::setw(4) << static_cast<int>(letter);
      else
        out << (letter == '"' || letter == '\\' ? "\\" : "") << letter;
    }
    out << '"';
    return out.str();
  }
  out << toml::value<std::string>(text);
  return out.str();
}

std::string TomlWriter::decimal(double value, int digits) {
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(digits);
  out << value;
  return out.str();
}

}  // namespace trocar
