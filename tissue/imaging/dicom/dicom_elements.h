// The elements of a DICOM file that the readers need, parsed and checked by ourselves before any library sees the file.
//
// Source: DICOM PS3.5 section 7 (elements, sequences) and annex A (encodings), PS3.10 section 7 (file header). Only
// elements of a fixed list are kept, none of which names a patient; everything else is stepped over. Pixel data stay in
// the file: only their place is kept. Thread: any.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tissue/imaging/dicom/byte_source.h"
#include "tissue/imaging/dicom/transfer_syntax.h"

namespace trocar {

/// Group in the upper 16 bits, element in the lower.
using DicomTag = std::uint32_t;

struct DicomItem;

struct DicomElement {
  std::string value;             ///< trimmed text, or binary numbers in little endian order
  std::vector<DicomItem> items;  ///< of a sequence
};

struct DicomItem {
  std::map<DicomTag, DicomElement> elements;

  const DicomElement* find(DicomTag tag) const;
  /// The first item of a sequence; nullptr when there is none.
  const DicomItem* first_item(DicomTag tag) const;
  std::string text(DicomTag tag) const;  ///< "" when it is missing
  /// Numbers of a text element separated by backslashes. nullopt when missing, or when one of them is no finite number.
  std::optional<std::vector<double>> decimals(DicomTag tag) const;
  std::optional<std::uint32_t> whole(DicomTag tag) const;  ///< first value of a 16 or 32 bit element
};

struct PixelSpan {
  bool present = false;
  bool encapsulated = false;
  bool words = false;                    ///< stored as 16-bit words (OW): bytes of big endian files come swapped
  bool floating = false;                 ///< float or double pixel data, which no reader here takes
  std::uint64_t offset = 0, length = 0;  ///< native: of the bytes. Encapsulated: of all fragments with their headers
  std::vector<std::pair<std::uint64_t, std::uint32_t>> fragments;  ///< offset and length, without the offset table
  std::vector<std::uint32_t> frame_offsets;                        ///< the basic offset table
};

struct DicomFile {
  DicomItem data;
  const TransferSyntax* syntax = nullptr;  ///< nullptr: not in the standard's list
  bool has_header = true;                  ///< false: no "DICM" signature, the encoding was guessed
  PixelSpan pixels;
  std::string damage;  ///< "" or why parsing stopped: what came before it is in `data`
};

/// Bytes that may still be inflated for one input, so that many small files cannot become endless work.
struct InflateBudget {
  std::uint64_t left = std::uint64_t{1} << 30;
};

/// nullopt when the file is not DICOM. Damage of a file that is DICOM is told in `damage`.
/// @param source receives the bytes in which `pixels` lie (those of an inflated file are in memory)
/// @throws InputError when the file cannot be read at all
std::optional<DicomFile> read_dicom_elements(const std::filesystem::path& path, const std::string& name,
                                             InflateBudget& budget, std::unique_ptr<ByteSource>* source = nullptr);

}  // namespace trocar
