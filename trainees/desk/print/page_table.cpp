// Tables over pages: the head comes again on each, a row stays whole, a word that is too long is broken, a cell that is
// too long ends with an ellipsis.
#include <algorithm>
#include <numeric>

#include "trainees/desk/print/page_flow.h"

namespace trocar::printed {
namespace {

constexpr double kSize = 8.0, kMonoSize = 6.8, kHeadSize = 7.2, kPad = 5, kRowPad = 4.4, kDrawnHeight = 21,
                 kUsualWord = 50;
constexpr int kMostLines = 8;

Face face_of(const Column& column) { return column.mono ? Face::kMono : Face::kPlain; }
double size_of(const Column& column) { return column.mono ? kMonoSize : kSize; }

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
      const std::vector<std::vector<std::string>> lines = lines_of(row);
      const double height = height_of(row, lines);
      if (!flow_.fits(height)) {
        flow_.next_page();
        head(true);
      }
      put_row(row, lines, height);
    }
    if (table_.rows.empty()) flow_.words(table_.none, Face::kPlain, kSize, kDim);
    flow_.down(8);
  }

 private:
  /// Room for the longest word of the head and of the cells, but for hashes and words that are longer than usual.
  double least_width(std::size_t column) const {
    const PdfPages& pages = flow_.pages();
    const auto longest = [&](std::string words, Face face, double size) {
      words = printable(words);
      std::replace(words.begin(), words.end(), ' ', '\n');
      double out = 0;
      for (const std::string& word : wrapped(words, PageFlow::kContent, pages.measure(face, size)))
        out = std::max(out, pages.width_of(word, face, size));
      return out;
    };
    double out = longest(table_.columns[column].title, Face::kBold, kHeadSize);
    const Column& about = table_.columns[column];
    for (const auto& row : table_.rows) {
      if (about.mono || column >= row.size()) continue;
      const double wide = longest(row[column].words, face_of(about), size_of(about));
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
    PdfPages& pages = flow_.pages();
    std::vector<std::vector<std::string>> titles;
    std::size_t most = 1;
    for (std::size_t i = 0; i < widths_.size(); ++i) {
      titles.push_back(wrapped(printable(table_.columns[i].title), inner(i), pages.measure(Face::kBold, kHeadSize), 3));
      most = std::max(most, titles.back().size());
    }
    if (!table_.caption.empty())
      flow_.words(table_.caption + (again ? " (continued)" : ""), Face::kPlain, kHeadSize, kDim);
    if (table_.rows.empty()) return;
    const double step = 1.2 * kHeadSize;
    for (std::size_t i = 0; i < widths_.size(); ++i) {
      double y = flow_.y() + 3 + step * static_cast<double>(most - titles[i].size());
      for (const std::string& line : titles[i]) put_words(i, y += step, line, Face::kBold, kHeadSize, kInk);
    }
    flow_.down(3 + step * static_cast<double>(most) + 4);
    pages.line(PageFlow::kLeft, flow_.y(), PageFlow::kRight, flow_.y(), 0.9, kInk);
  }

  void put_words(std::size_t column, double y, const std::string& words, Face face, double size, const Colour& colour) {
    double x =
        PageFlow::kLeft + std::accumulate(widths_.begin(), widths_.begin() + static_cast<std::ptrdiff_t>(column), 0.0);
    if (table_.columns[column].number)
      flow_.pages().text_right(x + inner(column), y, words, face, size, colour);
    else
      flow_.pages().text(x, y, words, face, size, colour);
  }

  std::vector<std::vector<std::string>> lines_of(const std::vector<Cell>& row) const {
    std::vector<std::vector<std::string>> out;
    for (std::size_t i = 0; i < widths_.size() && i < row.size(); ++i)
      out.push_back(wrapped(printable(row[i].words), inner(i),
                            flow_.pages().measure(face_of(table_.columns[i]), size_of(table_.columns[i])), kMostLines));
    return out;
  }

  double height_of(const std::vector<Cell>& row, const std::vector<std::vector<std::string>>& lines) const {
    double highest = 0;
    for (std::size_t i = 0; i < lines.size(); ++i)
      highest =
          std::max(highest, row[i].svg.empty() ? 1.28 * kSize * static_cast<double>(lines[i].size()) : kDrawnHeight);
    return highest + kRowPad;
  }

  void put_row(const std::vector<Cell>& row, const std::vector<std::vector<std::string>>& lines, double height) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      double y = flow_.y() + 0.5 * kRowPad - 0.28 * kSize;
      if (!row[i].svg.empty()) {
        const double x =
            PageFlow::kLeft + std::accumulate(widths_.begin(), widths_.begin() + static_cast<std::ptrdiff_t>(i), 0.0);
        flow_.pages().chart(row[i].svg, x, flow_.y() + 2, std::min(inner(i), kDrawnHeight * 120.0 / 34.0));
        continue;
      }
      for (const std::string& line : lines[i])
        put_words(i, y += 1.28 * kSize, line, face_of(table_.columns[i]), size_of(table_.columns[i]),
                  colour_of(row[i].tone));
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
