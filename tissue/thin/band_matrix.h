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
    const std::size_t n = rows_.size();
    for (std::size_t k = 0; k < n; ++k) {
      const double pivot = rows_[k][kBand];
      if (!(pivot > 0)) return false;
      const std::size_t below = std::min(kBand, n - 1 - k);
      std::array<double, kBand> column{};
      for (std::size_t i = 0; i < below; ++i) column[i] = rows_[k + 1 + i][kBand - 1 - i];
      for (std::size_t i = 0; i < below; ++i) {
        const double scaled = column[i] / pivot;
        double* row = rows_[k + 1 + i].data() + (kBand - i);  // of column k + 1
        for (std::size_t c = 0; c <= i; ++c) row[c] -= scaled * column[c];
        row[-1] = scaled;
      }
    }
    return true;
  }

  /// After factor(): the solution in place of the right-hand side.
  void solve(std::vector<double>& x) const {
    const std::size_t n = rows_.size();
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < std::min(kBand, n - 1 - k); ++i)
        x[k + 1 + i] -= rows_[k + 1 + i][kBand - 1 - i] * x[k];
    for (std::size_t r = 0; r < n; ++r) x[r] /= rows_[r][kBand];
    for (std::size_t r = n; r-- > 0;)
      for (std::size_t c = r - std::min(r, kBand); c < r; ++c) x[c] -= rows_[r][c + kBand - r] * x[r];
  }

 private:
  using Row = std::array<double, kBand + 1>;
  std::vector<Row> rows_;
};

}  // namespace trocar
