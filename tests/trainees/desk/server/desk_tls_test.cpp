// The desk behind TLS: a certificate made for the test, and a client that accepts no other.
#include "tests/trainees/desk/server/live_desk.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <fstream>

#include "tests/trainees/desk/server/tls_sample.h"
#include "trainees/desk/server/connection.h"

namespace trocar::review::desk_tls_test {
namespace {

namespace fs = std::filesystem;

class DeskTls : public LiveDesk {
 protected:
  DeskTls() { make_identity(certificate_, key_); }
  void serve_tls() {
    DeskServerOptions given = options();
    given.certificate = certificate_;
    given.key = key_;
    given.limits.head_ms = 1000;
    serve(std::move(given));
  }
  fs::path certificate_ = folder_ / "cert.pem", key_ = folder_ / "key.pem";
};

TEST_F(DeskTls, SpeaksToWhoKnowsItsCertificate) {
  add_accounts();
  serve_tls();
  httplib::SSLClient client("localhost", port());
  client.set_ca_cert_path(certificate_.c_str());
  client.enable_server_certificate_verification(true);
  const auto page = client.Get("/sign-in");
  ASSERT_TRUE(page) << httplib::to_string(page.error());
  EXPECT_EQ(page->status, 200);
  const std::string cookie = page->get_header_value("Set-Cookie");
  EXPECT_TRUE(cookie.starts_with("__Host-trocar_desk_" + std::to_string(port()) + "=")) << cookie;
  EXPECT_NE(cookie.find("; Secure"), std::string::npos);
  const httplib::Headers visitor{{"Cookie", cookie.substr(0, cookie.find(';'))}};
  const httplib::Params form{{"login", "ines"}, {"password", kPassword}, {"token", field_of(page->body, "token")}};
  const auto in = client.Post("/sign-in", visitor, form);
  ASSERT_TRUE(in);
  EXPECT_EQ(in->status, 303);
  EXPECT_TRUE(server_->addresses()[0].starts_with("https://"));
}

TEST_F(DeskTls, TellsAPlainVisitorNothing) {
  serve_tls();
  const std::string raw = raw_answer(port(), raw_get(port(), "/everybody"));
  EXPECT_EQ(raw.find("page for"), std::string::npos);
  EXPECT_EQ(status_of(raw), 0);
  SlowVisitor silent(port());  // a handshake that never comes ends too
  EXPECT_EQ(silent.rest(), "");
}

TEST_F(DeskTls, RefusesOldProtocols) {
  serve_tls();
  httplib::SSLClient client("localhost", port());
  client.enable_server_certificate_verification(false);
  SSL_CTX_set_max_proto_version(client.ssl_context(), TLS1_1_VERSION);
  EXPECT_FALSE(client.Get("/everybody"));
}

TEST_F(DeskTls, SaysWhatIsWrongWithItsFiles) {
  const auto message = [](const fs::path& certificate, const fs::path& key) {
    return message_of<InputError>([&] { TlsIdentity(certificate, key); });
  };
  EXPECT_EQ(message(certificate_, key_), "");
  EXPECT_EQ(TlsIdentity(certificate_, key_).names(), (std::vector<std::string>{"localhost", "desk.clinic.example"}));
  EXPECT_NE(message(folder_ / "none.pem", key_).find("none.pem: cannot be read"), std::string::npos);
  EXPECT_NE(message(certificate_, folder_), "");
  EXPECT_NE(message(key_, key_).find("no certificate"), std::string::npos);
  const fs::path other = folder_ / "other.pem", other_key = folder_ / "other_key.pem";
  make_identity(other, other_key);
  EXPECT_NE(message(certificate_, other_key).find("other_key.pem"), std::string::npos);
  for (const int rights : {0640, 0604, 0620}) {
    fs::permissions(key_, fs::perms(rights));
    EXPECT_NE(message(certificate_, key_).find("other users may open this private key"), std::string::npos) << rights;
  }
  fs::permissions(key_, fs::perms(0400));
  EXPECT_EQ(message(certificate_, key_), "");
  std::ofstream(folder_ / "empty.pem");
  EXPECT_NE(message(folder_ / "empty.pem", key_), "");
}

}  // namespace
}  // namespace trocar::review::desk_tls_test
