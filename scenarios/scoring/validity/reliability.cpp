#include "scenarios/scoring/validity/reliability.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

namespace trocar {
namespace {

constexpr std::array<const char*, 3> kFacetNames{"person", "board", "attempt"};

using Places = std::array<std::size_t, 3>;

/// Sum over all cells of the squared mean over what `facets` leaves out, scores counted from the grand mean.
double squared_means(const ScoreCube& cube, std::size_t facets, double grand_mean) {
  const Places& size = cube.size();
  std::map<Places, std::pair<double, std::size_t>> sums;
  std::size_t cell = 0;
  for (Places at{}; at[0] < size[0]; ++at[0]) {
    for (at[1] = 0; at[1] < size[1]; ++at[1]) {
      for (at[2] = 0; at[2] < size[2]; ++at[2]) {
        Places kept{};
        for (std::size_t f = 0; f < 3; ++f) kept[f] = facets >> f & 1 ? at[f] : 0;
        auto& [sum, count] = sums[kept];
        sum += cube.scores()[cell++] - grand_mean;
        ++count;
      }
    }
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0, [](double squares, const auto& entry) {
    const auto& [sum, count] = entry.second;
    return squares + sum * sum / static_cast<double>(count);
  });
}

double alternating(std::size_t more, std::size_t fewer) {
  return (std::popcount(more) - std::popcount(fewer)) % 2 == 0 ? 1 : -1;
}

}  // namespace

double VarianceComponents::total() const {
  double sum = 0;
  for (std::size_t facets = 1; facets < kFacetSets; ++facets) sum += variance(facets);
  return sum;
}

double VarianceComponents::standard_error() const { return std::sqrt(error()); }

double VarianceComponents::dependability(int attempts) const {
  const double person = variance(kPersonFacet), all = person + error() / attempts;
  return all > 0 ? person / all : 0;
}

int VarianceComponents::attempts_for(double wanted) const {
  const double person = variance(kPersonFacet);
  if (!(person > 0)) return 0;
  // Rounding must not ask for one attempt more than a whole number of them.
  return std::max(1, static_cast<int>(std::ceil(wanted / (1 - wanted) * error() / person - 1e-9)));
}

std::string facet_words(std::size_t facets) {
  std::string words;
  for (std::size_t f = 0; f < kFacetNames.size(); ++f) {
    if (facets >> f & 1) words += (words.empty() ? "" : " x ") + std::string(kFacetNames[f]);
  }
  return words;
}

VarianceComponents variance_components(const ScoreCube& cube) {
  const Places& size = cube.size();
  std::size_t varied = 0;
  for (std::size_t f = 0; f < 3; ++f) varied |= size[f] > 1 ? std::size_t{1} << f : 0;
  if (!(varied & kPersonFacet) || varied == kPersonFacet)
    throw std::invalid_argument("variance components need two persons and two boards or attempts");
  const double mean =
      std::accumulate(cube.scores().begin(), cube.scores().end(), 0.0) / static_cast<double>(cube.scores().size());
  std::array<double, kFacetSets> squares{};
  for (std::size_t facets = 0; facets < kFacetSets; ++facets) squares[facets] = squared_means(cube, facets, mean);
  VarianceComponents out;
  for (std::size_t facets = 1; facets < kFacetSets; ++facets) {
    if (facets & ~varied) continue;
    double sum = 0, freedom = 1;
    for (std::size_t part = 0; part < kFacetSets; ++part) {
      if (!(part & ~facets)) sum += alternating(facets, part) * squares[part];
    }
    for (std::size_t f = 0; f < 3; ++f) freedom *= facets >> f & 1 ? static_cast<double>(size[f] - 1) : 1;
    out.mean_square[facets] = sum / freedom;
  }
  for (std::size_t facets = 1; facets < kFacetSets; ++facets) {
    if (facets & ~varied) continue;
    double sum = 0, repeats = 1;
    for (std::size_t whole = facets; whole < kFacetSets; ++whole) {
      if (!(facets & ~whole) && !(whole & ~varied)) sum += alternating(whole, facets) * out.mean_square[whole];
    }
    for (std::size_t f = 0; f < 3; ++f) repeats *= facets >> f & 1 ? 1 : static_cast<double>(size[f]);
    out.estimate[facets] = sum / repeats;
  }
  return out;
}

double icc_agreement(const std::vector<std::vector<double>>& scores) {
  ScoreCube cube(scores.size(), scores.empty() ? 0 : scores.front().size(), 1);
  for (std::size_t p = 0; p < scores.size(); ++p) {
    if (scores[p].size() != cube.size()[1]) throw std::invalid_argument("ICC needs as many scores for each person");
    for (std::size_t b = 0; b < scores[p].size(); ++b) cube.at(p, b, 0) = scores[p][b];
  }
  // By the estimates as they are, negative ones too: that is the coefficient as it is defined.
  const VarianceComponents found = variance_components(cube);
  const double all = std::accumulate(found.estimate.begin(), found.estimate.end(), 0.0);
  return all > 0 ? found.estimate[kPersonFacet] / all : 0;
}

}  // namespace trocar
