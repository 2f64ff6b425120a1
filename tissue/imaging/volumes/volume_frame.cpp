#include "tissue/imaging/volumes/volume_frame.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "haptics/input_error.h"
#include "tissue/imaging/labels/label_grid.h"
#include "tissue/imaging/volumes/volume_reader.h"

namespace trocar {
namespace {

constexpr double kFewestMm = 0.01, kMostMm = 100;
constexpr double kLeastOpening = 0.3;  // determinant of the unit axes: three axes 30 degrees off still have 0.5

[[noreturn]] void refuse_frame(const std::string& file, const std::string& field, const std::string& what) {
  throw InputError(file + ": " + field + ": " + what);
}

}  // namespace

std::string plain(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& letter : result)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return result;
}

void check_frame(const Eigen::Affine3d& frame, const std::string& field, const std::string& file,
                 const std::string& hint, std::vector<std::string>& notes) {
  if (!frame.matrix().allFinite()) refuse_frame(file, field, "the transform is not finite");
  if (frame.translation().cwiseAbs().maxCoeff() > 1e5) refuse_frame(file, field, "the origin is more than 100 m away");
  for (int axis = 0; axis < 3; ++axis) {
    const double length = frame.linear().col(axis).norm();
    if (!(length >= kFewestMm && length <= kMostMm))
      refuse_frame(file, field, "voxel size " + plain(length) + " mm along axis " + std::to_string(axis + 1) + hint);
  }
  const double opening = std::abs(frame.linear().colwise().normalized().determinant());
  if (opening < kLeastOpening) refuse_frame(file, field, "the axes nearly fall into one plane");
  const double skew = skew_of(frame);
  if (skew > kSkewTolerance)
    notes.push_back(field + ": the axes are not at right angles (shear or gantry tilt, cosine " + plain(skew) + ")");
}

void check_size(const std::array<long long, 3>& size, long long components, const std::string& field,
                const std::string& file) {
  double count = static_cast<double>(components);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (size[axis] < 2)
      refuse_frame(file, field,
                   std::to_string(size[axis]) + " voxels along axis " + std::to_string(axis + 1) +
                       ": a volume needs at least 2");
    count *= static_cast<double>(size[axis]);
  }
  if (components < 1) refuse_frame(file, field, std::to_string(components) + " values a voxel");
  if (count > static_cast<double>(kMostLabelVoxels))
    refuse_frame(file, field,
                 plain(count) + " voxels, more than " + std::to_string(kMostLabelVoxels) +
                     ": crop the volume or sample it coarser");
}

Eigen::Affine3d settled_frame(const Eigen::Affine3d& frame) {
  Eigen::Affine3d settled = frame;
  const auto rounded = [](double value, double grid) { return std::round(value * grid) / grid + 0.0; };
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      settled.linear()(row, column) = rounded(frame.linear()(row, column), 1 << 20);
    settled.translation()[row] = rounded(frame.translation()[row], 1 << 10);
  }
  return settled;
}

Eigen::Vector3d ras_signs(std::string_view space, const std::string& field, const std::string& file) {
  const std::string name = lower_case(space);
  if (name == "ras" || name == "right-anterior-superior") return {1, 1, 1};
  if (name == "las" || name == "left-anterior-superior") return {-1, 1, 1};
  if (name == "lps" || name == "left-posterior-superior") return {-1, -1, 1};
  if (name.ends_with("-time") || name == "rast" || name == "last" || name == "lpst")
    refuse_frame(file, field, "a series over time; one volume is wanted");
  refuse_frame(file, field, "does not say where left and right are; RAS, LAS or LPS is wanted");
}

double millimetres_in(std::string_view unit, const std::string& field, const std::string& file) {
  const std::string name = lower_case(unit);
  if (name == "mm" || name == "millimeter" || name == "millimetre" || name == "millimeters") return 1;
  if (name == "cm" || name == "centimeter") return 10;
  if (name == "dm") return 100;
  if (name == "m" || name == "meter" || name == "metre") return 1000;
  if (name == "um" || name == "micron" || name == "micrometer" || name == "\xc2\xb5m") return 1e-3;
  refuse_frame(file, field, "no unit of length that is known here; mm, cm, dm, m or um");
}

}  // namespace trocar
