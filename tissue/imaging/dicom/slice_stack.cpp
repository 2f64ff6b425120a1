#include "tissue/imaging/dicom/slice_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kSameDirection = 2e-3;  // rad: 0.5 mm over 25 cm, half a pixel of a CT
constexpr double kSameSpacing = 5e-4;    // of the spacing: a quarter of a pixel over 512
constexpr double kSamePlace = 0.01;      // mm
constexpr double kUneven = 0.1;          // of a step: positions are often written rounded to 0.1 mm
constexpr double kGap = 1.5;             // of the usual step: a slice is missing
constexpr double kShiftMatters = 0.25;   // pixels over the whole pile

std::string mm(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", value);
  return text;
}

/// "A and B", shorter where both names begin with the same file.
std::string both(const StackSlice& a, const StackSlice& b) { return a.name + " and " + b.name; }

void require_same_kind(const StackSlice& first, const StackSlice& other) {
  if (first.rows != other.rows || first.columns != other.columns)
    throw InputError(both(first, other) + " have different sizes (" + std::to_string(first.columns) + " x " +
                     std::to_string(first.rows) + " and " + std::to_string(other.columns) + " x " +
                     std::to_string(other.rows) + " pixels): they are not one volume");
  const SlicePlace &a = first.place, &b = other.place;
  if ((a.along_row - b.along_row).norm() > kSameDirection || (a.along_column - b.along_column).norm() > kSameDirection)
    throw InputError(both(first, other) +
                     " have different orientations: a series of slices in one direction is needed, " +
                     "this looks like a localiser (scout) or several scans in one series");
  if (std::abs(a.row_step / b.row_step - 1) > kSameSpacing ||
      std::abs(a.column_step / b.column_step - 1) > kSameSpacing)
    throw InputError(both(first, other) + " have different pixel spacings (" + mm(a.row_step) + " and " +
                     mm(b.row_step) + "): they are not one volume");
}

struct Sorted {
  const std::vector<StackSlice>& slices;
  const SliceStack& stack;

  const StackSlice& at(std::size_t n) const { return slices[stack.order[n]]; }
  double height(std::size_t n) const { return stack.normal.dot(at(n).place.position); }
  std::size_t count() const { return stack.order.size(); }

  double usual_step() const {
    std::vector<double> steps;
    for (std::size_t n = 1; n < count(); ++n) steps.push_back(height(n) - height(n - 1));
    const std::size_t middle = (steps.size() - 1) / 2;  // the lower one of two: a gap must not count as usual
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(middle), steps.end());
    return steps[middle];
  }
};

void require_no_duplicates(const Sorted& pile) {
  std::size_t doubles = 0, first = 0;
  for (std::size_t n = 1; n < pile.count(); ++n)
    if (pile.height(n) - pile.height(n - 1) < kSamePlace && doubles++ == 0) first = n;
  if (doubles == 0) return;
  const bool shifted = (pile.at(first).place.position - pile.at(first - 1).place.position).norm() > 1;
  throw InputError(both(pile.at(first - 1), pile.at(first)) + " lie in the same " +
                   (shifted ? "plane, side by side" : "place") +
                   (doubles > 1 ? ", and so do " + std::to_string(doubles - 1) + " other pairs" : "") +
                   ": a copy, or several phases, echoes or directions in one series; leave one image for every place");
}

void require_no_gap(const Sorted& pile) {
  const double usual = pile.usual_step();
  for (std::size_t n = 1; n < pile.count(); ++n) {
    const double step = pile.height(n) - pile.height(n - 1);
    if (step < kGap * usual) continue;
    const long missing = std::max(1L, std::lround(step / usual) - 1);
    throw InputError("between " + both(pile.at(n - 1), pile.at(n)) + " lies a gap of " + mm(step) +
                     " where slices are " + mm(usual) + " apart: " + std::to_string(missing) +
                     (missing == 1 ? " slice is" : " slices are") +
                     " missing; get the missing images or choose another series");
  }
}

void require_even(const Sorted& pile, const SliceStack& stack) {
  for (std::size_t n = 1; n < pile.count(); ++n) {
    const double off = pile.height(n) - pile.height(0) - static_cast<double>(n) * stack.slice_step;
    if (std::abs(off) > kUneven * stack.slice_step)
      throw InputError(pile.at(n).name + ": lies " + mm(std::abs(off)) + " from where evenly spaced slices (" +
                       mm(stack.slice_step) + ") would put it: the slices are unevenly spaced or some are missing");
  }
}

Eigen::Vector2d in_plane(const SliceStack& stack, const Eigen::Vector3d& offset) {
  return {stack.along_row.dot(offset), stack.along_column.dot(offset)};
}

void find_shift(const Sorted& pile, SliceStack& stack) {
  const auto last = static_cast<double>(pile.count() - 1);
  const double pixel = std::min(stack.row_step, stack.column_step);
  const Eigen::Vector2d all = in_plane(stack, pile.at(pile.count() - 1).place.position - stack.origin);
  stack.shift = all / last;
  for (std::size_t n = 1; n < pile.count(); ++n) {
    const Eigen::Vector2d off =
        in_plane(stack, pile.at(n).place.position - stack.origin) - static_cast<double>(n) * stack.shift;
    if (off.norm() > std::max(0.5 * pixel, 0.2))
      throw InputError(
          pile.at(n).name + ": lies " + mm(off.norm()) +
          " to the side of where the slices before and after it put it: " + "the slices are not one straight pile");
  }
  if (all.norm() < kShiftMatters * pixel) stack.shift.setZero();
  stack.tilt_deg = std::atan2(stack.shift.norm(), stack.slice_step) * 180 / std::numbers::pi;
}

}  // namespace

SliceStack stacked(const std::vector<StackSlice>& slices, const std::string& input) {
  if (slices.empty()) throw InputError(input + ": holds no images");
  const StackSlice& first = slices.front();
  if (slices.size() == 1)
    throw InputError(
        first.name + ": is a single image of " + std::to_string(first.columns) + " x " + std::to_string(first.rows) +
        " pixels: a volume needs two slices at least, an organ some dozens; give the folder with the whole series");
  for (const StackSlice& slice : slices) require_same_kind(first, slice);
  SliceStack stack;
  stack.rows = first.rows, stack.columns = first.columns;
  stack.along_row = first.place.along_row, stack.along_column = first.place.along_column;
  stack.normal = stack.along_row.cross(stack.along_column);
  stack.row_step = first.place.row_step, stack.column_step = first.place.column_step;
  stack.order.resize(slices.size());
  std::iota(stack.order.begin(), stack.order.end(), std::size_t{0});
  std::stable_sort(stack.order.begin(), stack.order.end(), [&](std::size_t a, std::size_t b) {
    return stack.normal.dot(slices[a].place.position) < stack.normal.dot(slices[b].place.position);
  });
  const Sorted pile{slices, stack};
  stack.origin = pile.at(0).place.position;
  require_no_duplicates(pile);
  require_no_gap(pile);
  stack.slice_step = (pile.height(pile.count() - 1) - pile.height(0)) / static_cast<double>(pile.count() - 1);
  require_even(pile, stack);
  find_shift(pile, stack);
  return stack;
}

}  // namespace trocar
