// What the program says to a trainee, in the language that was chosen: English sentences are the keys.
//
// assets/languages/fr.toml and de.toml give for each English sentence its translation; English needs no file. A sentence
// that has none comes back in English and is listed by missing(). Places for values are {0}, {1}, ... Plain value, any thread
// (missing() aside).
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace trocar {

class Words {
 public:
  /// English.
  Words() = default;
  /// @param language "en", "fr", "de": FOLDER/LANGUAGE.toml. @throws InputError naming file, line and column.
  Words(const std::filesystem::path& folder, const std::string& language);

  std::string operator()(std::string_view english) const;
  /// With {0}, {1}, ... replaced. A brace that names no value stays as it is.
  std::string operator()(std::string_view english, const std::vector<std::string>& values) const;
  /// A number with the decimal sign of the language: "0,48".
  std::string number(double value, int decimals) const;

  const std::string& language() const { return language_; }
  /// Sentences asked for that the catalogue lacks.
  const std::set<std::string>& missing() const { return missing_; }

 private:
  std::string language_ = "en";
  std::map<std::string, std::string, std::less<>> translations_;
  mutable std::set<std::string> missing_;
};

/// Languages that the folder holds, English first: code and own name ("fr", "Français").
struct Language {
  std::string code, name;
};
std::vector<Language> languages(const std::filesystem::path& folder);

}  // namespace trocar
