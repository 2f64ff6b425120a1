// The Rasch model: simulated answers recovered within the standard errors, an independent maximiser of the same
// likelihood, and who cannot be estimated at all.
#include "trainees/progress/rasch.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

namespace trocar::rasch_test {
namespace {

double chance(double logit) { return 1 / (1 + std::exp(-logit)); }

struct Simulated {
  std::vector<double> abilities, difficulties;
  std::vector<RaschCell> cells;
};

std::string number(const char* letter, std::size_t k) {
  return letter + std::string(k < 10 ? "0" : "") + std::to_string(k);
}

/// Difficulties spread evenly and sum to 0. @param tries of each trainee at each item.
Simulated simulate(unsigned seed, std::size_t trainees, std::size_t items, int tries) {
  std::mt19937 random(seed);
  Simulated out;
  for (std::size_t i = 0; i < items; ++i)
    out.difficulties.push_back(-1.5 + 3.0 * static_cast<double>(i) / static_cast<double>(items - 1));
  for (std::size_t t = 0; t < trainees; ++t) out.abilities.push_back(-1 + 2 * (random() / 4294967296.0));
  for (std::size_t t = 0; t < trainees; ++t)
    for (std::size_t i = 0; i < items; ++i) {
      RaschCell cell{number("T", t), number("I", i), tries, 0};
      for (int k = 0; k < tries; ++k)
        cell.passes += random() / 4294967296.0 < chance(out.abilities[t] - out.difficulties[i]) ? 1 : 0;
      out.cells.push_back(cell);
    }
  return out;
}

/// Newton on all parameters at once, the last difficulty being less the sum of the others.
Eigen::VectorXd oracle(const Simulated& sim) {
  const auto n = static_cast<Eigen::Index>(sim.abilities.size()),
             m = static_cast<Eigen::Index>(sim.difficulties.size());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n + m - 1);
  for (int round = 0; round < 100; ++round) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size());
    Eigen::MatrixXd curvature = Eigen::MatrixXd::Zero(x.size(), x.size());
    for (std::size_t c = 0; c < sim.cells.size(); ++c) {
      const auto t = static_cast<Eigen::Index>(c) / m, i = static_cast<Eigen::Index>(c) % m;
      Eigen::VectorXd row = Eigen::VectorXd::Zero(x.size());
      row[t] = 1;
      if (i < m - 1)
        row[n + i] = -1;
      else
        row.tail(m - 1).setConstant(1);
      const double p = chance(row.dot(x)), tries = sim.cells[c].tries;
      gradient += row * (sim.cells[c].passes - tries * p);
      curvature += tries * p * (1 - p) * row * row.transpose();
    }
    const Eigen::VectorXd step = curvature.ldlt().solve(gradient);
    x += step;
    if (step.cwiseAbs().maxCoeff() < 1e-12) break;
  }
  return x;
}

TEST(Rasch, AgreesWithAnIndependentMaximiser) {
  const Simulated sim = simulate(11, 15, 5, 12);
  const auto fit = fit_rasch(sim.cells);
  ASSERT_TRUE(fit && fit->set_aside.empty());
  ASSERT_EQ(fit->trainees.size(), 15u);
  EXPECT_LE(fit->largest_step, 1e-9);
  const Eigen::VectorXd wanted = oracle(sim);
  for (std::size_t t = 0; t < 15; ++t) EXPECT_NEAR(fit->trainees[t].logit, wanted[static_cast<Eigen::Index>(t)], 1e-6);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(fit->items[i].logit, wanted[static_cast<Eigen::Index>(15 + i)], 1e-6);
}

TEST(Rasch, RecoversWhatWasSimulatedWithinItsStandardErrors) {
  double squares = 0, items_worst = 0;
  int n = 0, beyond = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Simulated sim = simulate(seed, 40, 8, 25);
    const auto fit = fit_rasch(sim.cells);
    ASSERT_TRUE(fit);
    for (std::size_t t = 0; t < fit->trainees.size(); ++t) {
      const double z = (fit->trainees[t].logit - sim.abilities[t]) / fit->trainees[t].standard_error;
      squares += z * z;
      beyond += std::abs(z) > 1.96 ? 1 : 0;
      ++n;
    }
    for (std::size_t i = 0; i < fit->items.size(); ++i)
      items_worst =
          std::max(items_worst, std::abs(fit->items[i].logit - sim.difficulties[i]) / fit->items[i].standard_error);
  }
  EXPECT_NEAR(std::sqrt(squares / n), 1, 0.12) << "the error is what the standard error says";
  EXPECT_NEAR(static_cast<double>(beyond) / n, 0.05, 0.035);
  EXPECT_LT(items_worst, 4);
}

TEST(Rasch, StandardErrorShrinksWithTheRootOfTheAttempts) {
  const double few = fit_rasch(simulate(3, 30, 6, 20).cells)->trainees[0].standard_error;
  const double many = fit_rasch(simulate(3, 30, 6, 80).cells)->trainees[0].standard_error;
  EXPECT_NEAR(few / many, 2, 0.25);
}

TEST(Rasch, TwoItemsByHand) {
  // One trainee passes A 3 of 4 and B 1 of 4: ability 0 by symmetry, difficulties -ln 3 and +ln 3.
  const auto fit = fit_rasch(std::vector<RaschCell>{{"T", "A", 4, 3}, {"T", "B", 4, 1}});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->trainees[0].logit, 0, 1e-8);
  EXPECT_NEAR(fit->items[0].logit, -std::log(3.0), 1e-8);
  EXPECT_NEAR(fit->items[1].logit, std::log(3.0), 1e-8);
  EXPECT_NEAR(fit->items[0].standard_error, 1 / std::sqrt(4 * 0.75 * 0.25), 1e-8);
  EXPECT_EQ(fit->items[0].n, 4);
  EXPECT_EQ(fit->trainees[0].n, 8);
}

TEST(Rasch, AnswersOneByOneAreTheSame) {
  std::vector<RaschAnswer> answers;
  for (const bool passed : {true, true, true, false}) answers.push_back({"T", "A", passed});
  for (const bool passed : {false, true, false, false}) answers.push_back({"T", "B", passed});
  EXPECT_NEAR(fit_rasch(answers)->items[1].logit, std::log(3.0), 1e-8);
}

TEST(Rasch, SetsAsideWhoOnlyPassesOrOnlyFails) {
  Simulated sim = simulate(7, 10, 4, 10);
  for (const RaschCell& cell :
       {RaschCell{"always", "I00", 5, 5}, {"never", "I00", 5, 0}, {"T00", "too easy", 5, 5}, {"T01", "untried", 0, 0}})
    sim.cells.push_back(cell);
  const auto fit = fit_rasch(sim.cells);
  EXPECT_EQ(fit->set_aside, (std::vector<std::string>{"always", "never", "too easy"}));
  EXPECT_NEAR(fit->trainees[3].logit, fit_rasch(simulate(7, 10, 4, 10).cells)->trainees[3].logit, 1e-8)
      << "and nobody else's estimate moves";
}

TEST(Rasch, SetsAsideWhoIsNotConnected) {
  std::vector<RaschCell> cells = simulate(9, 8, 3, 10).cells;
  cells.push_back({"Island", "Rock", 10, 5});
  const auto fit = fit_rasch(cells);
  EXPECT_EQ(fit->set_aside, (std::vector<std::string>{"Island", "Rock"}));
}

TEST(Rasch, AStaircaseHasNoEstimate) {
  // Both trainees pass all that is easy and fail all that is hard: any distance between the two items fits better than
  // a smaller one.
  std::vector<RaschCell> cells;
  for (const char* trainee : {"T1", "T2"})
    for (int k = 0; k < 3; ++k) {
      cells.push_back({trainee, "easy", 1, 1});
      cells.push_back({trainee, "hard", 1, 0});
    }
  EXPECT_FALSE(fit_rasch(cells));
  EXPECT_FALSE(fit_rasch(std::vector<RaschCell>{}));
}

TEST(Rasch, OrdersBoardsThatNobodyMetTogether) {
  // Strong and weak trainees meet different items; one of each meets both: raw pass rates would put the hard item
  // first.
  std::mt19937 random(21);
  std::vector<RaschCell> cells;
  const auto add = [&](const std::string& who, double ability, const char* item, double difficulty) {
    RaschCell cell{who, item, 40, 0};
    for (int k = 0; k < 40; ++k) cell.passes += random() / 4294967296.0 < chance(ability - difficulty) ? 1 : 0;
    cells.push_back(cell);
  };
  for (std::size_t k = 0; k < 10; ++k) add(number("strong", k), 2, "hard", 1);
  for (std::size_t k = 0; k < 10; ++k) add(number("weak", k), -2, "easy", -1);
  for (const auto& [who, ability] : {std::pair{"strong00", 2.0}, {"weak00", -2.0}})
    for (const auto& [item, difficulty] : {std::pair{"hard", 1.0}, {"easy", -1.0}}) add(who, ability, item, difficulty);
  const auto fit = fit_rasch(cells);
  ASSERT_TRUE(fit);
  EXPECT_GT(fit->items[1].logit, fit->items[0].logit) << fit->items[0].name << " before " << fit->items[1].name;
}

}  // namespace
}  // namespace trocar::rasch_test
