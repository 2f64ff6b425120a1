// What is refused is not lost, and nobody ends in a blind alley.
#include "tests/trainees/desk/server/desk_samples.h"

#include <gtest/gtest.h>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/server/url_text.h"
#include "trainees/records/assessments.h"
#include "trainees/records/curricula.h"

namespace trocar::review::desk_refusal_test {
namespace {

class DeskRefusal : public DeskTest {
 protected:
  DeskRefusal() {
    add_accounts();
    make_gate({}, desk_routes());
    ines_ = signed_in("ines");
  }
  /// The refused form's page; `said` is the reason that stands in it.
  std::string refused(const std::string& path, const std::string& form, const std::string& said, int status = 400) {
    const Answer answer = ask("POST", path, ines_, form + "&password=" + percent_encoded(kPassword));
    EXPECT_EQ(answer.response.status, status) << path;
    EXPECT_NE(answer.response.body.find(said), std::string::npos) << path << "\n"
                                                                  << answer.response.body.substr(0, 3000);
    return answer.response.body;
  }
  Visitor ines_;
};

TEST_F(DeskRefusal, ATraineeWhoOpensTheDeskComesToTheOwnPage) {
  const Visitor anna = signed_in("anna");
  const Answer first = ask("GET", "/", anna);
  EXPECT_EQ(first.response.status, 303);
  EXPECT_EQ(first.response.location, "/trainee/T-anna");
  const std::string own = ask("GET", "/trainee/T-anna", anna).response.body;
  EXPECT_NE(own.find("action=\"/sign-out\""), std::string::npos);
  EXPECT_NE(own.find("href=\"/attempt/" + annas_), std::string::npos);
  EXPECT_EQ(ask("GET", "/curriculum", anna).response.status, 403);
  EXPECT_EQ(ask("GET", "/", ines_).response.status, 200) << "staff stays where it is";
  EXPECT_EQ(ask("POST", "/", anna).response.status, 405);
}

TEST_F(DeskRefusal, ANoteStaysInItsField) {
  const std::string too_long(4001, 'x');
  const std::string on_attempt =
      refused("/attempt/" + annas_ + "/note", "text=%20%20" + too_long, "no more than 4000 characters");
  EXPECT_NE(on_attempt.find(too_long + "</textarea>"), std::string::npos);
  EXPECT_NE(on_attempt.find("aria-describedby=\"why-note\""), std::string::npos);
  EXPECT_NE(on_attempt.find("id=\"why-note\""), std::string::npos);
  EXPECT_NE(refused("/trainee/T-anna/note", "text=" + too_long, "no more than 4000").find(too_long), std::string::npos);
  EXPECT_TRUE(AssessmentStore(database_).notes_of("T-anna").empty());
  EXPECT_EQ(ask("GET", "/attempt/" + annas_ + "/note", ines_).response.location, "/attempt/" + annas_ + "#notes")
      << "loading the page again works";
}

TEST_F(DeskRefusal, ADecisionASignatureAndAWithdrawalStayInTheirs) {
  const std::string decision = refused("/attempt/" + annas_ + "/override", "passed=yes&reason=no",
                                       "Reason: say why, in at least 10 characters.");
  EXPECT_NE(decision.find("<details open=\"open\"><summary>Decide otherwise"), std::string::npos)
      << "the field is in sight";
  EXPECT_NE(decision.find(">\nno</textarea>"), std::string::npos);
  EXPECT_NE(decision.find("<option value=\"yes\" selected"), std::string::npos);
  refused("/attempt/" + annas_ + "/override", "reason=long+enough+a+reason", "Decision: say passed or not passed.");
  const std::string signature =
      refused("/attempt/" + annas_ + "/sign", "meaning=admiration&note=well+done", "Signature: its meaning is review");
  EXPECT_NE(signature.find("value=\"well done\""), std::string::npos);
  const Certificate held =
      AssessmentStore(database_).certify("T-anna", "surface-touch", "L1", "1", "{}", {"0192-x", "x"});
  const std::string withdrawal = refused("/certificate/" + held.uuid + "/revoke", "reason=why", "Reason: say why");
  EXPECT_NE(withdrawal.find("<details open=\"open\"><summary>Withdraw"), std::string::npos);
  EXPECT_NE(withdrawal.find("value=\"why\""), std::string::npos);
  refused("/certificate/none/revoke", "reason=why", "There is no such certificate in this record.");
}

TEST_F(DeskRefusal, ACertificateSaysWhichConditionFails) {
  const std::string page = refused("/attempt/" + annas_ + "/certify", "", "Not done. No certificate.");
  EXPECT_NE(page.find("Unsafe: 2 of the last 2 attempts were unsafe"), std::string::npos) << page;
  const std::string looked_at = ask("GET", "/attempt/" + annas_, ines_).response.body;
  EXPECT_NE(looked_at.find("<li>Unsafe: 2 of the last 2"), std::string::npos) << "the page says so before anybody asks";
  EXPECT_EQ(looked_at.find("/certify\""), std::string::npos);
}

TEST_F(DeskRefusal, GroupsAndNumbersOfAttemptsToo) {
  const std::string group =
      refused("/curriculum/group", "do=join&trainee=T-anna&group=" + std::string(65, 'g'), "id=\"why-group\"");
  EXPECT_NE(group.find("value=\"" + std::string(65, 'g') + "\""), std::string::npos);
  EXPECT_NE(group.find("<option value=\"T-anna\" selected"), std::string::npos);
  const Answer other = ask("GET", "/compare?attempt=" + annas_ + "&other=ffffffff", ines_);
  EXPECT_EQ(other.response.status, 404);
  EXPECT_NE(other.response.body.find("value=\"ffffffff\""), std::string::npos);
  EXPECT_NE(other.response.body.find("Attempt ffffffff: not in this database."), std::string::npos);
}

TEST_F(DeskRefusal, WhatWasWrittenIsGivenBackWhenTheFormIsTooOldOrTheSignInHasEnded) {
  const std::string form = "text=my+long+%3Cnote%3E&password=secret+word";
  const Answer old = ask("POST", "/attempt/" + annas_ + "/note", {ines_.cookie, "x"}, form);
  EXPECT_EQ(old.response.status, 403);
  EXPECT_NE(old.response.body.find("my long &lt;note&gt;"), std::string::npos);
  EXPECT_EQ(old.response.body.find("secret word"), std::string::npos);
  const Answer person = ask("POST", "/roster/add", {ines_.cookie, "x"}, "code=T-77&name=Ann+Lee&email=a%40b.example");
  EXPECT_EQ(person.response.status, 403);
  EXPECT_NE(person.response.body.find("code: T-77\nemail: a@b.example\nname: Ann Lee"), std::string::npos);
  EXPECT_EQ(person.response.body.find("Send again"), std::string::npos) << "who sent it is not known";
  now_ += std::chrono::hours(1);
  const Answer ended = ask("POST", "/attempt/" + annas_ + "/note", ines_, form);
  EXPECT_EQ(ended.response.status, 401);
  EXPECT_NE(ended.response.body.find("Your sign-in has ended"), std::string::npos);
  EXPECT_NE(ended.response.body.find("my long &lt;note&gt;"), std::string::npos);
  EXPECT_EQ(ended.response.body.find("secret word"), std::string::npos);
}

TEST_F(DeskRefusal, WhatIsMissingIsSaidInASentenceWithoutFolders) {
  const Answer nobody = ask("GET", "/trainee/T-nobody", ines_);
  EXPECT_EQ(nobody.response.status, 404);
  EXPECT_NE(nobody.response.body.find("There is no trainee &quot;T-nobody&quot; in this record."), std::string::npos);
  EXPECT_EQ(nobody.response.body.find(folder_.string()), std::string::npos);
  desk_.sources.trace = [this](const std::filesystem::path&) -> Trace {
    throw InputError((folder_ / "a.trec").string() + ": is cut");
  };
  const std::string page = ask("GET", "/attempt/" + annas_, ines_).response.body;
  EXPECT_NE(page.find("The recording is not in its place any more."), std::string::npos);
  EXPECT_EQ(page.find(folder_.string()), std::string::npos);
}

TEST(Sentence, LeavesOutFoldersOnly) {
  EXPECT_EQ(sentence("/home/x y/trocar.db: disk full"), "X y/trocar.db: disk full.");
  EXPECT_EQ(sentence("/var/lib/trocar.db: disk full"), "trocar.db: disk full.") << "a file keeps its name";
  EXPECT_EQ(sentence("role: trainee. Or not"), "Role: trainee. Or not.");
  EXPECT_EQ(sentence("cannot be read: \"/a/b/c.trec\""), "Cannot be read: \"c.trec\".");
  EXPECT_EQ(sentence("1/2 of a / b, see http://x/y"), "1/2 of a / b, see http://x/y.");
  EXPECT_EQ(sentence("/one"), "/one.");
  EXPECT_EQ(sentence(""), "");
  EXPECT_EQ(sentence("Done!"), "Done!");
}

}  // namespace
}  // namespace trocar::review::desk_refusal_test
