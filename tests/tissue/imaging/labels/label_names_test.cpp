// Label tables in full, tables of the user's own, and the choice of a segment by number or name.
#include <set>

#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tissue/imaging/labels/label_choice.h"
#include "tissue/imaging/labels/label_table_file.h"

namespace trocar::label_names_test {
namespace {

TEST(FullTables, HaveEveryClassOnce) {
  const std::pair<const char*, std::size_t> tables[] = {
      {"totalsegmentator-v1", 104}, {"totalsegmentator-v2", 117}, {"totalsegmentator-mr", 50}};
  for (const auto& [name, count] : tables) {
    const LabelTable& table = label_table(name);
    EXPECT_EQ(table.labels.size(), count);
    std::set<std::string_view> names;
    for (std::size_t n = 0; n < count; ++n) {
      EXPECT_EQ(table.labels[n].number, static_cast<int>(n) + 1) << name;
      names.insert(table.labels[n].name);
    }
    EXPECT_EQ(names.size(), count) << name;
  }
}

TEST(FullTables, AgreeWithThePublishedClassMaps) {
  const LabelTable &v1 = label_table("totalsegmentator-v1"), &v2 = label_table("totalsegmentator-v2"),
                   &mr = label_table("totalsegmentator-mr");
  for (const auto& [number, name] : {std::pair{13, "lung_upper_lobe_left"},
                                     {41, "vertebrae_C1"},
                                     {50, "brain"},
                                     {55, "small_bowel"},
                                     {69, "rib_left_12"},
                                     {81, "rib_right_12"},
                                     {92, "sacrum"},
                                     {93, "face"},
                                     {104, "urinary_bladder"}})
    EXPECT_EQ(v1.name_of(number), name);
  for (const auto& [number, name] : {std::pair{17, "thyroid_gland"},
                                     {21, "urinary_bladder"},
                                     {26, "vertebrae_S1"},
                                     {51, "heart"},
                                     {52, "aorta"},
                                     {64, "portal_vein_and_splenic_vein"},
                                     {79, "spinal_cord"},
                                     {91, "skull"},
                                     {103, "rib_left_12"},
                                     {116, "sternum"},
                                     {117, "costal_cartilages"}})
    EXPECT_EQ(v2.name_of(number), name);
  for (const auto& [number, name] : {std::pair{10, "lung_left"},
                                     {16, "urinary_bladder"},
                                     {19, "vertebrae"},
                                     {22, "heart"},
                                     {23, "aorta"},
                                     {25, "portal_vein_and_splenic_vein"},
                                     {40, "gluteus_maximus_left"},
                                     {50, "brain"}})
    EXPECT_EQ(mr.name_of(number), name);
}

std::vector<std::pair<int, std::string>> entries(const OwnLabelTable& table) {
  std::vector<std::pair<int, std::string>> list;
  for (const LabelName& entry : table.table().labels) list.emplace_back(entry.number, entry.name);
  return list;
}

TEST(OwnTable, FourWaysToWriteOneTable) {
  const std::vector<std::pair<int, std::string>> wanted{{1, "liver"}, {5, "gall bladder"}};
  const auto parsed = [](const std::string& text) { return entries(parse_label_table(text, "my/own.csv")); };
  EXPECT_EQ(parsed("number,name\n1,liver\n5,gall bladder\n"), wanted);
  EXPECT_EQ(parsed("\xef\xbb\xbf\"number\",\"name\"\r\n1,\"liver\",0,0,0\r\n5,\"gall bladder\"\r\n"), wanted);
  EXPECT_EQ(parsed("# mine\n1\tliver\n\n5\tgall bladder\n"), wanted);
  EXPECT_EQ(
      parsed(
          "    0     0    0    0        0  0  0    \"Clear Label\"\n    1   255    0    0        1  1  1    \"liver\"\n"
          "    5     0  255    0        1  1  1    \"gall bladder\"\n"),
      wanted);
  const std::vector<std::pair<int, std::string>> slicer{{1, "liver"}, {5, "gallbladder"}};
  EXPECT_EQ(parsed("# Color table file\n0 background 0 0 0 0\n1 liver 221 130 101 255\n5 gallbladder 139 150 98 255\n"),
            slicer);
  EXPECT_EQ(parsed("LabelValue,Name,Color_R,Color_G\n1,liver,1,2\n5,gallbladder,3,4"), slicer);
}

TEST(OwnTable, LivesAsLongAsACopy) {
  OwnLabelTable copy;
  {
    const OwnLabelTable made = parse_label_table("7,spleen", "folder/organs.csv");
    copy = made;
  }
  EXPECT_EQ(copy.table().name, "organs.csv");
  EXPECT_EQ(copy.table().number_of("spleen"), 7);
}

TEST(OwnTable, MistakesAreNamedWithTheirLine) {
  const auto refused = [](const std::string& text) {
    return test::message_of<InputError>([&] { parse_label_table(text, "own.csv"); });
  };
  EXPECT_CONTAINS(refused("1,liver\nx2,spleen\n"), "own.csv:2:1: no label number");
  EXPECT_CONTAINS(refused("1,liver\n70000,spleen\n"), "own.csv:2:1: no label number");
  EXPECT_CONTAINS(refused("1,liver\n-2,spleen\n"), "own.csv:2:1");
  EXPECT_CONTAINS(refused("1,liver\n1,spleen\n"), "own.csv:2:1: number 1 is given twice");
  EXPECT_CONTAINS(refused("1,liver\n2,liver\n"), "own.csv:2:3: name \"liver\" is given twice");
  EXPECT_CONTAINS(refused("1,liver\n2,\n"), "own.csv:2:");
  EXPECT_CONTAINS(refused("1,liver\n\n7\n"), "own.csv:3:1: \"number,name\" is wanted");
  EXPECT_CONTAINS(refused("number,name\n"), "own.csv: no entry");
  EXPECT_CONTAINS(refused("1," + std::string(90, 'x')), "80 letters");
  EXPECT_CONTAINS(refused(std::string(2 << 20, '#')), "larger than 1 MiB");
  EXPECT_CONTAINS(test::message_of<InputError>([] { read_label_table("no/such.csv"); }), "no such file");
}

TEST(TableOrFile, TakesEither) {
  test::TemporaryFolder folder;
  EXPECT_EQ(label_table_or_file("totalsegmentator-mr").table().number_of("colon"), 15);
  EXPECT_EQ(label_table_or_file(folder.write("own.tsv", "3\tcolon\n").string()).table().number_of("colon"), 3);
  const std::string message = test::message_of<InputError>([] { label_table_or_file("mine"); });
  EXPECT_CONTAINS(message, "known: totalsegmentator-v1");
  EXPECT_CONTAINS(message, "nor is it a file");
}

LabelMap bare_map(const std::vector<int>& numbers) {
  LabelMap map;
  map.layers.resize(1);
  for (const int number : numbers) map.segments.push_back({0, number, ""});
  return map;
}

TEST(ChooseSegment, NumbersNeedNoTable) {
  const LabelMap map = bare_map({1, 5});
  EXPECT_EQ(choose_segment(map, "5", nullptr, "m").number, 5);
  EXPECT_EQ(choose_segment(map, "5", nullptr, "m").name, "");
  EXPECT_EQ(choose_segment(map, "5", &label_table("totalsegmentator-v1"), "m").name, "liver");
  EXPECT_EQ(choose_segment(bare_map({3}), "", nullptr, "m").number, 3);
  const auto refused = [&](std::string_view wanted) {
    return test::message_of<InputError>([&] { choose_segment(map, wanted, nullptr, "map.nii"); });
  };
  EXPECT_CONTAINS(refused("9"), "map.nii: label 9 marks no voxel; it holds 1, 5");
  EXPECT_CONTAINS(refused(""), "say which with --label");
}

TEST(ChooseSegment, ANumberIsNeverSilentlyGivenAName) {
  const LabelMap map = bare_map({1, 7});
  const std::string message = test::message_of<InputError>([&] { choose_segment(map, "aorta", nullptr, "map.nii"); });
  EXPECT_CONTAINS(message, "--label-table");
  EXPECT_CONTAINS(message, "totalsegmentator-v1 (7), totalsegmentator-v2 (52), totalsegmentator-mr (23)");
  EXPECT_EQ(choose_segment(map, "aorta", &label_table("totalsegmentator-v1"), "m").number, 7);
  EXPECT_EQ(choose_segment(map, "pancreas", &label_table("totalsegmentator-v2"), "m").number, 7);
  EXPECT_CONTAINS(
      test::message_of<InputError>([&] { choose_segment(map, "colon", &label_table("totalsegmentator-v1"), "m"); }),
      "number 57 in the table totalsegmentator-v1, which marks no voxel; it holds 1 spleen, 7 aorta");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { choose_segment(map, "tail", nullptr, "m"); }),
                  "no table that is known here does");
}

TEST(ChooseSegment, TheFilesOwnNamesComeFirst) {
  LabelMap map = bare_map({1, 2});
  map.segments[0].name = "liver", map.segments[1].name = "liver";
  map.segments[1].layer = 1;
  EXPECT_CONTAINS(test::message_of<InputError>([&] { choose_segment(map, "liver", nullptr, "m"); }),
                  "choose one with --label 0:1 or --label 1:2");
  EXPECT_EQ(choose_segment(map, "1:2", nullptr, "m").number, 2);
  map.segments[1].name = "tumour";
  EXPECT_EQ(choose_segment(map, "liver", &label_table("totalsegmentator-v1"), "m").number, 1);
  EXPECT_TRUE(guess_label_table(map).size() == label_table_names().size());  // nothing is left to name
}

TEST(GuessTable, NamesTheTablesThatCouldBeMeant) {
  EXPECT_EQ(guess_label_table(bare_map({5, 117})), (std::vector<std::string>{"totalsegmentator-v2"}));
  EXPECT_EQ(guess_label_table(bare_map({5, 104})),
            (std::vector<std::string>{"totalsegmentator-v1", "totalsegmentator-v2"}));
  EXPECT_TRUE(guess_label_table(bare_map({500})).empty());
  EXPECT_EQ(listed_segments(bare_map({1, 2, 3}), nullptr, 2), "1, 2 and 1 more");
}

}  // namespace
}  // namespace trocar::label_names_test
