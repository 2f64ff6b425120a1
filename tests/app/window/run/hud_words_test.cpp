// The display in another language: every sentence that director and display can make is known, and is found by its
// form.
#include "app/window/run/hud_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace trocar::hud_words_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

bool known(const std::string& sentence) {
  const auto& all = hud_sentences();
  return std::any_of(all.begin(), all.end(), [&](const std::string& form) {
    if (form == sentence) return true;
    return form.find('{') != std::string::npos && form.substr(0, form.find('{')) == sentence;  // "Stay between " + ...
  });
}

TEST(HudWords, EverySentenceOfTheDirectorIsKnown) {
  const std::regex call(R"(say\(status, ([^;]*)\);)"), literal(R"re("((?:[^"\\]|\\.)+)")re");
  int found = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(TROCAR_SOURCE_DIR) / "scenarios")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = text_of(entry.path());
    for (std::sregex_iterator it(text.begin(), text.end(), call), end; it != end; ++it) {
      const std::string arguments = (*it)[1];
      for (std::sregex_iterator word(arguments.begin(), arguments.end(), literal); word != end; ++word) {
        const std::string sentence = (*word)[1];
        if (sentence == "after" || sentence == "." || sentence.front() == ' ' || sentence == ": ") continue;
        ++found;
        EXPECT_TRUE(known(sentence)) << entry.path().filename() << ": " << sentence;
      }
    }
  }
  EXPECT_GT(found, 50) << "the sources are still read";
}

TEST(HudWords, ToastsThatAreKeptForAWhileAreKnownToo) {
  const std::regex kept(R"re(toast_ = "([^"]+)")re");
  const std::string text = text_of(fs::path(TROCAR_SOURCE_DIR) / "scenarios/kinds/grasp/grasp_task.cpp");
  int found = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), kept), end; it != end; ++it, ++found)
    EXPECT_TRUE(known((*it)[1])) << (*it)[1];
  EXPECT_GE(found, 4);
}

TEST(HudWords, EveryTextOfADisplayIsAsked) {
  const fs::path folder = fs::temp_directory_path() / "hud-words";
  fs::create_directories(folder);
  std::ofstream(folder / "xx.toml")
      << "name = \"X\"\ndecimal = \",\"\n[words]\n"
         "\"Press gently\" = \"SANFT\"\n\"Reach {0} and hold.\" = \"ERREICHE {0}\"\n\"{0} to {1} N\" = \"{0} bis {1} "
         "N\"\n"
         "\"Tip force\" = \"KRAFT\"\n\"Discs held\" = \"SCHEIBEN\"\n\"simulated\" = \"SIMULIERT\"\n"
         "\"Rest at the start\" = \"RUHE\"\n\"Trainee: {0}\" = \"WER: {0}\"\n";
  const Translator words(folder, "xx");
  Hud hud;
  hud.trainee = "Trainee: T-1";
  hud.toast = "Press gently";
  hud.toast_hint = "Reach 0.4 to 0.8 N and hold.";
  hud.bars = {{.label = "Tip force"}};
  hud.steps = {{"Rest at the start", HudStep::State::kOpen}};
  hud.rows = {{"Discs held", "2 / 12", ""}};
  hud.device = {{"plant", "simulated", ""}};
  hud = in_words(std::move(hud), words);
  EXPECT_EQ(hud.trainee, "WER: T-1");
  EXPECT_EQ(hud.toast, "SANFT");
  EXPECT_EQ(hud.toast_hint, "ERREICHE 0,4 bis 0,8 N") << "numbers take the decimal sign";
  EXPECT_EQ(hud.bars[0].label, "KRAFT");
  EXPECT_EQ(hud.steps[0].text, "RUHE");
  EXPECT_EQ(hud.rows[0].name, "SCHEIBEN");
  EXPECT_EQ(hud.rows[0].value, "2 / 12");
  EXPECT_EQ(hud.device[0].value, "SIMULIERT");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace trocar::hud_words_test
