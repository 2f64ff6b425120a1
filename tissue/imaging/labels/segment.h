// One segment of a segmentation: its number, and all that its file says about what it is.
//
// Names, colours and codes come from the file alone (.seg.nrrd, the label table in a NIfTI, DICOM SEG, RTSTRUCT).
// Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trocar {

/// A term of a terminology as DICOM writes codes (PS3.3 chapter 8): {"type", "SCT", "10200004", "Liver"}.
struct SegmentCode {
  std::string role;  ///< "category", "type", "type modifier", "region", "region modifier"
  std::string scheme, value, meaning;
  bool operator==(const SegmentCode&) const = default;
};

using SegmentColour = std::array<std::uint8_t, 3>;  ///< sRGB

struct Segment {
  std::size_t layer = 0;
  int number = 0;         ///< in that layer
  std::string name = {};  ///< as the file gives it; "" when it gives none (a bare label map)
  std::optional<SegmentColour> colour = {};
  std::vector<SegmentCode> codes = {};  ///< in the order of the roles above
};

inline constexpr std::size_t kReadableBytes = 80;

/// A name as a file has it, made fit to be printed: blanks for control characters (C0, DEL and C1), no blanks round it,
/// at most kReadableBytes (cut between the letters of UTF-8).
std::string readable_name(std::string text);

/// Names as they are compared: "Left Kidney", "left-kidney" and "left_kidney" are one. ASCII letters small, whatever is
/// neither letter nor digit one '_' between words; other letters of UTF-8 stay.
std::string folded_name(std::string_view name);

/// "a, b and 7 more".
std::string listed_words(const std::vector<std::string>& words, std::size_t most);

/// Colour from parts of one. @returns nothing unless all three are numbers from 0 to 1
std::optional<SegmentColour> colour_of(double red, double green, double blue);

}  // namespace trocar
