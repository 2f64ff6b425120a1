// A report as plain values: what stands in it, in order, whatever it is written as. PDF and HTML are made of the same
// one, so that they hold the same.
//
// All text is UTF-8 and not escaped; charts are the desk's own SVG. Thread: any.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace trocar::printed {

enum class Tone : std::uint8_t { kPlain, kGood, kBad, kQuiet };

struct Heading {
  std::string words = {};
  int level = 1;          ///< 1: a part of the report; 2: within it
  bool new_page = false;  ///< begins one
};

struct Paragraph {
  std::string words = {};
  Tone tone = Tone::kPlain;
  bool mark = false;  ///< a point of a list
};

/// Names with their values.
struct Facts {
  std::vector<std::pair<std::string, std::string>> pairs = {};
  int columns = 4;
  bool mono = false;  ///< values are hashes and the like
};

struct Cell {
  std::string words = {};
  std::string svg = {};  ///< drawn in its place
  Tone tone = Tone::kPlain;
  Cell() = default;
  Cell(std::string text) : words(std::move(text)) {}  // NOLINT(google-explicit-constructor): a row reads as its words
  Cell(const char* text) : words(text) {}             // NOLINT(google-explicit-constructor)
  Cell(std::string text, Tone how) : words(std::move(text)), tone(how) {}
  static Cell drawn(std::string picture) {
    Cell out;
    out.svg = std::move(picture);
    return out;
  }
};

struct Column {
  std::string title = {};
  double share = 1;     ///< of the width, beside the other columns'
  bool number = false;  ///< to the right
  bool mono = false;
};

struct Table {
  std::string caption = {};
  std::vector<Column> columns = {};
  std::vector<std::vector<Cell>> rows = {};
  std::string none = "None.";  ///< said in place of no rows
};

struct Figure {
  std::string svg = {}, caption = {};
  double share = 1;  ///< of the width
};
/// Side by side.
struct Figures {
  std::vector<Figure> all = {};
};

struct Picture {
  std::string png = {}, caption = {};
  double share = 1;
};

/// A verdict across the page.
struct Verdict {
  std::string word = {}, reason = {}, number = {}, under_number = {};
  Tone tone = Tone::kPlain;
};

using Block = std::variant<Heading, Paragraph, Facts, Table, Figures, Picture, Verdict>;

struct Report {
  std::string kind = {};   ///< "Trainee report"
  std::string title = {};  ///< "Müller, Anna"
  std::string subtitle = {};
  std::string who = {};  ///< in the head of every page
  std::string newest_utc =
      {};                 ///< newest entry that it rests on: its date, so that the same record makes the same bytes
  std::string mark = {};  ///< across every page: "DEMO"
  std::vector<Block> blocks = {};
};

/// One page to hang on a wall, with what it rests on.
struct CertificateSheet {
  std::string holder = {}, code = {}, skill = {};  ///< "Surface touch, level L2"
  std::string statement = {};                      ///< what was shown, in a sentence
  std::vector<std::pair<std::string, std::string>> facts = {};
  std::vector<Column> columns = {};  ///< of the evidence
  std::vector<std::vector<std::string>> evidence =
      {};  ///< newest last; the oldest are left out where the page ends, and it says so
  std::string evidence_words = {};
  std::vector<std::string> not_attested = {};
  std::string certified_by = {}, date = {}, uuid = {};
  std::string withdrawn = {};    ///< why and when; "" while it stands
  std::string in_question = {};  ///< why it may not stand; "" while all that it stands on holds
  std::string newest_utc = {};
  bool demo = false;

  /// Of the file, in its properties: whose it is, in their own script.
  std::string file_title() const {
    return "Certificate: " + holder + (holder == code ? "" : ", trainee " + code) + ", " + skill;
  }
};

/// @throws EnvironmentError: a font is missing. std::invalid_argument: a chart that is not of this program's making.
std::string pdf_of(const Report& report);
std::string pdf_of(const CertificateSheet& sheet);
/// One file by itself: style and charts inside, no script, no link to elsewhere.
std::string html_of(const Report& report);
std::string html_of(const CertificateSheet& sheet);

/// "22 Nov 2026"; text that is no date stays as it is.
std::string day_text(const std::string& utc);

}  // namespace trocar::printed
