// What the pages of programmes show, as plain values, how it is read, and the pages: programmes and whom they are
// assigned to, the form of one, the grid of people and steps, who is late. Nothing here changes the record. Thread:
// that of the Database.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/queries/programme_query.h"
#include "trainees/desk/queries/views.h"
#include "trainees/desk/routes/route.h"

namespace trocar::review {

/// Words for an exercise and its level, as the program or the record has them.
using StepTitles = std::map<std::string, std::string>;
std::string step_title(const StepTitles& titles, const ProgrammeStep& step);

struct ProgrammesView {
  std::vector<KeptProgramme> programmes = {};
  std::vector<Assignment> assignments = {};  ///< newest first, withdrawn ones too
  std::vector<std::string> groups = {};
};

/// A step as it stands in the form, before anybody has looked whether it means something.
struct StepDraft {
  std::string step = {}, passes = "3", days = "1", due_days = {}, input = {};  ///< step: "surface-touch|L1"
  bool in_a_row = false, sign_off = false;
};

/// What the program ships, and what was tried here. @param shipped may be empty: then only that.
KnownLevels known_levels(Database& database, const std::vector<ExerciseLevels>& shipped);

struct ProgrammeView {
  std::string name = {};
  int version = 0;  ///< 0: not saved yet
  int seen = 0;     ///< version that the form was made from
  std::vector<StepDraft> steps = {};
  std::string text = {};               ///< as TOML
  std::string problem = {};            ///< of the form
  std::string unreadable = {};         ///< of the text
  std::vector<Choice> exercises = {};  ///< "surface-touch|L1" and its words
  std::vector<std::string> inputs = {};
};

struct GridQuestion {
  std::string programme = {}, group = {}, state = {};
  bool deactivated = false;
  int page = 1;
};

struct GridView {
  GridQuestion asked = {};
  std::vector<std::string> programmes = {}, groups = {};
  StepTitles titles = {};
  ProgrammeGrid grid = {};
  std::string problem = {};  ///< why there is no grid
};

struct RemindersView {
  std::string programme = {}, group = {};
  int days = 14;
  std::vector<std::string> programmes = {}, groups = {};
  StepTitles titles = {};
  std::vector<Reminder> lines = {};
};

ProgrammesView programmes_view(Desk& desk);
/// Of a saved programme, or an empty one of that name. @throws InputError: the name is that of rules of progress.
ProgrammeView programme_view(Desk& desk, const std::string& name);
/// The form as it was sent.
ProgrammeView drafted(Desk& desk, const std::map<std::string, std::string>& form);
/// @throws InputError: which step, and what is wrong with it.
Programme programme_of(const std::vector<StepDraft>& steps);
GridView grid_view(Desk& desk, const Request& request);
RemindersView reminders_view(Desk& desk, const Request& request);

std::string programmes_page(const ProgrammesView& view, Frame frame);
std::string programme_page(const ProgrammeView& view, Frame frame);
std::string grid_page(const GridView& view, Frame frame);
std::string reminders_page(const RemindersView& view, Frame frame);
inline constexpr int kPeopleInGrid = 100;

std::string grid_csv(const GridView& view);
std::string reminders_csv(const std::vector<Reminder>& lines);

}  // namespace trocar::review
