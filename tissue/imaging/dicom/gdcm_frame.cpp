#include "tissue/imaging/dicom/gdcm_frame.h"

#include <gdcmImage.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>

#include "haptics/input_error.h"

namespace trocar {
namespace {

void silence() {
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
}

gdcm::DataElement gdcm_fragments(const std::string& bytes) {
  gdcm::Fragment fragment;
  fragment.SetByteValue(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  const gdcm::SmartPointer<gdcm::SequenceOfFragments> sequence = new gdcm::SequenceOfFragments;
  sequence->AddFragment(fragment);
  gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
  pixels.SetVR(gdcm::VR::OB);
  pixels.SetVL(0xFFFFFFFFU);
  pixels.SetValue(*sequence);
  return pixels;
}

}  // namespace

std::string decode_frame_gdcm(const std::string& bytes, const DicomImage& image, const std::string& name) {
  silence();
  const PixelFormat& format = image.format;
  gdcm::Image frame;
  frame.SetNumberOfDimensions(2);
  frame.SetDimension(0, static_cast<unsigned>(image.columns));
  frame.SetDimension(1, static_cast<unsigned>(image.rows));
  frame.SetPixelFormat(gdcm::PixelFormat(1, static_cast<unsigned short>(format.allocated),
                                         static_cast<unsigned short>(format.stored),
                                         static_cast<unsigned short>(format.high_bit), format.is_signed ? 1 : 0));
  frame.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  frame.SetTransferSyntax(gdcm::TransferSyntax::GetTSType(std::string(image.syntax->uid).c_str()));
  frame.SetDataElement(gdcm_fragments(bytes));
  const std::size_t need = static_cast<std::size_t>(image.rows) * static_cast<std::size_t>(image.columns) *
                           static_cast<std::size_t>(format.allocated / 8);
  std::string values(frame.GetBufferLength(), '\0');
  if (values.size() < need || !frame.GetBuffer(values.data()))
    throw InputError(name + ": its pixels (" + std::string(image.syntax->name) +
                     ") cannot be decoded: they are damaged");
  if (frame.GetPixelFormat().GetBitsAllocated() != format.allocated)
    throw InputError(name + ": its compressed pixels have other bits than its header says");
  values.resize(need);
  return values;
}

}  // namespace trocar
