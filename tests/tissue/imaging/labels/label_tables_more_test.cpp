// Label tables as people write them, and the segment that a person means: round trips, exact places of mistakes, and
// answers that do not depend on the order of lines or segments.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/labels/label_choice.h"
#include "tissue/imaging/labels/label_table_file.h"
#include "tissue/imaging/phantom/phantom_labels.h"

namespace trocar::label_tables_more_test {
namespace {

using Entries = std::vector<std::pair<int, std::string>>;

Entries random_entries(std::uint64_t seed, int count) {
  std::mt19937_64 engine(seed);
  std::set<int> numbers;
  while (static_cast<int>(numbers.size()) < count) numbers.insert(1 + static_cast<int>(engine() % 65535));
  Entries entries;
  for (const int number : numbers) entries.emplace_back(number, "organ_" + std::to_string(number));
  std::shuffle(entries.begin(), entries.end(), engine);
  return entries;
}

Entries entries_of(const OwnLabelTable& own) {
  Entries entries;
  for (const LabelName& each : own.table().labels) entries.emplace_back(each.number, std::string(each.name));
  return entries;
}

std::string refused(const std::string& text) {
  return test::message_of<InputError>([&] { parse_label_table(text, "own.csv"); });
}

std::string listed(const Entries& entries, const char* gap, const char* end) {
  std::string text;
  for (const auto& [number, name] : entries) text += std::to_string(number) + gap + name + end;
  return text;
}

TEST(LabelTableText, RandomTablesComeBackInTheirOrderFromEveryWayToWriteThem) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Entries entries = random_entries(seed, 60);
    for (const char* gap : {",", "\t", " ", ", ", "   "})
      for (const char* end : {"\n", "\r\n", "\n\n", "  \n# a comment, 5\n"})
        EXPECT_EQ(entries_of(parse_label_table(listed(entries, gap, end), "own")), entries) << gap << end;
    std::string snap, slicer = "# Color table file\n0 Background 0 0 0 0\n";
    for (const auto& [number, name] : entries) {
      snap += "  " + std::to_string(number) + "  221 130 101  1  1  1  \"" + name + "\"\n";
      slicer += std::to_string(number) + " " + name + " 221 130 101 255\n";
    }
    EXPECT_EQ(entries_of(parse_label_table(snap, "own.txt")), entries);
    EXPECT_EQ(entries_of(parse_label_table(slicer, "own.ctbl")), entries);
  }
}

TEST(LabelTableText, NamesWithBlanksLiveInQuotationMarksOrBetweenCommas) {
  EXPECT_EQ(parse_label_table("7,left kidney\n", "t").table().number_of("left kidney"), 7);
  EXPECT_EQ(parse_label_table("7\tleft kidney\n", "t").table().number_of("left kidney"), 7);
  EXPECT_EQ(parse_label_table("7,\"kidney, left\"\n", "t").table().number_of("kidney, left"), 7);
  EXPECT_EQ(parse_label_table(" 7 1 2 3 1 1 1 \"left kidney\"\n", "t").table().number_of("left kidney"), 7);
  EXPECT_EQ(parse_label_table("7,foie-g\xc3\xa8re\n", "t").table().name_of(7), "foie-g\xc3\xa8re");
}

TEST(LabelTableText, TheBackgroundTheHeadingAndTheMarkOfASpreadsheetAreNoEntries) {
  const Entries liver{{5, "liver"}};
  EXPECT_EQ(entries_of(parse_label_table("0,background\n5,liver\n", "t")), liver);
  EXPECT_EQ(entries_of(parse_label_table("number,name\n5,liver\n", "t")), liver);
  EXPECT_EQ(entries_of(parse_label_table("\xef\xbb\xbf"
                                         "5,liver\n",
                                         "t")),
            liver);
  EXPECT_EQ(entries_of(parse_label_table("\n\n# table of mine\nLabel\tOrgan\n\n5\tliver", "t")), liver);
  EXPECT_CONTAINS(refused("5,liver\nnumber,name\n"), "own.csv:2:1");  // a heading is the first line only
  EXPECT_CONTAINS(refused("0,background\n"), "no entry");
}

TEST(LabelTableText, TheLastLineNeedsNoEnd) {
  EXPECT_EQ(entries_of(parse_label_table("1,a\n2,b", "t")), entries_of(parse_label_table("1,a\n2,b\n", "t")));
}

TEST(LabelTableText, NumbersEndWhereAVoxelsNumbersEnd) {
  EXPECT_EQ(parse_label_table("65535,top\n1,bottom\n", "t").table().name_of(65535), "top");
  for (const char* number : {"65536", "-1", "1.5", "1e3", "0x10", "5x", "99999999999999999999", "+"})
    EXPECT_CONTAINS(refused("1,liver\n" + std::string(number) + ",spleen\n"), "own.csv:2:1: no label number");
}

TEST(LabelTableText, EveryMistakeIsFoundAtItsOwnLine) {
  const Entries entries = random_entries(99, 40);
  for (int at = 2; at <= 40; at += 3) {
    Entries doubled = entries;
    doubled[static_cast<std::size_t>(at - 1)].first = entries[0].first;
    const std::string place = "own.csv:" + std::to_string(at) + ":";
    EXPECT_CONTAINS(refused(listed(doubled, ",", "\n")),
                    place + "1: number " + std::to_string(entries[0].first) + " is given twice");
    doubled = entries;
    doubled[static_cast<std::size_t>(at - 1)].second = entries[0].second;
    const auto column = std::to_string(doubled[static_cast<std::size_t>(at - 1)].first).size() + 2;
    EXPECT_CONTAINS(refused(listed(doubled, ",", "\n")),
                    place + std::to_string(column) + ": name \"" + entries[0].second + "\" is given twice");
  }
}

TEST(LabelTableText, NamesHaveAnEndAndNoControlCharacters) {
  EXPECT_NO_THROW(parse_label_table("1," + std::string(80, 'x'), "t"));
  EXPECT_CONTAINS(refused("1," + std::string(81, 'x')), "own.csv:1:3: a name of more than 80 letters");
  EXPECT_CONTAINS(refused("12,li\x1bver\n"), "own.csv:1:4: a name with a control character");
  EXPECT_CONTAINS(refused("12,li\x7fver\n"), "own.csv:1:4: a name with a control character");
  EXPECT_CONTAINS(refused("12,\"\"\n"), "no name behind the number");
}

TEST(LabelTableText, AnUnknownNameOrNumberIsNeitherFoundNorInvented) {
  const Entries entries = random_entries(5, 30);
  const OwnLabelTable own = parse_label_table(listed(entries, ",", "\n"), "t");
  for (const auto& [number, name] : entries) {
    EXPECT_EQ(own.table().number_of(name), number);
    EXPECT_EQ(own.table().name_of(number), name);
    EXPECT_FALSE(own.table().number_of(name + "_").has_value());
    EXPECT_FALSE(own.table().number_of(name.substr(1)).has_value());
  }
  EXPECT_FALSE(own.table().name_of(0).has_value());
  EXPECT_FALSE(own.table().number_of("").has_value());
}

TEST(LabelTableFile, TheNameIsTheLastPartOfThePath) {
  test::TemporaryFolder folder;
  const auto path = folder.write("my organs.csv", "5,liver\n");
  EXPECT_EQ(read_label_table(path).table().name, "my organs.csv");
  EXPECT_EQ(label_table_or_file(path.string()).table().number_of("liver"), 5);
  EXPECT_CONTAINS(test::message_of<InputError>([&] { read_label_table(folder.path()); }), "no such file");
  const auto broken = folder.write("broken.csv", "5,liver\n5,spleen\n");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { label_table_or_file(broken.string()); }), "broken.csv:2:1");
}

TEST(LabelTableFile, ABuiltInTableSurvivesBeingWrittenOutAndReadAgain) {
  for (const std::string& name : label_table_names()) {
    std::string text = "number,name\n";
    for (const LabelName& each : label_table(name).labels)
      text += std::to_string(each.number) + "," + std::string(each.name) + "\n";
    const OwnLabelTable own = parse_label_table(text, "copy.csv");
    ASSERT_EQ(own.table().labels.size(), label_table(name).labels.size());
    for (const LabelName& each : label_table(name).labels) EXPECT_EQ(own.table().name_of(each.number), each.name);
  }
}

TEST(PhantomLabelTable, NumbersAndNamesAreUniqueAndTheTableHasThemAll) {
  std::set<int> numbers;
  std::set<std::string_view> names;
  for (const LabelName& each : kPhantomLabels) {
    EXPECT_TRUE(numbers.insert(each.number).second) << each.number;
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    EXPECT_EQ(label_table(kPhantomTable).name_of(each.number), each.name);
    EXPECT_EQ(each.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string_view::npos) << each.name;
  }
  EXPECT_EQ(label_table(kPhantomTable).labels.size(), kPhantomLabels.size());
}

LabelMap map_of(const std::vector<Segment>& segments) {
  LabelMap map;
  for (const Segment& each : segments) map.layers.resize(std::max(map.layers.size(), each.layer + 1));
  map.segments = segments;
  return map;
}

TEST(SegmentChoice, EverySegmentIsFoundByNumberAndByNameInAnyOrder) {
  std::vector<Segment> segments{{0, 1, "liver"}, {0, 2, "left kidney"}, {1, 9, "tumour"}, {2, 14, "5"}, {2, 77, ""}};
  std::mt19937_64 engine(1);
  for (int round = 0; round < 20; ++round) {
    std::shuffle(segments.begin(), segments.end(), engine);
    const LabelMap map = map_of(segments);
    for (const Segment& each : segments) {
      const Segment by_number = choose_segment(map, std::to_string(each.number), nullptr, "m");
      EXPECT_EQ(by_number.layer, each.layer);
      EXPECT_EQ(by_number.name, each.name);
      if (each.name.empty() || each.name == "5") continue;
      const Segment by_name = choose_segment(map, each.name, nullptr, "m");
      EXPECT_EQ(by_name.number, each.number);
      EXPECT_EQ(by_name.layer, each.layer);
    }
  }
}

TEST(SegmentChoice, ANumberInSeveralLayersIsAskedBack) {
  const LabelMap map = map_of({{0, 1, "liver"}, {1, 1, "tumour"}});
  const std::string message = test::message_of<InputError>([&] { choose_segment(map, "1", nullptr, "seg.nrrd"); });
  EXPECT_CONTAINS(message, "seg.nrrd: \"1\"");
  EXPECT_CONTAINS(message, "1 liver (layer 0), 1 tumour (layer 1)");
  EXPECT_CONTAINS(message, "--label \"tumour\"");
  EXPECT_EQ(choose_segment(map, "tumour", nullptr, "seg.nrrd").layer, 1U);
}

TEST(SegmentChoice, NamesAreTakenToTheLetterFirstAndElseInAnyCase) {
  const LabelMap map = map_of({{0, 1, "Liver"}, {0, 2, "liver right"}});
  for (const char* wanted : {"Liver", "liver", "LIVER", " Liver"})
    EXPECT_EQ(choose_segment(map, wanted, nullptr, "m").number, 1) << wanted;
  EXPECT_EQ(choose_segment(map, "Liver_Right", nullptr, "m").number, 2);
  for (const char* wanted : {"live", "right", "-"})
    EXPECT_THROW(choose_segment(map, wanted, nullptr, "m"), InputError) << wanted;
  const LabelMap two = map_of({{0, 1, "Clip"}, {0, 2, "clip"}});
  EXPECT_EQ(choose_segment(two, "clip", nullptr, "m").number, 2);
  EXPECT_THROW(choose_segment(two, "CLIP", nullptr, "m"), InputError) << "two names differ in case alone";
}

TEST(SegmentChoice, APersonsOwnTableGoesFirstAndABuiltInOneMayNotDisagree) {
  const OwnLabelTable own = parse_label_table("index,label,name\n1,a,liver\n7,b,spleen\n", "own.csv");
  const LabelMap map = map_of({{0, 1, "aorta"}, {0, 7, "liver"}});
  EXPECT_EQ(choose_segment(map, "liver", &own.table(), "m").number, 1);
  EXPECT_EQ(choose_segment(map, "7", &own.table(), "m").name, "spleen");
  EXPECT_NO_THROW(require_agreement(map, own.table(), "m"));
  EXPECT_CONTAINS(
      test::message_of<InputError>([&] { require_agreement(map, label_table("totalsegmentator-v1"), "m.nii"); }),
      "m.nii: label 1 is \"aorta\" by the file's own names and \"spleen\" in the table");
  EXPECT_NO_THROW(require_agreement(map_of({{0, 1, "Spleen"}, {0, 2, ""}}), label_table("totalsegmentator-v1"), "m"));
  EXPECT_CONTAINS(test::message_of<InputError>([] { parse_label_table("a,b,c\n1,2,liver\n", "own.csv"); }),
                  "own.csv:1:1: which columns are number and name?");
}

TEST(SegmentChoice, ATableNamesOnlyWhatTheFileLeavesUnnamed) {
  const OwnLabelTable own = parse_label_table("1,liver\n2,spleen\n3,colon\n", "own.csv");
  const LabelMap map = map_of({{0, 1, "tumour"}, {0, 2, ""}, {0, 4, ""}});
  LabelTable table = own.table();
  table.own = false;
  EXPECT_EQ(choose_segment(map, "1", &table, "m").name, "tumour");
  EXPECT_EQ(choose_segment(map, "2", &table, "m").name, "spleen");
  EXPECT_EQ(choose_segment(map, "4", &table, "m").name, "");
  EXPECT_EQ(choose_segment(map, "spleen", &table, "m").number, 2);
  EXPECT_THROW(choose_segment(map, "liver", &table, "m"), InputError);  // the file calls number 1 a tumour
  EXPECT_CONTAINS(test::message_of<InputError>([&] { choose_segment(map, "colon", &table, "m.nii"); }),
                  "m.nii: \"colon\" is number 3 in the table own.csv, which marks no voxel");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { choose_segment(map, "x", &table, "m"); }),
                  "is no name in the table own.csv");
}

TEST(SegmentChoice, TheOnlySegmentNeedsNoNameAndSeveralAreListed) {
  const LabelMap one = map_of({{0, 5, ""}});
  EXPECT_EQ(choose_segment(one, "", &label_table("totalsegmentator-v1"), "m").name, "liver");
  EXPECT_CONTAINS(test::message_of<InputError>([] {
                    choose_segment(map_of({{0, 1, "a"}, {0, 2, "b"}}), "", nullptr, "m.nii");
                  }),
                  "m.nii: holds 2 segments: say which with --label; 1 a, 2 b");
}

TEST(SegmentList, HoldsAsManyAsAskedAndCountsTheRest) {
  std::vector<Segment> segments;
  for (int number = 1; number <= 30; ++number) segments.push_back({0, number, ""});
  const LabelMap map = map_of(segments);
  for (std::size_t most = 1; most <= 30; ++most) {
    const std::string text = listed_segments(map, nullptr, most);
    EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), ',')), most - 1);
    EXPECT_EQ(text.ends_with(" and " + std::to_string(30 - most) + " more"), most < 30) << text;
  }
  EXPECT_EQ(listed_segments(map, nullptr), listed_segments(map, nullptr, 20));
  EXPECT_EQ(listed_segments(map_of({}), nullptr), "");
}

TEST(TableGuess, DoesNotDependOnTheOrderAndOnlyShrinksWithMoreSegments) {
  std::mt19937_64 engine(3);
  for (int round = 0; round < 30; ++round) {
    std::vector<Segment> segments;
    std::size_t before = label_table_names().size();
    for (int n = 0; n < 6; ++n) {
      segments.push_back({0, 1 + static_cast<int>(engine() % 120), ""});
      const std::vector<std::string> guessed = guess_label_table(map_of(segments));
      EXPECT_LE(guessed.size(), before);
      before = guessed.size();
      std::vector<Segment> turned(segments.rbegin(), segments.rend());
      EXPECT_EQ(guess_label_table(map_of(turned)), guessed);
      for (const std::string& name : guessed)
        for (const Segment& each : segments) EXPECT_TRUE(label_table(name).name_of(each.number).has_value()) << name;
    }
  }
}

}  // namespace
}  // namespace trocar::label_tables_more_test
