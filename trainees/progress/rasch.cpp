#include "trainees/progress/rasch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace trocar {
namespace {

constexpr int kMostRounds = 2000;
constexpr double kCloseEnough = 1e-9, kLongestStep = 1.0;

/// Trainees and items as the two sides of one numbering: trainees first.
struct Table {
  std::vector<std::string> names;
  std::size_t trainees = 0;
  struct Cell {
    std::size_t trainee, item;
    double tries, passes;
  };
  std::vector<Cell> cells;
};

Table table_of(const std::vector<RaschCell>& given) {
  std::map<std::string, std::size_t> trainees, items;
  std::map<std::pair<std::string, std::string>, std::pair<double, double>> sums;
  for (const RaschCell& cell : given) {
    if (cell.tries <= 0) continue;
    trainees[cell.trainee];
    items[cell.item];
    auto& [tries, passes] = sums[{cell.trainee, cell.item}];
    tries += cell.tries;
    passes += cell.passes;
  }
  Table table;
  table.trainees = trainees.size();
  for (auto* side : {&trainees, &items})
    for (auto& [name, number] : *side) {
      number = table.names.size();
      table.names.push_back(name);
    }
  for (const auto& [key, sum] : sums)
    table.cells.push_back({trainees[key.first], items[key.second], sum.first, sum.second});
  return table;
}

using Edges = std::vector<std::vector<std::size_t>>;

/// Reached from `start`, in the order in which they are left for good.
void walk(const Edges& edges, std::size_t start, std::vector<bool>& seen, std::vector<std::size_t>& left) {
  std::vector<std::pair<std::size_t, std::size_t>> path{{start, 0}};
  seen[start] = true;
  while (!path.empty()) {
    auto& [node, next] = path.back();
    if (next == edges[node].size()) {
      left.push_back(node);
      path.pop_back();
      continue;
    }
    const std::size_t to = edges[node][next++];
    if (seen[to]) continue;
    seen[to] = true;
    path.emplace_back(to, 0);
  }
}

/// Largest strongly connected group of the graph "trainee passed item, item failed trainee" (Kosaraju). Others have no
/// finite estimate.
std::vector<bool> estimable(const Table& table) {
  const std::size_t n = table.names.size();
  Edges out(n), in(n);
  const auto connect = [&](std::size_t from, std::size_t to) {
    out[from].push_back(to);
    in[to].push_back(from);
  };
  for (const Table::Cell& cell : table.cells) {
    if (cell.passes > 0) connect(cell.trainee, cell.item);
    if (cell.passes < cell.tries) connect(cell.item, cell.trainee);
  }
  std::vector<bool> seen(n, false);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < n; ++k)
    if (!seen[k]) walk(out, k, seen, order);
  seen.assign(n, false);
  std::vector<std::size_t> largest;
  for (auto node = order.rbegin(); node != order.rend(); ++node) {
    if (seen[*node]) continue;
    std::vector<std::size_t> group;
    walk(in, *node, seen, group);
    if (group.size() > largest.size()) largest = group;
  }
  std::vector<bool> kept(n, false);
  for (const std::size_t node : largest) kept[node] = true;
  return kept;
}

double chance(double logit) { return 1 / (1 + std::exp(-logit)); }

struct Sums {
  std::vector<double> left_over, information;  ///< passes less expected passes; variance of it
};

Sums sums_of(const Table& table, const std::vector<double>& logits) {
  Sums out{std::vector<double>(logits.size()), std::vector<double>(logits.size())};
  for (const Table::Cell& cell : table.cells) {
    const double p = chance(logits[cell.trainee] - logits[cell.item]);
    const double rest = cell.passes - cell.tries * p, variance = cell.tries * p * (1 - p);
    out.left_over[cell.trainee] += rest;
    out.left_over[cell.item] -= rest;
    out.information[cell.trainee] += variance;
    out.information[cell.item] += variance;
  }
  return out;
}

/// Newton on one side while the other stands. @returns the longest step.
double improve(const Table& table, std::vector<double>& logits, std::size_t from, std::size_t to) {
  const Sums sums = sums_of(table, logits);
  double longest = 0;
  for (std::size_t k = from; k < to; ++k) {
    if (!(sums.information[k] > 0)) continue;
    const double step = std::clamp(sums.left_over[k] / sums.information[k], -kLongestStep, kLongestStep);
    logits[k] += step;
    longest = std::max(longest, std::abs(step));
  }
  return longest;
}

/// Difficulties sum to nothing.
void centre(std::vector<double>& logits, std::size_t trainees) {
  double mean = 0;
  for (std::size_t k = trainees; k < logits.size(); ++k)
    mean += logits[k] / static_cast<double>(logits.size() - trainees);
  for (double& logit : logits) logit -= mean;
}

/// The table without those that have no estimate; their names.
std::vector<std::string> keep(Table& table, const std::vector<bool>& kept) {
  std::vector<std::string> aside;
  std::vector<std::size_t> number(table.names.size());
  Table small;
  for (std::size_t k = 0; k < table.names.size(); ++k) {
    if (!kept[k]) {
      aside.push_back(table.names[k]);
      continue;
    }
    number[k] = small.names.size();
    small.names.push_back(table.names[k]);
    small.trainees += k < table.trainees ? 1 : 0;
  }
  for (Table::Cell cell : table.cells)
    if (kept[cell.trainee] && kept[cell.item])
      small.cells.push_back({number[cell.trainee], number[cell.item], cell.tries, cell.passes});
  table = std::move(small);
  std::sort(aside.begin(), aside.end());
  return aside;
}

}  // namespace

std::optional<RaschFit> fit_rasch(const std::vector<RaschCell>& cells) {
  Table table = table_of(cells);
  RaschFit fit;
  fit.set_aside = keep(table, estimable(table));
  if (table.cells.empty()) return std::nullopt;
  std::vector<double> logits(table.names.size());
  fit.largest_step = 1;
  while (fit.rounds < kMostRounds && fit.largest_step > kCloseEnough) {
    fit.largest_step = improve(table, logits, 0, table.trainees);
    fit.largest_step = std::max(fit.largest_step, improve(table, logits, table.trainees, logits.size()));
    centre(logits, table.trainees);
    ++fit.rounds;
  }
  const Sums sums = sums_of(table, logits);
  std::vector<int> tries(logits.size());
  for (const Table::Cell& cell : table.cells)
    for (const std::size_t k : {cell.trainee, cell.item}) tries[k] += static_cast<int>(cell.tries);
  for (std::size_t k = 0; k < logits.size(); ++k)
    (k < table.trainees ? fit.trainees : fit.items)
        .push_back({table.names[k], logits[k], 1 / std::sqrt(sums.information[k]), tries[k]});
  return fit;
}

std::optional<RaschFit> fit_rasch(const std::vector<RaschAnswer>& answers) {
  std::vector<RaschCell> cells;
  for (const RaschAnswer& answer : answers) cells.push_back({answer.trainee, answer.item, 1, answer.passed ? 1 : 0});
  return fit_rasch(cells);
}

}  // namespace trocar
