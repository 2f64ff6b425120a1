// `trocar trainee import|group|deactivate|reactivate` and `trocar programme ...`: what scripts see.
#include <fstream>
#include <sstream>

#include "app/cli/records/cohort_command.h"
#include "app/cli/records/people_command.h"
#include "app/cli/records/programme_command.h"
#include "app/cli/records/trainee_command.h"
#include "app/cli/text_table.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/records/programmes.h"
#include "trainees/records/trainee_store.h"

namespace trocar::people_commands_test {
namespace {

class PeopleCommands : public TemporaryFolder {
 protected:
  std::filesystem::path written(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::string said() {
    const std::string all = out_.str();
    out_.str("");
    return all;
  }
  bool has(const std::string& text, const std::string& part) const { return text.find(part) != std::string::npos; }
  const std::filesystem::path file_ = folder_ / "t.db";
  std::ostringstream out_, err_;
};

TEST(TextTable, NothingInACellSteersTheTerminal) {
  TextTable table({{"code"}, {"name"}});
  table.add({"A-1",
             "J\xC3\xBCrgen\x1B[2J\n\xC2\x9B"
             "31m\x7F"});
  std::ostringstream out;
  table.print(out);
  EXPECT_EQ(out.str(), "code  name\nA-1   J\xC3\xBCrgen?[2J???31m?\n");
}

TEST_F(PeopleCommands, AListIsLookedAtAndTaken) {
  PeopleOptions options;
  options.database = file_;
  options.list = written("list.csv",
                         "\xEF\xBB\xBF"
                         "code;name\r\nA-1;Ada\r\nB-2;Bo\r\n");
  options.group = "2026 A";
  options.preview = true;
  EXPECT_EQ(trainee_import(options, out_, err_), 0);
  EXPECT_TRUE(has(said(), "added  A-1"));
  EXPECT_TRUE(has(err_.str(), "2 added, 0 joining a group, 0 skipped, 0 refused; nothing is written yet"));
  EXPECT_TRUE(TraineeStore(*std::make_unique<Database>(file_)).list().empty());
  options.preview = false;
  EXPECT_EQ(trainee_import(options, out_, err_), 0);
  options.list = written("more.csv", "code,name\nA-1,Ada\nA 3,Cy\nC-3,Cy\n");
  EXPECT_EQ(trainee_import(options, out_, err_), 2) << "a line is refused, the others are taken";
  EXPECT_TRUE(has(said(), "refused"));
  Database database(file_);
  EXPECT_EQ(TraineeStore(database).list().size(), 3U);
  EXPECT_EQ(CurriculumStore(database).members("2026 A").size(), 3U);
  options.list = folder_ / "none.csv";
  EXPECT_THROW(trainee_import(options, out_, err_), InputError);
  options.list = written("bad.csv", "code\n\"x\n");
  EXPECT_NE(message_of<InputError>([&] { trainee_import(options, out_, err_); }).find("bad.csv:2:1:"),
            std::string::npos);
  EXPECT_EQ(problems_of(database), "");
}

TEST_F(PeopleCommands, ManyAreGroupedDeactivatedAndLeftOut) {
  {
    Database database(file_);
    for (const char* code : {"A-1", "B-2"}) store_attempt(database, sample_start(code), sample_result());
  }
  PeopleOptions options;
  options.database = file_;
  options.group = "2026 A";
  options.codes = {"A-1", "B-2", "C-3"};
  EXPECT_THROW(trainee_group(options, out_, err_), InputError);
  EXPECT_TRUE(CurriculumStore(*std::make_unique<Database>(file_)).groups().empty()) << "nobody was changed";
  options.codes = {"A-1", "B-2"};
  trainee_group(options, out_, err_);
  EXPECT_EQ(said(), "A-1\nB-2\n");
  options.codes = {"B-2"};
  trainee_set_active(options, false, out_, err_);
  EXPECT_EQ(said(), "1 deactivated\n");
  CohortOptions cohort;
  cohort.database = file_;
  cohort_command(cohort, out_, err_);
  EXPECT_FALSE(has(said(), "B-2"));
  cohort.deactivated = true;
  cohort_command(cohort, out_, err_);
  EXPECT_TRUE(has(said(), "B-2"));
  trainee_set_active(options, true, out_, err_);
  EXPECT_EQ(said(), "1 reactivated\n");
}

TEST_F(PeopleCommands, AProgrammeIsSavedAssignedAndAskedFor) {
  {
    Database database(file_);
    for (const char* code : {"A-1", "B-2"}) TraineeStore(database).ensure_trainee(code);
    CurriculumStore(database).join("A-1", "2026 A", {"", "x"});
  }
  ProgrammeOptions options;
  options.database = file_;
  options.name = "Basics";
  const std::string toml = "# mine\n[[step]]\nexercise = \"surface-touch\"\nlevel = \"L1\"\npasses = 2\n";
  options.text = written("basics.toml", toml);
  EXPECT_EQ(programme_save(options, out_, err_), 0);
  EXPECT_EQ(said(), "Basics version 1\n");
  programme_show(options, out_, err_);
  EXPECT_EQ(said(), toml);
  options.text = written("bad.toml", toml + "x = 1\n");
  for (const auto& [from, to, words] : {std::tuple{"surface-touch", "nothing-here", "step 1: there is no exercise"},
                                        {"\"L1\"", "\"L99\"", "step 1: surface-touch has no level"}}) {
    std::string other = toml;
    ProgrammeOptions wrong = options;
    wrong.text = written("other.toml", other.replace(other.find(from), std::string(from).size(), to));
    const std::string complaint = message_of<InputError>([&] { programme_save(wrong, out_, err_); });
    EXPECT_NE(complaint.find(words), std::string::npos) << complaint;
  }
  EXPECT_NE(message_of<InputError>([&] { programme_save(options, out_, err_); }).find("bad.toml:6:1:"),
            std::string::npos);
  options.group = "2026 A";
  options.due = "2020-06-30";
  programme_assign(options, out_, err_);
  const std::string uuid = said();
  EXPECT_EQ(uuid.size(), 37U);
  programme_list(options, out_, err_);
  EXPECT_TRUE(has(said(), "group 2026 A  2020-06-30"));
  options.group.clear();
  programme_grid_command(options, out_, err_);
  const std::string grid = said();
  EXPECT_TRUE(has(grid, "surface-touch L1") && has(grid, "overdue") && !has(grid, "B-2")) << grid;
  options.csv = true;
  programme_grid_command(options, out_, err_);
  EXPECT_TRUE(
      has(said(), "A-1,,2026 A,1,Basics,1,surface-touch,L1,2 passes,overdue,0,0,0,2020-06-30,0 of 2 passes\r\n"));
  programme_reminders(options, out_, err_);
  EXPECT_TRUE(has(said(), "A-1,,2026 A,Basics,surface-touch L1,2020-06-30,-"));
  trainee_show({file_, "A-1"}, out_, err_);
  EXPECT_TRUE(has(said(), "due 2020-06-30: surface-touch L1, 0 of 2 passes (Basics, overdue)"));
  options.assignment = uuid.substr(0, 36);
  programme_withdraw(options, out_, err_);
  EXPECT_TRUE(has(said(), "withdrawn"));
  EXPECT_THROW(programme_withdraw(options, out_, err_), InputError);
}

}  // namespace
}  // namespace trocar::people_commands_test
