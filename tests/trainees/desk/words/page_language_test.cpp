// Pages in other languages: what is translated, what never is, and that the catalogues say all that the pages say.
#include "trainees/desk/words/page_language.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "haptics/input_error.h"
#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "tests/trainees/desk/server/desk_samples.h"
#include "tests/trainees/records/cohort_samples.h"
#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/desk/pages/desk_page.h"
#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/queries/record_views.h"
#include "trainees/desk/routes/route_table.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/replica_facts.h"
#include "trainees/records/trainee_store.h"

namespace trocar::review::page_language_test {
namespace {

const std::filesystem::path kTree = TROCAR_SOURCE_DIR, kFolder = kTree / "assets/languages";

class PageLanguageFile : public TemporaryFolder {
 protected:
  PageLanguage language(const std::string& words, const std::string& unit = "MB") {
    std::filesystem::create_directories(folder_ / "desk");
    std::ofstream(folder_ / "de.toml")
        << "name = \"Deutsch\"\n[words]\n\"Hold\" = \"Halten\"\n\"{0} of {1}\" = \"x\"\n";
    std::ofstream(folder_ / "desk/de.toml")
        << "units = {deg = \"\xC2\xB0\", " << unit
        << " = \"Mo\"}\ndecimal = \",\"\nday = \"{0}. {1} {2}\"\nmonths = [\"Jan.\", \"Feb.\", \"M\xC3\xA4rz\", "
           "\"Apr.\", \"Mai\", "
           "\"Juni\", \"Juli\", \"Aug.\", \"Sep.\", \"Okt.\", \"Nov.\", \"Dez.\"]\n[words]\n"
        << words;
    return {folder_, "de"};
  }
};

TEST_F(PageLanguageFile, WholeTextsPatternsAndSentences) {
  const PageLanguage german = language(
      "\"Ready\" = \"Bereit\"\n\"{n} of {n} passed\" = \"{n1} von {n2} bestanden\"\n\"best {p}, by {t}\" = \"von {t}: "
      "{p}\"\n\"score\" = \"Punkte\"\n\"Nothing is due.\" = \"Nichts ist f\xC3\xA4llig.\"\n");
  EXPECT_EQ(german.words("Ready"), "Bereit");
  EXPECT_EQ(german.words("Hold"), "Halten") << "from the window's catalogue";
  EXPECT_EQ(german.words("3 of 4 passed"), "3 von 4 bestanden");
  EXPECT_EQ(german.words("best score, by Ready"), "von Ready: Punkte") << "{t} stays as it is";
  EXPECT_EQ(german.words("Score."), "Punkte.") << "small letter and stop are tried";
  EXPECT_EQ(german.words("Nothing is due. Unheard of. Score."), "Nichts ist f\xC3\xA4llig. Unheard of. Punkte.");
  EXPECT_EQ(german.words("22 Nov 2026, 13:05"), "22. Nov. 2026, 13:05");
  EXPECT_EQ(german.words("1 Mar"), "1. M\xC3\xA4rz");
  EXPECT_EQ(german.words("86.5 mm/s"), "86,5 mm/s");
  EXPECT_EQ(german.words("1.58 deg"), "1,58\xC2\xB0");
  EXPECT_EQ(german.words("2 deg, 1.5 MB"), "2\xC2\xB0, 1,5 Mo");
  EXPECT_EQ(german.words("deg"), "\xC2\xB0") << "the unit of an axis";
  EXPECT_EQ(german.words("1.2.3"), "1.2.3") << "a version is no number";
  EXPECT_EQ(german.words("Nobody knows"), "Nobody knows");
}

TEST_F(PageLanguageFile, ANameTakesNoSentenceThatIsKnown) {
  const PageLanguage german = language(
      "\"Not done.\" = \"Nein.\"\n\"Not done. {p}\" = \"Nein. {p}\"\n\"{t}: the disk is full, and nothing was "
      "written\" = \"{t}: voll\"\n");
  EXPECT_EQ(german.words("Not done. a.db.backup: the disk is full, and nothing was written."),
            "Nein. a.db.backup: voll.");
  EXPECT_EQ(german.words("Dr. Ann: the disk is full, and nothing was written."), "Dr. Ann: voll.");
}

TEST_F(PageLanguageFile, OfAPageOnlyWhatIsTheDesksOwnIsTranslated) {
  const PageLanguage german = language("\"Ready\" = \"Be<reit\"\n\"a & b\" = \"a & c\"\n");
  const auto page = [&](const std::string& html) { return german.page(html); };
  EXPECT_EQ(page("<html lang=\"en\"><p title=\"Ready\"> Ready </p>"),
            "<html lang=\"de\"><p title=\"Be&lt;reit\"> Be&lt;reit </p>");
  EXPECT_EQ(page("<p>a &amp; b</p>"), "<p>a &amp; c</p>");
  for (const char* kept :
       {"<p translate=\"no\">Ready<p>Ready</p>Ready</p>", "<td class=\"x mono\">Ready</td>", "<code>Ready</code>",
        "<p class=\"said\">Ready</p>", "<textarea rows=\"2\">\nReady</textarea>", "<input value=\"Ready\"/>",
        "<!-- Ready -->", "<", "<p title", "&nbsp;", "<!"})
    EXPECT_EQ(page(kept), kept);
  EXPECT_EQ(page("<td data-label=\"Ready\" title=\"Ready\" translate=\"no\">Ready</td>"),
            "<td data-label=\"Be&lt;reit\" title=\"Ready\" translate=\"no\">Ready</td>")
      << "a column's name is the desk's own, whatever its cell holds";
  EXPECT_EQ(page("<br translate=\"no\"><p>Ready</p>"), "<br translate=\"no\"><p>Be&lt;reit</p>");
  EXPECT_EQ(page("<b translate=\"no\"><i>Ready</i></b>Ready"), "<b translate=\"no\"><i>Ready</i></b>Be&lt;reit");
}

TEST_F(PageLanguageFile, ACatalogueThatCannotBeRightIsRefusedWithItsPlace) {
  for (const char* words : {"\"{n} tries\" = \"Versuche\"\n", "\"{n}{p}\" = \"{n}{p}\"\n", "\"a\" = 3\n",
                            "\"a\" = \"\"\n", "\"a\" = \"b\"\n\"a\" = \"c\"\n"}) {
    try {
      language(words);
      ADD_FAILURE() << words;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("de.toml:"), std::string::npos) << error.what();
    }
  }
}

TEST_F(PageLanguageFile, OnlyUnitsHaveASignOfTheirOwn) {
  EXPECT_THROW(language("\"a\" = \"b\"\n", "flowers"), InputError);
}

TEST(PageLanguages, TheCookieGoesBeforeTheBrowser) {
  const PageLanguages all(kFolder);
  const auto code = [&](const char* cookie, const char* accept) {
    const PageLanguage* one = all.chosen(cookie, accept);
    return one == nullptr ? "en" : one->code();
  };
  EXPECT_EQ(code("", ""), "en");
  EXPECT_EQ(code("", "de-CH,de;q=0.9,en;q=0.8"), "de");
  EXPECT_EQ(code("", "en-US,en;q=0.9,fr;q=0.8"), "en");
  EXPECT_EQ(code("", "es, fr;q=0.5, de;q=0.7"), "de");
  EXPECT_EQ(code("", "FR"), "fr");
  EXPECT_EQ(code("", "de;q=0"), "en");
  EXPECT_EQ(code("en", "de"), "en");
  EXPECT_EQ(code("fr", "de"), "fr");
  EXPECT_EQ(code("xx", "de"), "de");
}

/// Every page that a person can meet, in English.
class AllPages : public testing::Test {
 protected:
  AllPages() : database_(":memory:"), desk_{database_, {}, false}, table_(desk_routes()) {
    test::fill_cohort(database_, {});
    TraineeStore(database_).ensure_trainee("ready");
    TraineeStore(database_).edit("ready", "Ready", {}, "");
    desk_.sources.trace = [](const std::filesystem::path&) { return sample_trace(); };
    desk_.sources.picture = [](const std::string&, double, int) { return std::string(); };
    desk_.sources.level_facts = [](const std::string&, const std::string&) { return LevelFacts{{0.4, 0.8, 1.5}, 70}; };
    desk_.sources.exercises = {{"surface-touch", "Surface touch", {"L1", "L2"}}};
  }

  std::string ask(const std::string& method, const std::string& path, std::map<std::string, std::string> values = {}) {
    const RouteTable::Found found = table_.find(method, path);
    if (found.route == nullptr) throw std::logic_error("no route " + path);
    Request request;
    request.path = path;
    request.arguments = found.arguments;
    (method == "GET" ? request.query : request.form) = std::move(values);
    request.account = Account{"a-1", "ines", "Dr Ines Okafor", Role::kAdministrator};
    request.token = "token-4711";
    request.now_utc = "2026-06-01T10:00:00Z";
    return found.route->answer(request, desk_).body;
  }

  std::vector<std::string> pages() {
    Frame frame = sample_frame();
    std::vector<std::string> out{cohort_page(sample_cohort(), frame),
                                 trainee_page(sample_trainee(), frame),
                                 attempt_page(sample_attempt(), frame),
                                 attempt_page(sample_attempt(90, 1), frame),
                                 compare_page(sample_compare(), frame),
                                 curriculum_page(sample_curriculum(), frame),
                                 station_page(sample_stations(), frame),
                                 station_page({}, frame),
                                 cohort_page({}, frame),
                                 password_page(false, frame),
                                 password_page(true, frame),
                                 sign_in_page({}).body};
    for (const int status : {400, 401, 403, 404, 405, 408, 411, 413, 414, 415, 421, 429, 431, 500, 503, 505, 507})
      out.push_back(error_page(status).body);
    const std::string attempt = AttemptStore(database_).latest()->uuid;
    ask("POST", "/attempt/" + attempt + "/note", {{"text", "Not signed yet."}});
    ask("POST", "/attempt/" + attempt + "/sign", {{"meaning", "approval"}, {"note", "Ready"}});
    ask("POST", "/roster/add", {{"code", "X-1"}, {"name", "Not started"}, {"email", ""}, {"group", "Cohort"}});
    ask("POST", "/programme",
        {{"name", "Grid"},
         {"do", "save"},
         {"s1.step", "surface-touch|L1"},
         {"s1.passes", "2"},
         {"s1.days", "1"},
         {"s1.row", "yes"},
         {"s1.input", ""},
         {"s1.due", "10"}});
    ask("POST", "/programmes/assign", {{"programme", "Grid"}, {"group", "Cohort"}, {"trainee", ""}, {"due", ""}});
    for (const std::string& path :
         {std::string("/"), std::string("/why"), std::string("/roster"), std::string("/roster/import"),
          std::string("/programmes"), std::string("/grid"), std::string("/reminders"), std::string("/curriculum"),
          std::string("/station"), std::string("/accounts"), std::string("/record"), std::string("/retention"),
          "/attempt/" + attempt, "/trainee/" + AttemptStore(database_).latest()->trainee,
          "/compare/" + attempt + "/" + attempt, "/attempt/" + attempt + "/film", std::string("/trainee/ready")})
      out.push_back(ask("GET", path));
    out.push_back(ask("GET", "/programme", {{"name", "Grid"}}));
    out.push_back(ask("GET", "/roster/person", {{"code", "X-1"}}));
    out.push_back(ask("GET", "/grid", {{"programme", "Grid"}}));
    out.push_back(ask("GET", "/roster", {{"who", "deactivated"}}));
    out.push_back(ask("POST", "/roster/import", {{"csv", "code;name\nA1;Ann\nX-1;Not started\n"}, {"do", "look"}}));
    out.push_back(ask("POST", "/roster/selected", {{"do", "cards"}, {"p:X-1", "yes"}}));
    out.push_back(ask("POST", "/attempt/" + attempt + "/override", {{"passed", "no"}, {"reason", "short"}}));
    return out;
  }

  Database database_;
  Desk desk_;
  RouteTable table_;
};

/// Names, codes and data of the samples that stand among the desk's own words, and texts that a sample made up.
const std::regex kData(
    "(alvarez|brandt|chen|dubois|expert|standard|ready|sha256|Tremor|X-1|reach-and-orient.*|surface-touch.*|"
    "limited-grasp.*|Metric no.*|words of .*|.*19 Mar.*|(Compare|Trocar desk): reach-and-orient .*|.*[Cc]ritical "
    "force.*|"
    ".*(In|in) band.*|Excess|.*Excess: .*|.*went past.*|.*without a pass|.*over the newest.*|.*2 Feb|certificate of 1 "
    "Mar.*|largest \\|F\\|.*|Synthetic phantom, CC0-1\\.0|trocar 0\\.7|board 3, organ phantom.*)");

TEST_F(AllPages, EveryTextHasATranslation) {
  for (const char* code : {"de", "fr"}) {
    const PageLanguage language(kFolder, code);
    AskedWords asked;
    for (const std::string& html : pages()) {
      const std::string page = language.page(html, &asked);
      EXPECT_NE(page.find("<html lang=\"" + std::string(code) + "\""), std::string::npos);
      std::smatch misread;
      EXPECT_FALSE(std::regex_search(page, misread, std::regex("(nein|non)\\. [0-9]+"))) << misread.str();
    }
    for (const std::string& text : asked.unknown) EXPECT_TRUE(std::regex_match(text, kData)) << code << ": " << text;
  }
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// What the record and the program write, as pages show it.
TEST(Catalogues, SayWhatARecordBringsOntoPages) {
  std::set<std::string> texts = {
      "certificate of 30 Nov 2026: 1 of the 16 attempts that it stands on was decided not passed by Ann on 30 Nov "
      "2026: x",
      "In question: 2 of the 16 attempts that it stands on were decided not passed by Ann on 30 Nov 2026: x. Look, and "
      "withdraw it if it must not stand.",
      "the attempt that it cites is no longer the one that was certified",
      "attempt 01a2, on which it stands, is another person's",
      "trocar run at vm, process 3764",
      "The clock began",
      "Film, Surface touch L1, demo-emil - Trocar desk",
      "Surface touch L1 (withdrawn)",
      "an account that is gone (01a22e4c)",
      "Reach and orient, version 2, level L1",
      "106 attempts, head a2169a95fa61af42\xE2\x80\xA6",
      "0 attempts, head none",
      "0 attempts, head none, its key lay there already",
      "Local instructor",
      "Demo",
      "from"};
  for (const auto& file : std::filesystem::directory_iterator(kTree / "scenarios/scoring")) {
    if (!file.path().filename().string().ends_with("metrics.cpp")) continue;
    const std::string source = text_of(file.path());
    static const std::regex pushed("\\{\"([a-z]+_[a-z0-9_]+)\",");
    for (auto it = std::sregex_iterator(source.begin(), source.end(), pushed); it != std::sregex_iterator(); ++it)
      texts.insert(metric_title((*it)[1]));
  }
  EXPECT_GT(texts.size(), 50U);
  for (const std::string& table : sealed_tables()) texts.insert(table + " added");
  for (const char* action : {kActionBegun, kActionFinished, kActionReplicated, kActionStation, kActionMessage,
                             kActionRenewed, kActionMade, kActionMigrated, kActionKey, kActionReplica, kActionLinked})
    texts.insert(action);
  for (const char* code : {"de", "fr"}) {
    const PageLanguage language(kFolder, code);
    AskedWords asked;
    for (const std::string& text : texts) language.words(text, &asked);
    EXPECT_EQ(asked.unknown, std::set<std::string>{}) << code;
  }
  const PageLanguage german(kFolder, "de");
  EXPECT_EQ(german.words("programme Basics: 0 of 3 passes, 0 of 2 days"),
            "Programm Basics: 0 von 3 bestanden, an 0 von 2 Tagen");
  EXPECT_EQ(german.words("Surface touch L1, Ready - Trocar desk"), "Oberfläche berühren L1, Ready - Trocar-Pult")
      << "a code stays, whatever it says";
  EXPECT_NE(german.words("Due"), german.words("By"));
}

TEST_F(AllPages, NamesAndNotesStayWhateverTheySay) {
  const PageLanguage german(kFolder, "de");
  pages();
  const std::string attempt = AttemptStore(database_).latest()->uuid;
  const auto german_page = [&](const std::string& path, std::map<std::string, std::string> values = {}) {
    return german.page(ask("GET", path, std::move(values)));
  };
  const CheckedPage person = check_page(german_page("/trainee/ready"));
  EXPECT_EQ(person.problems, std::vector<std::string>{});
  EXPECT_EQ(person.all("h1").at(0)->text, "Ready");
  EXPECT_EQ(person.all("title").at(0)->text, "Ready - Trocar desk");
  const CheckedPage noted = check_page(german_page("/attempt/" + attempt));
  EXPECT_EQ(noted.problems, std::vector<std::string>{});
  EXPECT_EQ(noted.all("p", "said").at(0)->text, "Not signed yet.");
  EXPECT_NE(noted.by_id("sign")->text.find("Ready"), std::string::npos) << "the note of a signature";
  EXPECT_NE(noted.by_id("sign")->text.find("Unterschrieben von"), std::string::npos);
  const std::string roster = check_page(german_page("/roster")).by_id("people")->text;
  for (const char* own : {"Ready", "Not started", "Cohort"}) EXPECT_NE(roster.find(own), std::string::npos) << own;
  EXPECT_EQ(check_page(german_page("/grid", {{"programme", "Grid"}})).all("h1").at(0)->text, "Grid");
}

TEST_F(AllPages, OnlyTheProgramsOwnNamesAreTranslated) {
  const PageLanguage german(kFolder, "de");
  EXPECT_EQ(german.page(printed_html("Local instructor", "")), "<span>Lehrkraft vor Ort</span>");
  EXPECT_EQ(german.page(printed_html("Local instructor")), "<span>Lehrkraft vor Ort</span>");
  for (const std::string& name : {printed_html("Local instructor", "u-1"), printed_html("Demo", "u-1"),
                                  printed_html("Demo"), printed_html("Ready", "")})
    EXPECT_EQ(german.page(name), name);
  EXPECT_EQ(PageLanguage(kFolder, "fr").page(printed_html("Demo", "")), "<span>D\xC3\xA9mo</span>");
  EXPECT_NE(german
                .words("certificate of 30 Nov 2026: 1 of the 16 attempts that it stands on was decided not passed by "
                       "Local instructor on 30 Nov 2026: x")
                .find("der Lehrkraft vor Ort"),
            std::string::npos);
  Frame frame = sample_frame();
  frame.who = "Local instructor";
  EXPECT_NE(german.page(cohort_page({}, frame)).find(">Local instructor<"), std::string::npos) << "an account's name";
  frame.signed_in = false;
  EXPECT_EQ(german.page(cohort_page({}, frame)).find("Local instructor"), std::string::npos);
}

TEST_F(AllPages, AMigrationIsToldInWordsAndANameIsNotCut) {
  AuditEntry migrated, joined;
  migrated.action = kActionMigrated;
  migrated.detail = "106 attempts, head " + std::string(64, 'a') + kKeyLayThere;
  joined.action = "group joined";
  joined.detail = "Weiterbildung Viszeralchirurgie Herbst 2026";
  AuditEntry begun = joined;
  begun.detail = std::string(64, 'b') + " " + std::string(64, 'c');
  AuditView view;
  view.entries = {migrated, joined, begun};
  const std::string page = PageLanguage(kFolder, "de").page(audit_page(view, sample_frame()));
  for (const std::string& words :
       {"106 Versuche, Kopf " + std::string(16, 'a') + "\xE2\x80\xA6, der Schl\xC3\xBCssel lag schon da", joined.detail,
        std::string(16, 'b') + "\xE2\x80\xA6 " + std::string(16, 'c') + "\xE2\x80\xA6"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
}

/// Sources in a room of the tree, or that one.
std::vector<std::filesystem::path> sources_in(const char* room) {
  if (std::filesystem::is_regular_file(kTree / room)) return {kTree / room};
  std::vector<std::filesystem::path> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kTree / room))
    for (const char* kind : {".cpp", ".h", ".toml"})
      if (entry.path().extension() == kind) out.push_back(entry.path());
  return out;
}

/// Entries that sample pages do not show: their words stand together in the sources that make pages.
TEST_F(AllPages, NothingIsTranslatedInVain) {
  std::string sources;
  for (const char* room : {"trainees", "scenarios", "app"})
    for (const std::filesystem::path& file : sources_in(room)) sources += text_of(file);
  const auto plain = [](const std::string& text) {
    std::string out;
    for (const char c : text) {
      const bool letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
      if (letter)
        out += c;
      else if (c >= 'A' && c <= 'Z')
        out += static_cast<char>(c + 32);
      else if (!out.empty() && out.back() != ' ')
        out += ' ';
    }
    return out;
  };
  sources = plain(sources);
  for (const char* code : {"de", "fr"}) {
    const PageLanguage language(kFolder, code);
    AskedWords asked;
    for (const std::string& html : pages()) language.page(html, &asked);
    for (const std::string& key : language.keys()) {
      if (asked.used.contains(key)) continue;
      std::istringstream words(plain(std::regex_replace(key, std::regex("\\{[npt]\\d?\\}"), " ")));
      int all = 0, there = 0;
      for (std::string before, word; words >> word; before = word) {
        if (before.empty()) continue;
        ++all;
        there += sources.find(before + " " + word) != std::string::npos ? 1 : 0;
      }
      if (all > 1) {  // of two words the one may come from a table of the record
        EXPECT_GE(2 * there, all) << code << ": " << key;
      }
    }
  }
}

/// Where what can reach a page is thrown.
constexpr const char* kRefusing[] = {"trainees/desk",
                                     "trainees/files",
                                     "trainees/integrity",
                                     "trainees/progress",
                                     "trainees/records",
                                     "trainees/store",
                                     "trainees/exchange/export/export_choice.cpp",
                                     "app/desk/desk_films.cpp",
                                     "app/desk/desk_pictures.cpp",
                                     "app/desk/demo_cohort.cpp",
                                     "haptics/toml_keys.cpp"};

/// What no page shows: the source, and words of the text where not all of it is meant.
struct Unshown {
  const char *source, *words;
};
constexpr Unshown kUnshown[] = {
    // Said at the terminal that starts the desk, or makes the demo.
    {"trainees/desk/server/desk_server.cpp", ""},
    {"trainees/desk/server/tls_identity.cpp", ""},
    {"trainees/desk/words/page_language.cpp", ""},
    {"app/desk/demo_cohort.cpp", ": exists already"},
    {"app/desk/demo_cohort.cpp", "in the meantime"},
    {"trainees/records/demo_record.cpp", ""},
    // Before the first page: another program's database, or one of an earlier version, is opened.
    {"trainees/store/database.cpp", "no place for the database"},
    {"trainees/store/migrations.cpp", "of another program"},
    {"trainees/store/migrations.cpp", "holds its texts as"},
    {"trainees/store/migrations.cpp", "migrating would break"},
    {"trainees/store/migrations.cpp", "the backup is not whole"},
    {"trainees/store/migrations.cpp", "is of schema"},
    {"trainees/store/migrations.cpp", "was written by a newer trocar"},
    // Commands of the command line alone.
    {"trainees/files/password_file.cpp", ""},
    {"trainees/files/write_file.cpp", ""},
    {"trainees/integrity/witness.cpp", ""},
    {"trainees/records/consents.cpp", ""},
    {"trainees/records/erasure.cpp", ""},
    {"trainees/records/person_record.cpp", ""},
    // Attempts are begun and stored by the window.
    {"trainees/records/attempt_rows.cpp", "at most 1024 sub-scores"},
    {"trainees/records/attempt_store.cpp", "the attempt is still"},
    {"trainees/records/attempt_store.cpp", "is another trainee's"},
    {"trainees/records/attempt_store.cpp", "an exam board is met once"},
    {"trainees/records/attempt_store.cpp", "before it began"},
    {"trainees/records/attempt_store.cpp", "cannot be finished again"},
    {"trainees/records/attempt_store.cpp", "its row was changed while it ran"},
    {"trainees/records/process_identity.cpp", ""},
    {"trainees/store/lookup_tables.cpp", ""},
    // The sign-in's own 503, which says only that the desk is busy; a mistake of the program.
    {"trainees/desk/server/desk_sessions.cpp", ""},
    {"trainees/integrity/sealed_rows.cpp", "no table whose rows are sealed"}};

/// Throws without words of their own: what they say comes from another source, or from the reader of TOML.
const std::set<std::string> kSaidElsewhere = {"why", "what", "message", "request.unconfirmed",
                                              "std::string(error.description())"};

constexpr const char *kTyped = "A-17", *kCounted = "7";

/// What stands for operands that are neither typed nor counted, by source and name.
const std::map<std::string, std::string> kOperands = {
    {"accounts role", "instructor"},
    {"accounts role_name", "instructor"},
    {"assessments by", " by decision of A-17 on 2026-06-30"},
    {"assessments what", "rating A-17, A-17"},
    {"attempt_chain what", "signed"},
    {"curricula lost", "its key A-17 is missing: what is written now is not signed, which db check tells for ever"},
    {"curricula range_words", "from 0 to 100"},
    {"curriculum_view by", "the one that came with the program"},
    {"database other", "trigger A-17 was altered"},
    {"desk_films foreign", "another file lies in the place of its recording"},
    {"desk_pictures foreign", "another file lies in the place of its recording"},
    {"desk_pictures one.run.failure", "another file lies in the place of its recording"},
    {"export_choice what", "group"},
    {"film_routes desk.sources.no_film", "No film: this desk makes none."},
    {"password_rules name", "password"},
    {"people_import name", "list"},
    {"people_import row.reason", "has no code"},
    {"printed_text what", "note"},
    {"programme place", "programme \"A-17\", step 7: "},
    {"programme_view what", "step 7, passes"},
    {"programme_view which", "step 7, "},
    {"record_backup size_text", "1.2 GB"},
    {"rules called", "'A-17'"},
    {"rules short_text", "7"},
    {"signing lost", "its key A-17 is missing: what is written now is not signed, which db check tells for ever"},
    {"signing why", "accounts are kept here, so only an account can sign: sign in first"},
    {"sqlite_handle message", "A-17: cannot run a statement: A-17"}};

/// Where the sign stands next, outside of texts and of brackets; where the bracket ends that `from` is in.
std::size_t next_sign(const std::string& code, std::size_t from, char sign) {
  int open = 0;
  for (std::size_t at = from; at < code.size(); ++at) {
    const char c = code[at];
    if (c == '"' || c == '\'') {
      while (++at < code.size() && code[at] != c) at += code[at] == '\\' ? 1 : 0;
    } else if (std::string_view("([{").find(c) != std::string_view::npos) {
      ++open;
    } else if (std::string_view(")]}").find(c) != std::string_view::npos) {
      if (open-- == 0) return at;
    } else if (code.compare(at, 2, "::") == 0) {
      ++at;
    } else if (c == sign && open == 0) {
      return at;
    }
  }
  return code.size();
}

std::vector<std::string> parts_of(const std::string& code, char sign) {
  std::vector<std::string> out;
  for (std::size_t from = 0, to = 0; from <= code.size(); from = to + 1) {
    to = next_sign(code, from, sign);
    std::string part = code.substr(from, to - from);
    part.erase(0, part.find_first_not_of(" \n"));
    part.erase(part.find_last_not_of(" \n") + 1);
    out.push_back(std::move(part));
  }
  return out;
}

/// What an expression of texts can say. @param source its file's name
std::vector<std::string> said_by(const std::string& code, const std::string& source) {
  if (const std::size_t either = next_sign(code, 0, '?'); either < code.size()) {
    const std::size_t otherwise = next_sign(code, either + 1, ':');
    std::vector<std::string> out = said_by(code.substr(either + 1, otherwise - either - 1), source);
    for (std::string& text : said_by(code.substr(otherwise + 1), source)) out.push_back(std::move(text));
    return out;
  }
  const std::vector<std::string> operands = parts_of(code, '+');
  if (operands.size() > 1) {
    std::vector<std::string> out{""};
    for (const std::string& operand : operands) {
      std::vector<std::string> longer;
      for (const std::string& before : out)
        for (const std::string& text : said_by(operand, source)) longer.push_back(before + text);
      out = std::move(longer);
    }
    return out;
  }
  const std::string& one = operands[0];
  if (one.starts_with('"')) {
    static const std::regex literal("\"((\\\\.|[^\"\\\\])*)\""), escape("\\\\(.)");
    std::string text;
    for (auto it = std::sregex_iterator(one.begin(), one.end(), literal); it != std::sregex_iterator(); ++it)
      text += std::regex_replace((*it)[1].str(), escape, "$1");
    return {text};
  }
  for (const std::string_view wrapped : {"std::string(", "("})
    if (one.starts_with(wrapped)) return said_by(one.substr(wrapped.size(), one.size() - wrapped.size() - 1), source);
  if (one.starts_with("std::to_string(")) return {kCounted};
  const auto at = kOperands.find(source + " " + one.substr(0, one.find('(')));
  return {at == kOperands.end() ? kTyped : at->second};
}

struct Refusal {
  std::string source = {}, place = {}, text = {};
};

/// What a source throws, or answers instead of a page, as a sentence of it.
std::vector<Refusal> refusals_in(const std::filesystem::path& file) {
  static const std::regex refusing(
      "throw (InputError|EnvironmentError|error_at|step_error|fault)\\(|return refused\\(|error_page\\(");
  std::vector<Refusal> out;
  const std::string code = text_of(file), source = std::filesystem::relative(file, kTree).generic_string();
  for (auto it = std::sregex_iterator(code.begin(), code.end(), refusing); it != std::sregex_iterator(); ++it) {
    const auto begin = static_cast<std::size_t>(it->position() + it->length());
    const std::string place =
        source + ":" + std::to_string(1 + std::count(code.begin(), code.begin() + it->position(), '\n'));
    const std::vector<std::string> arguments = parts_of(code.substr(begin, next_sign(code, begin, '\0') - begin), ',');
    const bool page = it->str().starts_with("error_page");
    const std::string said = page ? arguments[std::min<std::size_t>(1, arguments.size() - 1)] : arguments.back();
    if (std::regex_replace(said, std::regex("\"\""), "").find('"') == std::string::npos) {
      const bool thrown = it->str().starts_with("throw");
      EXPECT_TRUE(!thrown || kSaidElsewhere.contains(said)) << place << ": " << said;
      continue;
    }
    for (const std::string& text : said_by(said, file.stem().string()))
      if (!text.empty()) out.push_back({source, place, text});
  }
  return out;
}

std::ptrdiff_t times(const std::string& text, const std::string& part) {
  std::ptrdiff_t out = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++out;
  return out;
}

TEST(Refusals, HaveATranslationAndKeepWhatWasTyped) {
  const PageLanguage languages[] = {{kFolder, "de"}, {kFolder, "fr"}};
  std::size_t all = 0;
  std::set<std::string> passed_over;
  for (const char* room : kRefusing)
    for (const std::filesystem::path& file : sources_in(room))
      for (const Refusal& refusal : refusals_in(file)) {
        const auto* unshown = std::find_if(std::begin(kUnshown), std::end(kUnshown), [&](const Unshown& one) {
          return refusal.source == one.source && refusal.text.find(one.words) != std::string::npos;
        });
        if (unshown != std::end(kUnshown)) {
          passed_over.insert(std::string(unshown->source) + unshown->words);
          continue;
        }
        ++all;
        const std::string english = sentence(refusal.text);
        for (const PageLanguage& language : languages) {
          AskedWords asked;
          const std::string own = language.words(english, &asked);
          EXPECT_TRUE(asked.unknown.empty() && own != english && times(own, kTyped) == times(english, kTyped))
              << refusal.place << ": " << english << "\n"
              << language.code() << ": " << own;
          const std::string alone = language.words("Not done."), why = language.words("Not done. " + english);
          EXPECT_TRUE(why.starts_with(alone)) << refusal.place << ": " << why;
        }
      }
  EXPECT_GT(all, 200U);
  for (const Unshown& one : kUnshown)
    EXPECT_TRUE(passed_over.contains(std::string(one.source) + one.words))
        << one.source << " says no more: " << one.words;
}

TEST(Refusals, AreReadAsTheyStandOnPages) {
  const PageLanguage german(kFolder, "de"), french(kFolder, "fr");
  EXPECT_EQ(german.words("Not done. Trainee \"A-17\": there is none."),
            "Nicht ausgeführt. Den Code „A-17“ hat hier niemand.");
  EXPECT_EQ(french.words("Not done. Trainee \"A-17\": there is none."),
            "Non exécuté. Personne n'a ici le code « A-17 ».");
  EXPECT_EQ(german.words("Not done. Step 3, passes: a whole number from 1 to 100."),
            "Nicht ausgeführt. Schritt 3, Bestehen: eine ganze Zahl von 1 bis 100.");
  EXPECT_EQ(german.words("List:3:5: a quote is opened and never closed."),
            "Liste, Zeile 3, Spalte 5: ein Anführungszeichen wird geöffnet und nie geschlossen.");
  EXPECT_EQ(french.words("standard:3:4: 'unsafe.window' must be a whole number"),
            "standard, ligne 3, colonne 4 : 'unsafe.window' doit être un nombre entier");
  EXPECT_EQ(
      german.words("This record takes no decisions now: its key desk.db.key is missing: what is written now is not "
                   "signed, which db check tells for ever. Put it back, or make a new one with trocar db key "
                   "--renew."),
      "Diese Akte nimmt jetzt keine Entscheidungen an: ihr Schlüssel desk.db.key fehlt: was jetzt geschrieben "
      "wird, ist nicht signiert, was db check für immer sagt. Legen Sie ihn zurück, oder machen Sie mit trocar "
      "db key --renew einen neuen.");
  EXPECT_EQ(french.words("You cannot sign, decide or certify: the station's key is missing."),
            "Vous ne pouvez ni signer, ni décider, ni certifier : la clé du poste manque.");
  EXPECT_EQ(german.words("Is there already as Ann, deactivated."), "Ist schon da als Ann, deaktiviert.");
  EXPECT_EQ(german.words("Not done. No certificate. Competence has not been shown: 3 attempts, none passed yet."),
            "Nicht ausgeführt. Kein Zertifikat. Das Können ist nicht gezeigt: 3 Versuche, noch keiner bestanden.");
  EXPECT_EQ(german.words("Not done. r.db.2026-11-30T22-34-43.941Z.backup: the disk is full: no backup was made; make "
                         "room on it."),
            "Nicht ausgeführt. r.db.2026-11-30T22-34-43.941Z.backup: die Platte ist voll: es wurde keine Sicherung "
            "gemacht; schaffen Sie Platz darauf.");
}

TEST_F(AllPages, AnAttemptsPageIsTranslatedInAFewMilliseconds) {
  const PageLanguage german(kFolder, "de");
  AttemptView view = sample_attempt();
  for (int i = 0; i < 42; ++i)
    view.result.events.push_back({1.0 * i, "TARGET_HELD", Severity::kInfo, i, 1.1, "N", Vec3::Zero()});
  const std::string html = attempt_page(view, sample_frame());
  double best_ms = 1e9;
  for (int i = 0; i < 10; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    german.page(html);
    best_ms =
        std::min(best_ms, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  RecordProperty("bytes", static_cast<int>(html.size()));
  RecordProperty("best_us", static_cast<int>(1000 * best_ms));
  EXPECT_LT(best_ms, 10) << html.size() << " bytes";
}

class GateLanguage : public DeskTest {};

TEST_F(GateLanguage, IsChosenByALinkAndKeptInACookie) {
  make_gate({.languages = std::make_shared<PageLanguages>(kFolder)}, desk_routes());
  const Answer chosen = ask("GET", "/sign-in?next=%2Fwhy&lang=de");
  EXPECT_EQ(chosen.response.status, 303);
  EXPECT_EQ(chosen.response.location, "/sign-in?next=%2Fwhy");
  EXPECT_EQ(chosen.cookie.substr(0, chosen.cookie.find(';')), "lang=de");
  EXPECT_EQ(ask("GET", "/nothing?lang=fr").response.location, "/") << "no page to come back to";
  EXPECT_EQ(ask("GET", "/?lang=xx").response.status, 400);
  EXPECT_EQ(ask("GET", "/?lang=xx").cookie.find("lang="), std::string::npos);
  EXPECT_NE(ask("GET", "/sign-in", {"lang=de", ""}).response.body.find("Anmelden"), std::string::npos);
  EXPECT_NE(ask("GET", "/sign-in", {}, "", {"Accept-Language: fr"}).response.body.find("Se connecter"),
            std::string::npos);
  EXPECT_NE(ask("GET", "/sign-in", {"lang=en", ""}, "", {"Accept-Language: fr"}).response.body.find("Sign in"),
            std::string::npos);
  EXPECT_EQ(ask("GET", "/desk.js", {"lang=de", ""}).response.body, ask("GET", "/desk.js").response.body);
}

}  // namespace
}  // namespace trocar::review::page_language_test
