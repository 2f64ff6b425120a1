#include "trainees/progress/rules.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <toml++/toml.h>

#include "haptics/input_error.h"
#include "haptics/toml_keys.h"

namespace trocar {
namespace {

InputError error_at(const std::string& name, const toml::source_region& where, const std::string& what) {
  return InputError(name, static_cast<int>(where.begin.line), static_cast<int>(where.begin.column), what);
}

std::string short_text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

/// One table of the file; every key is asked for, what is left over is an error.
class Section {
 public:
  Section(const toml::table& document, std::string name, const std::string& file)
      : name_(std::move(name)), file_(file) {
    const toml::node* node = document.get(name_);
    if (node == nullptr) return;
    if (!node->is_table()) throw error_at(file_, node->source(), "'" + name_ + "' must be a table: [" + name_ + "]");
    table_ = node->as_table();
  }

  void read(const char* key, double& value, double low, double high) {
    if (const toml::node* node = asked(key)) value = checked(*node, key, low, high);
  }

  void read(const char* key, int& value, int low, int high) {
    const toml::node* node = asked(key);
    if (node == nullptr) return;
    if (!node->is_integer()) throw error_at(file_, node->source(), called(key) + " must be a whole number");
    value = static_cast<int>(checked(*node, key, low, high));
  }

  /// Whole numbers that rise.
  void read(const char* key, std::vector<int>& values, int low, int high) {
    const toml::node* node = asked(key);
    if (node == nullptr) return;
    if (!node->is_array()) throw error_at(file_, node->source(), called(key) + " must be a list of whole numbers");
    values.clear();
    for (const toml::node& entry : *node->as_array()) {
      if (!entry.is_integer()) throw error_at(file_, entry.source(), called(key) + " must hold whole numbers");
      const int value = static_cast<int>(checked(entry, key, low, high));
      if (!values.empty() && value <= values.back()) throw error_at(file_, entry.source(), called(key) + " must rise");
      values.push_back(value);
    }
  }

  void require(bool holds, const char* key, const std::string& what) const {
    if (!holds)
      throw error_at(file_, table_->get(key) != nullptr ? table_->get(key)->source() : table_->source(), what);
  }

  void finish() const {
    if (table_ == nullptr) return;
    for (const auto& [key, value] : *table_)
      if (std::find(asked_.begin(), asked_.end(), key.str()) == asked_.end())
        throw error_at(file_, key.source(),
                       "unknown key '" + std::string(key.str()) + "' in [" + name_ + "]: known are " + known());
  }

 private:
  std::string called(const char* key) const { return "'" + name_ + "." + key + "'"; }

  const toml::node* asked(const char* key) {
    asked_.emplace_back(key);
    return table_ == nullptr ? nullptr : table_->get(key);
  }

  double checked(const toml::node& node, const char* key, double low, double high) const {
    if (!node.is_number()) throw error_at(file_, node.source(), called(key) + " must be a number");
    const double value = *node.value<double>();
    if (std::isfinite(value) && value >= low && value <= high) return value;
    throw error_at(
        file_, node.source(),
        called(key) + " = " + short_text(value) + " is out of range " + short_text(low) + " to " + short_text(high));
  }

  std::string known() const {
    std::string out;
    for (const std::string& key : asked_) out += (out.empty() ? "" : ", ") + key;
    return out;
  }

  std::string name_, file_;
  const toml::table* table_ = nullptr;
  std::vector<std::string> asked_;
};

toml::table parsed(const std::string& text, const std::string& name) {
  require_short_keys(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw error_at(name, error.source(), std::string(error.description()));
  }
}

void read_version(const toml::table& document, const std::string& name, ProgressRules& rules) {
  const toml::node* version = document.get("version");
  if (version == nullptr) throw error_at(name, document.source(), "missing key 'version': every decision names it");
  const auto text = version->value<std::string>();
  if (!version->is_string() || text->empty() || text->size() > 32)
    throw error_at(name, version->source(), "'version' must be a text of 1 to 32 characters");
  rules.version = *text;
}

void read_flags(const toml::table& document, const std::string& name, ProgressRules& rules) {
  Section unlock(document, "unlock", name), stuck(document, "stuck", name), unsafe(document, "unsafe", name),
      integrity(document, "integrity", name), plateau(document, "plateau", name);
  unlock.read("passes_in_a_row", rules.passes_to_unlock, 1, 100);
  stuck.read("attempts", rules.stuck_after, 2, 1000);
  unsafe.read("window", rules.unsafe_window, 1, 1000);
  unsafe.read("attempts", rules.unsafe_attempts, 1, 1000);
  unsafe.require(rules.unsafe_attempts <= rules.unsafe_window, "attempts",
                 "'unsafe.attempts' must not exceed 'unsafe.window'");
  integrity.read("window", rules.integrity_window, 1, 1000);
  integrity.read("attempts", rules.integrity_attempts, 1, 1000);
  integrity.read("late_share", rules.late_share, 0, 1);
  integrity.require(rules.integrity_attempts <= rules.integrity_window, "attempts",
                    "'integrity.attempts' must not exceed 'integrity.window'");
  plateau.read("window", rules.plateau_window, 3, 1000);
  plateau.read("rise", rules.plateau_rise, 0, 100);
  for (const Section* section : {&unlock, &stuck, &unsafe, &integrity, &plateau}) section->finish();
}

void read_decisions(const toml::table& document, const std::string& name, ProgressRules& rules) {
  Section tests(document, "cusum", name), ready(document, "ready", name), retention(document, "retention", name),
      rasch(document, "rasch", name);
  tests.read("adequate", rules.cusum.adequate, 1e-4, 0.99);
  tests.read("inadequate", rules.cusum.inadequate, 1e-4, 0.99);
  tests.read("shown_at", rules.cusum.shown_at, 0.01, 100);
  tests.read("relapse_at", rules.cusum.relapse_at, 0.01, 100);
  tests.require(rules.cusum.adequate < rules.cusum.inadequate, "adequate",
                "'cusum.adequate' must be less than 'cusum.inadequate'");
  ready.read("least_reliability", rules.least_reliability, 0, 0.999);
  ready.read("window", rules.reliability_window, 3, 1000);
  retention.read("days", rules.retention_days, 1, 3660);
  retention.read("early_days", rules.retention_early_days, 0, 365);
  rasch.read("least_attempts", rules.rasch_least_attempts, 1, 100000000);
  rasch.read("largest_standard_error", rules.rasch_largest_se, 0.01, 10);
  for (const Section* section : {&tests, &ready, &retention, &rasch}) section->finish();
}

}  // namespace

ProgressRules read_progress_rules(const std::string& toml, const std::string& name) {
  const toml::table document = parsed(toml, name);
  const std::vector<std::string> known{"version", "unlock", "stuck", "unsafe",    "integrity",
                                       "plateau", "cusum",  "ready", "retention", "rasch"};
  for (const auto& [key, value] : document)
    if (std::find(known.begin(), known.end(), key.str()) == known.end())
      throw error_at(name, key.source(), "unknown key '" + std::string(key.str()) + "'");
  ProgressRules rules;
  read_version(document, name, rules);
  read_flags(document, name, rules);
  read_decisions(document, name, rules);
  return rules;
}

}  // namespace trocar
