#include "trainees/desk/print/pdf_pages.h"

#include <cairo-pdf.h>
#include <librsvg/rsvg.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "haptics/input_error.h"
#include "trainees/markup/html.h"
#include "trainees/markup/svg.h"

#ifdef __SANITIZE_ADDRESS__
/// Fontconfig and who asks it keep what was found until the program ends.
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig"; }
#endif

namespace trocar::printed {
namespace {

template <class T>
std::shared_ptr<T> owned(T* object) {
  return {object, g_object_unref};
}

using Description = std::unique_ptr<PangoFontDescription, decltype(&pango_font_description_free)>;
using Characters = std::unique_ptr<char, decltype(&g_free)>;

const char* name_of(Font::Face face) {
  return face == Font::Face::kMono   ? "DejaVu Sans Mono"
         : face == Font::Face::kBold ? "DejaVu Sans Bold"
                                     : "DejaVu Sans";
}

Description description(const Font& font) {
  Description out(pango_font_description_from_string(name_of(font.face)), pango_font_description_free);
  pango_font_description_set_absolute_size(out.get(), font.size * PANGO_SCALE);
  return out;
}

/// @throws EnvironmentError: fontconfig names another one in its place.
void need_font(PangoContext* context, const Font& font) {
  const std::string wanted = name_of(font.face);
  if (PangoFont* found = pango_context_load_font(context, description(font).get()); found != nullptr) {
    const Description got(pango_font_describe(found), pango_font_description_free);
    g_object_unref(found);
    pango_font_description_unset_fields(got.get(), PANGO_FONT_MASK_SIZE);
    if (wanted == Characters(pango_font_description_to_string(got.get()), g_free).get()) return;
  }
  throw EnvironmentError("font " + wanted + " not found by fontconfig; install fonts-dejavu-core");
}

/// Lengths in points, letters where the font's own widths put them. @throws EnvironmentError: a font is missing.
std::shared_ptr<PangoContext> context_of_points() {
  auto out = owned(pango_font_map_create_context(pango_cairo_font_map_get_default()));
  const std::unique_ptr<cairo_font_options_t, decltype(&cairo_font_options_destroy)> options(
      cairo_font_options_create(), cairo_font_options_destroy);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  pango_cairo_context_set_font_options(out.get(), options.get());
  pango_cairo_context_set_resolution(out.get(), 72);
  pango_context_set_round_glyph_positions(out.get(), FALSE);
  for (const Font& font : {plain(10), bold(10), mono(10)}) need_font(out.get(), font);
  return out;
}

std::string printable(const std::string& text) {
  const Characters valid(g_utf8_make_valid(text.data(), static_cast<gssize>(text.size())), g_free);
  std::string out = valid.get();
  for (char& c : out)
    if (g_ascii_iscntrl(c) && c != '\n') c = ' ';
  return out;
}

/// The date as Cairo takes it; "" when the text is not both date and time with its zone.
std::string date_of(const std::string& utc) {
  GDateTime* date = g_date_time_new_from_iso8601(utc.c_str(), nullptr);
  if (date == nullptr) return "";
  const Characters text(g_date_time_format(date, "%Y-%m-%dT%H:%M:%SZ"), g_free);
  g_date_time_unref(date);
  return text.get();
}

/// What is left to be read is moved on. @param from std::string_view
cairo_status_t read_bytes(void* from, unsigned char* to, unsigned length) {
  auto& left = *static_cast<std::string_view*>(from);
  if (length > left.size()) return CAIRO_STATUS_READ_ERROR;
  left.copy(reinterpret_cast<char*>(to), length);
  left.remove_prefix(length);
  return CAIRO_STATUS_SUCCESS;
}

using Pixels = std::shared_ptr<cairo_surface_t>;

/// @return null when it is broken, or wider or higher than 8191 pixels.
Pixels pixels_of(const std::string& png) {
  constexpr std::size_t kWidthAt = 16, kHeightAt = 20, kPixelsAt = 24;
  const auto modest = [&](std::size_t at) { return png[at] == 0 && png[at + 1] == 0 && (png[at + 2] & 0xE0) == 0; };
  if (png.size() < kPixelsAt || !modest(kWidthAt) || !modest(kHeightAt)) return nullptr;
  std::string_view left = png;
  Pixels out(cairo_image_surface_create_from_png_stream(read_bytes, &left), cairo_surface_destroy);
  return cairo_surface_status(out.get()) == CAIRO_STATUS_SUCCESS ? out : nullptr;
}

double shape_of(const Pixels& pixels) {
  return pixels == nullptr ? 0
                           : static_cast<double>(cairo_image_surface_get_height(pixels.get())) /
                                 cairo_image_surface_get_width(pixels.get());
}

struct Chart {
  std::shared_ptr<RsvgHandle> svg = {};
  double width = 1, shape = 0;  ///< of the viewBox; height over width, 0: cannot be drawn
};

/// Read without an address of its own, so that it can name no file.
Chart chart_of(const std::string& svg) {
  std::string whole = svg::without_links(svg);
  if (whole.starts_with("<svg ") && whole.find(" xmlns=") > whole.find('>'))
    whole.insert(4, " xmlns=\"http://www.w3.org/2000/svg\"");
  Chart out;
  auto* handle = rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(whole.data()), whole.size(), nullptr);
  if (handle == nullptr) return out;
  out.svg = owned(handle);
  gboolean ignored = FALSE, boxed = FALSE;
  RsvgLength length;
  RsvgRectangle box{};
  rsvg_handle_get_intrinsic_dimensions(handle, &ignored, &length, &ignored, &length, &boxed, &box);
  const double shape = box.height / box.width;
  if (boxed == FALSE || !(shape > 0 && shape < 10)) return out;
  out.width = box.width;
  out.shape = shape;
  return out;
}

/// As on the desk's pages. @param least size of words, in the chart's own lengths.
std::string chart_style(double least) {
  const auto size = [&](double usual) { return fixed_text(std::max(usual, least), 3) + "px"; };
  return "svg{overflow:visible;stroke-linejoin:round;font-family:'DejaVu Sans';font-size:" + size(14) +
         "}svg text:not([fill]){fill:#27313b}.square{font-size:" + size(20) + "}";
}

/// Where the last character begins.
std::size_t begin_of_last(const std::string& text) {
  return static_cast<std::size_t>(g_utf8_prev_char(text.data() + text.size()) - text.data());
}

cairo_status_t append(void* to, const unsigned char* bytes, unsigned length) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

void set_colour(cairo_t* cr, const Colour& c, double opacity = 1) {
  cairo_set_source_rgba(cr, c[0], c[1], c[2], opacity);
}

}  // namespace

struct PdfPages::State {
  using Drawing = std::function<void(cairo_t*)>;
  std::string title, date;
  std::shared_ptr<PangoContext> context = context_of_points();
  std::vector<std::vector<Drawing>> pages = {};
  std::size_t page = 0;
  std::map<std::tuple<std::string, Font, double, int>, std::shared_ptr<PangoLayout>> layouts = {};  // asked for often
  std::map<std::string, Chart> charts = {};
  std::map<std::string, Pixels> pictures = {};

  void draw(Drawing one) { pages.at(page).push_back(std::move(one)); }
  const Chart& chart(const std::string& svg) {
    const auto [it, added] = charts.try_emplace(svg);
    if (added) it->second = chart_of(svg);
    return it->second;
  }
  const Pixels& picture(const std::string& png) {
    const auto [it, added] = pictures.try_emplace(png);
    if (added) it->second = pixels_of(png);
    return it->second;
  }

  std::shared_ptr<PangoLayout> layout(const std::string& words, const Font& font, int width, PangoWrapMode wrap) const {
    auto out = owned(pango_layout_new(context.get()));
    pango_layout_set_font_description(out.get(), description(font).get());
    pango_layout_set_text(out.get(), words.data(), static_cast<int>(words.size()));
    pango_layout_set_width(out.get(), width);
    pango_layout_set_wrap(out.get(), wrap);
    const std::unique_ptr<PangoAttrList, decltype(&pango_attr_list_unref)> attributes(pango_attr_list_new(),
                                                                                      pango_attr_list_unref);
    pango_attr_list_insert(attributes.get(), pango_attr_insert_hyphens_new(FALSE));  // a hash is copied as it stands
    pango_layout_set_attributes(out.get(), attributes.get());
    return out;
  }
};

int Lines::count() const { return pango_layout_get_line_count(layout_.get()); }

double Lines::width() const {
  PangoRectangle box;
  pango_layout_get_extents(layout_.get(), nullptr, &box);
  return pango_units_to_double(box.width);
}

PdfPages::PdfPages(const std::string& title, const std::string& utc)
    : state_(new State{printable(title), date_of(utc)}) {}

PdfPages::~PdfPages() = default;

void PdfPages::add() {
  state_->page = state_->pages.size();
  state_->pages.emplace_back();
}

void PdfPages::choose(int page) {
  state_->page = static_cast<std::size_t>(page);
  static_cast<void>(state_->pages.at(state_->page));
}

int PdfPages::count() const { return static_cast<int>(state_->pages.size()); }

Lines PdfPages::lines(const std::string& words, const Font& font, double width, int most) const {
  std::shared_ptr<PangoLayout>& layout = state_->layouts[{words, font, width, most}];
  if (layout != nullptr) return {font, layout};
  const int units = width > 0 ? pango_units_from_double(width) : -1;
  std::string text = printable(words);
  layout = state_->layout(text, font, units, PANGO_WRAP_WORD_CHAR);
  const auto too_many = [&] { return most > 0 && pango_layout_get_line_count(layout.get()) > most; };
  if (too_many())
    text.resize(static_cast<std::size_t>(pango_layout_get_line_readonly(layout.get(), most)->start_index));
  while (too_many()) {
    while (text.ends_with(' ') || text.ends_with('\n')) text.pop_back();
    layout = state_->layout(text + "\xE2\x80\xA6", font, units, PANGO_WRAP_WORD_CHAR);
    if (text.empty()) break;
    text.resize(begin_of_last(text));
  }
  return {font, layout};
}

double PdfPages::width_of_word(const std::string& words, const Font& font) const {
  return Lines(font, state_->layout(printable(words), font, 0, PANGO_WRAP_WORD)).width();
}

void PdfPages::text_line(double x, double y, const Lines& lines, int index, const Colour& colour, Side side) {
  PangoLayoutLine* line = pango_layout_get_line_readonly(lines.layout_.get(), index);
  PangoRectangle box;
  pango_layout_line_get_extents(line, nullptr, &box);
  const double before = side == Side::kLeft ? 0 : side == Side::kMiddle ? 0.5 : 1;
  const double left = x - before * pango_units_to_double(box.width);
  state_->draw([=, kept = lines.layout_](cairo_t* cr) {
    set_colour(cr, colour);
    cairo_move_to(cr, left, y);
    pango_cairo_show_layout_line(cr, line);
  });
}

void PdfPages::text(double x, double y, const Lines& lines, const Colour& colour, Side side, double leading) {
  for (int i = 0; i < lines.count(); ++i)
    text_line(x, y + i * (leading > 0 ? leading : lines.font_.leading()), lines, i, colour, side);
}

void PdfPages::text(double x, double y, const std::string& words, const Font& font, const Colour& colour, Side side) {
  text(x, y, lines(words, font), colour, side);
}

void PdfPages::line(double x0, double y0, double x1, double y1, double width, const Colour& colour) {
  state_->draw([=](cairo_t* cr) {
    set_colour(cr, colour);
    cairo_set_line_width(cr, width);
    cairo_move_to(cr, x0, y0);
    cairo_line_to(cr, x1, y1);
    cairo_stroke(cr);
  });
}

void PdfPages::fill(double x, double y, double width, double height, const Colour& colour) {
  state_->draw([=](cairo_t* cr) {
    set_colour(cr, colour);
    cairo_rectangle(cr, x, y, width, height);
    cairo_fill(cr);
  });
}

void PdfPages::frame(double x, double y, double width, double height, double line_width, const Colour& colour) {
  state_->draw([=](cairo_t* cr) {
    set_colour(cr, colour);
    cairo_set_line_width(cr, line_width);
    cairo_rectangle(cr, x, y, width, height);
    cairo_stroke(cr);
  });
}

double PdfPages::height_of_chart(const std::string& svg, double width) { return width * state_->chart(svg).shape; }

double PdfPages::chart(const std::string& svg, double x, double y, double width) {
  constexpr double kLeastWords = 6.2;  // points: below it nobody reads
  const Chart& chart = state_->chart(svg);
  const RsvgRectangle box{x, y, width, width * chart.shape};
  if (box.height <= 0) return 0;
  state_->draw([=](cairo_t* cr) {
    const std::string style = chart_style(kLeastWords * chart.width / width);
    rsvg_handle_set_stylesheet(chart.svg.get(), reinterpret_cast<const guint8*>(style.data()), style.size(), nullptr);
    rsvg_handle_render_document(chart.svg.get(), cr, &box, nullptr);
  });
  return box.height;
}

double PdfPages::height_of_picture(const std::string& png, double width) {
  return width * shape_of(state_->picture(png));
}

double PdfPages::picture(const std::string& png, double x, double y, double width) {
  const Pixels& pixels = state_->picture(png);
  if (pixels == nullptr) return 0;
  state_->draw([=](cairo_t* cr) {
    cairo_save(cr);
    cairo_translate(cr, x, y);
    const double scale = width / cairo_image_surface_get_width(pixels.get());
    cairo_scale(cr, scale, scale);
    cairo_set_source_surface(cr, pixels.get(), 0, 0);
    cairo_paint(cr);
    cairo_restore(cr);
  });
  return width * shape_of(pixels);
}

void PdfPages::stamp(const std::string& words, const Colour& colour) {
  constexpr double kSlant = 0.86;  // rad, along the page's diagonal
  const double size = std::min(120.0, 680.0 / std::max(1.0, lines(words, bold(1)).width()));
  const Lines stamped = lines(words, bold(size));
  state_->draw([=](cairo_t* cr) {
    cairo_save(cr);
    cairo_translate(cr, 0.5 * kWidth, 0.5 * kHeight);
    cairo_rotate(cr, -kSlant);
    cairo_move_to(cr, -0.5 * stamped.width(), 0.35 * size);
    set_colour(cr, colour, 0.07);
    pango_cairo_show_layout_line(cr, pango_layout_get_line_readonly(stamped.layout_.get(), 0));
    cairo_restore(cr);
  });
}

std::string PdfPages::bytes() {
  std::string out;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_pdf_surface_create_for_stream(append, &out, kWidth, kHeight), cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, state_->title.c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, "Trocar");
  // Without one Cairo would take the clock's.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 state_->date.empty() ? nullptr : state_->date.c_str());
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cr(cairo_create(surface.get()), cairo_destroy);
  for (const auto& page : state_->pages) {
    for (const State::Drawing& draw : page) draw(cr.get());
    cairo_show_page(cr.get());
  }
  cairo_surface_finish(surface.get());
  for (const cairo_status_t status : {cairo_status(cr.get()), cairo_surface_status(surface.get())})
    if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(std::string("PDF: ") + cairo_status_to_string(status));
  return out;
}

double shape_of_picture(const std::string& png) { return shape_of(pixels_of(png)); }

}  // namespace trocar::printed
