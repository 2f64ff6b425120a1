#include "tissue/mesh/files/patient_axes.h"

#include "haptics/input_error.h"

namespace trocar {

Mat3 to_ras(const std::string& frame) {
  const std::string positive = "RAS", negative = "LPI";
  Mat3 turn = Mat3::Zero();
  for (std::size_t n = 0; n < frame.size() && n < 3; ++n) {
    const std::size_t plus = positive.find(frame[n]), minus = negative.find(frame[n]);
    const std::size_t row = plus != std::string::npos ? plus : minus;
    if (row != std::string::npos) turn(static_cast<int>(row), static_cast<int>(n)) = plus != std::string::npos ? 1 : -1;
  }
  if (frame.size() != 3 || turn.determinant() == 0)
    throw InputError("frame \"" + frame +
                     "\": three letters are wanted, what x, y and z point at: R or L, A or P, S or I, as RAS or LPS");
  return turn;
}

std::string frame_of_up_axis(const std::string& up_axis) {
  if (up_axis == "z") return "RAS";
  if (up_axis == "y") return "LSA";
  if (up_axis == "x") return "SRA";
  throw InputError("up axis \"" + up_axis + "\": x, y or z is wanted");
}

}  // namespace trocar
