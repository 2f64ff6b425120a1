// A symmetric positive matrix of a chain: everything within kBand columns of the diagonal, solved by L D L^T.
//
// Row r holds columns r - kBand .. r. A rod's node has four unknowns (place, turn), a bend couples three nodes: eleven
// neighbouring unknowns. Fixed order of operations: same input, same bytes. Thread: any; factor() and solve() allocate
// nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace trocar {

class BandMatrix {
 public:
  static constexpr std::size_t kBand = 10;

  void reset(std::size_t size) { rows_.assign(size, Row{}); }
  std::size_t size() const { return rows_.size(); }

  /// @param row, column below or on the diagonal, at most kBand apart.
  double& at(std::size_t row, std::size_t column) { return rows_[row][column + kBand - row]; }

  /// @return false when it is not positive: what was in it is lost.
  bool factor() {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      Row& row = rows_[r];
      const std::size_t first = r - std::min(r, kBand);
      for (std::size_t c = first; c < r; ++c) {
        const Row& other = rows_[c];
        double sum = row[c + kBand - r];
        for (std::size_t k = std::max(first, c - std::min(c, kBand)); k < c; ++k)
          sum -= row[k + kBand - r] * other[k + kBand - c];
        row[c + kBand - r] = sum;  // still times D of its column
      }
      double diagonal = row[kBand];
      for (std::size_t c = first; c < r; ++c) {
        const double scaled = row[c + kBand - r] / rows_[c][kBand];
        diagonal -= scaled * row[c + kBand - r];
        row[c + kBand - r] = scaled;
      }
      if (!(diagonal > 0)) return false;
      row[kBand] = diagonal;
    }
    return true;
  }

  /// After factor(): the solution in place of the right-hand side.
  void solve(std::vector<double>& x) const {
    const std::size_t n = rows_.size();
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = r - std::min(r, kBand); c < r; ++c) x[r] -= rows_[r][c + kBand - r] * x[c];
    for (std::size_t r = 0; r < n; ++r) x[r] /= rows_[r][kBand];
    for (std::size_t r = n; r-- > 0;)
      for (std::size_t c = r - std::min(r, kBand); c < r; ++c) x[c] -= rows_[r][c + kBand - r] * x[r];
  }

 private:
  using Row = std::array<double, kBand + 1>;
  std::vector<Row> rows_;
};

}  // namespace trocar
