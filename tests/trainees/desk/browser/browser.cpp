#include "tests/trainees/desk/browser/browser.h"

#include <fcntl.h>
#include <httplib.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace trocar::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::chrono::seconds kLimit{60};  // only a fault takes so long, on two busy cores too
constexpr std::chrono::milliseconds kPause{30};
constexpr int kMostTabs = 600;
constexpr const char* kElement = "element-6066-11e4-a52e-4f735466cecf";  // W3C WebDriver, 12.1

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error(why); }

std::string decoded_base64(const std::string& text) {
  static const std::string kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  unsigned bits = 0;
  int have = 0;
  for (const char c : text) {
    const std::size_t value = kLetters.find(c);
    if (value == std::string::npos) continue;
    bits = bits << 6U | static_cast<unsigned>(value);
    if ((have += 6) < 8) continue;
    have -= 8;
    out += static_cast<char>(bits >> static_cast<unsigned>(have) & 0xFFU);
  }
  return out;
}

std::vector<std::string> code_points(const std::string& text) {
  std::vector<std::string> out;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0U) == 0x80U && !out.empty())
      out.back() += c;
    else
      out.emplace_back(1, c);
  }
  return out;
}

/// Chromium begins slower without these and asks for what no test needs.
Json arguments_of(const BrowserLook& look, const fs::path& folder) {
  Json out = {"--headless=new",
              "--no-sandbox",
              "--disable-dev-shm-usage",
              "--disable-gpu",
              "--no-first-run",
              "--disable-extensions",
              "--disable-background-networking",
              "--disable-component-update",
              "--disable-sync",
              "--disable-breakpad",
              "--mute-audio",
              "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1 , EXCLUDE localhost"};
  out.push_back("--user-data-dir=" + (folder / "profile").string());
  if (!look.phone) out.push_back("--window-size=" + std::to_string(look.width) + "," + std::to_string(look.height));
  return out;
}

Json capabilities(const BrowserLook& look, const fs::path& folder, const fs::path& downloads) {
  Json preferences = {{"download.default_directory", downloads.string()}, {"download.prompt_for_download", false}};
  if (!look.script) preferences["profile.managed_default_content_settings.javascript"] = 2;
  Json chrome = {{"args", arguments_of(look, folder)}, {"prefs", preferences}};
  if (look.phone)
    chrome["mobileEmulation"] = {
        {"deviceMetrics", {{"width", look.width}, {"height", look.height}, {"pixelRatio", 2.0}, {"touch", false}}}};
  return {{"capabilities",
           {{"alwaysMatch",
             {{"browserName", "chrome"},
              {"acceptInsecureCerts", look.any_certificate},
              {"goog:chromeOptions", chrome},
              {"goog:loggingPrefs", {{"browser", "ALL"}, {"performance", "ALL"}}}}}}}};
}

}  // namespace

/// The chromedriver process; all that it began ends with it.
struct Browser::Driver {
  pid_t process = -1;
  std::unique_ptr<httplib::Client> client;

  explicit Driver(const fs::path& folder) {
    // Now and then it ends at once, for want of a port as it seems: then it is begun again.
    std::string said;
    int port = 0;
    for (int attempt = 0; port == 0 && attempt < 5; ++attempt) {
      end();
      said.clear();
      port = begin(folder, said);
    }
    if (port == 0) {
      end();
      fail(
          "no browser: chromedriver did not begin. Install Debian's chromium and chromium-driver "
          "(cmake/debian-packages.txt; ./check does it). It said: " +
          said);
    }
    client = std::make_unique<httplib::Client>("127.0.0.1", port);
    client->set_read_timeout(kLimit);
    client->set_keep_alive(true);
    client->set_tcp_nodelay(true);
  }
  ~Driver() { end(); }

  /// Begins the process; its port, or 0 where it ended before it had one, with all that it `said`.
  int begin(const fs::path& folder, std::string& said) {
    int ends[2];
    if (::pipe(ends) != 0) fail("no pipe");
    process = ::fork();
    if (process == 0) {
      ::setpgid(0, 0);
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      ::dup2(ends[1], 1);
      ::dup2(ends[1], 2);
      ::close(ends[0]);
      ::setenv("HOME", folder.c_str(), 1);
      ::setenv("TMPDIR", folder.c_str(), 1);
      ::execlp("chromedriver", "chromedriver", "--port=0", static_cast<char*>(nullptr));
      ::_exit(127);
    }
    ::close(ends[1]);
    const int port = port_said(ends[0], said);
    ::close(ends[0]);
    return port;
  }

  /// "ChromeDriver was started successfully on port 40123."
  static int port_said(int from, std::string& said) {
    char piece[512];
    for (ssize_t count = 0; (count = ::read(from, piece, sizeof piece)) > 0;) {
      said.append(piece, static_cast<std::size_t>(count));
      const std::size_t at = said.find("successfully on port ");
      if (at != std::string::npos && said.find('\n', at) != std::string::npos) return std::stoi(said.substr(at + 21));
    }
    return 0;
  }
  void end() {
    if (process <= 0) return;
    ::kill(-process, SIGKILL);
    ::waitpid(process, nullptr, 0);
    process = -1;
  }
};

Browser::Browser(const BrowserLook& look, const fs::path& folder)
    : home_(folder / "browser"), downloads_(folder / "saved") {
  fs::create_directories(downloads_);
  fs::create_directories(home_);
  driver_ = std::make_unique<Driver>(home_);
  const Json made = ask("POST", "/session", capabilities(look, home_, downloads_));
  session_ = made.at("sessionId").get<std::string>();
}

Browser::~Browser() {
  try {
    if (!session_.empty()) session("DELETE", "");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "browser: %s\n", error.what());
  }
  driver_.reset();
  // Its processes end a moment later and write until then.
  std::error_code error;
  for (int left = 100; left > 0 && fs::exists(home_, error); --left) {
    fs::remove_all(home_, error);
    if (error) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

Json Browser::ask(const std::string& method, const std::string& path, const Json& body) {
  const std::string text = body.is_null() ? "{}" : body.dump();
  const auto answer = method == "GET"      ? driver_->client->Get(path)
                      : method == "DELETE" ? driver_->client->Delete(path)
                                           : driver_->client->Post(path, text, "application/json");
  if (!answer) fail("browser does not answer: " + method + " " + path);
  const Json json = Json::parse(answer->body, nullptr, false);
  if (json.is_discarded() || !json.contains("value")) fail("browser: " + answer->body.substr(0, 300));
  const Json& value = json["value"];
  if (value.is_object() && value.contains("error"))
    fail(value["error"].get<std::string>() + ": " + value["message"].get<std::string>().substr(0, 300));
  return value;
}

Json Browser::session(const std::string& method, const std::string& path, const Json& body) {
  return ask(method, "/session/" + session_ + path, body);
}

void Browser::open(const std::string& address) { session("POST", "/url", {{"url", address}}); }
std::string Browser::address() { return session("GET", "/url").get<std::string>(); }

Json Browser::run(const std::string& body, const Json& arguments) {
  return session("POST", "/execute/sync", {{"script", body}, {"args", arguments}});
}

void Browser::until(const std::string& what, const std::function<bool()>& holds) {
  const auto end = std::chrono::steady_clock::now() + kLimit;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) fail("waited in vain for " + what + " at " + address());
    std::this_thread::sleep_for(kPause);
  }
}

bool Browser::has(const std::string& selector) {
  return !session("POST", "/elements", {{"using", "css selector"}, {"value", selector}}).empty();
}

std::string Browser::find(const std::string& selector) {
  Json found;
  until(selector, [&] {
    found = session("POST", "/elements", {{"using", "css selector"}, {"value", selector}});
    return !found.empty();
  });
  return found[0].at(kElement).get<std::string>();
}

std::string Browser::text(const std::string& selector) {
  return session("GET", "/element/" + find(selector) + "/text").get<std::string>();
}

std::string Browser::property(const std::string& selector, const std::string& name) {
  const Json value = session("GET", "/element/" + find(selector) + "/property/" + name);
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void Browser::click(const std::string& selector) {
  session("POST", "/element/" + find(selector) + "/click", Json::object());
}

void Browser::arrives(const std::function<void()>& act) {
  run("document.documentElement.setAttribute('data-left', 'yes')");
  act();
  until("another page", [&] {
    return run("return document.readyState === 'complete' && !document.documentElement.hasAttribute('data-left')")
        .get<bool>();
  });
}

void Browser::follow(const std::string& selector) {
  arrives([&] { click(selector); });
}

void Browser::type(const std::string& selector, const std::string& words) {
  const std::string id = find(selector);
  session("POST", "/element/" + id + "/clear", Json::object());
  session("POST", "/element/" + id + "/value", {{"text", words}});
}

void Browser::press(const std::string& keys) {
  Json actions = Json::array();
  for (const std::string& one : code_points(keys)) {
    actions.push_back({{"type", "keyDown"}, {"value", one}});
    actions.push_back({{"type", "keyUp"}, {"value", one}});
  }
  session("POST", "/actions", {{"actions", {{{"type", "key"}, {"id", "keys"}, {"actions", actions}}}}});
}

void Browser::press(const char* one, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += one;
  press(all);
}

void Browser::tab_to(const std::string& selector) {
  for (int i = 0; i < kMostTabs; ++i) {
    press(key::kTab);
    if (run("return !!document.activeElement && document.activeElement.matches(arguments[0])", {selector}).get<bool>())
      return;
  }
  fail("Tab never comes to " + selector + " at " + address());
}

std::vector<Json> Browser::cookies() { return session("GET", "/cookie").get<std::vector<Json>>(); }

void Browser::as_printed() {
  session("POST", "/goog/cdp/execute", {{"cmd", "Emulation.setEmulatedMedia"}, {"params", {{"media", "print"}}}});
}

void Browser::keep_focused() {
  session("POST", "/goog/cdp/execute",
          {{"cmd", "Emulation.setFocusEmulationEnabled"}, {"params", {{"enabled", true}}}});
}

void Browser::picture(const fs::path& file) {
  const Json size = session("POST", "/goog/cdp/execute",
                            {{"cmd", "Page.getLayoutMetrics"}, {"params", Json::object()}})["cssContentSize"];
  const Json clip = {{"x", 0}, {"y", 0}, {"width", size["width"]}, {"height", size["height"]}, {"scale", 1}};
  const Json made =
      session("POST", "/goog/cdp/execute",
              {{"cmd", "Page.captureScreenshot"}, {"params", {{"captureBeyondViewport", true}, {"clip", clip}}}});
  std::ofstream(file, std::ios::binary) << decoded_base64(made["data"].get<std::string>());
}

std::vector<std::string> Browser::complaints(const std::vector<std::string>& expected) {
  std::vector<std::string> out;
  for (const Json& line : session("POST", "/se/log", {{"type", "browser"}})) {
    if (line.value("level", "") != "SEVERE" && line.value("level", "") != "WARNING") continue;
    const std::string message = line.value("level", "") + " " + line.value("message", "");
    const auto named = [&](const std::string& part) { return message.find(part) != std::string::npos; };
    if (std::none_of(expected.begin(), expected.end(), named)) out.push_back(message);
  }
  return out;
}

std::vector<std::string> Browser::requests_outside(const std::string& beginning) {
  for (const Json& line : session("POST", "/se/log", {{"type", "performance"}})) {
    const Json message = Json::parse(line.value("message", ""), nullptr, false);
    if (!message.is_object() || message["message"].value("method", "") != "Network.requestWillBeSent") continue;
    asked_.push_back(message["message"]["params"]["request"].value("url", ""));
  }
  std::vector<std::string> out;
  for (const std::string& url : asked_)
    if (!url.starts_with(beginning) && !url.starts_with("data:") && !url.starts_with("chrome:")) out.push_back(url);
  if (asked_.empty()) out.push_back("nothing was noted at all");
  return out;
}

fs::path Browser::saved(const std::string& name) {
  until("the file " + name, [&] { return fs::exists(downloads_ / name); });
  return downloads_ / name;
}

}  // namespace trocar::test
