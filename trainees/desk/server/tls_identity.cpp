#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <fstream>

#include "haptics/input_error.h"
#include "trainees/desk/server/connection.h"

namespace trocar::review {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  char reason[160] = "";
  ERR_error_string_n(ERR_peek_last_error(), reason, sizeof reason);
  ERR_clear_error();
  throw InputError(file.string() + ": " + what + " (" + reason + ")");
}

void must_be_readable(const std::filesystem::path& file) {
  if (!std::ifstream(file).good() || std::filesystem::is_directory(file))
    throw InputError(file.string() + ": cannot be read");
}

/// Whoever has the key can read and write what goes between a browser and the desk.
void must_be_private(const std::filesystem::path& key) {
  using std::filesystem::perms;
  if ((std::filesystem::status(key).permissions() & (perms::group_all | perms::others_all)) != perms::none)
    throw InputError(key.string() + ": other users may open this private key; take their rights away first: chmod 600");
}

}  // namespace

TlsIdentity::TlsIdentity(const std::filesystem::path& certificate, const std::filesystem::path& key)
    : context_(nullptr) {
  must_be_readable(certificate);
  must_be_readable(key);
  must_be_private(key);
  std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(SSL_CTX_new(TLS_server_method()), SSL_CTX_free);
  if (!context) throw EnvironmentError("TLS cannot be set up on this machine");
  SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
  SSL_CTX_set_options(context.get(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_mode(context.get(), SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  if (SSL_CTX_use_certificate_chain_file(context.get(), certificate.c_str()) != 1)
    refuse(certificate, "is no certificate in PEM form");
  if (SSL_CTX_use_PrivateKey_file(context.get(), key.c_str(), SSL_FILETYPE_PEM) != 1)
    refuse(key, "is no private key in PEM form that belongs to the certificate");
  if (SSL_CTX_check_private_key(context.get()) != 1) refuse(key, "does not belong to " + certificate.string());
  context_ = context.release();
}

TlsIdentity::~TlsIdentity() { SSL_CTX_free(static_cast<SSL_CTX*>(context_)); }

std::vector<std::string> TlsIdentity::names() const {
  std::vector<std::string> out;
  const X509* certificate = SSL_CTX_get0_certificate(static_cast<SSL_CTX*>(context_));
  auto* names = certificate
                    ? static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr))
                    : nullptr;
  for (int i = 0; i < sk_GENERAL_NAME_num(names); ++i) {
    const GENERAL_NAME* name = sk_GENERAL_NAME_value(names, i);
    if (name->type != GEN_DNS) continue;
    std::string text(reinterpret_cast<const char*>(ASN1_STRING_get0_data(name->d.dNSName)),
                     static_cast<std::size_t>(ASN1_STRING_length(name->d.dNSName)));
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    out.push_back(text);
  }
  GENERAL_NAMES_free(names);
  return out;
}

}  // namespace trocar::review
