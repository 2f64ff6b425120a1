// The DICOM elements that the readers keep (PS3.6). Nothing here names a patient, a person, a place or a time.
//
// Thread: any.
#pragma once

#include "tissue/imaging/dicom/dicom_elements.h"

namespace trocar::tag {

inline constexpr DicomTag kTransferSyntax = 0x00020010;
inline constexpr DicomTag kDirectoryRecords = 0x00041220, kReferencedFile = 0x00041500;
inline constexpr DicomTag kImageType = 0x00080008, kSopClass = 0x00080016, kSopInstance = 0x00080018,
                          kModality = 0x00080060;
inline constexpr DicomTag kEchoTime = 0x00180081, kEcho = 0x00180086, kTrigger = 0x00181060, kDiffusion = 0x00189087;
inline constexpr DicomTag kAcquisition = 0x00200012, kTemporalPosition = 0x00200100;
inline constexpr DicomTag kStudy = 0x0020000D, kSeries = 0x0020000E, kSeriesNumber = 0x00200011;
inline constexpr DicomTag kPosition = 0x00200032, kOrientation = 0x00200037, kFrameOfReference = 0x00200052;
inline constexpr DicomTag kSamples = 0x00280002, kPhotometric = 0x00280004, kFrames = 0x00280008, kRows = 0x00280010;
inline constexpr DicomTag kColumns = 0x00280011, kPixelSpacing = 0x00280030, kBitsAllocated = 0x00280100;
inline constexpr DicomTag kBitsStored = 0x00280101, kHighBit = 0x00280102, kPixelRepresentation = 0x00280103;
inline constexpr DicomTag kIntercept = 0x00281052, kSlope = 0x00281053, kLossy = 0x00282110;
inline constexpr DicomTag kSharedGroups = 0x52009229, kFrameGroups = 0x52009230;
inline constexpr DicomTag kPlanePosition = 0x00209113, kPlaneOrientation = 0x00209116, kPixelMeasures = 0x00289110;
inline constexpr DicomTag kValueTransformation = 0x00289145;
inline constexpr DicomTag kSegmentationType = 0x00620001, kMaximumFraction = 0x0062000E, kPadding = 0x00280120;
inline constexpr DicomTag kSegments = 0x00620002, kSegmentNumber = 0x00620004, kSegmentLabel = 0x00620005;
inline constexpr DicomTag kDisplayLab = 0x0062000D, kSegmentIdentification = 0x0062000A,
                          kReferencedSegment = 0x0062000B;
inline constexpr DicomTag kPropertyCategory = 0x00620003, kPropertyType = 0x0062000F,
                          kPropertyTypeModifier = 0x00620011;
inline constexpr DicomTag kAnatomicRegion = 0x00082218, kAnatomicRegionModifier = 0x00082220;
inline constexpr DicomTag kCodeValue = 0x00080100, kCodeScheme = 0x00080102, kCodeMeaning = 0x00080104;
inline constexpr DicomTag kPaletteAbout = 0x00281101, kPalette = 0x00281201;  // of red; green and blue follow
inline constexpr DicomTag kFloatPixels = 0x7FE00008, kDoublePixels = 0x7FE00009, kPixels = 0x7FE00010;
inline constexpr DicomTag kItem = 0xFFFEE000, kItemEnd = 0xFFFEE00D, kSequenceEnd = 0xFFFEE0DD;

}  // namespace trocar::tag
