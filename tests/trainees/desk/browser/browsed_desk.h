// A desk with a small cohort that a browser looks at: twelve trainees, one of them unsafe ("A-risky"), accounts of
// every role.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/trainees/desk/browser/browser.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/server/desk_server.h"

namespace trocar::test {

inline constexpr const char* kRisky = "A-risky";
inline constexpr const char* kDeskPassword = "correct horse battery";

class BrowsedDesk : public TemporaryFolder {
 protected:
  BrowsedDesk();
  /// Accounts ines (instructor), adam (administrator), risky (of A-risky).
  void add_accounts();
  review::DeskServerOptions options();
  void serve(review::DeskServerOptions given);
  void look(const BrowserLook& look) { browser_ = std::make_unique<Browser>(look, folder_); }

  std::string at(const std::string& path) const { return base_ + path; }
  void sign_in(const std::string& login);
  /// The page is sound, and what it is called.
  void expect_sound(const std::string& page, bool tabs = false);
  /// Nothing was complained of and nothing asked for elsewhere.
  void expect_quiet(const std::vector<std::string>& expected = {});

  std::filesystem::path file_;
  std::string base_, attempt_;  ///< newest attempt of A-risky
  std::unique_ptr<review::DeskServer> server_;
  std::unique_ptr<Browser> browser_;
};

}  // namespace trocar::test
