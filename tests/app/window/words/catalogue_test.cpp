// Every sentence that a trainee can meet has a translation in every language, and nothing is translated in vain.
#include <algorithm>
#include <cctype>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "app/picture/scene/scene_view.h"
#include "app/window/input/key_map.h"
#include "app/window/words/translator.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/scoring/metrics.h"
#include "tests/app/window/words/sentence_scan.h"
#include "trainees/markup/html.h"

namespace trocar::catalogue_test {
namespace {

const std::filesystem::path kTree = TROCAR_SOURCE_DIR, kFolder = kTree / "assets/languages";
/// Room on the screen: a translation may be longer than the English by a third and a word.
constexpr double kLonger = 1.35, kWord = 10;

std::vector<Translator> translated() {
  std::vector<Translator> out;
  for (const Language& language : languages(kFolder))
    if (language.code != "en") out.emplace_back(kFolder, language.code);
  return out;
}

std::vector<Exercise> exercises() {
  std::vector<Exercise> out;
  for (const auto& file : files_below(kTree / "scenarios/exercises", {".toml"})) out.push_back(load_exercise(file));
  return out;
}

void add_screens(std::set<std::string>& out) {
  for (const auto& file : files_below(kTree / "app", {".cpp", ".h"})) {
    if (file.parent_path().filename() == "words") continue;
    for (const std::string& text : words_asked(file_text(file))) out.insert(text);
  }
}

void add_exercises(std::set<std::string>& out) {
  for (const Exercise& exercise : exercises()) {
    out.insert({exercise.title, exercise.goal, exercise.number + " " + exercise.title});
    for (const ExerciseLevel& level : exercise.levels) {
      out.insert(mapping_name(level.mapping));
      if (level.exam) out.insert(level.name);
      for (const SubscoreRule& rule : level.rubric.subscores) out.insert({rule.name, words_of(rule.name)});
    }
  }
}

void add_labels(std::set<std::string>& out) {
  const HudLabels l;
  out.insert({l.match, l.force, l.steps, l.so_far, l.device, l.tip, l.angle, l.error, l.limit, l.peak, l.band, l.more});
}

/// What must be in a catalogue as it stands.
std::set<std::string> wanted() {
  std::set<std::string> out;
  add_screens(out);
  add_exercises(out);
  add_labels(out);
  for (const ActionName& one : action_names()) out.insert(one.words);
  for (std::int32_t key = 0; key <= kKeyAlt; ++key)
    if (const std::string name = key_name(key); name.size() > 1 && !std::isdigit(static_cast<unsigned char>(name[1])))
      out.insert(name);
  for (const MetricDefinition& metric : metric_catalogue()) out.emplace(metric.meaning);
  std::erase_if(out, [](const std::string& text) { return own_pieces(text).empty(); });
  return out;
}

std::string plain(std::string text) {
  for (char& c : text) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// All literals of the program and texts of exercises and organs, one after the other.
std::string all_said() {
  std::string out;
  for (const char* folder : {"app", "scenarios"})
    for (const auto& file : files_below(kTree / folder, {".cpp", ".h"}))
      for (const Literal& one : literals_of(file_text(file))) out += plain(one.text) + "\n";
  for (const char* folder : {"scenarios/exercises", "assets/organs"})
    for (const auto& file : files_below(kTree / folder, {".toml"})) out += plain(file_text(file)) + "\n";
  for (const Exercise& exercise : exercises()) out += plain(exercise.number + " " + exercise.title) + "\n";
  return out;
}

/// A sentence may be put together from several literals: between places and signs.
std::vector<std::string> fragments(const std::string& key) {
  static const std::regex kSign("[.:;,()]| \xe2\x88\x92");
  std::vector<std::string> out;
  for (const std::string& piece : own_pieces(key))
    for (const std::string& part : own_pieces(std::regex_replace(piece, kSign, "{0}")))
      if (part.size() > 2) out.push_back(part);
  return out;
}

std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

/// Does some key say this piece between its places?
bool says(const Translator& words, const std::string& text) {
  for (const auto& [key, value] : words.catalogue()) {
    const auto pieces = own_pieces(key), asked = own_pieces(text);
    const auto in_key = [&](const std::string& piece) {
      return std::find(pieces.begin(), pieces.end(), piece) != pieces.end();
    };
    if (std::all_of(asked.begin(), asked.end(), in_key)) return true;
  }
  return false;
}

TEST(Catalogues, HaveEverySentenceOfTheScreens) {
  const std::set<std::string> all = wanted();
  ASSERT_GT(all.size(), 150u);
  for (const Translator& words : translated()) {
    for (const std::string& text : all)
      EXPECT_TRUE(words.catalogue().contains(text)) << words.language() << ".toml lacks \"" << text << '"';
  }
}

TEST(Catalogues, HaveWhatExercisesSayDuringTheRun) {
  for (const Translator& words : translated()) {
    for (const auto& file : files_below(kTree / "scenarios", {".cpp"}))
      for (const std::string& text : sentences_said(file_text(file)))
        EXPECT_TRUE(says(words, text)) << words.language() << ".toml lacks \"" << text << "\" of " << file.filename();
    for (const Literal& one : literals_of(file_text(kTree / "app/picture/attempt/attempt_hud.cpp"))) {
      const bool sentence =
          letters(one.text) > 5 && one.text.find_first_of("%/.") == std::string::npos && one.text != "always";
      EXPECT_TRUE(!sentence || says(words, one.text))
          << words.language() << ".toml lacks \"" << one.text << "\" of the display";
    }
  }
}

TEST(Catalogues, HaveNothingThatNobodySays) {
  const std::string said = all_said();
  const std::set<std::string> all = wanted();
  for (const Translator& words : translated()) {
    for (const auto& [key, value] : words.catalogue()) {
      if (all.contains(key)) continue;
      for (const std::string& piece : fragments(key))
        EXPECT_NE(said.find(plain(piece)), std::string::npos)
            << words.language() << ".toml: nobody says \"" << key << '"';
    }
  }
}

TEST(Catalogues, HaveTheSameSentences) {
  const auto all = translated();
  for (const Translator& words : all)
    for (const auto& [key, value] : all.front().catalogue())
      EXPECT_TRUE(words.catalogue().contains(key)) << words.language() << ": " << key;
  for (const Translator& words : all) EXPECT_EQ(words.catalogue().size(), all.front().catalogue().size());
}

TEST(Catalogues, FitOnTheScreen) {
  for (const Translator& words : translated())
    for (const auto& [key, value] : words.catalogue())
      EXPECT_LE(static_cast<double>(letters(value)), kLonger * static_cast<double>(letters(key)) + kWord)
          << words.language() << ": " << value;
}

/// The program's font has Latin-1, Latin Extended-A, general punctuation and the mathematical signs that English uses.
TEST(Catalogues, HaveLettersOfTheFontOnly) {
  for (const Translator& words : translated()) {
    for (const auto& [key, value] : words.catalogue()) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        const auto c = static_cast<unsigned char>(value[i]);
        if (c < 0x80 || (c & 0xc0) == 0x80) continue;
        const bool latin = c <= 0xc5, punctuation = value.compare(i, 2, "\xe2\x80") == 0,
                   minus = value.compare(i, 3, "\xe2\x88\x92") == 0;
        EXPECT_TRUE(latin || punctuation || minus) << words.language() << ": " << value;
      }
    }
  }
}

TEST(SentenceScan, ReadsLiteralsAsTheCompilerJoinsThem) {
  const std::string code = "f(\"a \" // \"no\"\n  \"b\", 'x', '\"', \"c\\\"d\"); /* \"no\" */ g(R\"(raw \"q\")\");";
  std::vector<std::string> texts;
  for (const Literal& one : literals_of(code)) texts.push_back(one.text);
  EXPECT_EQ(texts, (std::vector<std::string>{"a b", "c\"d", "raw \"q\""}));
  EXPECT_EQ(literals_of("x = \"one \"\n    \"two\";").at(0).text, "one two");
}

TEST(SentenceScan, FindsWhatIsAskedForAndWhatIsSaid) {
  EXPECT_EQ(words_asked("ui.text(ui.words()(on ? \"Stop\" : \"Go\"), k); w(\"Next: {0}\", {f(\"E01\")}); words(\"A "
                        "\"\n \"b\"); show(\"no\");"),
            (std::vector<std::string>{"Stop", "Go", "Next: {0}", "A b"}));
  EXPECT_EQ(sentences_said("say(status, \"Go\", \"Pen \" + n + \".\"); toast_ = \"Dropped\"; log.add(\"NO\");"),
            (std::vector<std::string>{"Go", "Pen ", ".", "Dropped"}));
  EXPECT_EQ(own_pieces("Disc {0}: {1} to {2} N."), (std::vector<std::string>{"Disc", "to", "N."}));
  EXPECT_TRUE(own_pieces("{0} / {1}").empty());
}

}  // namespace
}  // namespace trocar::catalogue_test
