#include "tissue/imaging/dicom/even_planes.h"

#include <algorithm>
#include <cmath>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kSamePlane = 0.01;  // mm
constexpr double kOff = 0.1;         // of a step
constexpr double kMostSlices = 20000;

/// The middle one of the distances near the smallest: single distances carry the rounding of two positions.
double usual_step(const std::vector<double>& gaps) {
  const double smallest = *std::min_element(gaps.begin(), gaps.end());
  std::vector<double> near;
  std::copy_if(gaps.begin(), gaps.end(), std::back_inserter(near), [&](double gap) { return gap < 1.5 * smallest; });
  const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
  std::nth_element(near.begin(), middle, near.end());
  return *middle;
}

}  // namespace

EvenPlanes even_planes(const std::vector<double>& heights, const std::string& what, const std::string& name) {
  std::vector<double> sorted = heights, gaps;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t n = 1; n < sorted.size(); ++n)
    if (sorted[n] - sorted[n - 1] > kSamePlane) gaps.push_back(sorted[n] - sorted[n - 1]);
  EvenPlanes planes;
  planes.first = sorted.front(), planes.count = 1;
  planes.slice.assign(heights.size(), 0);
  if (gaps.empty()) return planes;
  const double usual = usual_step(gaps), span = sorted.back() - sorted.front();
  if (span / usual > kMostSlices) throw InputError(name + ": its " + what + " span more than 20000 slices");
  for (const double gap : gaps) planes.count += static_cast<int>(std::lround(gap / usual));
  planes.step = span / (planes.count - 1);
  for (std::size_t n = 0; n < heights.size(); ++n) {
    const double at = (heights[n] - planes.first) / planes.step;
    planes.slice[n] = static_cast<int>(std::lround(at));
    if (std::abs(at - planes.slice[n]) > kOff)
      throw InputError(name + ": its " + what + " are not evenly spaced: one lies " +
                       std::to_string(heights[n] - planes.first) + " mm from the first where slices are " +
                       std::to_string(planes.step) + " mm apart");
  }
  return planes;
}

}  // namespace trocar
