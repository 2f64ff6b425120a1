// `trocar device card` on a card that is not there.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include <nlohmann/json.hpp>

#include "haptics/device/hostmot2/fake_hostmot2.h"

namespace trocar::card_command_test {
namespace {

struct Said {
  std::string out;
  int code = 0;
};

Said ask(const FakeHostmot2& card, const std::string& more) {
  const std::string line = std::string(TROCAR_PROGRAM) + " device card " + card.address() + more + " 2>/dev/null";
  Said said;
  FILE* pipe = ::popen(line.c_str(), "r");
  std::array<char, 256> part{};
  while (std::fgets(part.data(), part.size(), pipe)) said.out += part.data();
  said.code = ::pclose(pipe) >> 8;
  return said;
}

TEST(CardCommand, SaysWhoTheCardIsAndWhatItsInputsSay) {
  SimulatedDaq device(FakeHostmot2::device_config({}));
  FakeHostmot2 card(device, {}, hostmot2::standard_wiring());
  const Said said = ask(card, " --json");
  ASSERT_EQ(said.code, 0) << said.out;
  const auto json = nlohmann::json::parse(said.out);
  EXPECT_EQ(json["board"], "7I80HD");
  EXPECT_EQ(json["inputs"].size(), 20U);
  EXPECT_EQ(json["inputs"][2]["input"], "emergency stop");
  EXPECT_EQ(json["modules"][0]["there"], 8);
  EXPECT_NE(ask(card, "").out.find("enabling switch closed"), std::string::npos);
  EXPECT_FALSE(card.amplifiers_enabled());
}

TEST(CardCommand, ACardWithTooLittleIsToldWithFour) {
  SimulatedDaq device(FakeHostmot2::device_config({}));
  FakeHostmot2 card(device, {}, hostmot2::standard_wiring(), {.encoders = 4});
  EXPECT_EQ(ask(card, "").code, 4);
  card.trouble({.silent = true});
  EXPECT_EQ(ask(card, "").code, 3);
}

}  // namespace
}  // namespace trocar::card_command_test
