#include "tissue/imaging/labels/itk_region.h"

#include <itkBinaryThresholdImageFilter.h>
#include <itkConnectedThresholdImageFilter.h>
#include <itkCurvatureFlowImageFilter.h>
#include <itkImage.h>
#include <itkMultiThreaderBase.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>
#include <cstddef>

namespace trocar {
namespace {

using Mask = itk::Image<std::uint8_t, 3>;
using Values = itk::Image<float, 3>;

/// An ITK image over our own memory; nothing is copied.
template <typename Image>
typename Image::Pointer over(std::vector<typename Image::PixelType>& voxels, const RegionShape& shape) {
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
  const auto image = Image::New();
  typename Image::RegionType region;
  typename Image::SpacingType spacing;
  for (unsigned axis = 0; axis < 3; ++axis) {
    region.SetSize(axis, static_cast<itk::SizeValueType>(shape.size[axis]));
    spacing[axis] = shape.spacing_mm[axis];
  }
  image->SetRegions(region);
  image->SetSpacing(spacing);
  image->GetPixelContainer()->SetImportPointer(voxels.data(), voxels.size(), false);
  return image;
}

template <typename Image>
void copy_back(const Image& image, std::vector<typename Image::PixelType>& voxels) {
  std::copy_n(image.GetBufferPointer(), voxels.size(), voxels.begin());
}

bool any(const std::vector<std::uint8_t>& mask) {
  return std::find(mask.begin(), mask.end(), std::uint8_t{1}) != mask.end();
}

/// Adds every voxel within the radius of the voxels that hold `value`.
void spread(std::vector<std::uint8_t>& mask, const RegionShape& shape, double radius_mm, std::uint8_t value) {
  for (std::uint8_t& voxel : mask) voxel = voxel == value ? 1 : 0;
  if (any(mask)) {
    const auto filter = itk::SignedMaurerDistanceMapImageFilter<Mask, Values>::New();
    filter->SetInput(over<Mask>(mask, shape));
    filter->SetUseImageSpacing(true);
    filter->SetSquaredDistance(false);
    filter->SetInsideIsPositive(false);
    filter->Update();
    const float* distance = filter->GetOutput()->GetBufferPointer();
    const auto reach = static_cast<float>(radius_mm * (1 + 1e-6));  // voxels at the radius itself belong to the ball
    for (std::size_t voxel = 0; voxel < mask.size(); ++voxel)
      if (distance[voxel] <= reach) mask[voxel] = 1;
  }
  for (std::uint8_t& voxel : mask) voxel = voxel == 1 ? value : static_cast<std::uint8_t>(1 - value);
}

}  // namespace

void curvature_flow(std::vector<float>& values, const RegionShape& shape, int steps) {
  const auto filter = itk::CurvatureFlowImageFilter<Values, Values>::New();
  filter->SetInput(over<Values>(values, shape));
  filter->SetNumberOfIterations(static_cast<itk::IdentifierType>(steps));
  filter->SetTimeStep(0.0625);  // the largest that is stable in three dimensions
  filter->Update();
  copy_back(*filter->GetOutput(), values);
}

std::vector<std::uint8_t> window_mask(const std::vector<float>& values, const RegionShape& shape, float low,
                                      float high) {
  const auto filter = itk::BinaryThresholdImageFilter<Values, Mask>::New();
  filter->SetInput(over<Values>(const_cast<std::vector<float>&>(values), shape));
  filter->SetLowerThreshold(low);
  filter->SetUpperThreshold(high);
  filter->SetInsideValue(1);
  filter->SetOutsideValue(0);
  filter->Update();
  std::vector<std::uint8_t> mask(values.size());
  copy_back(*filter->GetOutput(), mask);
  return mask;
}

void dilate(std::vector<std::uint8_t>& mask, const RegionShape& shape, double radius_mm) {
  spread(mask, shape, radius_mm, 1);
}

void erode(std::vector<std::uint8_t>& mask, const RegionShape& shape, double radius_mm) {
  spread(mask, shape, radius_mm, 0);
}

void keep_connected(std::vector<std::uint8_t>& mask, const RegionShape& shape, const std::array<int, 3>& seed) {
  const auto filter = itk::ConnectedThresholdImageFilter<Mask, Mask>::New();
  filter->SetInput(over<Mask>(mask, shape));
  filter->SetLower(1);
  filter->SetUpper(1);
  filter->SetReplaceValue(1);
  filter->SetConnectivity(itk::ConnectedThresholdImageFilter<Mask, Mask>::FaceConnectivity);
  filter->SetSeed({{seed[0], seed[1], seed[2]}});
  filter->Update();
  copy_back(*filter->GetOutput(), mask);
}

}  // namespace trocar
