// The desk behind TLS: a certificate made for the test, and a client that accepts no other.
#include "tests/trainees/review/live_desk.h"

#include <gtest/gtest.h>
#include <httplib.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <cstdio>
#include <fstream>

#include "trainees/review/connection.h"

namespace trocar::review {
namespace {

namespace fs = std::filesystem;

/// A key and a certificate for "localhost" that signs itself, as PEM files.
void make_identity(const fs::path& certificate, const fs::path& key) {
  EVP_PKEY* pair = EVP_EC_gen("P-256");
  X509* made = X509_new();
  X509_set_version(made, 2);
  ASN1_INTEGER_set(X509_get_serialNumber(made), 1);
  X509_gmtime_adj(X509_getm_notBefore(made), -3600);
  X509_gmtime_adj(X509_getm_notAfter(made), 3600);
  X509_set_pubkey(made, pair);
  X509_NAME* name = X509_get_subject_name(made);
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>("localhost"), -1, -1, 0);
  X509_set_issuer_name(made, name);
  X509_EXTENSION* names = X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, "DNS:localhost,DNS:Desk.Clinic.Example");
  X509_add_ext(made, names, -1);
  X509_sign(made, pair, EVP_sha256());
  std::FILE* file = std::fopen(certificate.c_str(), "w");
  PEM_write_X509(file, made);
  std::fclose(file);
  file = std::fopen(key.c_str(), "w");
  PEM_write_PrivateKey(file, pair, nullptr, nullptr, 0, nullptr, nullptr);
  std::fclose(file);
  X509_EXTENSION_free(names);
  X509_free(made);
  EVP_PKEY_free(pair);
}

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
  std::ofstream(folder_ / "empty.pem");
  EXPECT_NE(message(folder_ / "empty.pem", key_), "");
}

}  // namespace
}  // namespace trocar::review
