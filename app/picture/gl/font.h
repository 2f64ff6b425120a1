// Text for the head-up display: DejaVu Sans through FreeType, measured and drawn with the same numbers.
//
// Sizes are pixels of the em square; positions are pixels, y down, at the baseline. The font comes from Debian's
// fonts-dejavu-core. Thread: one at a time (glyphs are cached).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace trocar {

struct Glyph {
  int width = 0, height = 0;           ///< px of the coverage bitmap
  int left = 0, top = 0;               ///< px from pen to the bitmap's left, from baseline up to its top
  double advance = 0;                  ///< px
  std::vector<std::uint8_t> coverage;  ///< width * height, 0..255
};

class FontSet {
 public:
  /// @throws EnvironmentError naming the places searched and the package.
  FontSet();
  ~FontSet();
  FontSet(FontSet&&) noexcept;

  /// Width of UTF-8 text, px. Malformed bytes count as the replacement character.
  double width(const std::string& text, int size, bool bold = false);
  double ascent(int size) const { return 0.928 * size; }  ///< DejaVu's own, px above the baseline
  double line_height(int size) const { return 1.164 * size; }
  const Glyph& glyph(char32_t code, int size, bool bold);

  /// `text` if it fits into `width` px, else its longest beginning that fits with an ellipsis.
  std::string fitted(const std::string& text, int size, bool bold, double width);
  /// Breaks at spaces into lines no wider than `width`; the last of `max_lines` gets an ellipsis when text is left.
  std::vector<std::string> wrapped(const std::string& text, int size, bool bold, double width, int max_lines);

 private:
  struct Faces;
  std::unique_ptr<Faces> faces_;
  std::unordered_map<std::uint64_t, Glyph> glyphs_;  ///< by code, size and face
};

/// Code points of UTF-8 text; each malformed byte gives U+FFFD.
std::u32string decode_utf8(const std::string& text);

}  // namespace trocar
