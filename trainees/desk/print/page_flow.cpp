#include "trainees/desk/print/page_flow.h"

#include <algorithm>

namespace trocar::printed {
namespace {

constexpr double kBody = 9.4, kSmall = 7.8, kLabel = 7.2, kGap = 14;

double figure_width(const Figures& figures, const Figure& figure) {
  return (PageFlow::kContent - kGap * static_cast<double>(figures.all.size() - 1)) * figure.share;
}

double figure_height(PageFlow& flow, const Figures& figures) {
  double highest = 0;
  for (const Figure& figure : figures.all) {
    const double width = figure_width(figures, figure);
    const Drawing drawing = read_svg(figure.svg);
    highest = std::max(highest, width * drawing.height / drawing.width + 4 +
                                    flow.height_of_words(figure.caption, Face::kPlain, kSmall, width));
  }
  return highest + 8;
}

struct FactSize {
  Face face;
  double size;
};
FactSize size_of(const Facts& facts) { return facts.mono ? FactSize{Face::kMono, 7.4} : FactSize{Face::kBold, kBody}; }

/// Of the facts that stand side by side from that one on.
double fact_row_height(PageFlow& flow, const Facts& facts, std::size_t from) {
  const double width = PageFlow::kContent / facts.columns - 8;
  const auto [face, size] = size_of(facts);
  double highest = 0;
  for (std::size_t i = from; i < facts.pairs.size() && i < from + static_cast<std::size_t>(facts.columns); ++i)
    highest = std::max(highest, flow.height_of_words(facts.pairs[i].second, face, size, width));
  return highest + PageFlow::leading(kLabel) + 5;
}

/// Word, reason and number stand side by side.
constexpr double kVerdictWord = 140, kVerdictNumber = 136,
                 kVerdictReason = PageFlow::kContent - kVerdictWord - kVerdictNumber;

double facts_height(PageFlow& flow, const Facts& facts) {
  double out = 3;
  for (std::size_t from = 0; from < facts.pairs.size(); from += static_cast<std::size_t>(facts.columns))
    out += fact_row_height(flow, facts, from);
  return out;
}

double verdict_height(PageFlow& flow, const Verdict& verdict) {
  return std::max(46.0, 22 + flow.height_of_words(verdict.reason, Face::kPlain, kBody, kVerdictReason));
}

}  // namespace

const Colour& colour_of(Tone tone) {
  switch (tone) {
    case Tone::kGood:
      return kGreen;
    case Tone::kBad:
      return kRed;
    case Tone::kQuiet:
      return kDim;
    case Tone::kPlain:
      break;
  }
  return kInk;
}

void PageFlow::next_page() {
  pages_->add();
  y_ = kTop;
}

void PageFlow::need(double height) {
  if (!fits(height) && !at_top()) next_page();
}

int PageFlow::words(const std::string& text, Face face, double size, const Colour& colour, double x, double width) {
  const std::vector<std::string> lines = wrapped(printable(text), width, pages_->measure(face, size));
  for (const std::string& line : lines) {
    if (!fits(leading(size))) next_page();
    y_ += leading(size);
    pages_->text(x, y_ - 0.3 * size, line, face, size, colour);
  }
  return static_cast<int>(lines.size());
}

double PageFlow::height_of_words(const std::string& text, Face face, double size, double width) const {
  return text.empty()
             ? 0
             : leading(size) * static_cast<double>(wrapped(printable(text), width, pages_->measure(face, size)).size());
}

void put(PageFlow& flow, const Heading& heading, double least_behind) {
  const double size = heading.level == 1 ? 14 : 11;
  if (heading.new_page && !flow.at_top()) flow.next_page();
  flow.need(2.2 * size + flow.height_of_words(heading.words, Face::kBold, size) + least_behind);
  if (!flow.at_top()) flow.down(heading.level == 1 ? 16 : 10);
  flow.words(heading.words, Face::kBold, size, heading.level == 1 ? kBlue : kInk);
  if (heading.level == 1) flow.pages().line(PageFlow::kLeft, flow.y() + 3, PageFlow::kRight, flow.y() + 3, 0.8, kBlue);
  flow.down(heading.level == 1 ? 8 : 3);
}

void put(PageFlow& flow, const Paragraph& paragraph) {
  const bool quiet = paragraph.tone == Tone::kQuiet;
  const double size = quiet ? kSmall : kBody, indent = paragraph.mark ? 11 : 0, width = PageFlow::kContent - indent;
  const double whole = flow.height_of_words(paragraph.words, Face::kPlain, size, width);
  flow.need(std::min(whole, 3 * PageFlow::leading(size)));
  if (paragraph.mark)
    flow.pages().fill(PageFlow::kLeft + 1, flow.y() + 0.62 * size, 3.2, 3.2, colour_of(paragraph.tone));
  flow.words(paragraph.words, Face::kPlain, size, colour_of(paragraph.tone), PageFlow::kLeft + indent, width);
  flow.down(paragraph.mark ? 2 : 4);
}

void put(PageFlow& flow, const Facts& facts) {
  if (const double height = facts_height(flow, facts); height <= PageFlow::kKeptWhole) flow.need(height);
  flow.down(3);
  const double slot = PageFlow::kContent / facts.columns;
  const auto [face, size] = size_of(facts);
  for (std::size_t from = 0; from < facts.pairs.size(); from += static_cast<std::size_t>(facts.columns)) {
    const double height = fact_row_height(flow, facts, from);
    flow.need(height);
    for (std::size_t i = from; i < facts.pairs.size() && i < from + static_cast<std::size_t>(facts.columns); ++i) {
      const double x = PageFlow::kLeft + slot * static_cast<double>(i - from);
      double y = flow.y() + kLabel;
      flow.pages().text(x, y, printable(facts.pairs[i].first), Face::kPlain, kLabel, kDim);
      for (const std::string& line :
           wrapped(printable(facts.pairs[i].second), slot - 8, flow.pages().measure(face, size)))
        flow.pages().text(x, y += PageFlow::leading(size), line, face, size, kInk);
    }
    flow.down(height);
  }
  flow.down(4);
}

void put(PageFlow& flow, const Figures& figures) {
  if (figures.all.empty()) return;
  const double height = figure_height(flow, figures);
  flow.need(height);
  double x = PageFlow::kLeft;
  for (const Figure& figure : figures.all) {
    const double width = figure_width(figures, figure);
    double y = flow.y() + flow.pages().chart(figure.svg, x, flow.y(), width) + 4;
    for (const std::string& line :
         wrapped(printable(figure.caption), width, flow.pages().measure(Face::kPlain, kSmall)))
      flow.pages().text(x, (y += PageFlow::leading(kSmall)) - 0.3 * kSmall, line, Face::kPlain, kSmall, kDim);
    x += width + kGap;
  }
  flow.down(height);
}

void put(PageFlow& flow, const Picture& picture) {
  const double width = PageFlow::kContent * picture.share, height = flow.pages().height_of_picture(picture.png, width);
  if (height <= 0) return;
  flow.need(height + 20);
  flow.pages().picture(picture.png, PageFlow::kLeft, flow.y(), width);
  flow.down(height + 3);
  flow.words(picture.caption, Face::kPlain, kSmall, kDim);
  flow.down(6);
}

void put(PageFlow& flow, const Verdict& verdict) {
  const double height = verdict_height(flow, verdict), left = PageFlow::kLeft;
  flow.need(height);
  PdfPages& pages = flow.pages();
  pages.fill(left, flow.y(), PageFlow::kContent, height, kPale);
  pages.fill(left, flow.y(), 5, height, colour_of(verdict.tone));
  const double middle = flow.y() + 0.5 * height;
  pages.text(left + 16, middle + 6,
             shortened(printable(verdict.word), kVerdictWord - 26, pages.measure(Face::kBold, 17)), Face::kBold, 17,
             colour_of(verdict.tone));
  const auto lines = wrapped(printable(verdict.reason), kVerdictReason, pages.measure(Face::kPlain, kBody));
  double base = middle - 0.5 * PageFlow::leading(kBody) * static_cast<double>(lines.size()) - 0.3 * kBody;
  for (const std::string& line : lines)
    pages.text(left + kVerdictWord, base += PageFlow::leading(kBody), line, Face::kPlain, kBody, kInk);
  pages.text_right(PageFlow::kRight - 8, middle + (verdict.under_number.empty() ? 6 : 1), printable(verdict.number),
                   Face::kBold, 17, kInk);
  const double room = kVerdictNumber - 20;
  pages.text_right(PageFlow::kRight - 8, middle + 13,
                   shortened(printable(verdict.under_number), room, pages.measure(Face::kPlain, kSmall)), Face::kPlain,
                   kSmall, kDim);
  flow.down(height + 8);
}

double least_height(PageFlow& flow, const Block& block) {
  if (const auto* figures = std::get_if<Figures>(&block))
    return figures->all.empty() ? 0 : figure_height(flow, *figures);
  if (const auto* picture = std::get_if<Picture>(&block))
    return flow.pages().height_of_picture(picture->png, PageFlow::kContent * picture->share) + 20;
  if (const auto* verdict = std::get_if<Verdict>(&block)) return verdict_height(flow, *verdict);
  if (const auto* facts = std::get_if<Facts>(&block)) return std::min(facts_height(flow, *facts), PageFlow::kKeptWhole);
  if (const auto* table = std::get_if<Table>(&block)) return least_height(flow, *table);
  return 2 * PageFlow::leading(kBody);
}

}  // namespace trocar::printed
