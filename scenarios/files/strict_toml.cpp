#include "scenarios/files/strict_toml.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include <toml++/toml.h>

#include "haptics/input_error.h"
#include "haptics/toml_keys.h"

namespace trocar {

struct StrictTable::Node {
  std::shared_ptr<const toml::table> document;  ///< keeps `table` alive
  const toml::table* table = nullptr;
  std::string file;
  std::vector<std::string> asked;
};

namespace {

InputError error_at(const std::string& file, const toml::source_region& where, const std::string& message) {
  return InputError(file, static_cast<int>(where.begin.line), static_cast<int>(where.begin.column), message);
}

std::string short_number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace

int edit_distance(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  int best_distance = static_cast<int>(std::max<std::size_t>(2, word.size() / 3)) + 1;
  for (const std::string& candidate : known) {
    const int distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string read_text_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (in && in.peek() == std::ifstream::traits_type::eof() && !in.bad()) throw InputError(path + ": is empty");
  if (!in || !(text << in.rdbuf())) throw InputError(path + ": cannot be read");
  return text.str();
}

StrictTable::StrictTable(std::shared_ptr<Node> node) : node_(std::move(node)) {}

StrictTable StrictTable::parse(const std::string& text, const std::string& file) {
  auto node = std::make_shared<Node>();
  node->file = file;
  require_short_keys(text, file);
  try {
    node->document = std::make_shared<const toml::table>(toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    throw error_at(file, error.source(), std::string(error.description()));
  }
  node->table = node->document.get();
  return StrictTable(node);
}

bool StrictTable::has(const std::string& key) const { return node_->table->contains(key); }

void StrictTable::allow(const std::string& key) { node_->asked.push_back(key); }

void StrictTable::fail(const std::string& key, const std::string& message) const {
  const toml::node* value = node_->table->get(key);
  throw error_at(node_->file, value ? value->source() : node_->table->source(), message);
}

namespace {

/// The value of a key that must exist; a key that is nearly it, and not otherwise known, is taken for a slip.
const toml::node& required(const toml::table& table, const std::string& file, std::vector<std::string>& asked,
                           const std::string& key) {
  asked.push_back(key);
  if (const toml::node* value = table.get(key)) return *value;
  for (const auto& [name, value] : table) {
    const std::string found(name.str());
    if (std::find(asked.begin(), asked.end(), found) != asked.end()) continue;
    if (nearest_word(found, {key}) == key)
      throw error_at(file, name.source(), "unknown key '" + found + "': did you mean '" + key + "'?");
  }
  throw error_at(file, table.source(), "missing key '" + key + "'");
}

double checked_number(const toml::node& value, const std::string& file, const std::string& key, double low,
                      double high) {
  if (!value.is_number()) throw error_at(file, value.source(), "'" + key + "' must be a number");
  const double number = *value.value<double>();
  if (!std::isfinite(number)) throw error_at(file, value.source(), "'" + key + "' must be finite");
  if (number < low || number > high) {
    throw error_at(file, value.source(),
                   "'" + key + "' = " + short_number(number) + " is out of range " + short_number(low) + " to " +
                       short_number(high));
  }
  return number;
}

}  // namespace

double StrictTable::number(const std::string& key, double low, double high) {
  const toml::node& value = required(*node_->table, node_->file, node_->asked, key);
  return checked_number(value, node_->file, key, low, high);
}

double StrictTable::number_or(const std::string& key, double low, double high, double fallback) {
  if (has(key)) return number(key, low, high);
  node_->asked.push_back(key);
  return fallback;
}

double StrictTable::number_or_word(const std::string& key, double low, double high, const std::string& word,
                                   double meaning) {
  const toml::node& value = required(*node_->table, node_->file, node_->asked, key);
  if (!value.is_string()) return checked_number(value, node_->file, key, low, high);
  if (value.value<std::string>() != word) fail(key, "'" + key + "' must be a number or \"" + word + "\"");
  return meaning;
}

int StrictTable::integer(const std::string& key, int low, int high) {
  const toml::node& value = required(*node_->table, node_->file, node_->asked, key);
  if (!value.is_integer()) fail(key, "'" + key + "' must be a whole number");
  return static_cast<int>(checked_number(value, node_->file, key, low, high));
}

int StrictTable::integer_or(const std::string& key, int low, int high, int fallback) {
  if (has(key)) return integer(key, low, high);
  node_->asked.push_back(key);
  return fallback;
}

bool StrictTable::flag_or(const std::string& key, bool fallback) {
  node_->asked.push_back(key);
  const toml::node* value = node_->table->get(key);
  if (!value) return fallback;
  if (!value->is_boolean()) fail(key, "'" + key + "' must be true or false");
  return *value->value<bool>();
}

std::string StrictTable::text(const std::string& key) {
  const toml::node& value = required(*node_->table, node_->file, node_->asked, key);
  if (!value.is_string()) fail(key, "'" + key + "' must be a text in quotes");
  const std::string text = *value.value<std::string>();
  if (text.empty()) fail(key, "'" + key + "' must not be empty");
  return text;
}

std::string StrictTable::text_or(const std::string& key, const std::string& fallback) {
  if (has(key)) return text(key);
  node_->asked.push_back(key);
  return fallback;
}

namespace {

/// What to say of a word that is none of the allowed ones; empty: it is one.
std::string choice_refusal(const std::string& key, const std::string& word, const std::vector<std::string>& allowed) {
  if (std::find(allowed.begin(), allowed.end(), word) != allowed.end()) return "";
  const std::string near = nearest_word(word, allowed);
  return "'" + key + "' is \"" + word + "\": known are " + joined(allowed) +
         (near.empty() ? "" : "; did you mean '" + near + "'?");
}

}  // namespace

std::string StrictTable::choice(const std::string& key, const std::vector<std::string>& allowed) {
  const std::string word = text(key);
  if (const std::string refusal = choice_refusal(key, word, allowed); !refusal.empty()) fail(key, refusal);
  return word;
}

std::vector<std::string> StrictTable::texts(const std::string& key, std::size_t most,
                                            const std::function<std::string(const std::string&)>& refusal) {
  const toml::node& value = required(*node_->table, node_->file, node_->asked, key);
  const toml::array* array = value.as_array();
  if (!array || array->empty() || array->size() > most)
    fail(key, "'" + key + "' must be an array of 1 to " + std::to_string(most) + " names");
  std::vector<std::string> out;
  for (const toml::node& element : *array) {
    if (!element.is_string()) throw error_at(node_->file, element.source(), "'" + key + "' must hold names in quotes");
    out.push_back(*element.value<std::string>());
    if (const std::string why = refusal(out.back()); !why.empty()) throw error_at(node_->file, element.source(), why);
  }
  return out;
}

std::vector<std::string> StrictTable::choices(const std::string& key, const std::vector<std::string>& allowed,
                                              std::size_t most) {
  return texts(key, most, [&](const std::string& word) { return choice_refusal(key, word, allowed); });
}

std::string StrictTable::choice_or(const std::string& key, const std::vector<std::string>& allowed,
                                   const std::string& fallback) {
  if (has(key)) return choice(key, allowed);
  node_->asked.push_back(key);
  return fallback;
}

std::vector<double> StrictTable::numbers(const std::string& key, std::size_t count, double low, double high) {
  const toml::node& value = required(*node_->table, node_->file, node_->asked, key);
  const toml::array* array = value.as_array();
  if (!array || array->size() != count)
    fail(key, "'" + key + "' must be an array of " + std::to_string(count) + " numbers");
  std::vector<double> result;
  for (const toml::node& element : *array) result.push_back(checked_number(element, node_->file, key, low, high));
  return result;
}

Vec3 StrictTable::vector(const std::string& key, double low, double high) {
  const std::vector<double> values = numbers(key, 3, low, high);
  return {values[0], values[1], values[2]};
}

std::pair<double, double> StrictTable::pair(const std::string& key, double low, double high) {
  const std::vector<double> values = numbers(key, 2, low, high);
  return {values[0], values[1]};
}

Vec3 StrictTable::vector_or(const std::string& key, double low, double high, const Vec3& fallback) {
  if (has(key)) return vector(key, low, high);
  node_->asked.push_back(key);
  return fallback;
}

std::vector<std::pair<double, double>> StrictTable::pairs(const std::string& key, double low, double high) {
  const toml::node& value = required(*node_->table, node_->file, node_->asked, key);
  const toml::array* array = value.as_array();
  if (!array || array->empty()) fail(key, "'" + key + "' must be an array of [low, high] pairs");
  std::vector<std::pair<double, double>> result;
  for (const toml::node& element : *array) {
    const toml::array* both = element.as_array();
    if (!both || both->size() != 2)
      throw error_at(node_->file, element.source(), "'" + key + "' must hold pairs [low, high]");
    result.emplace_back(checked_number(*both->get(0), node_->file, key, low, high),
                        checked_number(*both->get(1), node_->file, key, low, high));
  }
  return result;
}

std::vector<Vec3> StrictTable::vectors(const std::string& key, std::size_t least, double low, double high) {
  const toml::node& value = required(*node_->table, node_->file, node_->asked, key);
  const toml::array* array = value.as_array();
  if (!array || array->size() < least)
    fail(key, "'" + key + "' must be an array of at least " + std::to_string(least) + " points [x, y, z]");
  std::vector<Vec3> result;
  for (const toml::node& element : *array) {
    const toml::array* point = element.as_array();
    if (!point || point->size() != 3)
      throw error_at(node_->file, element.source(), "'" + key + "' must hold points [x, y, z]");
    Vec3 read;
    for (std::size_t i = 0; i < 3; ++i)
      read[static_cast<Eigen::Index>(i)] = checked_number(*point->get(i), node_->file, key, low, high);
    result.push_back(read);
  }
  return result;
}

StrictTable StrictTable::table(const std::string& key) {
  const toml::node& value = required(*node_->table, node_->file, node_->asked, key);
  if (!value.is_table()) fail(key, "'" + key + "' must be a table [" + key + "]");
  return StrictTable(std::make_shared<Node>(Node{node_->document, value.as_table(), node_->file, {}}));
}

std::vector<StrictTable> StrictTable::tables(const std::string& key) {
  const toml::node& value = required(*node_->table, node_->file, node_->asked, key);
  const toml::array* array = value.as_array();
  if (!array || array->empty() || !array->is_homogeneous<toml::table>())
    fail(key, "'" + key + "' must be an array of tables [[" + key + "]]");
  std::vector<StrictTable> result;
  for (const toml::node& element : *array)
    result.push_back(StrictTable(std::make_shared<Node>(Node{node_->document, element.as_table(), node_->file, {}})));
  return result;
}

void StrictTable::finish() const {
  for (const auto& [name, value] : *node_->table) {
    const std::string key(name.str());
    if (std::find(node_->asked.begin(), node_->asked.end(), key) != node_->asked.end()) continue;
    const std::string near = nearest_word(key, node_->asked);
    throw error_at(node_->file, name.source(),
                   "unknown key '" + key + "'" +
                       (near.empty() ? ": known are " + joined(node_->asked) : ": did you mean '" + near + "'?"));
  }
}

}  // namespace trocar
