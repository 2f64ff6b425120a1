// A mass on the stylus of any simulated device.
#include <gtest/gtest.h>

#include "app/studies/device/identified_device.h"

namespace trocar::plant_payload_test {
namespace {

TEST(TruePlant, PayloadSitsOnAnyDevice) {
  PlantParameters heavy = nominal_parameters();
  heavy.stylus_mass = 0.2;
  EXPECT_DOUBLE_EQ(with_payload(heavy, 0.05).stylus_mass, 0.25);
  EXPECT_NEAR(with_payload(heavy, 0.05).stylus_com.z(), 0.05 * 0.030 / 0.25, 1e-12);
  EXPECT_EQ(drawn_with_payload(3, 0.01).stylus_com, with_payload(draw_parameters(3), 0.01).stylus_com);
}

}  // namespace
}  // namespace trocar::plant_payload_test
