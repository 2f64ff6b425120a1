// The pages of the desk as functions from plain values to HTML, and the files that go with them.
//
// Every page is complete without script, well-formed as XML, asks nothing of other servers, and passes every text from
// outside through escape_html. Style and script are files of their own, so that the content security policy needs no
// exceptions. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/queries/views.h"
#include "trainees/live/live_stations.h"

namespace trocar::review {

std::string cohort_page(const CohortView& view, Frame frame);
std::string trainee_page(const TraineeView& view, Frame frame);
/// Why attempts fail: lost points, gates, critical events, and a measure over the attempts, of what is asked for.
std::string why_page(const WhyView& view, Frame frame);
std::string attempt_page(const AttemptView& view, Frame frame);
std::string compare_page(const CompareView& view, Frame frame);
std::string curriculum_page(const CurriculumView& view, Frame frame);
std::string station_page(const LiveStations& view, Frame frame);
/// @param now what the trainee does now, a sentence. @param problem why it could not be sent; text is then what was
/// typed.
std::string station_message_page(const std::string& trainee, const std::string& now, const std::string& problem,
                                 const std::string& text, Frame frame);
/// One's own password. @param trainee a PIN will do.
std::string password_page(bool trainee, Frame frame);
/// A short page of one sentence: not found, refused, bad input. @param words not escaped yet.
std::string message_page(const std::string& title, const std::string& words, Frame frame);

/// Part of the attempt page: what a person adds (sign-off, override, certificate, note). Not for trainees.
std::string sign_off_section(const AttemptView& view, const Frame& frame);
std::string notes_section(const std::vector<Note>& notes, const std::string& action, const Frame& frame);

/// A line of a trainee's list: an attempt of the chosen curve with its place there, or one that the device ended.
struct ListedAttempt {
  const CurvePoint* point = nullptr;
  int place = 0;  ///< 0: in no curve
};
/// The part of that list that the page shows, newest first.
struct AttemptsPage {
  std::vector<ListedAttempt> shown = {};
  int page = 1, pages = 1, first = 1, all = 0;
};
AttemptsPage attempts_page(const TraineeView& view);

/// Lines with the asked state, in the asked order; equal ones by code, exercise and level.
std::vector<CohortEntry> selected_lines(const CohortView& view);
/// Trainees in that state, each once, with their newest line of it; those unsafe with their worst, worst first, else in
/// the order of the codes.
std::vector<const CohortEntry*> trainees_in_state(const CohortView& view, Flag flag);
inline constexpr int kLinesOnPage = 100;

/// RFC 4180, CRLF, header line, numbers to the bit. Texts that a spreadsheet would take for a formula get a leading
/// apostrophe.
std::string cohort_csv(const CohortView& view);
std::string trainee_csv(const TraineeView& view);
std::string attempt_csv(const AttemptView& view);

}  // namespace trocar::review
