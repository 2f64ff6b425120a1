// Which route answers a method and a path.
//
// A pattern is split at '/'; each part is a word, an argument "{code}" or both ("{code}.csv"). Parts of the path are
// decoded one by one, once: an escaped slash never makes a new part, and an argument never holds a slash or a
// backslash, nor is it "." or "..". Words win over arguments, from the left. Thread: any may read.
#pragma once

#include "trainees/desk/routes/route.h"

namespace trocar::review {

class RouteTable {
 public:
  /// @throws std::logic_error: a pattern that cannot be read, a method other than GET and POST, or two alike.
  explicit RouteTable(std::vector<Route> routes);

  struct Found {
    const Route* route = nullptr;
    std::map<std::string, std::string> arguments = {};
    std::vector<std::string> methods = {};  ///< that the path has; empty: no such page
  };
  /// @param path as sent, without the query. HEAD is answered by GET.
  Found find(const std::string& method, const std::string& path) const;
  const std::vector<Route>& routes() const { return routes_; }

 private:
  struct Part {
    std::string before, argument, after;
  };
  static std::vector<Part> parts_of(const std::string& pattern);
  static bool fits(const std::vector<Part>& pattern, const std::vector<std::string>& path,
                   std::map<std::string, std::string>& arguments);

  std::vector<Route> routes_;
  std::vector<std::vector<Part>> patterns_;
};

}  // namespace trocar::review
