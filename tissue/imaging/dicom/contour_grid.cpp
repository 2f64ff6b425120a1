#include "tissue/imaging/dicom/contour_grid.h"

#include <algorithm>
#include <cmath>

#include "haptics/input_error.h"
#include "tissue/imaging/dicom/even_planes.h"

namespace trocar {
namespace {

constexpr double kFlat = 0.2;                    // of a slice: how far a contour may leave its plane
constexpr double kFlatMm = 0.25;                 // the same where there are no slices yet
constexpr double kFinest = 0.25, kCoarsest = 1;  // mm, pixels of an own grid
constexpr double kPixelsAcross = 60;             // of the smallest structure
constexpr int kMargin = 2;

/// Thickness of the thickest contour along each axis of a frame, and the structure it belongs to.
struct Thickness {
  Eigen::Vector3d most = Eigen::Vector3d::Zero();
  std::array<const Structure*, 3> of{};
};

Thickness thickness(const ContourGrid& grid, const std::vector<Structure>& structures) {
  Thickness result;
  for (const Structure& structure : structures)
    for (const Contour& contour : structure.closed) {
      Eigen::AlignedBox3d box;
      for (const Eigen::Vector3d& point : contour) box.extend(grid.index_of(point));
      for (int axis = 0; axis < 3; ++axis)
        if (box.sizes()[axis] > result.most[axis])
          result.most[axis] = box.sizes()[axis], result.of[static_cast<std::size_t>(axis)] = &structure;
    }
  return result;
}

/// The same grid with `last` as the last axis; the others keep their order.
ContourGrid turned(const ContourGrid& grid, int last) {
  if (last == 2) return grid;
  const std::array<int, 3> order = last == 0 ? std::array<int, 3>{1, 2, 0} : std::array<int, 3>{0, 2, 1};
  ContourGrid result = grid;
  for (int axis = 0; axis < 3; ++axis) {
    const int from = order[static_cast<std::size_t>(axis)];
    result.size[static_cast<std::size_t>(axis)] = grid.size[static_cast<std::size_t>(from)];
    result.index_to_ras_mm.linear().col(axis) = grid.index_to_ras_mm.linear().col(from);
  }
  return result;
}

/// Twice the area vector of a contour (Newell): normal to its plane.
Eigen::Vector3d area_vector(const Contour& contour) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < contour.size(); ++n)
    sum += (contour[n] - contour[0]).cross(contour[(n + 1) % contour.size()] - contour[0]);
  return sum;
}

/// Normal of the largest contour, towards the head, the front or the right of the patient.
Eigen::Vector3d common_normal(const std::vector<Structure>& structures, const std::string& file) {
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (const Structure& structure : structures)
    for (const Contour& contour : structure.closed)
      if (const Eigen::Vector3d area = area_vector(contour); area.norm() > best.norm()) best = area;
  if (best.norm() < 1e-6) throw InputError(file + ": its contours enclose no area");
  best.normalize();
  int main_axis = 0;
  best.cwiseAbs().maxCoeff(&main_axis);
  if ((main_axis == 2) != (best[main_axis] > 0))
    best = -best;  // LPS: z towards the head, x and y away from right and front
  return best;
}

/// Heights of the contours along the normal; each must be flat.
std::vector<double> plane_heights(const std::vector<Structure>& structures, const Eigen::Vector3d& normal,
                                  const std::string& file) {
  std::vector<double> heights;
  for (const Structure& structure : structures)
    for (const Contour& contour : structure.closed) {
      double low = normal.dot(contour[0]), high = low;
      for (const Eigen::Vector3d& point : contour)
        low = std::min(low, normal.dot(point)), high = std::max(high, normal.dot(point));
      if (high - low > kFlatMm)
        throw InputError(file + ": structure " + std::to_string(structure.number) + " (" + structure.name +
                         "): its contours do not lie in parallel planes; give the image that they were drawn on");
      heights.push_back((low + high) / 2);
    }
  return heights;
}

/// Pixel size that resolves the smallest structure.
double pixel_size(const std::vector<Structure>& structures, const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  double smallest = kCoarsest * kPixelsAcross;
  for (const Structure& structure : structures) {
    Eigen::AlignedBox2d box;
    for (const Contour& contour : structure.closed)
      for (const Eigen::Vector3d& point : contour) box.extend(Eigen::Vector2d(u.dot(point), v.dot(point)));
    if (!box.isEmpty()) smallest = std::min(smallest, box.sizes().maxCoeff());
  }
  return std::clamp(smallest / kPixelsAcross, kFinest, kCoarsest);
}

}  // namespace

ContourGrid image_contour_grid(const ImageVolume& image, const std::vector<Structure>& structures,
                               const std::string& file) {
  const ContourGrid grid{image.size, image.index_to_ras_mm};
  const Thickness thick = thickness(grid, structures);
  int axis = 0;
  thick.most.minCoeff(&axis);
  if (thick.most[axis] <= kFlat) return turned(grid, axis);
  const Structure& worst = *thick.of[static_cast<std::size_t>(axis)];
  throw InputError(file + ": structure " + std::to_string(worst.number) + " (" + worst.name +
                   "): its contours do not lie in the slices of the image: they were drawn on another series");
}

ContourGrid own_contour_grid(const std::vector<Structure>& structures, const std::string& file) {
  const Eigen::Vector3d normal = common_normal(structures, file);
  const EvenPlanes planes = even_planes(plane_heights(structures, normal, file), "contours", file);
  if (planes.step == 0)
    throw InputError(file + ": its contours lie in a single plane: a volume needs two at least, an organ some dozens");
  const Eigen::Vector3d side = std::abs(normal.x()) < 0.8 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d u = (side - normal.dot(side) * normal).normalized(), v = normal.cross(u);
  const double pixel = pixel_size(structures, u, v);
  Eigen::AlignedBox2d box;
  for (const Structure& structure : structures)
    for (const Contour& contour : structure.closed)
      for (const Eigen::Vector3d& point : contour) box.extend(Eigen::Vector2d(u.dot(point), v.dot(point)));
  const Eigen::Vector2d extent = box.sizes() / pixel;
  if ((extent.x() + 6) * (extent.y() + 6) * (planes.count + 2.0) > static_cast<double>(kMostVoxels))
    throw InputError(file + ": its contours would need more voxels than an import may hold (268 million)");
  ContourGrid grid;
  grid.size = {static_cast<int>(std::ceil(extent.x())) + 1 + 2 * kMargin,
               static_cast<int>(std::ceil(extent.y())) + 1 + 2 * kMargin, planes.count + 2};
  Eigen::Affine3d lps = Eigen::Affine3d::Identity();
  lps.linear() << u * pixel, v * pixel, normal * planes.step;
  lps.translation() = u * (box.min().x() - kMargin * pixel) + v * (box.min().y() - kMargin * pixel) +
                      normal * (planes.first - planes.step);
  grid.index_to_ras_mm = Eigen::Affine3d(Eigen::Scaling(-1.0, -1.0, 1.0)) * lps;
  return grid;
}

}  // namespace trocar
