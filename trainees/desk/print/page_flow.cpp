#include "trainees/desk/print/page_flow.h"

#include <algorithm>

namespace trocar::printed {
namespace {

constexpr Font kBody = plain(9.4), kSmall = plain(7.8), kLabel = plain(7.2), kLarge = bold(17);
constexpr double kGap = 14;

double figure_width(const Figures& figures, const Figure& figure) {
  return (PageFlow::kContent - kGap * static_cast<double>(figures.all.size() - 1)) * figure.share;
}

double figure_height(PageFlow& flow, const Figures& figures) {
  double highest = 0;
  for (const Figure& figure : figures.all) {
    const double width = figure_width(figures, figure);
    highest = std::max(highest, flow.pages().height_of_chart(figure.svg, width) + 4 +
                                    flow.height_of_words(figure.caption, kSmall, width));
  }
  return highest + 8;
}

Font font_of(const Facts& facts) { return facts.mono ? mono(7.4) : bold(kBody.size); }

/// Of the facts that stand side by side from that one on.
double fact_row_height(PageFlow& flow, const Facts& facts, std::size_t from) {
  const double width = PageFlow::kContent / facts.columns - 8;
  double highest = 0;
  for (std::size_t i = from; i < facts.pairs.size() && i < from + static_cast<std::size_t>(facts.columns); ++i)
    highest = std::max(highest, flow.height_of_words(facts.pairs[i].second, font_of(facts), width));
  return highest + kLabel.leading() + 5;
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
  return std::max(46.0, 22 + flow.height_of_words(verdict.reason, kBody, kVerdictReason));
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

void PageFlow::words(const std::string& text, const Font& font, const Colour& colour, double x, double width) {
  const Lines lines = pages_->lines(text, font, width);
  for (int i = 0; i < lines.count(); ++i) {
    if (!fits(font.leading())) next_page();
    y_ += font.leading();
    pages_->text_line(x, y_ - 0.3 * font.size, lines, i, colour);
  }
}

double PageFlow::height_of_words(const std::string& text, const Font& font, double width) const {
  return text.empty() ? 0 : pages_->lines(text, font, width).height();
}

void put(PageFlow& flow, const Heading& heading, double least_behind) {
  const Font font = bold(heading.level == 1 ? 14 : 11);
  if (heading.new_page && !flow.at_top()) flow.next_page();
  flow.need(2.2 * font.size + flow.height_of_words(heading.words, font) + least_behind);
  if (!flow.at_top()) flow.down(heading.level == 1 ? 16 : 10);
  flow.words(heading.words, font, heading.level == 1 ? kBlue : kInk);
  if (heading.level == 1) flow.pages().line(PageFlow::kLeft, flow.y() + 3, PageFlow::kRight, flow.y() + 3, 0.8, kBlue);
  flow.down(heading.level == 1 ? 8 : 3);
}

void put(PageFlow& flow, const Paragraph& paragraph) {
  const Font& font = paragraph.tone == Tone::kQuiet ? kSmall : kBody;
  const double indent = paragraph.mark ? 11 : 0, width = PageFlow::kContent - indent;
  flow.need(std::min(flow.height_of_words(paragraph.words, font, width), 3 * font.leading()));
  if (paragraph.mark)
    flow.pages().fill(PageFlow::kLeft + 1, flow.y() + 0.62 * font.size, 3.2, 3.2, colour_of(paragraph.tone));
  flow.words(paragraph.words, font, colour_of(paragraph.tone), PageFlow::kLeft + indent, width);
  flow.down(paragraph.mark ? 2 : 4);
}

void put(PageFlow& flow, const Facts& facts) {
  if (const double height = facts_height(flow, facts); height <= PageFlow::kKeptWhole) flow.need(height);
  flow.down(3);
  const double slot = PageFlow::kContent / facts.columns;
  const Font font = font_of(facts);
  for (std::size_t from = 0; from < facts.pairs.size(); from += static_cast<std::size_t>(facts.columns)) {
    const double height = fact_row_height(flow, facts, from);
    flow.need(height);
    for (std::size_t i = from; i < facts.pairs.size() && i < from + static_cast<std::size_t>(facts.columns); ++i) {
      const double x = PageFlow::kLeft + slot * static_cast<double>(i - from), y = flow.y() + kLabel.size;
      flow.pages().text(x, y, facts.pairs[i].first, kLabel, kDim);
      flow.pages().text(x, y + font.leading(), flow.pages().lines(facts.pairs[i].second, font, slot - 8), kInk);
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
    const double y = flow.y() + flow.pages().chart(figure.svg, x, flow.y(), width) + 4;
    flow.pages().text(x, y + kSmall.leading() - 0.3 * kSmall.size, flow.pages().lines(figure.caption, kSmall, width),
                      kDim);
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
  flow.words(picture.caption, kSmall, kDim);
  flow.down(6);
}

void put(PageFlow& flow, const Verdict& verdict) {
  const double height = verdict_height(flow, verdict), left = PageFlow::kLeft;
  flow.need(height);
  PdfPages& pages = flow.pages();
  pages.fill(left, flow.y(), PageFlow::kContent, height, kPale);
  pages.fill(left, flow.y(), 5, height, colour_of(verdict.tone));
  const double middle = flow.y() + 0.5 * height;
  pages.text(left + 16, middle + 6, pages.lines(verdict.word, kLarge, kVerdictWord - 26, 1), colour_of(verdict.tone));
  const Lines reason = pages.lines(verdict.reason, kBody, kVerdictReason);
  pages.text(left + kVerdictWord, middle - 0.5 * reason.height() - 0.3 * kBody.size + kBody.leading(), reason, kInk);
  pages.text(PageFlow::kRight - 8, middle + (verdict.under_number.empty() ? 6 : 1), verdict.number, kLarge, kInk,
             Side::kRight);
  pages.text(PageFlow::kRight - 8, middle + 13, pages.lines(verdict.under_number, kSmall, kVerdictNumber - 20, 1), kDim,
             Side::kRight);
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
  return 2 * kBody.leading();
}

}  // namespace trocar::printed
