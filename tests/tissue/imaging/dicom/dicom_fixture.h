// DICOM files made element by element for tests, independent of every reader and library of the project.
//
// Source: DICOM PS3.5 section 7 and PS3.10 section 7. Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace trocar::test {

enum class Encoding { kExplicit, kImplicit, kBigEndian, kDeflated };

inline constexpr const char* kCtClass = "1.2.840.10008.5.1.4.1.1.2";
inline constexpr const char* kMrClass = "1.2.840.10008.5.1.4.1.1.4";
inline constexpr const char* kEnhancedCtClass = "1.2.840.10008.5.1.4.1.1.2.1";
inline constexpr const char* kSegmentationClass = "1.2.840.10008.5.1.4.1.1.66.4";
inline constexpr const char* kLabelMapClass = "1.2.840.10008.5.1.4.1.1.66.7";
inline constexpr const char* kStructureClass = "1.2.840.10008.5.1.4.1.1.481.3";
inline constexpr const char* kRle = "1.2.840.10008.1.2.5";

/// A data set: elements by tag, each replaceable, written in order of their tags.
class Elements {
 public:
  explicit Elements(Encoding encoding = Encoding::kExplicit) : encoding_(encoding) {}

  Elements& text(std::uint32_t tag, const char* vr, const std::string& value);
  Elements& numbers(std::uint32_t tag, const std::vector<double>& values);  ///< DS
  Elements& word(std::uint32_t tag, unsigned value);                        ///< US
  Elements& bytes(std::uint32_t tag, const char* vr, const std::string& value);
  /// @param undefined with delimiters instead of lengths
  Elements& sequence(std::uint32_t tag, const std::vector<Elements>& items, bool undefined = false);
  /// Compressed pixel data: an empty offset table, or the one given, and the fragments.
  Elements& fragments(const std::vector<std::string>& pieces, const std::vector<std::uint32_t>& table = {});
  Elements& raw(std::uint32_t tag, const std::string& whole);  ///< head and value as they are
  Elements& erase(std::uint32_t tag);
  std::string encoded() const;
  Encoding encoding() const { return encoding_; }

 private:
  std::string head(std::uint32_t tag, const char* vr, std::size_t length) const;
  std::string number(std::uint64_t value, int size) const;

  Encoding encoding_;
  std::map<std::uint32_t, std::string> elements_;
};

/// Preamble, signature, file header and data set (deflated where its encoding says so).
/// @param syntax "" for that of the encoding
std::string dicom_file(const Elements& data, const std::string& syntax = "");

/// One slice of a series; every field may be changed before `file()`.
struct SliceFixture {
  int columns = 6, rows = 5;
  Eigen::Vector3d position{-10, -20, 30};  ///< LPS
  Eigen::Vector3d along_row{1, 0, 0}, along_column{0, 1, 0};
  double row_step = 0.5, column_step = 0.75;
  int allocated = 16, stored = 16;
  bool is_signed = true;
  std::string modality = "CT", sop_class = kCtClass, series = "1.2.3.4", study = "1.2.3", photometric = "MONOCHROME2";
  std::string series_number = "1";
  bool rescale = true;
  double slope = 1, intercept = -1024;
  Encoding encoding = Encoding::kExplicit;
  std::function<int(int i, int j)> value = [](int i, int j) { return 100 + i + 10 * j; };
  std::function<void(Elements&)> change = [](Elements&) {};  ///< last word on the elements

  std::string pixels() const;  ///< native bytes in the encoding's order
  Elements elements() const;
  std::string file(const std::string& syntax = "") const { return dicom_file(elements(), syntax); }
};

/// A stack of `count` slices along the normal, `step` mm apart; stored value 1000 k + 10 j + i.
std::vector<SliceFixture> stack_of(int count, double step, const SliceFixture& like = {});

/// One enhanced multi-frame file of the slices: sizes and pixel measures shared, positions frame by frame.
Elements enhanced(const std::vector<SliceFixture>& slices);

/// RLE of one frame (PS3.5 annex G), most significant bytes first.
std::string rle_frame(const std::string& little_endian_pixels, int bytes_per_pixel);

}  // namespace trocar::test
