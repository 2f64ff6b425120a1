#include "trainees/desk/print/pdf_pages.h"

#include <hpdf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "haptics/input_error.h"
#include "trainees/desk/print/png_check.h"

namespace trocar::printed {
namespace {

/// Haru calls it from C: it may not throw. What went wrong stays in the document and is looked at in the end.
void keep_quiet(HPDF_STATUS, HPDF_STATUS, void*) {}

std::string font_file(const std::string& file) {
  std::string searched;
  for (const char* place : {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu", "/usr/share/fonts/TTF",
                            "/usr/share/fonts/dejavu-sans-fonts", "/usr/local/share/fonts"}) {
    const std::filesystem::path path = std::filesystem::path(place) / file;
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored)) return path.string();
    searched += std::string(" ") + place;
  }
  throw EnvironmentError("font " + file + " not found in" + searched + "; install fonts-dejavu-core");
}

/// Properties of a PDF are of the one-byte set that begins with Latin-1.
std::string property_text(const std::string& utf8) {
  std::string out;
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    const auto c = static_cast<unsigned char>(utf8[i]);
    const unsigned next = i + 1 < utf8.size() ? static_cast<unsigned char>(utf8[i + 1]) : 0U;
    if (c < 0x80)
      out += c < 0x20 ? ' ' : utf8[i];
    else if ((c == 0xC2 || c == 0xC3) && next >= (c == 0xC2 ? 0xA1U : 0x80U))
      out += static_cast<char>(((c & 3U) << 6) | (next & 0x3FU));
    else if (c >= 0xC0)
      out += '?';
  }
  return out;
}

/// The date as a PDF has it; false when the text is none.
bool date_of(const std::string& utc, HPDF_Date& out) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  const int found = std::sscanf(utc.c_str(), "%4d-%2d-%2dT%2d:%2d:%2d", &year, &month, &day, &hour, &minute, &second);
  if (found < 3 || year < 1900 || month < 1 || month > 12 || day < 1 || day > 31 || hour > 23 || minute > 59 ||
      second > 59)
    return false;
  out = {year, month, day, hour, minute, second, 'Z', 0, 0};
  return true;
}

HPDF_REAL real(double value) { return static_cast<HPDF_REAL>(std::isfinite(value) ? value : 0); }

constexpr double kLeastWords = 6.2;  // points: below it nobody reads

}  // namespace

struct PdfPages::State {
  HPDF_Doc document = nullptr;
  std::map<Face, HPDF_Font> fonts;
  std::vector<HPDF_Page> pages;
  HPDF_Page page = nullptr;
  std::map<std::pair<int, int>, HPDF_ExtGState> opacities;  // in thousandths
  std::map<std::string, HPDF_Image> pictures;

  HPDF_Image image(const std::string& png) {
    const auto [it, added] = pictures.try_emplace(png, nullptr);
    if (added && whole_png(png))
      it->second = HPDF_LoadPngImageFromMem(document, reinterpret_cast<const HPDF_BYTE*>(png.data()),
                                            static_cast<HPDF_UINT>(png.size()));
    if (it->second == nullptr) HPDF_ResetError(document);  // a broken picture is none
    return it->second;
  }
  void ink(const Colour& c) const { HPDF_Page_SetRGBFill(page, real(c[0]), real(c[1]), real(c[2])); }
  void pen(const Colour& c) const { HPDF_Page_SetRGBStroke(page, real(c[0]), real(c[1]), real(c[2])); }
};

PdfPages::PdfPages(const std::string& title, const std::string& utc) : state_(std::make_unique<State>()) {
  const std::map<Face, std::string> files = {{Face::kPlain, font_file("DejaVuSans.ttf")},
                                             {Face::kBold, font_file("DejaVuSans-Bold.ttf")},
                                             {Face::kMono, font_file("DejaVuSansMono.ttf")}};
  state_->document = HPDF_New(keep_quiet, nullptr);
  if (state_->document == nullptr) throw EnvironmentError("PDF: not enough memory");
  HPDF_Doc document = state_->document;
  HPDF_SetCompressionMode(document, HPDF_COMP_ALL);
  HPDF_UseUTFEncodings(document);
  for (const auto& [face, file] : files) {
    const char* name = HPDF_LoadTTFontFromFile(document, file.c_str(), HPDF_TRUE);
    const HPDF_Font font = name == nullptr ? nullptr : HPDF_GetFont(document, name, "UTF-8");
    if (font == nullptr) {
      HPDF_Free(document);
      throw EnvironmentError(file + ": cannot be read as a font; reinstall fonts-dejavu-core");
    }
    state_->fonts[face] = font;
  }
  HPDF_SetInfoAttr(document, HPDF_INFO_TITLE, property_text(title).c_str());
  HPDF_SetInfoAttr(document, HPDF_INFO_CREATOR, "Trocar");
  HPDF_Date date{};
  if (date_of(utc, date)) HPDF_SetInfoDateAttr(document, HPDF_INFO_CREATION_DATE, date);
}

PdfPages::~PdfPages() { HPDF_Free(state_->document); }

void PdfPages::add() {
  state_->page = HPDF_AddPage(state_->document);
  HPDF_Page_SetSize(state_->page, HPDF_PAGE_SIZE_A4, HPDF_PAGE_PORTRAIT);
  state_->pages.push_back(state_->page);
}

void PdfPages::choose(int page) { state_->page = state_->pages.at(static_cast<std::size_t>(page)); }

int PdfPages::count() const { return static_cast<int>(state_->pages.size()); }

double PdfPages::width_of(const std::string& words, Face face, double size) const {
  const HPDF_TextWidth width = HPDF_Font_TextWidth(
      state_->fonts.at(face), reinterpret_cast<const HPDF_BYTE*>(words.data()), static_cast<HPDF_UINT>(words.size()));
  return size * width.width / 1000.0;
}

WidthOf PdfPages::measure(Face face, double size) const {
  return [this, face, size](const std::string& words) { return width_of(words, face, size); };
}

void PdfPages::text(double x, double y, const std::string& words, Face face, double size, const Colour& colour) {
  if (words.empty()) return;
  state_->ink(colour);
  HPDF_Page_BeginText(state_->page);
  HPDF_Page_SetFontAndSize(state_->page, state_->fonts.at(face), real(size));
  HPDF_Page_TextOut(state_->page, real(x), real(kHeight - y), words.c_str());
  HPDF_Page_EndText(state_->page);
}

void PdfPages::text_right(double x, double y, const std::string& words, Face face, double size, const Colour& colour) {
  text(x - width_of(words, face, size), y, words, face, size, colour);
}

void PdfPages::text_middle(double x, double y, const std::string& words, Face face, double size, const Colour& colour) {
  text(x - 0.5 * width_of(words, face, size), y, words, face, size, colour);
}

void PdfPages::line(double x0, double y0, double x1, double y1, double width, const Colour& colour) {
  state_->pen(colour);
  HPDF_Page_SetLineWidth(state_->page, real(width));
  HPDF_Page_MoveTo(state_->page, real(x0), real(kHeight - y0));
  HPDF_Page_LineTo(state_->page, real(x1), real(kHeight - y1));
  HPDF_Page_Stroke(state_->page);
}

void PdfPages::fill(double x, double y, double width, double height, const Colour& colour) {
  state_->ink(colour);
  HPDF_Page_Rectangle(state_->page, real(x), real(kHeight - y - height), real(width), real(height));
  HPDF_Page_Fill(state_->page);
}

void PdfPages::frame(double x, double y, double width, double height, double line_width, const Colour& colour) {
  state_->pen(colour);
  HPDF_Page_SetLineWidth(state_->page, real(line_width));
  HPDF_Page_Rectangle(state_->page, real(x), real(kHeight - y - height), real(width), real(height));
  HPDF_Page_Stroke(state_->page);
}

void PdfPages::set_opacity(double fill, double stroke) {
  HPDF_ExtGState& known =
      state_->opacities[{static_cast<int>(std::lround(1000 * fill)), static_cast<int>(std::lround(1000 * stroke))}];
  if (known == nullptr) {
    known = HPDF_CreateExtGState(state_->document);
    HPDF_ExtGState_SetAlphaFill(known, real(fill));
    HPDF_ExtGState_SetAlphaStroke(known, real(stroke));
  }
  HPDF_Page_SetExtGState(state_->page, known);
}

/// Slanted lines at the pattern's distance, within the shape.
void PdfPages::hatch(const Shape::Run& run, double x, double y, double scale) {
  double x0 = 1e9, x1 = -1e9, y0 = 1e9, y1 = -1e9;
  for (const Point& p : run.points) {
    x0 = std::min(x0, x + scale * p.x);
    x1 = std::max(x1, x + scale * p.x);
    y0 = std::min(y0, y + scale * p.y);
    y1 = std::max(y1, y + scale * p.y);
  }
  if (x1 <= x0 || y1 <= y0) return;
  HPDF_Page_GSave(state_->page);
  HPDF_Page_Rectangle(state_->page, real(x0), real(kHeight - y1), real(x1 - x0), real(y1 - y0));
  HPDF_Page_Clip(state_->page);
  HPDF_Page_EndPath(state_->page);
  set_opacity(1, 0.4);
  const double step = std::max(2.5, 11.3 * scale), tall = y1 - y0;
  for (double at = x0 - tall; at < x1; at += step) line(at, y0, at + tall, y1, 2 * scale, {0.835, 0.369, 0});
  HPDF_Page_GRestore(state_->page);
}

void PdfPages::words_of_chart(const Shape& shape, double x, double y, double scale, double font_size) {
  const Face face = shape.bold ? Face::kBold : Face::kPlain;
  const double size = std::max(kLeastWords, font_size * scale);
  const std::string words = printable(shape.words);
  const double wide = width_of(words, face, size), at = x + scale * shape.at.x;
  const double left = shape.anchor == "end" ? at - wide : shape.anchor == "middle" ? at - 0.5 * wide : at;
  text(left, y + scale * shape.at.y, words, face, size, shape.fill.value_or(kInk));
}

void PdfPages::shape(const Shape& shape, double x, double y, double scale, double font_size) {
  if (shape.kind == Shape::Kind::kText) return words_of_chart(shape, x, y, scale, font_size);
  const bool circle = shape.kind == Shape::Kind::kCircle;
  if (shape.hatched)
    for (const Shape::Run& run : shape.runs) hatch(run, x, y, scale);
  const bool filled = shape.fill && shape.fill_opacity > 0, drawn = shape.stroke && shape.stroke_opacity > 0;
  if (!filled && !drawn) return;
  const HPDF_Page page = state_->page;
  HPDF_Page_GSave(page);
  set_opacity(shape.fill_opacity, shape.stroke_opacity);
  if (filled) state_->ink(*shape.fill);
  if (drawn) state_->pen(*shape.stroke);
  HPDF_Page_SetLineWidth(page, real(std::max(0.3, scale * shape.stroke_width)));
  HPDF_Page_SetLineJoin(page, HPDF_ROUND_JOIN);
  if (shape.round) HPDF_Page_SetLineCap(page, HPDF_ROUND_END);
  if (!shape.dash.empty()) {
    // Haru 2.3 takes whole numbers: never 0, which would draw nothing.
    std::vector<HPDF_UINT16> dash;
    for (std::size_t i = 0; i < shape.dash.size() && i < 4; ++i)
      dash.push_back(static_cast<HPDF_UINT16>(std::max(1L, std::lround(shape.dash[i] * scale))));
    HPDF_Page_SetDash(page, dash.data(), static_cast<HPDF_UINT>(dash.size()), 0);
  }
  if (circle)
    HPDF_Page_Circle(page, real(x + scale * shape.at.x), real(kHeight - y - scale * shape.at.y),
                     real(scale * shape.radius));
  for (const Shape::Run& run : shape.runs) {
    for (std::size_t i = 0; i < run.points.size(); ++i) {
      const HPDF_REAL px = real(x + scale * run.points[i].x), py = real(kHeight - y - scale * run.points[i].y);
      i == 0 ? HPDF_Page_MoveTo(page, px, py) : HPDF_Page_LineTo(page, px, py);
    }
    if (run.closed) HPDF_Page_ClosePath(page);
  }
  if (filled && drawn)
    HPDF_Page_FillStroke(page);
  else if (filled)
    HPDF_Page_Fill(page);
  else
    HPDF_Page_Stroke(page);
  HPDF_Page_GRestore(page);
}

double PdfPages::chart(const std::string& svg, double x, double y, double width) {
  const Drawing drawing = read_svg(svg);
  const double scale = width / drawing.width;
  for (const Shape& one : drawing.shapes) {
    const bool nothing =
        one.kind == Shape::Kind::kLines &&
        std::none_of(one.runs.begin(), one.runs.end(), [](const Shape::Run& run) { return run.points.size() > 1; });
    if (!nothing) shape(one, x, y, scale, drawing.font_size);
  }
  return scale * drawing.height;
}

double PdfPages::height_of_picture(const std::string& png, double width) {
  const HPDF_Image image = state_->image(png);
  if (image == nullptr) return 0;
  const HPDF_Point size = HPDF_Image_GetSize(image);
  return size.x > 0 ? width * size.y / size.x : 0;
}

double PdfPages::picture(const std::string& png, double x, double y, double width) {
  const double height = height_of_picture(png, width);
  if (height > 0)
    HPDF_Page_DrawImage(state_->page, state_->image(png), real(x), real(kHeight - y - height), real(width),
                        real(height));
  return height;
}

void PdfPages::stamp(const std::string& words, const Colour& colour) {
  constexpr double kSlant = 0.86;  // rad, along the page's diagonal
  const double size = std::min(120.0, 680.0 / std::max(1.0, width_of(words, Face::kBold, 1)));
  const double half = 0.5 * width_of(words, Face::kBold, size), c = std::cos(kSlant), s = std::sin(kSlant);
  HPDF_Page_GSave(state_->page);
  set_opacity(0.07, 1);
  state_->ink(colour);
  HPDF_Page_BeginText(state_->page);
  HPDF_Page_SetFontAndSize(state_->page, state_->fonts.at(Face::kBold), real(size));
  HPDF_Page_SetTextMatrix(state_->page, real(c), real(s), real(-s), real(c),
                          real(0.5 * kWidth - half * c + 0.35 * size * s),
                          real(0.5 * kHeight - half * s - 0.35 * size * c));
  HPDF_Page_ShowText(state_->page, words.c_str());
  HPDF_Page_EndText(state_->page);
  HPDF_Page_GRestore(state_->page);
}

std::string PdfPages::bytes() {
  HPDF_SaveToStream(state_->document);
  if (const HPDF_STATUS error = HPDF_GetError(state_->document); error != HPDF_OK)
    throw std::runtime_error("PDF: the library refused something (error " + std::to_string(error) + ")");
  HPDF_ResetStream(state_->document);
  std::string out(HPDF_GetStreamSize(state_->document), '\0');
  auto size = static_cast<HPDF_UINT32>(out.size());
  if (size > 0) HPDF_ReadFromStream(state_->document, reinterpret_cast<HPDF_BYTE*>(out.data()), &size);
  out.resize(size);
  return out;
}

}  // namespace trocar::printed
