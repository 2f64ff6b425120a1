#include "trainees/exchange/sync/central_address.h"

#include <libpq-fe.h>

#include <array>
#include <cstdlib>
#include <map>
#include <memory>
#include <sstream>

#include "haptics/input_error.h"
#include "trainees/files/password_file.h"

namespace trocar::sync {
namespace {

constexpr const char* kStrong = "verify-full";

/// The options that the address gives, as libpq reads them.
std::map<std::string, std::string> options_of(const std::string& url) {
  char* why = nullptr;
  const std::unique_ptr<PQconninfoOption, void (*)(PQconninfoOption*)> parsed(PQconninfoParse(url.c_str(), &why),
                                                                              PQconninfoFree);
  const std::unique_ptr<char, void (*)(void*)> words(why, PQfreemem);
  if (!parsed) throw InputError("the address is none that PostgreSQL reads: " + std::string(words ? words.get() : ""));
  std::map<std::string, std::string> given;
  for (const PQconninfoOption* option = parsed.get(); option->keyword != nullptr; ++option) {
    if (option->val != nullptr) given[option->keyword] = option->val;
  }
  return given;
}

bool on_this_machine(const std::string& host) {
  return host.empty() || host.front() == '/' || host.front() == '@' || host == "localhost" || host == "::1" ||
         (host.starts_with("127.") && host.find_first_not_of("0123456789.") == std::string::npos);
}

std::string of_environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// Several hosts stand with commas between them; what a service file says is not known here.
bool leaves_this_machine(const std::map<std::string, std::string>& given) {
  if (given.contains("service") || !of_environment("PGSERVICE").empty()) return true;
  const auto value = [&](const char* key, const char* environment) {
    const auto found = given.find(key);
    return found == given.end() ? of_environment(environment) : found->second;
  };
  // hostaddr says where to go, and host then only whom to expect there.
  std::istringstream hosts(value("host", "PGHOST") + "," + value("hostaddr", "PGHOSTADDR"));
  for (std::string host; std::getline(hosts, host, ',');) {
    if (!on_this_machine(host)) return true;
  }
  return false;
}

/// A mode that checks less than who answers, beyond this machine; "" when there is none.
std::string weaker_mode(const std::map<std::string, std::string>& given) {
  const auto mode = given.find("sslmode");
  return mode == given.end() || mode->second == kStrong || !leaves_this_machine(given) ? "" : mode->second;
}

std::string percent(const std::string& text) {
  static constexpr char kHex[] = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    out += '%';
    out += kHex[byte >> 4];
    out += kHex[byte & 15];
  }
  return out;
}

}  // namespace

std::string connection_text(const CentralAddress& address) {
  std::string url = address.url;
  if (!url.starts_with("postgresql://") && !url.starts_with("postgres://")) {
    throw InputError("\"" + url +
                     "\": an address begins with postgresql://, as postgresql://trocar@central.example/trocar");
  }
  const std::map<std::string, std::string> given = options_of(url);
  if (given.contains("password")) {
    throw InputError(
        "the address holds a password, which every process of this machine could read: use --password-file, ~/.pgpass "
        "or PGPASSWORD");
  }
  if (const std::string weak = weaker_mode(given); !weak.empty() && !address.weak_tls) {
    throw InputError("sslmode=" + weak +
                     " does not check that the central database is who it says it is: leave it out (verify-full), or "
                     "say --allow-weak-tls");
  }
  const auto add = [&](const std::string& name, const std::string& value) {
    if (given.contains(name)) return;
    url += (url.find('?') == std::string::npos ? "?" : "&") + name + "=" + value;
  };
  if (!address.password_file.empty()) add("password", percent(read_password_file(address.password_file)));
  if (leaves_this_machine(given)) {
    add("sslmode", kStrong);
    add("gssencmode", "disable");  // encryption by Kerberos would pass by the certificate
  }
  add("connect_timeout", "10");
  add("keepalives_idle", "20");
  add("tcp_user_timeout", "30000");
  add("application_name", "trocar");
  return url;
}

std::string weak_tls_remark(const CentralAddress& address) {
  const std::string weak = weaker_mode(options_of(address.url));
  return weak.empty() ? ""
                      : "sslmode=" + weak +
                            ": nobody checks that it is the central database that answers; whoever is in between can "
                            "read and change what goes";
}

std::string connecting_words(const std::string& libpq) {
  struct Meaning {
    const char *part, *words;
  };
  static constexpr std::array<Meaning, 5> kMeanings{{
      {"could not read root certificate file",
       "the root certificate that is to check the central database by cannot be read"},
      {"root certificate file",
       "no root certificate to check the central database by: put the certificate of who signed its own into"
       " ~/.postgresql/root.crt, or name the file: ?sslrootcert=FILE"},
      {"certificate verify failed",
       "its certificate is not signed by the root certificate here (~/.postgresql/root.crt, or sslrootcert of the"
       " address), or has run out: another authority, or somebody else answers"},
      {"does not match host name",
       "its certificate is for another name: use the name that stands in it, or somebody else answers"},
      {"does not support SSL",
       "it speaks no TLS: switch it on there (ssl = on, a certificate), for nobody can tell who answers otherwise"},
  }};
  for (const Meaning& meaning : kMeanings) {
    // libpq's own advice on a missing root certificate is to check nothing.
    if (libpq.find(meaning.part) != std::string::npos)
      return std::string(meaning.words) + " (" + libpq.substr(0, libpq.find(" Either provide")) + ")";
  }
  return libpq;
}

std::string encrypted_password(const CentralAddress& address, const std::string& role, const std::string& password) {
  const std::unique_ptr<PGconn, void (*)(PGconn*)> connection(PQconnectdb(connection_text(address).c_str()), PQfinish);
  const std::unique_ptr<char, void (*)(void*)> made(
      PQencryptPasswordConn(connection.get(), password.c_str(), role.c_str(), "scram-sha-256"), PQfreemem);
  if (!made)
    throw EnvironmentError(std::string("central database: no password can be made: ") +
                           PQerrorMessage(connection.get()));
  return made.get();
}

}  // namespace trocar::sync
