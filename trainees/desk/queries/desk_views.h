// From the database and a request to what a page shows. Thread: that of the Database.
#pragma once

#include <map>
#include <string>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/queries/views.h"
#include "trainees/desk/routes/route.h"
#include "trainees/progress/rules.h"

namespace trocar::review {

/// Name, own code, token, demo of the one who asks.
Frame frame_of(const Request& request, const Desk& desk);
/// Who writes, as assessments are stored.
Author author_of(const Request& request);
bool is_staff(const Request& request);
/// A number from 1 to a million of a page's address, else `otherwise`.
int whole_number(const std::string& text, int otherwise);
/// The cohort's lines, out of the desk's memory where it has one.
std::vector<CohortLine> lines_of(Desk& desk, const ProgressRules& rules, const CohortFilter& filter,
                                 const std::string& now_utc);
std::string argument(const std::map<std::string, std::string>& values, const std::string& name,
                     const std::string& otherwise = "");

CohortView cohort_view(Desk& desk, const Request& request);
WhyView why_view(Desk& desk, const Request& request);
/// @throws InputError: no such trainee; the query names an exercise, level, input or rubric of which there is no curve.
TraineeView trainee_view(Desk& desk, const Request& request);
/// @throws InputError: no such attempt, or still running.
AttemptView attempt_view(Desk& desk, const Request& request, const std::string& uuid);
/// What the film's page needs of it: no trace is read. @throws InputError: no such attempt, or still running.
AttemptView film_view(Desk& desk, const std::string& uuid);
CompareView compare_view(Desk& desk, const Request& request);
/// Those of the attempt's exercise and level, and those that cite it.
void add_certificates(AttemptView& view, Database& database);
std::vector<CurveDecision> decisions_of_curve(Database& database, const AttemptResult& attempt);
ShakenCertificates shaken_certificates(Database& database, const std::vector<Certificate>& certificates);
/// JSON. @param view with `ready`.
std::string certificate_evidence(const Database& database, const AttemptView& view);
/// @throws InputError: the query names a version of rules that is not kept.
CurriculumView curriculum_view(Desk& desk, const Request& request);

/// Who would pass today with these rules: competence shown and open to certify.
std::vector<PassPreview> preview_rules(Desk& desk, const ProgressRules& rules, const std::string& now_utc);
/// @throws InputError: the version that the text gives itself was used for another text, here or by the program.
void refuse_taken_version(Desk& desk, const std::string& text, const ProgressRules& rules);
/// The number that the question asks for, from graded attempts, one value a person; who would reach it.
BenchmarkProposal propose(Desk& desk, const BenchmarkQuestion& question, const std::string& now_utc);

/// id and title of every exercise that was tried.
std::vector<Choice> exercise_choices(Database& database);
/// Exercise and level of all attempts, each once.
std::vector<std::pair<std::string, std::string>> tried_levels(Database& database);
std::string exercise_title(Database& database, const std::string& id);
/// By id, those of the program first: what nobody has tried yet has a title too.
std::map<std::string, std::string> exercise_titles(Desk& desk);
std::vector<std::string> distinct_attempt_values(Database& database, const std::string& column);  ///< level or hand

}  // namespace trocar::review
