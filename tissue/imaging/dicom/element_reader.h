// Walks the elements of a DICOM data set (PS3.5 section 7) and keeps those of dicom_tags.h.
//
// Every length is checked against the end of what holds it; sequences are followed to a depth of 12; what is kept is
// bounded. Thread: one owner.
#pragma once

#include <array>

#include "tissue/imaging/dicom/dicom_elements.h"

namespace trocar {

class ElementReader {
 public:
  ElementReader(ByteSource& source, const TransferSyntax& syntax, PixelSpan& pixels)
      : source_(source), pixels_(pixels), explicit_(syntax.explicit_vr), big_(syntax.big_endian) {}

  /// Up to the pixel data or the end of the source.
  /// @throws InputError naming file and element: cut off, bad value representation, nested too deep
  void read_all(DicomItem& data, std::uint64_t from);
  /// Elements of one group; returns where the first of another group starts.
  std::uint64_t read_group(DicomItem& data, std::uint64_t from, unsigned group);

 private:
  struct Head {
    DicomTag tag = 0;
    std::array<char, 2> vr{'U', 'N'};
    std::uint32_t length = 0;
    std::uint64_t value_at = 0;
    bool undefined() const { return length == 0xFFFFFFFFU; }
    bool is(const char* name) const { return vr[0] == name[0] && vr[1] == name[1]; }
  };

  Head read_head(std::uint64_t at, std::uint64_t end);
  void read_explicit_length(Head& head, const unsigned char* bytes, std::uint64_t at, std::uint64_t end);
  void keep_value(DicomItem& item, const Head& head, char type);
  std::uint64_t read_element(DicomItem* item, const Head& head, std::uint64_t end, int depth);
  std::uint64_t read_sequence(DicomElement* into, const Head& head, std::uint64_t end, int depth);
  std::uint64_t read_item(DicomItem* item, const Head& head, std::uint64_t end, int depth);
  void read_pixels(const Head& head);
  void read_fragments(std::uint64_t at);
  void read_offset_table(const Head& head);
  std::uint32_t number(const unsigned char* bytes, int size) const;
  [[noreturn]] void damaged(DicomTag tag, const std::string& what) const;

  ByteSource& source_;
  PixelSpan& pixels_;
  bool explicit_, big_;
  std::size_t kept_ = 0;
};

}  // namespace trocar
