#include "trainees/desk/server/desk_memory.h"

#include <algorithm>
#include <cctype>

#include "trainees/store/sqlite_handle.h"

namespace trocar::review {
namespace {

bool same_code(const std::string& a, const std::string& b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

bool lets_through(const CohortFilter& filter, const CohortLine& line) {
  if (!filter.exercise.empty() && line.key.exercise_id != filter.exercise) return false;
  if (!filter.level.empty() && line.key.level != filter.level) return false;
  if (!filter.trainee.empty() && !same_code(line.trainee, filter.trainee)) return false;
  if (!filter.group.empty() && std::find(line.groups.begin(), line.groups.end(), filter.group) == line.groups.end())
    return false;
  const auto& judgements = line.judgements;
  return !filter.flag ||
         std::any_of(judgements.begin(), judgements.end(), [&](const Judgement& j) { return j.flag == *filter.flag; });
}

}  // namespace

DeskMemory::Key DeskMemory::key_now(Database& database, const std::string& now_utc) {
  return {sql::query_integer(database.connection(), "PRAGMA data_version"), sql::changes_of(database.connection()),
          now_utc.substr(0, 16)};
}

const std::vector<CohortLine>& DeskMemory::lines(Database& database, const std::string& now_utc) {
  // Before rows and rules are read: what is committed meanwhile makes them old at the next call.
  Key key = key_now(database, now_utc);
  if (key_ == key) return lines_;
  key_.reset();
  lines_ = cohort_lines(database, rules_in_force(database), {}, now_utc);
  key_ = std::move(key);
  ++made_;
  return lines_;
}

std::vector<CohortLine> filtered(const std::vector<CohortLine>& lines, const CohortFilter& filter) {
  std::vector<CohortLine> out;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(out),
               [&](const CohortLine& line) { return lets_through(filter, line); });
  return out;
}

}  // namespace trocar::review
