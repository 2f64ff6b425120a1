// What binds somebody asks for the password again; everyone sets their own; wrong ones count towards the same wait.
#include "tests/trainees/desk/server/desk_samples.h"
#include "trainees/records/assessments.h"

namespace trocar::review::desk_signing_test {
namespace {

const std::string kGood = "&password=correct+horse+battery";

class DeskSigning : public DeskTest {
 protected:
  DeskSigning() {
    add_accounts();
    make_gate({}, desk_routes());
  }
  Answer post(const Visitor& visitor, const std::string& path, const std::string& body) {
    return ask("POST", path, visitor, body);
  }
  std::size_t signatures() { return AssessmentStore(database_).signatures_of(annas_).size(); }
  std::string sign_path() const { return "/attempt/" + annas_ + "/sign"; }
};

TEST_F(DeskSigning, EveryFormThatBindsIsRefusedWithoutThePasswordAndKeepsWhatWasTyped) {
  const Visitor ines = signed_in("ines");
  for (const char* wrong : {"", "&password=", "&password=wrong+wrong+wrong"}) {
    const Answer sign = post(ines, sign_path(), std::string("meaning=review&note=Seen+it+all") + wrong);
    EXPECT_EQ(sign.response.status, 400) << wrong;
    EXPECT_NE(sign.response.body.find("Seen it all"), std::string::npos);
    EXPECT_EQ(sign.response.body.find("wrong wrong"), std::string::npos) << "a password never comes back";
  }
  EXPECT_EQ(post(ines, "/attempt/" + annas_ + "/override", "passed=no&reason=The+stand+slipped+twice").response.status,
            400);
  EXPECT_EQ(post(ines, "/attempt/" + annas_ + "/certify", "").response.status, 400);
  EXPECT_EQ(signatures(), 0U);
  EXPECT_TRUE(AssessmentStore(database_).overrides_of(annas_).empty());
  EXPECT_EQ(post(ines, sign_path(), "meaning=review&note=" + kGood).response.status, 303);
  EXPECT_EQ(post(ines, "/attempt/" + annas_ + "/override", "passed=no&reason=The+stand+slipped+twice" + kGood)
                .response.status,
            303);
  EXPECT_EQ(signatures(), 1U);
}

TEST_F(DeskSigning, EveryRouteThatBindsAsksForIt) {
  for (const Route& route : desk_routes()) {
    const bool binds = route.method == "POST" && (route.path.ends_with("/sign") || route.path.ends_with("/override") ||
                                                  route.path.ends_with("/certify") || route.path.ends_with("/revoke") ||
                                                  route.path == "/password");
    EXPECT_EQ(route.asks_password, binds) << route.method << " " << route.path;
  }
}

TEST_F(DeskSigning, WrongOnesMakeTheSessionWaitAndNobodyElse) {
  const Visitor ines = signed_in("ines"), elsewhere = signed_in("ines");
  for (int i = 0; i < 5; ++i) post(ines, sign_path(), "meaning=review&password=wrong+wrong");
  const Answer late = post(ines, sign_path(), "meaning=review" + kGood);
  EXPECT_EQ(late.response.status, 400);
  EXPECT_NE(late.response.body.find("Too many wrong tries. Wait 30 s"), std::string::npos);
  EXPECT_EQ(post(ines, sign_path(), "meaning=review&password=580279").response.status, 400) << "nor a PIN";
  EXPECT_EQ(signatures(), 0U);
  EXPECT_EQ(post(elsewhere, sign_path(), "meaning=approval" + kGood).response.status, 303);
  EXPECT_EQ(try_sign_in("ines", kPassword, stranger()).response.status, 303);
  now_ += std::chrono::seconds(31);
  EXPECT_EQ(post(ines, sign_path(), "meaning=review" + kGood).response.status, 303);
}

TEST_F(DeskSigning, WrongSignInsOfOthersStopNobodyWhoIsSignedIn) {
  const Visitor ines = signed_in("ines");
  for (const auto& [from, meaning] : {std::pair("10.0.0.50", "review"), std::pair("10.0.0.7", "approval")}) {
    address_ = from;
    for (int i = 0; i < 9; ++i) try_sign_in("ines", "wrong wrong", stranger());
    EXPECT_EQ(try_sign_in("ines", kPassword, stranger()).response.status, 429);
    EXPECT_EQ(post(ines, sign_path(), std::string("meaning=") + meaning + kGood).response.status, 303) << from;
  }
  EXPECT_EQ(signatures(), 2U);
}

TEST_F(DeskSigning, GuessesAtPinsKeepNobodyWithAPasswordOut) {
  for (int i = 0; i < 9; ++i) try_sign_in("ines", "58027" + std::to_string(i), stranger());
  EXPECT_EQ(try_sign_in("ines", "580279", stranger()).response.status, 429);
  EXPECT_EQ(try_sign_in("ines", kPassword, stranger()).response.status, 303);
  for (int i = 0; i < 5; ++i) try_sign_in("anna", "wrong wrong", stranger());
  EXPECT_EQ(try_sign_in("anna", "wrong wrong", stranger()).response.status, 429);
  EXPECT_EQ(try_sign_in("otto", "580279", stranger()).response.status, 429) << "PINs from this address still wait";
}

TEST_F(DeskSigning, EveryoneSetsTheirOwnPassword) {
  for (const char* login : {"anna", "ines", "adam"}) {
    const Visitor visitor = signed_in(login), elsewhere = signed_in(login);
    EXPECT_EQ(ask("GET", "/password", visitor).response.status, 200);
    EXPECT_EQ(post(visitor, "/password", "fresh=my+very+own+one&again=my+very+own+one").response.status, 400);
    EXPECT_EQ(post(visitor, "/password", "fresh=my+very+own+one&again=another+one" + kGood).response.status, 400);
    EXPECT_EQ(post(visitor, "/password", "fresh=1234567890&again=1234567890" + kGood).response.status, 400);
    EXPECT_EQ(
        post(visitor, "/password", "fresh=correct+horse+battery&again=correct+horse+battery" + kGood).response.status,
        400);
    const Answer set = post(visitor, "/password", "fresh=my+very+own+one&again=my+very+own+one" + kGood);
    EXPECT_EQ(set.response.status, 303) << login;
    EXPECT_EQ(ask("GET", "/password", {cookie_of(set), ""}).response.status, 200) << "who set it stays signed in";
    EXPECT_EQ(ask("GET", "/password", elsewhere).response.status, 401) << "others do not";
    EXPECT_TRUE(AccountStore(database_).verify(login, "my very own one"));
  }
}

TEST_F(DeskSigning, OfAPasswordThatAnAdministratorGaveNeedsAnOwnOneFirst) {
  const Visitor adam = signed_in("adam");
  ASSERT_EQ(post(adam, "/accounts/ines/password", "password=given+by+adam").response.status, 303);
  const Visitor ines = signed_in("ines", "given by adam");
  const std::string page = ask("GET", "/attempt/" + annas_, ines).response.body;
  EXPECT_NE(page.find("Set your own password"), std::string::npos);
  EXPECT_EQ(page.find("/sign\""), std::string::npos);
  EXPECT_EQ(post(ines, sign_path(), "meaning=review&password=given+by+adam").response.status, 400);
  EXPECT_EQ(signatures(), 0U);
  const Answer set = post(ines, "/password", "fresh=my+very+own+one&again=my+very+own+one&password=given+by+adam");
  ASSERT_EQ(set.response.status, 303);
  EXPECT_EQ(post(signed_in("ines", "my very own one"), sign_path(), "meaning=review&password=my+very+own+one")
                .response.status,
            303);
}

}  // namespace
}  // namespace trocar::review::desk_signing_test
