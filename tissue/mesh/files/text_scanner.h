// Words and numbers of a text file one after the other, with the line for messages.
//
// Numbers are read without a locale; only finite ones pass. Thread: one owner; the text must outlive it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace trocar {

class TextScanner {
 public:
  /// @param file name for messages
  TextScanner(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  /// The next word, stepping over blanks and ends of lines; "" at the end of the text.
  std::string_view word();
  /// As word(), without taking it.
  std::string_view peek();
  /// The rest of the line, its end taken but not returned.
  std::string_view line();
  bool at_end();

  /// @param what for the message: "x of vertex 7" @throws InputError with the line: no finite number
  double number(const char* what);
  /// @throws InputError with the line: no whole number from `least` to `most`
  std::int64_t whole(const char* what, std::int64_t least, std::int64_t most);

  /// Raw bytes from here on, and stepping over them.
  std::string_view rest() const { return text_.substr(offset_); }
  void skip(std::size_t bytes) { offset_ += bytes; }

  [[noreturn]] void refuse(const std::string& what) const;

 private:
  void skip_blanks();

  std::string_view text_;
  std::string file_;
  std::size_t offset_ = 0;
  int line_ = 1;
};

/// One word as a finite number. @return whether it is one
bool to_number(std::string_view word, double& value);
/// One word as a whole number. @return whether it is one
bool to_whole(std::string_view word, std::int64_t& value);

}  // namespace trocar
