// Strict reading of TOML: every key is asked for by name, with its type and range; whatever is left over is an error.
//
// Every error is an InputError "FILE:LINE:COLUMN: message" that names the key, with the nearest known key as a hint.
// Numbers must be finite. The parser itself stays behind the .cpp file. Thread: loading only.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

/// Number of single-character edits between two words (insert, delete, replace).
int edit_distance(const std::string& a, const std::string& b);
/// The word of `known` nearest to `word`, or "" when none is within about a third of its length.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);
/// "a, b, c"
std::string joined(const std::vector<std::string>& words);
/// Reads a whole file. @throws InputError naming the file when it cannot be read.
std::string read_text_file(const std::string& path);

class StrictTable {
 public:
  /// @param text the whole document. @param file name for messages.
  static StrictTable parse(const std::string& text, const std::string& file);

  bool has(const std::string& key) const;
  /// The key is known here and may be absent.
  void allow(const std::string& key);
  /// Number in [low, high]; integers are accepted as numbers.
  double number(const std::string& key, double low, double high);
  double number_or(const std::string& key, double low, double high, double fallback);
  int integer(const std::string& key, int low, int high);
  int integer_or(const std::string& key, int low, int high, int fallback);
  bool flag_or(const std::string& key, bool fallback);
  std::string text(const std::string& key);
  std::string text_or(const std::string& key, const std::string& fallback);
  std::string choice(const std::string& key, const std::vector<std::string>& allowed);
  std::string choice_or(const std::string& key, const std::vector<std::string>& allowed, const std::string& fallback);
  /// Array of one to `most` of the allowed words.
  std::vector<std::string> choices(const std::string& key, const std::vector<std::string>& allowed, std::size_t most);
  /// Array of one to `most` texts. @param refusal why one is none; "" where it is
  std::vector<std::string> texts(const std::string& key, std::size_t most,
                                 const std::function<std::string(const std::string&)>& refusal);
  /// Array of three numbers, each in [low, high].
  Vec3 vector(const std::string& key, double low, double high);
  /// Array of two numbers, each in [low, high].
  std::pair<double, double> pair(const std::string& key, double low, double high);
  /// Array of at least one such pair.
  std::vector<std::pair<double, double>> pairs(const std::string& key, double low, double high);
  /// Array of at least `least` arrays of three such numbers.
  std::vector<Vec3> vectors(const std::string& key, std::size_t least, double low, double high);
  Vec3 vector_or(const std::string& key, double low, double high, const Vec3& fallback);
  /// Number or the given word, which reads as `meaning`.
  double number_or_word(const std::string& key, double low, double high, const std::string& word, double meaning);
  StrictTable table(const std::string& key);
  /// Array of at least one table.
  std::vector<StrictTable> tables(const std::string& key);

  /// Call last. @throws InputError when a key was never asked for.
  void finish() const;
  /// @throws InputError at the place of `key` (of the table when the key is absent).
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;

 private:
  struct Node;
  std::vector<double> numbers(const std::string& key, std::size_t count, double low, double high);
  explicit StrictTable(std::shared_ptr<Node> node);
  std::shared_ptr<Node> node_;
};

}  // namespace trocar
