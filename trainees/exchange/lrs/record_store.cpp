#include "trainees/exchange/lrs/record_store.h"

#include <curl/curl.h>

#include <cstdlib>

#include "haptics/input_error.h"
#include "trainees/files/password_file.h"

namespace trocar::lrs {
namespace {

constexpr std::size_t kMostBody = 1 << 20;
constexpr long kConnecting_s = 10, kWhole_s = 60;

std::string part_of(CURLU* url, CURLUPart part) {
  char* text = nullptr;
  if (curl_url_get(url, part, &text, 0) != CURLUE_OK) return "";
  std::string out = text;
  curl_free(text);
  return out;
}

bool this_machine(const std::string& host) {
  return host == "localhost" || host == "[::1]" ||
         (host.starts_with("127.") && host.find_first_not_of("0123456789.") == std::string::npos);
}

/// @returns the address of what statements go to, without a slash at its end.
std::string checked(const LrsAddress& address) {
  const std::unique_ptr<CURLU, void (*)(CURLU*)> url(curl_url(), curl_url_cleanup);
  const std::string& text = address.url;
  const bool read = curl_url_set(url.get(), CURLUPART_URL, text.c_str(), 0) == CURLUE_OK;
  const std::string scheme = read ? part_of(url.get(), CURLUPART_SCHEME) : "";
  if (scheme != "https" && scheme != "http")
    throw InputError("\"" + text + "\": is no address of a record store such as https://lrs.example/xapi");
  if (!part_of(url.get(), CURLUPART_USER).empty() || !part_of(url.get(), CURLUPART_PASSWORD).empty())
    throw InputError("the address holds a password or a user: give --user and --password-file");
  if (!part_of(url.get(), CURLUPART_QUERY).empty() || !part_of(url.get(), CURLUPART_FRAGMENT).empty())
    throw InputError("\"" + text + "\": ends before \"?\" and \"#\"");
  if (scheme == "http" && !this_machine(part_of(url.get(), CURLUPART_HOST)) && !address.plain_http)
    throw InputError(text +
                     ": statements and the password would go over the network for everybody to read: use"
                     " https://, or say --allow-plain-http");
  std::string base = text;
  while (base.ends_with('/')) base.pop_back();
  return base;
}

std::string password_of(const LrsAddress& address) {
  if (!address.password_file.empty()) return read_password_file(address.password_file);
  const char* given = std::getenv("TROCAR_LRS_PASSWORD");
  return given == nullptr ? "" : given;
}

std::size_t keep_body(char* data, std::size_t, std::size_t bytes, void* to) {
  auto& body = *static_cast<std::string*>(to);
  if (body.size() + bytes > kMostBody) return 0;
  body.append(data, bytes);
  return bytes;
}

}  // namespace

struct RecordStore::Session {
  CURL* curl = nullptr;
  std::string base, user, password, authority, version = "1.0.3";

  Answer ask(const char* method, const std::string& path, const std::string* body) {
    curl_easy_reset(curl);
    Answer answer;
    char why[CURL_ERROR_SIZE] = "";
    curl_slist* headers = curl_slist_append(nullptr, ("X-Experience-API-Version: " + version).c_str());
    for (const char* header : {"Content-Type: application/json", "Accept: application/json", "Expect:"})
      headers = curl_slist_append(headers, header);
    curl_easy_setopt(curl, CURLOPT_URL, (base + path).c_str());
    curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(curl, CURLOPT_FOLLOWLOCATION, 0L);  // a password goes to whom it was given for
    curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
    curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, kConnecting_s);
    curl_easy_setopt(curl, CURLOPT_TIMEOUT, kWhole_s);
    curl_easy_setopt(curl, CURLOPT_HTTPHEADER, headers);
    curl_easy_setopt(curl, CURLOPT_USERAGENT, "trocar");
    curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, why);
    curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, keep_body);
    curl_easy_setopt(curl, CURLOPT_WRITEDATA, &answer.body);
    if (!authority.empty()) curl_easy_setopt(curl, CURLOPT_CAINFO, authority.c_str());
    if (body != nullptr) {
      curl_easy_setopt(curl, CURLOPT_CUSTOMREQUEST, method);
      curl_easy_setopt(curl, CURLOPT_POSTFIELDS, body->data());
      curl_easy_setopt(curl, CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body->size()));
      if (!user.empty()) {
        curl_easy_setopt(curl, CURLOPT_HTTPAUTH, CURLAUTH_BASIC);
        curl_easy_setopt(curl, CURLOPT_USERNAME, user.c_str());
        curl_easy_setopt(curl, CURLOPT_PASSWORD, password.c_str());
      }
    }
    const CURLcode code = curl_easy_perform(curl);
    curl_slist_free_all(headers);
    if (code == CURLE_OK) {
      curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &answer.status);
      curl_off_t wait = 0;
      curl_easy_getinfo(curl, CURLINFO_RETRY_AFTER, &wait);
      answer.retry_after_s = static_cast<long>(wait);
      if (answer.status == 200 && answer.body.empty()) answer = {0, "", 0, "its answer ended before it was whole"};
    } else {
      answer.failure = why[0] != '\0' ? why : curl_easy_strerror(code);
      if (code == CURLE_PEER_FAILED_VERIFICATION) answer.status = -1;
    }
    return answer;
  }
};

RecordStore::RecordStore(const LrsAddress& address) : session_(std::make_unique<Session>()) {
  session_->base = checked(address);
  session_->user = address.user;
  session_->password = password_of(address);
  session_->authority = address.authority.string();
  if (!session_->authority.empty() && !std::filesystem::is_regular_file(address.authority))
    throw InputError(session_->authority + ": no such file");
  session_->curl = curl_easy_init();
  if (session_->curl == nullptr) throw EnvironmentError("libcurl cannot be initialised");
}

RecordStore::~RecordStore() { curl_easy_cleanup(session_->curl); }

Answer RecordStore::about() { return session_->ask("GET", "/about", nullptr); }

Answer RecordStore::post(const std::vector<XapiStatement>& statements) {
  std::string body;
  for (const XapiStatement& statement : statements) body += (body.empty() ? "[" : ",") + statement.text;
  body += "]";
  return session_->ask("POST", "/statements", &body);
}

Answer RecordStore::put(const XapiStatement& statement) {
  return session_->ask("PUT", "/statements?statementId=" + statement.id, &statement.text);
}

void RecordStore::speak(const std::string& version) { session_->version = version; }

}  // namespace trocar::lrs
