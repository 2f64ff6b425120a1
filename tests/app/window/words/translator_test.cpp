#include "app/window/words/translator.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "haptics/input_error.h"

namespace trocar::translator_test {
namespace {

/// Catalogues in a folder of the test's own.
class Catalogue : public ::testing::Test {
 protected:
  Catalogue() { std::filesystem::create_directories(folder_); }
  ~Catalogue() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& code, const std::string& text) { std::ofstream(folder_ / (code + ".toml")) << text; }
  std::string refusal(const std::string& text) {
    write("fr", text);
    try {
      Translator(folder_, "fr");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("trocar_words_" + std::to_string(getpid()));
};

const char* const kSmall = R"(name = "Français"
decimal = ","
[words]
"Start" = "Commencer"
"Disc {0} of {1}: {2} to {3} N." = "Disque {0} sur {1} : de {2} à {3} N."
"Attempt {0}" = "Essai {0}"
"{1} after {0}" = "après {0}, {1}"
"Reach {0} and hold." = "Atteignez {0} et tenez."
"{0} to {1} N" = "{0} à {1} N"
"{0} of {1}" = "{0} sur {1}"
"Pen {0}." = "Stylo {0}."
)";

TEST_F(Catalogue, EnglishNeedsNoFile) {
  const Translator english;
  EXPECT_EQ(english("Start"), "Start");
  EXPECT_EQ(english("Attempt {0}", {"3"}), "Attempt 3");
  EXPECT_EQ(english.number(0.48, 2), "0.48");
  EXPECT_EQ(english.made("Reach 0.4 N."), "Reach 0.4 N.");
  EXPECT_TRUE(english.missing().empty());
  EXPECT_EQ(Translator("/nowhere", "en").language(), "en");
}

TEST_F(Catalogue, SentencesAndValues) {
  write("fr", kSmall);
  const Translator french(folder_, "fr");
  EXPECT_EQ(french("Start"), "Commencer");
  EXPECT_EQ(french("Attempt {0}", {"3"}), "Essai 3");
  EXPECT_EQ(french("{1} after {0}", {"A", "B"}), "après A, B");
  EXPECT_EQ(french.number(-1.5, 1), "-1,5");
  EXPECT_EQ(french.number(3, 0), "3");
  EXPECT_EQ(french.name("Start"), "Commencer");
  EXPECT_EQ(french.name("F12"), "F12");
  EXPECT_TRUE(french.missing().empty());
}

TEST_F(Catalogue, WhatIsMissingComesBackInEnglishAndIsListed) {
  write("fr", kSmall);
  const Translator french(folder_, "fr");
  EXPECT_EQ(french("Stop"), "Stop");
  EXPECT_EQ(french("{0} more", {"2"}), "2 more");
  EXPECT_EQ(french.missing(), (std::set<std::string>{"Stop", "{0} more"}));
}

TEST_F(Catalogue, ValuesAreNeverReadAsPlaces) {
  EXPECT_EQ(Translator()("{0} and {1}", {"{1}", "b"}), "{1} and b");
  EXPECT_EQ(Translator()("{0} of {5} {x} {", {"a"}), "a of {5} {x} {");
}

TEST_F(Catalogue, SentencesMadeElsewhereAreFoundByTheirForm) {
  write("fr", kSmall);
  const Translator french(folder_, "fr");
  EXPECT_EQ(french.made("Disc 3 of 12: 0.4 to 0.8 N."), "Disque 3 sur 12 : de 0,4 à 0,8 N.");
  EXPECT_EQ(french.made("Attempt 12"), "Essai 12");
  EXPECT_EQ(french.made("Start after 3.5 s"), "après 3,5 s, Commencer");  // values are translated too
  EXPECT_EQ(french.made(""), "");
  EXPECT_TRUE(french.missing().empty());
  EXPECT_EQ(french.made("Attempt "), "Attempt ");  // a place takes at least one letter
  EXPECT_EQ(french.made("Force 0.4 N."), "Force 0.4 N.");
  EXPECT_EQ(french.missing().size(), 2u);
}

TEST_F(Catalogue, SentencesInSentences) {
  write("fr", kSmall);
  const Translator french(folder_, "fr");
  EXPECT_EQ(french.made("Reach 0.4 to 0.8 N and hold."), "Atteignez 0,4 à 0,8 N et tenez.");
  EXPECT_EQ(french.made("Pen 3 of 8."), "Stylo 3 sur 8.");
  EXPECT_EQ(french.made("0.82"), "0,82");
  EXPECT_EQ(french.made("12.5 mm/s"), "12,5 mm/s");
  EXPECT_TRUE(french.missing().empty());
  EXPECT_EQ(french.made("sum of the tip's way"), "sum of the tip's way");  // "{0} of {1}" is for numbers
  EXPECT_EQ(french.made("CC BY 4.0"), "CC BY 4.0");
  EXPECT_EQ(french.missing().size(), 2u);
}

TEST_F(Catalogue, TheListOfWhatIsMissingStaysShort) {
  write("fr", kSmall);
  const Translator french(folder_, "fr");
  for (int i = 0; i < 5000; ++i) french.made("no such sentence " + std::to_string(i));
  EXPECT_EQ(french.missing().size(), 1000u);
}

TEST_F(Catalogue, CountsTakeTheSingularOfTheLanguage) {
  EXPECT_TRUE(Translator().one(1));
  EXPECT_FALSE(Translator().one(0));
  const Translator french(std::filesystem::path(TROCAR_SOURCE_DIR) / "assets/languages", "fr");
  EXPECT_TRUE(french.one(0));
  EXPECT_TRUE(french.one(1));
  EXPECT_FALSE(french.one(2));
  for (const char* wrong : {"singular = 1\n", "singular = []\n", "singular = [\"one\"]\n", "singular = [-1]\n"}) {
    write("xx", std::string("name = \"X\"\n") + wrong + "[words]\n");
    EXPECT_THROW(Translator(folder_, "xx"), InputError) << wrong;
  }
}

TEST_F(Catalogue, OnlyNumbersTakeTheDecimalSign) {
  const Translator german(std::filesystem::path(TROCAR_SOURCE_DIR) / "assets/languages", "de");
  EXPECT_EQ(german.made_number("+29.29"), "+29,29");
  EXPECT_EQ(german.made_number("inf"), "inf");
  EXPECT_EQ(german.made_number("q1"), "q1");
}

TEST_F(Catalogue, PlacesOfASentence) {
  EXPECT_EQ(places("{1} of {0} {1}"), (std::vector<int>{0, 1, 1}));
  EXPECT_TRUE(places("{} {a} { 0}").empty());
}

TEST_F(Catalogue, RefusalsNameFileLineAndColumn) {
  EXPECT_NE(refusal("name = \"F\"\n[words]\n\"a\" = 3\n").find("fr.toml:3:7: 'a' must be a text"), std::string::npos);
  EXPECT_NE(refusal("name = \"F\"\n[words]\n\"a\" = \n").find("fr.toml:3:"), std::string::npos);
  EXPECT_NE(refusal("[words]\n\"a {0}\" = \"b\"\n").find("fr.toml:2:11: 'b' has not the places"), std::string::npos);
  EXPECT_NE(refusal("[words]\n\"a\" = \"\"\n").find("not empty"), std::string::npos);
  EXPECT_NE(refusal("name = \"F\"\n").find("[words] is missing"), std::string::npos);
  EXPECT_NE(refusal("[words]\n[more]\n").find("'more' is not known"), std::string::npos);
}

TEST_F(Catalogue, CodesAreNoPaths) {
  for (const char* code : {"", "../fr", "fr.toml", "f r"}) EXPECT_THROW(Translator(folder_, code), InputError) << code;
  EXPECT_THROW(Translator(folder_, "it"), InputError);
}

TEST_F(Catalogue, LanguagesOfAFolder) {
  write("fr", kSmall);
  write("de", "name = \"Deutsch\"\n[words]\n");
  std::ofstream(folder_ / "README.md") << "no catalogue";
  const auto all = languages(folder_);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].code, "en");
  EXPECT_EQ(all[1].name, "Deutsch");
  EXPECT_EQ(all[2].code, "fr");
  EXPECT_EQ(all[2].name, "Français");
  EXPECT_EQ(languages("/nowhere").size(), 1u);
  write("it", "[words]\n");
  EXPECT_THROW(languages(folder_), InputError);
}

TEST(ShippedLanguages, AreThere) {
  const auto all = languages(TROCAR_SOURCE_DIR "/assets/languages");
  ASSERT_EQ(all.size(), 3u);
  for (const Language& language : all)
    EXPECT_EQ(Translator(TROCAR_SOURCE_DIR "/assets/languages", language.code).language(), language.code);
}

}  // namespace
}  // namespace trocar::translator_test
