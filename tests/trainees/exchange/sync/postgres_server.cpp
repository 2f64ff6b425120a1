#include "tests/trainees/exchange/sync/postgres_server.h"

#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <pqxx/pqxx>
#include <thread>

namespace trocar::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPassword = "a pass%word'&?";  // what an address has to escape

fs::path newest_programs() {
  fs::path found;
  std::error_code none;
  for (const auto& version : fs::directory_iterator("/usr/lib/postgresql", none)) {
    if (fs::exists(version.path() / "bin" / "initdb") && version.path() > found) found = version.path();
  }
  return found.empty() ? found : found / "bin";
}

}  // namespace

PostgresServer& PostgresServer::instance() {
  static PostgresServer server;
  return server;
}

bool PostgresServer::as_server(const std::string& command) const {
  return as_its_user(programs_.string() + "/" + command);
}

bool PostgresServer::as_its_user(const std::string& command) const {
  const std::string log = (folder_ / "commands.log").string();
  const std::string whole = "cd / && " + (user_.empty() ? "" : "runuser -u " + user_ + " -- ") + command;
  return std::system(("(" + whole + ") >>" + log + " 2>&1 </dev/null").c_str()) == 0;
}

PostgresServer::PostgresServer() : programs_(newest_programs()) {
  if (programs_.empty()) {
    reason_ =
        "PostgreSQL is not installed (no /usr/lib/postgresql/*/bin/initdb): NOTHING OF THE CENTRAL DATABASE WAS TESTED";
    return;
  }
  folder_ = fs::temp_directory_path() / ("trocar_pg_" + std::to_string(getpid()));
  fs::create_directories(folder_);
  password_file_ = folder_ / "password";
  std::ofstream(password_file_) << kPassword << '\n';
  std::ofstream(folder_ / "first") << kPassword << '\n';
  chmod(password_file_.c_str(), 0600);
  if (geteuid() == 0) {  // the server refuses to be root
    for (const char* name : {"nobody", "postgres"}) {
      if (const passwd* user = getpwnam(name))
        user_ = chown(folder_.c_str(), user->pw_uid, user->pw_gid) == 0 ? name : user_;
    }
    if (user_.empty()) reason_ = "running as root, and there is no other user for the server";
  }
  const std::string data = (folder_ / "data").string(), at = folder_.string();
  if (reason_.empty() && !as_server("initdb -D " + data + " -U trocar -A scram-sha-256 --pwfile=" + at +
                                    "/first --no-sync -E UTF8 --locale=C")) {
    reason_ = "initdb failed: " + (folder_ / "commands.log").string();
  }
  const int number = static_cast<int>(getpid());
  listens_ = "127." + std::to_string(number >> 14 & 255) + "." + std::to_string(1 + (number >> 7 & 127)) + "." +
             std::to_string(1 + (number & 127));
  if (reason_.empty())
    std::ofstream(folder_ / "data" / "pg_hba.conf", std::ios::app) << "host all all 127.0.0.0/8 scram-sha-256\n";
  if (reason_.empty() && !as_server("pg_ctl -D " + data + " -l " + at + "/server.log -w -t 60 -o \"-k " + at +
                                    " -c listen_addresses=" + listens_ +
                                    " -c fsync=off -c synchronous_commit=off -c full_page_writes=off -c "
                                    "autovacuum=off -c shared_buffers=16MB -c max_connections=20\" start")) {
    reason_ = "the server did not start: " + (folder_ / "server.log").string();
  }
}

PostgresServer::~PostgresServer() {
  if (folder_.empty()) return;
  as_server("pg_ctl -D " + (folder_ / "data").string() + " -m immediate -w stop");
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

CentralAddress PostgresServer::address_of(const std::string& name) const {
  return {"postgresql:///" + name + "?host=" + folder_.string() + "&user=trocar", password_file_};
}

std::string PostgresServer::connection_to(const std::string& name) const {
  return "host=" + folder_.string() + " user=trocar dbname=" + name + " password='a pass%word\\'&?'";
}

std::string PostgresServer::connection_to(const CentralAddress& address) const {
  const std::size_t start = std::string("postgresql:///").size();
  return connection_to(address.url.substr(start, address.url.find('?') - start));
}

CentralAddress PostgresServer::owner_of(const CentralAddress& address) const {
  const std::size_t start = std::string("postgresql:///").size();
  return address_of(address.url.substr(start, address.url.find('?') - start));
}

CentralAddress PostgresServer::as(const CentralAddress& address, const std::string& login,
                                  const fs::path& password_file) const {
  const std::string owner = owner_of(address).url;
  return {owner.substr(0, owner.rfind("user=")) + "user=" + login, password_file};
}

std::filesystem::path PostgresServer::speak_tls() {
  const std::string at = folder_.string() + "/", curve = " -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 1 ";
  EXPECT_TRUE(
      as_its_user("openssl req -x509" + curve + "-subj /CN=authority -keyout " + at + "ca.key -out " + at + "ca.crt"));
  EXPECT_TRUE(as_its_user("openssl req -x509" + curve +
                          "-subj /CN=central.test -addext subjectAltName=DNS:central.test"
                          " -CA " +
                          at + "ca.crt -CAkey " + at + "ca.key -keyout " + at + "tls.key -out " + at + "tls.crt"));
  set("ALTER SYSTEM SET ssl_cert_file = '" + at + "tls.crt'; ALTER SYSTEM SET ssl_key_file = '" + at + "tls.key'",
      "on");
  return at + "ca.crt";
}

void PostgresServer::speak_no_tls() { set("SELECT 1", "off"); }

void PostgresServer::set(const std::string& settings, const std::string& tls) const {
  {
    pqxx::connection connection(connection_to("postgres"));
    pqxx::nontransaction transaction(connection);
    for (std::size_t from = 0; from < settings.size(); from = settings.find(';', from + 1))
      transaction.exec(settings.substr(from + (from > 0), settings.find(';', from + 1) - from));
    transaction.exec("ALTER SYSTEM SET ssl = " + tls);
    transaction.exec("SELECT pg_reload_conf()");
  }
  for (int i = 0; i < 200; ++i) {  // the server takes it up when it comes to it
    pqxx::connection connection(connection_to("postgres"));
    if (pqxx::nontransaction(connection).exec("SHOW ssl")[0][0].c_str() == tls) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  ADD_FAILURE() << "the server does not take ssl = " << tls;
}

CentralAddress PostgresServer::over_network(const CentralAddress& address, const std::string& host,
                                            const std::string& more) const {
  const std::string owner = owner_of(address).url;
  const std::size_t start = std::string("postgresql:///").size();
  return {"postgresql://trocar@" + host + "/" + owner.substr(start, owner.find('?') - start) + "?hostaddr=" + listens_ +
              more,
          password_file_};
}

CentralAddress PostgresServer::make_database(const std::string& name) {
  pqxx::connection connection(connection_to("postgres"));
  pqxx::nontransaction(connection).exec("CREATE DATABASE " + name);
  return address_of(name);
}

CentralAddress PostgresServer::copy_database(const CentralAddress& of, const std::string& name) {
  const std::size_t start = std::string("postgresql:///").size();
  pqxx::connection connection(connection_to("postgres"));
  pqxx::nontransaction(connection)
      .exec("CREATE DATABASE " + name + " TEMPLATE " + of.url.substr(start, of.url.find('?') - start));
  return address_of(name);
}

void PostgresServer::while_locked(const CentralAddress& address, const std::function<void()>& meanwhile) const {
  pqxx::connection connection(connection_to(address));
  pqxx::work transaction(connection);
  transaction.exec("SELECT pg_advisory_xact_lock(1414677330)");
  meanwhile();
}

std::vector<std::string> PostgresServer::ask(const CentralAddress& address, const std::string& sql) const {
  pqxx::connection connection(connection_to(address));
  pqxx::nontransaction transaction(connection);
  transaction.exec("SET search_path TO trocar");
  std::vector<std::string> lines;
  for (const auto& row : transaction.exec(sql)) {
    std::string line;
    for (const auto& field : row) line += (line.empty() ? "" : "|") + std::string(field.is_null() ? "" : field.c_str());
    lines.push_back(line);
  }
  return lines;
}

}  // namespace trocar::test
