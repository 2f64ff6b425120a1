// Tables over pages: the head comes again on each, a row stays whole, a word that is too long is broken, a cell that is too long ends
// with an ellipsis.
#include <algorithm>
#include <numeric>

#include "trainees/printed/page_flow.h"

namespace trocar::printed {
namespace {

constexpr double kSize = 8.0, kMonoSize = 6.8, kHeadSize = 7.2, kPad = 5, kRowPad = 4.4, kDrawnHeight = 21;
constexpr int kMostLines = 8;

Face face_of(const Column& column) { return column.mono ? Face::kMono : Face::kPlain; }
double size_of(const Column& column) { return column.mono ? kMonoSize : kSize; }

class TableOnPages {
 public:
  TableOnPages(PageFlow& flow, const Table& table) : flow_(flow), table_(table) {
    double all = 0;
    for (const Column& column : table.columns) all += column.share;
    for (const Column& column : table.columns) widths_.push_back(PageFlow::kContent * column.share / std::max(all, 1e-9));
  }

  void draw() {
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
  double inner(std::size_t column) const { return widths_[column] - kPad; }

  void head(bool again) {
    PdfPages& pages = flow_.pages();
    std::vector<std::vector<std::string>> titles;
    std::size_t most = 1;
    for (std::size_t i = 0; i < widths_.size(); ++i) {
      titles.push_back(wrapped(printable(table_.columns[i].title), inner(i), pages.measure(Face::kBold, kHeadSize), 3));
      most = std::max(most, titles.back().size());
    }
    if (!table_.caption.empty()) flow_.words(table_.caption + (again ? " (continued)" : ""), Face::kPlain, kHeadSize, kDim);
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
    double x = PageFlow::kLeft + std::accumulate(widths_.begin(), widths_.begin() + static_cast<std::ptrdiff_t>(column), 0.0);
    if (table_.columns[column].number) flow_.pages().text_right(x + inner(column), y, words, face, size, colour);
    else flow_.pages().text(x, y, words, face, size, colour);
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
      highest = std::max(highest, row[i].svg.empty() ? 1.28 * kSize * static_cast<double>(lines[i].size()) : kDrawnHeight);
    return highest + kRowPad;
  }

  void put_row(const std::vector<Cell>& row, const std::vector<std::vector<std::string>>& lines, double height) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      double y = flow_.y() + 0.5 * kRowPad - 0.28 * kSize;
      if (!row[i].svg.empty()) {
        const double x = PageFlow::kLeft + std::accumulate(widths_.begin(), widths_.begin() + static_cast<std::ptrdiff_t>(i), 0.0);
        flow_.pages().chart(row[i].svg, x, flow_.y() + 2, std::min(inner(i), kDrawnHeight * 120.0 / 34.0));
        continue;
      }
      for (const std::string& line : lines[i])
        put_words(i, y += 1.28 * kSize, line, face_of(table_.columns[i]), size_of(table_.columns[i]), colour_of(row[i].tone));
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

}  // namespace trocar::printed
