// A real browser for tests: Debian's Chromium without a window, driven by its chromedriver through the W3C WebDriver
// protocol (JSON over HTTP on loopback).
//
// Waiting is always for a condition, with a limit so generous that only a fault reaches it. The browser resolves no
// name and so reaches no other host; what it asked for is noted all the same. Thread: one.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace trocar::test {

struct BrowserLook {
  int width = 1280, height = 800;
  bool phone = false;            ///< emulates one of that size
  bool script = true;            ///< false: pages run no script
  bool any_certificate = false;  ///< takes certificates that sign themselves
};

namespace key {
inline constexpr const char *kTab = "\uE004", *kEnter = "\uE007", *kRight = "\uE014", *kDown = "\uE015",
                            *kEnd = "\uE010", *kSpace = " ";
}

class Browser {
 public:
  using Json = nlohmann::json;
  /// @param folder for its profile and what it downloads.
  /// @throws std::runtime_error: not installed, or it does not begin; says what to do.
  Browser(const BrowserLook& look, const std::filesystem::path& folder);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void open(const std::string& address);
  std::string address();
  /// Of the page: the body of a function. Works where pages may run no script too. @returns its result.
  Json run(const std::string& body, const Json& arguments = Json::array());

  /// The first element that the selector fits, waited for. @throws std::runtime_error when none comes.
  std::string find(const std::string& selector);
  bool has(const std::string& selector);
  std::string text(const std::string& selector);
  std::string property(const std::string& selector, const std::string& name);
  void click(const std::string& selector);
  /// Clicks what leads to another page and waits until that has come.
  void follow(const std::string& selector);
  /// Replaces what stands in the field.
  void type(const std::string& selector, const std::string& words);
  /// Keys as a person presses them, wherever the focus is.
  void press(const std::string& keys);
  void press(const char* key, int times);
  /// Tab until the selector fits what has the focus. @throws std::runtime_error when the focus comes round without.
  void tab_to(const std::string& selector);
  /// Does what leads to another page and waits for it.
  void arrives(const std::function<void()>& act);
  /// @throws std::runtime_error naming `what` when it never holds.
  void until(const std::string& what, const std::function<bool()>& holds);
  std::vector<Json> cookies();
  /// Shows pages as a printer would get them.
  void as_printed();
  /// The page takes itself for focused whatever the desktop's focus does: :focus holds at once on a busy machine too.
  void keep_focused();
  /// A picture of the whole page, for people to look at.
  void picture(const std::filesystem::path& file);

  /// What pages complained of in the console since it was last asked, without those whose text has one of the parts.
  std::vector<std::string> complaints(const std::vector<std::string>& expected = {});
  /// Addresses that were asked for and do not begin so, but for the browser's own.
  std::vector<std::string> requests_outside(const std::string& beginning);
  /// A file that was saved, waited for until it is whole.
  std::filesystem::path saved(const std::string& name);

 private:
  Json ask(const std::string& method, const std::string& path, const Json& body = nullptr);
  Json session(const std::string& method, const std::string& path, const Json& body = nullptr);

  struct Driver;
  std::unique_ptr<Driver> driver_;
  std::string session_;
  std::filesystem::path home_, downloads_;
  std::vector<std::string> asked_;
};

}  // namespace trocar::test
