// Pages of a PDF to draw on: A4, points (1/72 inch), x from the left, y from the top down. Text in DejaVu, embedded;
// what it lacks comes from another font of the machine, else as a box. The same calls make the same bytes.
//
// Cairo writes the pages, Pango lays the words out, librsvg draws the charts. Pages are kept as what is to be drawn
// until bytes(), so that any of them may be drawn on at any time. Thread: one.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <string>

struct _PangoLayout;  // Pango's

namespace trocar::printed {

using Colour = std::array<double, 3>;  ///< red, green, blue; 0..1
inline constexpr Colour kInk = {0.08, 0.10, 0.12}, kDim = {0.34, 0.39, 0.44}, kRule = {0.80, 0.83, 0.86},
                        kBlue = {0.0, 0.34, 0.54}, kGreen = {0.0, 0.42, 0.31}, kRed = {0.66, 0.25, 0.0},
                        kPale = {0.955, 0.965, 0.975};

struct Font {
  enum class Face : std::uint8_t { kPlain, kBold, kMono } face = Face::kPlain;
  double size = 9.4;                              ///< points
  double leading() const { return 1.36 * size; }  ///< from line to line
  auto operator<=>(const Font&) const = default;
};
constexpr Font plain(double size) { return {Font::Face::kPlain, size}; }
constexpr Font bold(double size) { return {Font::Face::kBold, size}; }
constexpr Font mono(double size) { return {Font::Face::kMono, size}; }

enum class Side : std::uint8_t { kLeft, kMiddle, kRight };  ///< of the words that x gives

/// Words in lines: wrapped between words, or inside one that is longer than a line.
class Lines {
 public:
  int count() const;     ///< at least 1
  double width() const;  ///< of the widest
  double height() const { return count() * font_.leading(); }

 private:
  friend class PdfPages;
  Lines(const Font& font, std::shared_ptr<_PangoLayout> layout) : font_(font), layout_(std::move(layout)) {}
  Font font_;
  std::shared_ptr<_PangoLayout> layout_;
};

class PdfPages {
 public:
  static constexpr double kWidth = 595.276, kHeight = 841.89;

  /// @param title in the file's properties. @param utc date of the file, ISO 8601 with time and zone; another text:
  /// none.
  /// @throws EnvironmentError: a font is missing.
  PdfPages(const std::string& title, const std::string& utc);
  ~PdfPages();
  PdfPages(const PdfPages&) = delete;
  PdfPages& operator=(const PdfPages&) = delete;

  void add();             ///< a page, which is then drawn on
  void choose(int page);  ///< from 0
  int count() const;

  /// @param words broken bytes and controls become boxes and spaces, a line's end stays. @param width 0: any.
  /// @param most lines, the last of which ends with an ellipsis where more was said; 0: any number.
  Lines lines(const std::string& words, const Font& font, double width = 0, int most = 0) const;
  /// Of the widest piece that is not broken between words.
  double width_of_word(const std::string& words, const Font& font) const;

  /// The first line stands on y, the next ones below. @param leading between them; 0: the font's.
  void text(double x, double y, const Lines& lines, const Colour& colour, Side side = Side::kLeft, double leading = 0);
  void text(double x, double y, const std::string& words, const Font& font, const Colour& colour,
            Side side = Side::kLeft);
  void text_line(double x, double y, const Lines& lines, int index, const Colour& colour, Side side = Side::kLeft);
  void line(double x0, double y0, double x1, double y1, double width, const Colour& colour);
  void fill(double x, double y, double width, double height, const Colour& colour);
  void frame(double x, double y, double width, double height, double line_width, const Colour& colour);
  /// An SVG with its left upper corner there, as lines and text, its words at least 6.2 points high. Nothing outside it
  /// is read. @return its height; 0 when it cannot be read.
  double chart(const std::string& svg, double x, double y, double width);
  double height_of_chart(const std::string& svg, double width);
  /// PNG. @return its height; 0 when it cannot be read.
  double picture(const std::string& png, double x, double y, double width);
  double height_of_picture(const std::string& png, double width);
  /// Large pale words across the page.
  void stamp(const std::string& words, const Colour& colour);

  /// @throws std::runtime_error: Cairo refused something.
  std::string bytes();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Height over width of a PNG; 0 when it cannot be read. Thread: any.
double shape_of_picture(const std::string& png);

}  // namespace trocar::printed
