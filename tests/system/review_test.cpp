// The desk as a program: begins, answers, ends on SIGTERM; what it refuses; accounts from the command line.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/system/system_fixture.h"

namespace trocar::test::review_test {
namespace {

/// All that comes back to bytes sent to a loopback port.
std::string answer_of(int port, const std::string& bytes) {
  const int client = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in server{};
  server.sin_family = AF_INET;
  server.sin_port = htons(static_cast<std::uint16_t>(port));
  server.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string out;
  if (::connect(client, reinterpret_cast<sockaddr*>(&server), sizeof server) == 0 &&
      ::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL) > 0) {
    char piece[4096];
    for (ssize_t count = 0; (count = ::recv(client, piece, sizeof piece, 0)) > 0;)
      out.append(piece, static_cast<std::size_t>(count));
  }
  ::close(client);
  return out;
}

class Review : public SystemTest {
 protected:
  Launch with_input(Translator arguments, const std::string& input) const {
    folder_.write("input.txt", input);
    Launch out = launch(std::move(arguments));
    out.input = folder_ / "input.txt";
    return out;
  }
  Outcome add_account(const std::string& login, const std::string& role, const std::string& password) const {
    return run_program(
        with_input({"review", "account", "add", login, "--role", role, "--db", "desk.db"}, password + "\n"));
  }
  /// Waits for the address. @return its port, 0 when the program ended instead.
  static int port_of(RunningProgram& desk) {
    while (desk.running()) {
      const std::string out = desk.out_so_far();
      if (const std::size_t at = out.find("http://127.0.0.1:");
          at != std::string::npos && out.find('\n', at) != std::string::npos)
        return std::stoi(out.substr(at + 17));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return 0;
  }
  static std::string get(int port, const std::string& path) {
    return answer_of(port, "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n");
  }
};

TEST_F(Review, ServesUntilItIsAskedToEnd) {
  RunningProgram desk(launch({"review", "serve", "--port", "0", "--db", "desk.db"}));
  const int port = port_of(desk);
  ASSERT_GT(port, 0) << desk.wait().err;
  EXPECT_TRUE(get(port, "/style.css").starts_with("HTTP/1.1 200 OK\r\n"));
  EXPECT_TRUE(get(port, "/../../etc/passwd").starts_with("HTTP/1.1 404"));
  expect_refusal({"review", "serve", "--port", std::to_string(port), "--db", "desk.db"}, 3,
                 "choose another port with --port");
  desk.ask_to_end();
  const Outcome outcome = desk.wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.signal, 0);
  EXPECT_EQ(outcome.out, "http://127.0.0.1:" + std::to_string(port) + "/\n");
  EXPECT_EQ(trocar({"db", "check", "--db", "desk.db"}).exit_code, 0);
}

TEST_F(Review, TheNetworkNeedsAnAccountAndWarnsWithoutCertificate) {
  expect_refusal({"review", "serve", "--lan", "--port", "0", "--db", "desk.db"}, 2,
                 "trocar review account add LOGIN --role administrator");
  EXPECT_EQ(add_account("ines", "instructor", "correct horse battery").exit_code, 0);
  RunningProgram desk(launch({"review", "serve", "--lan", "--port", "0", "--db", "desk.db"}));
  const int port = port_of(desk);
  ASSERT_GT(port, 0) << desk.wait().err;
  EXPECT_TRUE(get(port, "/sign-in").starts_with("HTTP/1.1 200 OK\r\n"));
  desk.ask_to_end();
  const Outcome outcome = desk.wait();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("WARNING: without a certificate"), std::string::npos);
}

TEST_F(Review, KeepsAccounts) {
  const Outcome first = add_account("ines", "instructor", "correct horse battery");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.out, "ines instructor\n");
  EXPECT_EQ(add_account("ines", "instructor", "correct horse battery").exit_code, 2) << "taken";
  EXPECT_EQ(add_account("kim", "instructor", "short").exit_code, 2);
  EXPECT_EQ(add_account("kim", "king", "correct horse battery").exit_code, 2);
  EXPECT_EQ(add_account("T01", "trainee", "580274").exit_code, 2) << "no such trainee";
  EXPECT_EQ(trocar({"trainee", "add", "T01", "--db", "desk.db"}).exit_code, 0);
  EXPECT_EQ(add_account("T01", "trainee", "580274").exit_code, 0);
  EXPECT_EQ(trocar({"review", "account", "disable", "ines", "--db", "desk.db"}).exit_code, 2)
      << "nobody would be left to let people in";
  EXPECT_EQ(add_account("omar", "administrator", "correct horse battery").exit_code, 0);
  EXPECT_EQ(trocar({"review", "account", "disable", "ines", "--db", "desk.db"}).exit_code, 0);
  const Json list = json_of({"review", "account", "list", "--json", "--db", "desk.db"}, 0);
  ASSERT_EQ(list.size(), 3U);
  for (const Json& account : list) {
    EXPECT_EQ(account["disabled_utc"] != "", account["login"] == "ines") << account.dump();
    EXPECT_EQ(account["trainee"] == "T01", account["login"] == "T01") << account.dump();
  }
  EXPECT_EQ(list.dump().find("argon2"), std::string::npos);
  EXPECT_EQ(run_program(with_input({"review", "account", "password", "T01", "--db", "desk.db"}, "135791\n")).exit_code,
            0);
  EXPECT_EQ(
      run_program(with_input({"review", "account", "password", "nobody", "--db", "desk.db"}, "1357913579\n")).exit_code,
      2);
  EXPECT_EQ(run_program(with_input({"review", "account", "password", "T01", "--db", "desk.db"}, "")).exit_code, 2)
      << "no password came in";
  EXPECT_EQ(trocar({"db", "check", "--db", "desk.db"}).exit_code, 0);
}

TEST_F(Review, RefusesWhatItCannotServe) {
  expect_refusal({"review", "serve", "--cert", "none.pem", "--db", "desk.db"}, 2, "give both");
  expect_refusal({"review", "serve", "--cert", "none.pem", "--key", "none.pem", "--db", "desk.db"}, 2,
                 "none.pem: cannot be read");
  EXPECT_EQ(trocar({"review", "serve", "--port", "70000"}).exit_code, 2);
  EXPECT_EQ(trocar({"review"}).exit_code, 2);
}

}  // namespace
}  // namespace trocar::test::review_test
