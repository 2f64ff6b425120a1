#include "trainees/desk/reports/report_words.h"

#include <iterator>
#include <nlohmann/json.hpp>

namespace trocar::review {

std::string moment_text(const std::string& utc) {
  const std::string day = printed::day_text(utc);
  return day == utc || utc.size() < 16 ? day : day + ", " + utc.substr(11, 5);
}

std::string curve_words(const std::string& exercise, const std::string& level, const std::string& hand) {
  return exercise + " " + level + (hand.empty() ? "" : ", " + hand);
}

std::string evidence_words(const std::string& json) {
  const nlohmann::json evidence = nlohmann::json::parse(json, nullptr, false);
  if (!evidence.is_object() || !evidence.contains("words") || !evidence["words"].is_string()) return json;
  std::string words = evidence["words"].get<std::string>();
  words = words.substr(0, words.find("; a person decides"));
  return evidence.contains("n") && evidence["n"].is_number_integer()
             ? words + " (n = " + std::to_string(evidence["n"].get<int>()) + ")"
             : words;
}

std::string span_words(int fewest, int most) {
  return fewest == most ? std::to_string(most) : std::to_string(fewest) + " to " + std::to_string(most);
}

std::string period_words(const std::string& first_utc, const std::string& last_utc) {
  const std::string first = printed::day_text(first_utc), last = printed::day_text(last_utc);
  return first == last || last.empty() ? first : first + " to " + last;
}

printed::Tone tone_of(Flag flag) {
  switch (flag) {
    case Flag::kUnsafe:
    case Flag::kRelapsed:
    case Flag::kInQuestion:
    case Flag::kStuck:
    case Flag::kIntegrity:
      return printed::Tone::kBad;
    case Flag::kReady:
    case Flag::kCertified:
      return printed::Tone::kGood;
    case Flag::kPlateau:
    case Flag::kRetentionDue:
    case Flag::kLearning:
    case Flag::kNotStarted:
      break;
  }
  return printed::Tone::kPlain;
}

std::string result_words(bool scored, bool passed) { return !scored ? "no score" : passed ? "passed" : "not passed"; }

void append(std::vector<printed::Block>& to, std::vector<printed::Block> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

void note_blocks(std::vector<printed::Block>& to, const std::vector<Note>& notes) {
  to.emplace_back(printed::Heading{"Notes", 1});
  if (notes.empty()) to.emplace_back(printed::Paragraph{"None."});
  for (const Note& note : notes) {
    to.emplace_back(printed::Paragraph{note.text, printed::Tone::kPlain, true});
    to.emplace_back(printed::Paragraph{
        (note.printed.empty() ? "by an instructor" : note.printed) + ", " + moment_text(note.utc) +
            (note.seen_utc.empty() ? ", not met by the trainee yet" : ", met " + moment_text(note.seen_utc)),
        printed::Tone::kQuiet});
    if (!note.is_signed) to.emplace_back(printed::Paragraph{kUnsignedNote, printed::Tone::kBad});
  }
}

std::string mark_of(const ReportSetting& setting) { return setting.demo ? "DEMO" : ""; }

}  // namespace trocar::review
