// The desk in other languages: a finished English page in, the same page with its words translated out.
//
// A catalogue (assets/languages/desk/de.toml) has the decimal sign, the form of a day, twelve months, the units that
// are written otherwise, and a table [words] of "English" = "translation"; what it lacks comes from the window's
// (assets/languages/de.toml), so that exercises, events and measures have one name. A key may have places: {n} a number
// with at most a unit, a date or a time; {p} a part that has a translation itself; {t} any text, which stays as it is
// (a name, a code). The translation has the same ones; where their order differs, {p2} is the second {p} of the key.
// What no entry fits stays English.
//
// Looked up are texts between tags and the attributes alt, aria-label, data-label (the column of a table that a cell
// stands in), data-words (what the script says), placeholder and title, each as a whole; then without punctuation round
// it, with a small first letter, and sentence by sentence. Of the entries that fit a text so, with its full stop or
// without, the one that says most of it by itself counts; a {t} that begins an entry takes no sentence that is known.
// Elements with translate="no", code, classes "mono", "said" and "written", style and script are left alone but for
// data-label: what people wrote stands there. docs/decisions/0031-desk-languages.md says why it is done this way. Plain
// values, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace trocar::review {

/// Languages of the desk, each by its own name; English needs no catalogue.
struct DeskTongue {
  const char *code, *name;
};
inline constexpr std::array<DeskTongue, 3> kDeskTongues = {{{"en", "English"}, {"de", "Deutsch"}, {"fr", "Français"}}};

/// What pages asked of a catalogue.
struct AskedWords {
  std::set<std::string> unknown = {}, used = {};  ///< texts without translation; keys that gave one
};

class PageLanguage {
 public:
  /// @param folder of the window's catalogues, with those of the desk in FOLDER/desk. @param code "de".
  /// @throws InputError naming file, line and column.
  PageLanguage(const std::filesystem::path& folder, const std::string& code);

  const std::string& code() const { return code_; }
  /// @param html as the pages make it: attributes in double quotes. One pass; what cannot be read is copied.
  std::string page(std::string_view html, AskedWords* asked = nullptr) const;
  /// One plain text, not escaped.
  std::string words(std::string_view english, AskedWords* asked = nullptr) const;
  /// Of the desk's own catalogue.
  const std::set<std::string>& keys() const { return keys_; }

 private:
  struct Piece {
    char kind = ' ';         ///< n, p, t; a space: literal
    std::string text = {};   ///< of a literal
    std::size_t number = 0;  ///< of a place: the how many-th of its kind
  };
  struct Form {
    std::string key = {};
    std::vector<Piece> english = {}, own = {};
    std::size_t literal = 0;   ///< letters that it says by itself: the more, the surer the match
    std::string longest = {};  ///< of its literals: what lacks it does not fit
  };
  struct Values {
    std::vector<std::string> n = {}, p = {}, t = {};  ///< of {p} still in English
  };
  struct Asking;
  using Found = std::optional<std::string>;

  static std::vector<Piece> pieces_of(std::string_view text);
  void add(const std::string& key, const std::string& own);
  Found found(std::string_view english, int depth, Asking& asking) const;
  Found resolved(std::string_view english, int depth, Asking& asking) const;
  Found known(std::string_view english, int depth, Asking& asking, std::size_t& literal) const;
  Found whole(const std::string& english, Asking& asking) const;
  Found filled(std::string_view english, int depth, Asking& asking, std::size_t& literal) const;
  Found sentences(std::string_view english, int depth, Asking& asking) const;
  bool fits(const Form& form, std::size_t piece, std::string_view text, int depth, Values& values,
            Asking& asking) const;
  bool begins_with_known(std::string_view text) const;
  bool parts_known(Values& values, int depth, Asking& asking) const;
  std::string said(std::string_view english, Asking& asking) const;
  std::string joint(std::string_view english) const;
  std::string number(std::string_view text) const;

  std::string code_, decimal_, day_;
  std::vector<std::string> months_;
  std::map<std::string, std::string, std::less<>> units_;  ///< those that are written otherwise
  std::set<std::string> keys_;
  std::unordered_map<std::string, std::string> exact_;
  std::vector<Form> forms_;                                 ///< most literal text first
  std::array<std::vector<std::uint32_t>, 256> by_first_{};  ///< forms by the byte that they begin with
  std::vector<std::uint32_t> placed_;                       ///< forms that begin with a place
};

/// All catalogues of a folder.
class PageLanguages {
 public:
  /// @param folder as of PageLanguage. @throws InputError
  explicit PageLanguages(const std::filesystem::path& folder);
  /// The language that was chosen, else the one that the browser would rather have. @param cookie "de"; "" for none.
  /// @param accept header Accept-Language. @returns null: English.
  const PageLanguage* chosen(const std::string& cookie, const std::string& accept) const;

 private:
  std::vector<PageLanguage> all_;
};

/// Is this the code of a language of the desk?
bool desk_tongue(std::string_view code);

}  // namespace trocar::review
