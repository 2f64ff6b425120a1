// Pages of a PDF to draw on: A4, points (1/72 inch), x from the left, y from the top down. Text in DejaVu, embedded, so
// that every name prints; what the font lacks prints as a box. The same calls make the same bytes.
//
// Haru behind; it takes one page after the other, and any of them again. Thread: one.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "trainees/desk/print/fitted_text.h"
#include "trainees/desk/print/svg_shapes.h"

namespace trocar::printed {

enum class Face : std::uint8_t { kPlain, kBold, kMono };
inline constexpr Colour kInk = {0.08, 0.10, 0.12}, kDim = {0.34, 0.39, 0.44}, kRule = {0.80, 0.83, 0.86},
                        kBlue = {0.0, 0.34, 0.54}, kGreen = {0.0, 0.42, 0.31}, kRed = {0.66, 0.25, 0.0},
                        kPale = {0.955, 0.965, 0.975};

class PdfPages {
 public:
  static constexpr double kWidth = 595.276, kHeight = 841.89;

  /// @param title in the file's properties. @param utc date of the file, ISO 8601; "" or another text: none.
  /// @throws EnvironmentError: a font is missing.
  PdfPages(const std::string& title, const std::string& utc);
  ~PdfPages();
  PdfPages(const PdfPages&) = delete;
  PdfPages& operator=(const PdfPages&) = delete;

  void add();             ///< a page, which is then drawn on
  void choose(int page);  ///< from 0
  int count() const;

  double width_of(const std::string& words, Face face, double size) const;
  WidthOf measure(Face face, double size) const;
  /// On its base line. @param words one line, printable().
  void text(double x, double y, const std::string& words, Face face, double size, const Colour& colour);
  void text_right(double x, double y, const std::string& words, Face face, double size, const Colour& colour);
  void text_middle(double x, double y, const std::string& words, Face face, double size, const Colour& colour);
  void line(double x0, double y0, double x1, double y1, double width, const Colour& colour);
  void fill(double x, double y, double width, double height, const Colour& colour);
  void frame(double x, double y, double width, double height, double line_width, const Colour& colour);
  /// A chart with its left upper corner there. @return its height. @throws std::invalid_argument as read_svg.
  double chart(const std::string& svg, double x, double y, double width);
  /// PNG. @return its height; 0 when it is none.
  double picture(const std::string& png, double x, double y, double width);
  double height_of_picture(const std::string& png, double width);
  /// Large pale words across the page.
  void stamp(const std::string& words, const Colour& colour);

  std::string bytes();

 private:
  struct State;
  void shape(const Shape& shape, double x, double y, double scale, double font_size);
  void words_of_chart(const Shape& shape, double x, double y, double scale, double font_size);
  void hatch(const Shape::Run& run, double x, double y, double scale);
  void set_opacity(double fill, double stroke);
  std::unique_ptr<State> state_;
};

}  // namespace trocar::printed
