#include "app/organs/chosen_labels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::chosen_labels_test {
namespace {

LabelMap map_of(const std::vector<Segment>& segments) {
  LabelMap map;
  for (const Segment& segment : segments) {
    while (map.layers.size() <= segment.layer) {
      map.layers.emplace_back();
      map.layers.back().size = {4, 4, 4};
      map.layers.back().labels.assign(64, 0);
    }
    const auto slice = static_cast<std::ptrdiff_t>(16 * (segment.number % 4));  // large enough to be an organ
    std::fill_n(map.layers[segment.layer].labels.begin() + slice, 16, static_cast<std::uint16_t>(segment.number));
    map.segments.push_back(segment);
  }
  return map;
}

OrganImportOptions asking(const std::vector<std::string>& labels, const std::string& table = "") {
  OrganImportOptions options;
  options.label = labels;
  options.label_table = table;
  return options;
}

struct Choice {
  std::vector<ChosenLabel> labels;
  std::vector<std::string> decisions;
};

Choice choose(const OrganImportOptions& options, const LabelMap& map) {
  Choice choice;
  choice.labels = choose_labels(options, map, "map.nii.gz", choice.decisions);
  return choice;
}

std::string refusal(const OrganImportOptions& options, const LabelMap& map) {
  return test::message_of<InputError>([&] { choose(options, map); });
}

TEST(ChosenLabels, NoTableIsAssumedThoughAllAgree) {
  const LabelMap map = map_of({{0, 1, ""}, {0, 5, ""}});
  const Choice choice = choose(asking({"5"}), map);
  EXPECT_EQ(choice.labels.at(0).segment.name, "") << "5 is the liver in every table, and here whatever was drawn";
  EXPECT_EQ(choice.labels[0].table, "");
  EXPECT_CONTAINS(refusal(asking({"liver"}), map), "the file gives no such name");
}

TEST(ChosenLabels, NamesAreTakenInAnyCaseAndNameTakesOneLabel) {
  const LabelMap map = map_of({{0, 1, "Liver"}, {0, 2, "Left Kidney"}});
  EXPECT_EQ(choose(asking({"left_kidney"}), map).labels.at(0).segment.number, 2);
  OrganImportOptions by_name;
  by_name.name = "liver";
  EXPECT_EQ(choose(by_name, map).labels.at(0).segment.number, 1);
  by_name.name = "lyver";
  EXPECT_CONTAINS(refusal(by_name, map), "none of them is called \"lyver\"; did you mean \"Liver\"?");
  by_name.name = "liver";
  EXPECT_CONTAINS(refusal(by_name, map_of({{0, 1, "Liver"}, {0, 2, "liver"}})), "2 of them are called \"liver\"");
}

TEST(ChosenLabels, ANameNeedsATable) {
  const LabelMap map = map_of({{0, 1, ""}, {0, 7, ""}, {0, 10, ""}});
  const std::string message = refusal(asking({"pancreas"}), map);
  EXPECT_CONTAINS(message, "totalsegmentator-v1 (10)");
  EXPECT_CONTAINS(message, "totalsegmentator-v2 (7)");
  EXPECT_CONTAINS(message, "--label-table");
  const Choice v1 = choose(asking({"pancreas"}, "totalsegmentator-v1"), map),
               v2 = choose(asking({"pancreas"}, "totalsegmentator-v2"), map);
  EXPECT_EQ(v1.labels[0].segment.number, 10);
  EXPECT_EQ(v2.labels[0].segment.number, 7);
  EXPECT_EQ(v2.labels[0].table, "totalsegmentator-v2");
  EXPECT_TRUE(v2.decisions.empty()) << "nothing was assumed";
}

TEST(ChosenLabels, ABareNumberThatTablesNameDifferentlyStaysWithoutAName) {
  const Choice choice = choose(asking({"7"}), map_of({{0, 1, ""}, {0, 7, ""}}));
  EXPECT_EQ(choice.labels[0].segment.name, "");
  EXPECT_EQ(choice.labels[0].table, "");
  EXPECT_EQ(file_name_of(choice.labels[0].segment), "label-7");
}

TEST(ChosenLabels, NamesOfTheFileGoFirst) {
  const Choice choice = choose(asking({"Left kidney", "2"}), map_of({{0, 1, "Left kidney"}, {0, 2, "Tumour/1"}}));
  EXPECT_EQ(choice.labels[0].segment.number, 1);
  EXPECT_EQ(choice.labels[0].table, "");
  EXPECT_EQ(file_name_of(choice.labels[0].segment), "left_kidney");
  EXPECT_EQ(file_name_of(choice.labels[1].segment), "tumour_1");
}

TEST(ChosenLabels, ATableOfTheUsersOwn) {
  test::TemporaryFolder folder;
  const auto file = folder.write("mine.csv", "number,name\n1,lobe\n7,clip\n");
  const Choice choice = choose(asking({"clip"}, file.string()), map_of({{0, 1, ""}, {0, 7, ""}}));
  EXPECT_EQ(choice.labels[0].segment.number, 7);
  EXPECT_EQ(choice.labels[0].table, "mine.csv");
  EXPECT_CONTAINS(refusal(asking({"clip"}, "no-such-table"), map_of({{0, 7, ""}})), "no-such-table");
}

TEST(ChosenLabels, SeveralAreASceneAndNoneTwice) {
  const LabelMap map = map_of({{0, 1, "a"}, {0, 2, "b"}, {1, 1, "c"}});
  EXPECT_EQ(choose(asking({"a", "c"}), map).labels[1].segment.layer, 1U);
  EXPECT_CONTAINS(refusal(asking({"a", "a"}), map), "twice");
  OrganImportOptions all;
  all.all = true;
  EXPECT_EQ(choose(all, map).labels.size(), 3U);
  all.label = {"a"};
  EXPECT_CONTAINS(refusal(all, map), "--all");
  EXPECT_CONTAINS(refusal(asking({}), map), "--label, or --all");
  EXPECT_CONTAINS(refusal(asking({"Kidney (L)", "kidney l"}), map_of({{0, 1, "Kidney (L)"}, {0, 2, "kidney l"}})),
                  "both be written as \"kidney_l\"");
}

TEST(ChosenLabels, FileNamesHoldNothingButPlainLetters) {
  EXPECT_EQ(file_name_of({0, 3, "../../etc/passwd"}), "etc_passwd");
  EXPECT_EQ(file_name_of({0, 3, "Ä"}), "label-3");
  EXPECT_EQ(file_name_of({0, 3, ""}), "label-3");
}

}  // namespace
}  // namespace trocar::chosen_labels_test
