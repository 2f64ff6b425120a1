#include "tests/tissue/support/itk_volume.h"

#include <itkImage.h>
#include <itkImageFileReader.h>
#include <itkMetaImageIO.h>
#include <itkMultiThreaderBase.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "haptics/input_error.h"

namespace trocar {
namespace {

using Image = itk::Image<double, 3>;

ItkVolume copy_out(const Image& image) {
  ItkVolume volume;
  const auto size = image.GetLargestPossibleRegion().GetSize();
  for (unsigned axis = 0; axis < 3; ++axis) {
    volume.size[axis] = static_cast<int>(size[axis]);
    volume.origin_mm[axis] = image.GetOrigin()[axis];
    volume.spacing_mm[axis] = image.GetSpacing()[axis];
    for (unsigned column = 0; column < 3; ++column) volume.direction[axis][column] = image.GetDirection()(axis, column);
  }
  const double* first = image.GetBufferPointer();
  volume.values.assign(first, first + static_cast<std::ptrdiff_t>(size[0] * size[1] * size[2]));
  return volume;
}

}  // namespace

ItkVolume read_itk_volume(const std::filesystem::path& path) {
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
  try {
    const auto reader = itk::ImageFileReader<Image>::New();
    const std::string ending = path.extension().string();
    if (ending == ".nrrd")
      reader->SetImageIO(itk::NrrdImageIO::New());
    else if (ending == ".mha")
      reader->SetImageIO(itk::MetaImageIO::New());
    else
      reader->SetImageIO(itk::NiftiImageIO::New());
    reader->SetFileName(path.string());
    reader->Update();
    return copy_out(*reader->GetOutput());
  } catch (const itk::ExceptionObject& error) {
    throw InputError(path.string() + ": ITK refuses it: " + error.GetDescription());
  }
}

}  // namespace trocar
