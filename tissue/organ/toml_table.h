// TOML files of organs, strictly read and canonically written: unknown keys, missing keys and wrong types are refused
// with line and column; what is written has fixed decimals, so that equal content is equal bytes. Thread: any, not the
// tick.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace trocar {

/// One table of a parsed file. Reads key by key; finish() refuses what was not asked for.
class TomlTable {
 public:
  /// @param file name for messages. @throws InputError with line and column
  static TomlTable parse(const std::string& text, const std::string& file);

  std::string text(std::string_view key);
  bool boolean(std::string_view key);
  double number(std::string_view key);      ///< finite
  std::size_t count(std::string_view key);  ///< >= 0
  int integer(std::string_view key);        ///< 0..2^31-1
  bool has(std::string_view key) const;
  TomlTable table(std::string_view key);
  std::vector<TomlTable> tables(std::string_view key);
  std::vector<std::string> texts(std::string_view key);
  std::vector<double> numbers(std::string_view key);
  /// Text that must be `wanted`.
  void expect(std::string_view key, std::string_view wanted);
  void finish() const;

  /// Refuses the value of a key. @throws InputError always
  [[noreturn]] void refuse(std::string_view key, const std::string& what) const;
  const std::string& file() const { return file_; }

 private:
  struct Document;
  struct Access;
  TomlTable(std::shared_ptr<const Document> document, const void* table, std::string file);

  std::shared_ptr<const Document> document_;  ///< keeps the tables alive
  const void* table_;                         ///< a table of the document
  std::string file_;
  std::set<std::string> known_;
};

/// Writes "key = value" lines.
class TomlWriter {
 public:
  void table(const std::string& name) { text_ += "\n[" + name + "]\n"; }
  void array_table(const std::string& name) { text_ += "\n[[" + name + "]]\n"; }
  void add(const std::string& key, const std::string& value) { raw(key, quoted(value)); }
  void add(const std::string& key, const char* value) { raw(key, quoted(value)); }
  void add(const std::string& key, bool value) { raw(key, value ? "true" : "false"); }
  void add(const std::string& key, std::size_t value) { raw(key, std::to_string(value)); }
  void add(const std::string& key, int value) { raw(key, std::to_string(value)); }
  void add(const std::string& key, double value, int digits) { raw(key, decimal(value, digits)); }
  void add(const std::string& key, const std::vector<std::string>& texts);
  void raw(const std::string& key, const std::string& value) { text_ += key + " = " + value + "\n"; }
  std::string text() && { return std::move(text_); }

  static std::string quoted(const std::string& text);
  static std::string decimal(double value, int digits);

 private:
  std::string text_;
};

}  // namespace trocar
