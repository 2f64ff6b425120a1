// Tables over pages: the head comes again on each, a row stays whole, a word that is too long is broken, a cell that is
// too long ends with an ellipsis.
#include <algorithm>
#include <numeric>

#include "trainees/desk/print/page_flow.h"

namespace trocar::printed {
namespace {

constexpr Font kPlainCell = plain(8), kMonoCell = mono(6.8), kTitle = bold(7.2), kCaption = plain(7.2);
constexpr double kStep = 1.28 * 8, kHeadStep = 1.2 * 7.2, kPad = 5, kRowPad = 4.4, kDrawnHeight = 21, kUsualWord = 50;
constexpr int kMostLines = 8;

const Font& font_of(const Column& column) { return column.mono ? kMonoCell : kPlainCell; }

class TableOnPages {
 public:
  TableOnPages(PageFlow& flow, const Table& table) : flow_(flow), table_(table) { set_widths(); }

  /// Of all of it. @param most after which it is not looked at further.
  double height(double most) const {
    double out = 40;
    for (const auto& row : table_.rows) {
      out += height_of(row, lines_of(row));
      if (out > most) break;
    }
    return out;
  }

  void draw() {
    if (const double whole = height(PageFlow::kKeptWhole); whole <= PageFlow::kKeptWhole) flow_.need(whole);
    head(false);
    for (const auto& row : table_.rows) {
      const std::vector<Lines> lines = lines_of(row);
      const double height = height_of(row, lines);
      if (!flow_.fits(height)) {
        flow_.next_page();
        head(true);
      }
      put_row(row, lines, height);
    }
    if (table_.rows.empty()) flow_.words(table_.none, kPlainCell, kDim);
    flow_.down(8);
  }

 private:
  /// Room for the longest word of the head and of the cells, but for hashes and words that are longer than usual.
  double least_width(std::size_t column) const {
    const Column& about = table_.columns[column];
    double out = flow_.pages().width_of_word(about.title, kTitle);
    for (const auto& row : table_.rows) {
      if (about.mono || column >= row.size()) continue;
      const double wide = flow_.pages().width_of_word(row[column].words, font_of(about));
      out = std::max(out, about.number ? wide : std::min(wide, kUsualWord));
    }
    return std::min(out + kPad + 0.5, 2 * PageFlow::kContent / static_cast<double>(table_.columns.size()));
  }

  /// By the shares, yet none narrower than its least, where all of these have room.
  void set_widths() {
    const std::size_t count = table_.columns.size();
    std::vector<double> least(count, 0);
    double shares = 0, left = PageFlow::kContent, narrowest = 0;
    for (std::size_t i = 0; i < count; ++i) {
      least[i] = least_width(i);
      narrowest += least[i];
      shares += table_.columns[i].share;
    }
    if (narrowest > 0.97 * PageFlow::kContent) std::fill(least.begin(), least.end(), 0.0);
    widths_.assign(count, 0);
    for (bool again = true; again;) {
      again = false;
      for (std::size_t i = 0; i < count; ++i) {
        if (widths_[i] > 0 || left * table_.columns[i].share / shares >= least[i]) continue;
        widths_[i] = least[i];
        left -= least[i];
        shares -= table_.columns[i].share;
        again = true;
      }
    }
    for (std::size_t i = 0; i < count; ++i)
      if (widths_[i] <= 0) widths_[i] = left * table_.columns[i].share / shares;
  }

  double inner(std::size_t column) const { return widths_[column] - kPad; }

  void head(bool again) {
    std::vector<Lines> titles;
    int most = 1;
    for (std::size_t i = 0; i < widths_.size(); ++i) {
      titles.push_back(flow_.pages().lines(table_.columns[i].title, kTitle, inner(i), 3));
      most = std::max(most, titles.back().count());
    }
    if (!table_.caption.empty()) flow_.words(table_.caption + (again ? " (continued)" : ""), kCaption, kDim);
    if (table_.rows.empty()) return;
    for (std::size_t i = 0; i < widths_.size(); ++i)
      put_words(i, flow_.y() + 3 + kHeadStep * (most - titles[i].count() + 1), titles[i], kHeadStep, kInk);
    flow_.down(3 + kHeadStep * most + 4);
    flow_.pages().line(PageFlow::kLeft, flow_.y(), PageFlow::kRight, flow_.y(), 0.9, kInk);
  }

  double left_of(std::size_t column) const {
    return std::accumulate(widths_.begin(), widths_.begin() + static_cast<std::ptrdiff_t>(column), PageFlow::kLeft);
  }

  void put_words(std::size_t column, double y, const Lines& words, double step, const Colour& colour) {
    const bool number = table_.columns[column].number;
    flow_.pages().text(left_of(column) + (number ? inner(column) : 0), y, words, colour,
                       number ? Side::kRight : Side::kLeft, step);
  }

  std::vector<Lines> lines_of(const std::vector<Cell>& row) const {
    std::vector<Lines> out;
    for (std::size_t i = 0; i < widths_.size() && i < row.size(); ++i)
      out.push_back(flow_.pages().lines(row[i].words, font_of(table_.columns[i]), inner(i), kMostLines));
    return out;
  }

  double height_of(const std::vector<Cell>& row, const std::vector<Lines>& lines) const {
    double highest = 0;
    for (std::size_t i = 0; i < lines.size(); ++i)
      highest = std::max(highest, row[i].svg.empty() ? kStep * lines[i].count() : kDrawnHeight);
    return highest + kRowPad;
  }

  void put_row(const std::vector<Cell>& row, const std::vector<Lines>& lines, double height) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (row[i].svg.empty())
        put_words(i, flow_.y() + 0.5 * kRowPad + 0.78 * kStep, lines[i], kStep, colour_of(row[i].tone));
      else
        flow_.pages().chart(row[i].svg, left_of(i), flow_.y() + 2, std::min(inner(i), kDrawnHeight * 120.0 / 34.0));
    }
    flow_.down(height);
    flow_.pages().line(PageFlow::kLeft, flow_.y(), PageFlow::kRight, flow_.y(), 0.35, kRule);
  }

  PageFlow& flow_;
  const Table& table_;
  std::vector<double> widths_;
};

}  // namespace

void put(PageFlow& flow, const Table& table) { TableOnPages(flow, table).draw(); }

double least_height(PageFlow& flow, const Table& table) {
  constexpr double kHeadAndARow = 78;
  const double whole = TableOnPages(flow, table).height(PageFlow::kKeptWhole);
  return whole <= PageFlow::kKeptWhole ? whole : kHeadAndARow;
}

}  // namespace trocar::printed
