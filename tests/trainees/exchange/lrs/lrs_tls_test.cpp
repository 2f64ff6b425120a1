// A store that speaks TLS with a certificate of its own making is who it says it is for whoever names that certificate,
// and for nobody else.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <thread>

#include "tests/trainees/records/store_samples.h"
#include "trainees/exchange/lrs/lrs_delivery.h"

namespace trocar::lrs_tls_test {
namespace {

sockaddr_in at_port(int port) {
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = htons(static_cast<std::uint16_t>(port));
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return here;
}

int free_port() {
  const int probe = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in here = at_port(0);
  socklen_t size = sizeof here;
  bind(probe, reinterpret_cast<sockaddr*>(&here), size);
  getsockname(probe, reinterpret_cast<sockaddr*>(&here), &size);
  close(probe);
  return ntohs(here.sin_port);
}

bool answers(int port) {
  const int line = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in here = at_port(port);
  const bool there = connect(line, reinterpret_cast<sockaddr*>(&here), sizeof here) == 0;
  close(line);
  return there;
}

class LrsTls : public TemporaryFolder {
 protected:
  /// A server that shows a page to everybody, with a certificate for that name.
  void serve(const std::string& name) {
    const std::string key = (folder_ / "key.pem").string();
    certificate_ = folder_ / "certificate.pem";
    ASSERT_EQ(
        std::system(("openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 1 -subj /CN=store"
                     " -addext subjectAltName=" +
                     name + " -keyout " + key + " -out " + certificate_.string() + " 2>/dev/null")
                        .c_str()),
        0);
    port_ = free_port();
    server_ = fork();
    if (server_ == 0) {
      execlp("openssl", "openssl", "s_server", "-accept", ("127.0.0.1:" + std::to_string(port_)).c_str(), "-key",
             key.c_str(), "-cert", certificate_.c_str(), "-www", "-quiet", nullptr);
      _exit(127);
    }
    for (int i = 0; i < 200 && !answers(port_); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(25));
  }
  void TearDown() override {
    if (server_ <= 0) return;
    kill(server_, SIGKILL);
    waitpid(server_, nullptr, 0);
  }
  template <class Error>
  std::string refusal(const std::filesystem::path& authority) {
    Database database(folder_ / "t.db");
    store_attempt(database, sample_start("A"), sample_result());
    DeliveryOptions options;
    options.lrs.url = "https://127.0.0.1:" + std::to_string(port_) + "/xapi";
    options.lrs.authority = authority;
    return message_of<Error>([&] { deliver_to_lrs(database, choose_attempts(database, {}), {}, options); });
  }
  std::filesystem::path certificate_;
  int port_ = 0;
  pid_t server_ = -1;
};

TEST_F(LrsTls, IsCheckedAgainstTheAuthorityThatIsNamed) {
  serve("IP:127.0.0.1");
  EXPECT_NE(refusal<EnvironmentError>("").find("its certificate does not hold"), std::string::npos);
  const std::string let_in = refusal<InputError>(certificate_);
  EXPECT_NE(let_in.find("no record store answers there"), std::string::npos) << let_in;
}

TEST_F(LrsTls, AndAgainstTheName) {
  serve("DNS:another.example");
  EXPECT_NE(refusal<EnvironmentError>(certificate_).find("its certificate does not hold"), std::string::npos);
}

}  // namespace
}  // namespace trocar::lrs_tls_test
