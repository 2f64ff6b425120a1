#include "tests/tissue/imaging/dicom/segmentation_fixture.h"

#include <cmath>
#include <numbers>

namespace trocar::test {
namespace {

Elements code(const char* value, const char* meaning) {
  return Elements().text(0x00080100, "SH", value).text(0x00080102, "SH", "SCT").text(0x00080104, "LO", meaning);
}

Elements segment_of(int number, const std::string& label) {
  Elements segment;
  segment.sequence(0x00620003, {code("85756007", "Tissue")})
      .word(0x00620004, static_cast<unsigned>(number))
      .text(0x00620005, "LO", label);
  return segment.text(0x00620008, "CS", "MANUAL").sequence(0x0062000F, {code("10200004", "Liver")});
}

Elements frame_of(const SegmentationFrame& frame, unsigned index) {
  Elements item;
  const Eigen::Vector3d& p = frame.position;
  const std::string indices = std::string{static_cast<char>(frame.segment), 0, 0, 0, static_cast<char>(index), 0, 0, 0};
  item.sequence(0x00209111, {Elements().bytes(0x00209157, "UL", indices)});
  item.sequence(0x00209113, {Elements().numbers(0x00200032, {p.x(), p.y(), p.z()})});
  return frame.segment == 0
             ? item
             : item.sequence(0x0062000A, {Elements().word(0x0062000B, static_cast<unsigned>(frame.segment))});
}

/// Values of `bits` each, one after the other without a gap.
std::string packed(const std::vector<SegmentationFrame>& frames, int bits) {
  std::string bytes;
  std::size_t at = 0;
  for (const SegmentationFrame& frame : frames)
    for (const int value : frame.values) {
      if (bits == 1 && at++ % 8 == 0) bytes += '\0';
      if (bits == 1 && value != 0)
        bytes.back() = static_cast<char>(static_cast<unsigned char>(bytes.back()) | 1U << (at - 1) % 8);
      for (int shift = 0; bits > 1 && shift < bits; shift += 8) bytes += static_cast<char>(value >> shift & 0xFF);
    }
  if (bytes.size() % 2 != 0) bytes += '\0';
  return bytes;
}

Elements dimensions(Encoding encoding) {
  const auto pointer = [](const std::string& tag, const std::string& group) {
    return Elements().text(0x00209164, "UI", "1.2.7").bytes(0x00209165, "AT", tag).bytes(0x00209167, "AT", group);
  };
  Elements data(encoding);
  data.sequence(0x00209222, {pointer(std::string("\x62\0\x0B\0", 4), std::string("\x62\0\x0A\0", 4)),
                             pointer(std::string("\x20\0\x32\0", 4), std::string("\x20\0\x13\x91", 4))});
  return data;
}

}  // namespace

Elements SegmentationFixture::elements() const {
  Elements data = dimensions(encoding);
  data.sequence(0x00209221, {Elements().text(0x00209164, "UI", "1.2.7")});
  data.text(0x00080008, "CS", "DERIVED\\PRIMARY")
      .text(0x00080016, "UI", label_bits != 0 ? kLabelMapClass : kSegmentationClass)
      .text(0x00080018, "UI", "1.2.3.8.1");
  data.text(0x00080060, "CS", "SEG")
      .text(0x0020000D, "UI", "1.2.3")
      .text(0x0020000E, "UI", "1.2.3.8")
      .text(0x00200011, "IS", "8");
  data.text(0x00200013, "IS", "1").text(0x00200052, "UI", "1.2.9").text(0x00209311, "CS", "3D");
  data.word(0x00280002, 1).text(0x00280004, "CS", "MONOCHROME2").text(0x00280008, "IS", std::to_string(frames.size()));
  data.word(0x00280010, static_cast<unsigned>(rows)).word(0x00280011, static_cast<unsigned>(columns));
  const auto bits = static_cast<unsigned>(label_bits != 0 ? label_bits : maximum == 0 ? 1 : 8);
  data.word(0x00280100, bits)
      .word(0x00280101, bits)
      .word(0x00280102, bits - 1)
      .word(0x00280103, 0)
      .text(0x00282110, "CS", "00");
  data.text(0x00620001, "CS",
            label_bits != 0 ? "LABELMAP"
            : maximum == 0  ? "BINARY"
                            : "FRACTIONAL")
      .text(0x00700080, "CS", "SEG")
      .text(0x00700081, "LO", "");
  if (maximum != 0) data.text(0x00620010, "CS", "OCCUPANCY").word(0x0062000E, static_cast<unsigned>(maximum));
  std::vector<Elements> segments, groups;
  for (std::size_t n = 0; n < labels.size(); ++n)
    segments.push_back(segment_of(numbers.empty() ? static_cast<int>(n + 1) : numbers[n], labels[n]));
  for (std::size_t n = 0; n < frames.size(); ++n) groups.push_back(frame_of(frames[n], static_cast<unsigned>(n + 1)));
  Elements shared;
  const Eigen::Vector3d &u = along_row, &v = along_column;
  shared.sequence(0x00209116, {Elements().numbers(0x00200037, {u.x(), u.y(), u.z(), v.x(), v.y(), v.z()})});
  shared.sequence(0x00289110, {Elements().numbers(0x00180050, {99}).numbers(0x00280030, {column_step, row_step})});
  if (shared_segment != 0)
    shared.sequence(0x0062000A, {Elements().word(0x0062000B, static_cast<unsigned>(shared_segment))});
  data.sequence(0x00620002, segments).sequence(0x52009229, {shared}).sequence(0x52009230, groups);
  data.bytes(0x7FE00010, bits == 16 ? "OW" : "OB", packed(frames, static_cast<int>(bits)));
  change(data);
  return data;
}

std::string SegmentationFixture::bytes_of(const SegmentationFrame& frame) const {
  return packed({frame}, label_bits != 0 ? label_bits : maximum == 0 ? 1 : 8);
}

std::string SegmentationFixture::file(const std::string& syntax,
                                      const std::function<std::string(const SegmentationFrame&)>& coded) const {
  Elements data = elements();
  std::vector<std::string> pieces;
  for (const SegmentationFrame& frame : frames) pieces.push_back(coded(frame));
  return dicom_file(data.fragments(pieces), syntax);
}

Elements structure_set(const std::vector<StructureFixture>& structures) {
  std::vector<Elements> names, contours;
  for (const StructureFixture& structure : structures) {
    const std::string number = std::to_string(structure.number);
    names.push_back(Elements(Encoding::kImplicit)
                        .text(0x30060022, "IS", number)
                        .text(0x30060024, "UI", "1.2.9")
                        .text(0x30060026, "LO", structure.name));
    std::vector<Elements> of_structure;
    for (const auto& contour : structure.contours) {
      std::vector<double> numbers;
      for (const Eigen::Vector3d& point : contour) numbers.insert(numbers.end(), {point.x(), point.y(), point.z()});
      Elements item(Encoding::kImplicit);
      item.text(0x30060042, "CS", structure.type)
          .text(0x30060046, "IS", std::to_string(contour.size()))
          .numbers(0x30060050, numbers);
      of_structure.push_back(item);
    }
    contours.push_back(Elements(Encoding::kImplicit).sequence(0x30060040, of_structure).text(0x30060084, "IS", number));
  }
  Elements data(Encoding::kImplicit);
  data.text(0x00080016, "UI", kStructureClass).text(0x00080018, "UI", "1.2.3.9.1").text(0x00080060, "CS", "RTSTRUCT");
  data.text(0x0020000D, "UI", "1.2.3")
      .text(0x0020000E, "UI", "1.2.3.9")
      .text(0x00200011, "IS", "9")
      .text(0x30060002, "SH", "set");
  return data.sequence(0x30060020, names).sequence(0x30060039, contours);
}

std::vector<Eigen::Vector3d> rectangle(double left, double front, double right, double back, double z) {
  return {{left, front, z}, {right, front, z}, {right, back, z}, {left, back, z}};
}

std::vector<Eigen::Vector3d> circle(const Eigen::Vector3d& centre, double radius, int count) {
  std::vector<Eigen::Vector3d> points;
  for (int n = 0; n < count; ++n) {
    const double angle = 2 * std::numbers::pi * n / count;
    points.push_back(centre + Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0));
  }
  return points;
}

}  // namespace trocar::test
