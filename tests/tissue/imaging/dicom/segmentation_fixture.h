// DICOM segmentations and structure sets made for tests, element by element.
//
// Thread: any.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/tissue/imaging/dicom/dicom_fixture.h"

namespace trocar::test {

/// One frame of a segmentation: the segment (from 1), where it lies (LPS) and its values, row by row (0 or 1, or
/// 0..maximum, or numbers of segments).
struct SegmentationFrame {
  int segment = 1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::vector<int> values;
};

struct SegmentationFixture {
  int columns = 7, rows = 5;  ///< 35 pixels: frames do not begin at whole bytes
  Eigen::Vector3d along_row{1, 0, 0}, along_column{0, 1, 0};
  double row_step = 0.5, column_step = 0.75;
  std::vector<std::string> labels{"Liver"};
  std::vector<SegmentationFrame> frames;
  int maximum = 0;                          ///< 0: binary
  int label_bits = 0;                       ///< 8 or 16: a label map
  int shared_segment = 0;                   ///< that every frame marks, told once; frames then name 0
  std::vector<int> numbers;                 ///< of the segments; empty: 1, 2, ...
  Encoding encoding = Encoding::kExplicit;  ///< explicit or deflated
  std::function<void(Elements&)> change = [](Elements&) {};

  Elements elements() const;
  std::string file(const std::string& syntax = "") const { return dicom_file(elements(), syntax); }
  /// One frame's values as native bytes: packed bits of a binary one.
  std::string bytes_of(const SegmentationFrame& frame) const;
  /// Every frame in one fragment, as `coded` makes it of the frame.
  std::string file(const std::string& syntax, const std::function<std::string(const SegmentationFrame&)>& coded) const;
};

struct StructureFixture {
  int number = 1;
  std::string name = "Liver";
  std::vector<std::vector<Eigen::Vector3d>> contours;
  std::string type = "CLOSED_PLANAR";
};

Elements structure_set(const std::vector<StructureFixture>& structures);

/// Corners of a rectangle in a plane of constant z.
std::vector<Eigen::Vector3d> rectangle(double left, double front, double right, double back, double z);

/// A polygon of `count` points on a circle.
std::vector<Eigen::Vector3d> circle(const Eigen::Vector3d& centre, double radius, int count);

}  // namespace trocar::test
