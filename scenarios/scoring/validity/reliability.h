// How far one score can be trusted: variance components of persons x boards x attempts, reliability, standard error.
//
// Generalisability theory (Cronbach et al. 1972; Brennan 2001): a fully crossed design with one score a cell, every
// facet random; components by the expected mean squares of the analysis of variance. A facet of size 1 has no
// component: what it would carry lies in those of the others. Scores in points, variances in points squared. Pure.
// Thread: any.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace trocar {

/// Scores of a fully crossed design, one for each person, board and attempt.
class ScoreCube {
 public:
  ScoreCube(std::size_t persons, std::size_t boards, std::size_t attempts)
      : size_{persons, boards, attempts}, scores_(persons * boards * attempts) {}
  double& at(std::size_t person, std::size_t board, std::size_t attempt) {
    return scores_[(person * size_[1] + board) * size_[2] + attempt];
  }
  const std::array<std::size_t, 3>& size() const { return size_; }  ///< persons, boards, attempts
  const std::vector<double>& scores() const { return scores_; }     ///< the attempt runs fastest

 private:
  std::array<std::size_t, 3> size_;
  std::vector<double> scores_;
};

/// A set of facets as bits: what they do together.
inline constexpr std::size_t kPersonFacet = 1, kBoardFacet = 2, kAttemptFacet = 4, kFacetSets = 8;

struct VarianceComponents {
  std::array<double, kFacetSets> mean_square{}, estimate{};  ///< by set of facets; [0] is empty. Estimates may be < 0
  /// The estimate, 0 for a negative one: a variance cannot be.
  double variance(std::size_t facets) const { return estimate[facets] > 0 ? estimate[facets] : 0; }
  double total() const;
  /// All that makes a person's score of one attempt on a strange board differ from the mean over all of them.
  double error() const { return total() - variance(kPersonFacet); }
  /// Standard error of one attempt's score, points.
  double standard_error() const;
  /// Share of the variance that persons make of the mean of so many attempts, each on another board: 0..1 (the index of
  /// dependability Phi). 0 without any variance.
  double dependability(int attempts) const;
  /// Fewest attempts, each on another board, of that dependability; 0 when persons do not differ.
  int attempts_for(double dependability) const;
};

/// "person x board": how a set of facets is called.
std::string facet_words(std::size_t facets);

/// @throws std::invalid_argument: fewer than two persons, or nothing but persons.
VarianceComponents variance_components(const ScoreCube& cube);

/// ICC(2,1) of Shrout and Fleiss (1979): two-way random, absolute agreement, one measurement.
/// @param scores by person, as many for each, at least two of either. 0 without any variance.
double icc_agreement(const std::vector<std::vector<double>>& scores);

}  // namespace trocar
