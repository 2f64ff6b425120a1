// What the program says to a trainee, in the language that was chosen: English sentences are the keys.
//
// assets/languages/fr.toml and de.toml give for each English sentence its translation; English needs no file. A
// sentence that has none comes back in English and is listed by missing(). Places for values are {0}, {1}, ...
//
// A catalogue: name = "Français", decimal = ",", singular = [0, 1] (counts that take the singular; [1] when left out),
// and a table [words] of "English" = "translation". A translation has the places of its key, each once; what else
// stands in the file is refused. Plain value, any thread (missing() aside).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace trocar {

class Translator {
 public:
  /// English.
  Translator() = default;
  /// @param language "en", "fr", "de": FOLDER/LANGUAGE.toml. @throws InputError naming file, line and column.
  Translator(const std::filesystem::path& folder, const std::string& language);

  std::string operator()(std::string_view english) const;
  /// A name that may or may not have a translation (a key, an organ): as it is when it has none.
  std::string name(std::string_view english) const;
  /// With {0}, {1}, ... replaced. A brace that names no value stays as it is.
  std::string operator()(std::string_view english, const std::vector<std::string>& values) const;
  /// A sentence that another part made with its values in it ("Reach 0.4 to 0.8 N and hold."): found by the key that it
  /// fills ("Reach {0} and hold."), the one with most words first. Values are translated likewise ("{0} to {1} N"), and
  /// numbers take the decimal sign. A form that says little by itself is for numbers only.
  std::string made(std::string_view english) const;
  /// Does this count take the singular? words(words.one(n) ? "{0} attempt" : "{0} attempts", {...}).
  bool one(int count) const { return singular_.contains(count); }
  /// A number that was written with a point, with the decimal sign of the language; what is none comes back.
  std::string made_number(std::string_view english) const;
  /// A number with the decimal sign of the language: "0,48".
  std::string number(double value, int decimals) const;

  const std::string& language() const { return language_; }
  const std::string& decimal_sign() const { return decimal_; }
  /// All keys with their translations.
  const std::map<std::string, std::string, std::less<>>& catalogue() const { return translations_; }
  /// Sentences asked for that the catalogue lacks.
  const std::set<std::string>& missing() const { return missing_; }

 private:
  void note_missing(std::string_view english) const;
  std::optional<std::string> filled(std::string_view english, int depth) const;
  std::optional<std::string> found(std::string_view english, int depth) const;

  std::string language_ = "en", decimal_ = ".";
  std::set<int> singular_ = {1};
  std::vector<std::string> forms_;  ///< keys with places, most text first
  std::map<std::string, std::string, std::less<>> translations_;
  mutable std::set<std::string> missing_;
};

/// Languages that the folder holds, English first: code and own name ("fr", "Français").
struct Language {
  std::string code, name;
};
std::vector<Language> languages(const std::filesystem::path& folder);

/// Places of a sentence, sorted: "{1} of {0}" has 0 and 1.
std::vector<int> places(std::string_view sentence);

}  // namespace trocar
