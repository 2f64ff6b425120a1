#include "app/picture/gl/font.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>

#include "haptics/input_error.h"
#include "haptics/utf8.h"

namespace trocar {
namespace {

std::filesystem::path find_font(const std::string& file) {
  std::vector<std::filesystem::path> places;
  if (const char* home = std::getenv("XDG_DATA_HOME")) places.emplace_back(std::filesystem::path(home) / "fonts");
  for (const char* place : {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu", "/usr/share/fonts/TTF",
                            "/usr/share/fonts/dejavu-sans-fonts", "/usr/local/share/fonts"})
    places.emplace_back(place);
  std::string searched;
  for (const auto& place : places) {
    std::error_code ignored;
    if (std::filesystem::exists(place / file, ignored)) return place / file;
    searched += " " + place.string();
  }
  throw EnvironmentError("font " + file + " not found in" + searched + "; install fonts-dejavu-core");
}

}  // namespace

std::u32string decode_utf8(const std::string& text) {
  std::u32string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    const auto lead = static_cast<unsigned char>(text[at]);
    char32_t code = length == 0 ? U'\xFFFD' : length == 1 ? lead : lead & (0x7FU >> length);
    for (std::size_t n = 1; n < length; ++n) code = code << 6 | (static_cast<unsigned char>(text[at + n]) & 0x3FU);
    out.push_back(code);
    at += std::max<std::size_t>(1, length);
  }
  return out;
}

struct FontSet::Faces {
  FT_Library library = nullptr;
  std::array<FT_Face, 2> face{};  // regular, bold
  Faces() {
    if (FT_Init_FreeType(&library)) throw EnvironmentError("FreeType cannot start");
    const std::array<const char*, 2> files = {"DejaVuSans.ttf", "DejaVuSans-Bold.ttf"};
    for (std::size_t i = 0; i < files.size(); ++i) {
      const std::filesystem::path path = find_font(files[i]);
      if (FT_New_Face(library, path.c_str(), 0, &face[i]))
        throw EnvironmentError("font " + path.string() + " cannot be read");
    }
  }
  Faces(const Faces&) = delete;
  Faces& operator=(const Faces&) = delete;
  ~Faces() { FT_Done_FreeType(library); }
};

FontSet::FontSet() : faces_(std::make_unique<Faces>()) {}
FontSet::~FontSet() = default;
FontSet::FontSet(FontSet&&) noexcept = default;

const Glyph& FontSet::glyph(char32_t code, int size, bool bold) {
  const std::uint64_t key = std::uint64_t{code} << 32 | static_cast<std::uint32_t>(size) << 1 | (bold ? 1u : 0u);
  const auto [place, inserted] = glyphs_.try_emplace(key);
  Glyph& glyph = place->second;
  if (!inserted) return glyph;
  FT_Face face = faces_->face[bold ? 1 : 0];
  FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size));
  if (FT_Load_Char(face, code, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT)) return glyph;
  const FT_Bitmap& bitmap = face->glyph->bitmap;
  glyph.width = static_cast<int>(bitmap.width);
  glyph.height = static_cast<int>(bitmap.rows);
  glyph.left = face->glyph->bitmap_left;
  glyph.top = face->glyph->bitmap_top;
  glyph.advance = static_cast<double>(face->glyph->advance.x) / 64;
  for (int y = 0; y < glyph.height; ++y)
    glyph.coverage.insert(glyph.coverage.end(), bitmap.buffer + y * bitmap.pitch,
                          bitmap.buffer + y * bitmap.pitch + glyph.width);
  return glyph;
}

double FontSet::width(const std::string& text, int size, bool bold) {
  double sum = 0;
  for (const char32_t code : decode_utf8(text)) sum += glyph(code, size, bold).advance;
  return sum;
}

std::string FontSet::fitted(const std::string& text, int size, bool bold, double room) {
  if (width(text, size, bold) <= room) return text;
  const double left = room - width("\u2026", size, bold);
  std::size_t end = 0;
  for (double used = 0; end < text.size();) {
    const std::size_t length = std::max<std::size_t>(1, utf8_length(text, end));
    used += width(text.substr(end, length), size, bold);
    if (used > left) break;
    end += length;
  }
  while (end > 0 && text[end - 1] == ' ') --end;
  return left < 0 ? std::string() : text.substr(0, end) + "\u2026";
}

std::vector<std::string> FontSet::wrapped(const std::string& text, int size, bool bold, double room, int max_lines) {
  std::vector<std::string> lines;
  std::string line, rest = text;
  while (!rest.empty()) {
    const std::size_t space = rest.find(' ');
    const std::string word = rest.substr(0, space);
    const std::string longer = line.empty() ? word : line + " " + word;
    if (!line.empty() && width(longer, size, bold) > room) {
      if (static_cast<int>(lines.size()) + 1 == max_lines) {
        lines.push_back(fitted(line + " " + rest, size, bold, room));
        return lines;
      }
      lines.push_back(fitted(line, size, bold, room));
      line.clear();
      continue;
    }
    line = longer;
    rest = space == std::string::npos ? std::string() : rest.substr(space + 1);
  }
  if (!line.empty() || lines.empty()) lines.push_back(fitted(line, size, bold, room));
  return lines;
}

}  // namespace trocar
