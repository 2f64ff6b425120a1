// Drawn hands on tissue whose steps come late, stall and are lost: no energy comes out, no force grows by itself.
#include "app/studies/tissue/drawn_contacts.h"

#include <gtest/gtest.h>

#include <string>

namespace trocar::drawn_contacts_test {
namespace {

TEST(DrawnContacts, NoEnergyComesOutAndNoForceGrowsInAStall) {
  bool turned = false, slid = false;
  for (std::size_t n = 0; n < 4; ++n) {
    const DrawnContactMeasures m = run_drawn_contact(drawn_contact(1, n), {.rows = 40, .cell_m = 0.0125});
    const std::string which = "arm " + std::to_string(n);
    RecordProperty("out_mj_" + std::to_string(n), std::to_string(1e3 * m.energy_out_j));
    EXPECT_TRUE(m.finite) << which;
    EXPECT_LT(m.energy_out_j, 5e-5) << which;
    EXPECT_GT(m.put_in_j, 0) << which;
    EXPECT_LT(m.stall_growth_n, 1e-3) << which;
    EXPECT_LT(m.most_step_n, 0.3) << which;
    EXPECT_GT(m.most_n, 0.05) << which << " touched nothing";
    turned = turned || m.turned_rad > 0.3;
    slid = slid || m.slipping > 0.2;
  }
  EXPECT_TRUE(turned && slid);
}

TEST(DrawnContacts, ASeedDrawsTheSameArmsAgain) {
  const DrawnContactOptions options{.rows = 30, .cell_m = 0.020};
  const DrawnContactMeasures once = run_drawn_contact(drawn_contact(2, 1), options),
                             again = run_drawn_contact(drawn_contact(2, 1), options);
  EXPECT_EQ(once.put_in_j, again.put_in_j);
  EXPECT_EQ(once.most_n, again.most_n);
  EXPECT_NE(drawn_contact(2, 1).young_pa, drawn_contact(3, 1).young_pa);
}

}  // namespace
}  // namespace trocar::drawn_contacts_test
