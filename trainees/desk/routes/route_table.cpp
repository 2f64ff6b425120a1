#include "trainees/desk/routes/route_table.h"

#include <algorithm>
#include <stdexcept>

#include "trainees/desk/server/url_text.h"

namespace trocar::review {
namespace {

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> out;
  for (std::size_t from = 1; from <= path.size();) {
    const std::size_t to = std::min(path.find('/', from), path.size());
    out.push_back(path.substr(from, to - from));
    from = to + 1;
  }
  return out;
}

/// Decoded parts; nothing when one of them cannot stand in a path.
std::optional<std::vector<std::string>> decoded_parts(const std::string& path) {
  if (path.empty() || path[0] != '/') return {};
  std::vector<std::string> parts = split(path);
  for (std::string& part : parts) {
    const auto decoded = percent_decoded(part, false);
    if (!decoded || *decoded == "." || *decoded == "..") return {};
    if (decoded->find_first_of("/\\\t\r\n") != std::string::npos) return {};
    part = *decoded;
  }
  return parts;
}

}  // namespace

RouteTable::RouteTable(std::vector<Route> routes) {
  for (Route& route : routes) {
    if (route.method != "GET" && route.method != "POST")
      throw std::logic_error("route " + route.path + ": method " + route.method);
    if (!route.answer) throw std::logic_error("route " + route.path + ": nothing answers");
    patterns_.push_back(parts_of(route.path));
    routes_.push_back(std::move(route));
    const auto alike = [&](const Route& other) {
      return other.path == routes_.back().path && other.method == routes_.back().method;
    };
    if (std::count_if(routes_.begin(), routes_.end(), alike) > 1)
      throw std::logic_error("two routes " + routes_.back().path);
  }
}

std::vector<RouteTable::Part> RouteTable::parts_of(const std::string& pattern) {
  if (pattern.empty() || pattern[0] != '/') throw std::logic_error("route " + pattern + ": begins with '/'");
  std::vector<Part> out;
  for (const std::string& text : split(pattern)) {
    const std::size_t open = text.find('{'), close = text.find('}');
    if (open == std::string::npos && close == std::string::npos) {
      out.push_back({text, "", ""});
      continue;
    }
    if (open == std::string::npos || close == std::string::npos || close < open + 2)
      throw std::logic_error("route " + pattern + ": braces");
    const Part part{text.substr(0, open), text.substr(open + 1, close - open - 1), text.substr(close + 1)};
    if (part.after.find_first_of("{}") != std::string::npos)
      throw std::logic_error("route " + pattern + ": one argument between slashes");
    out.push_back(part);
  }
  return out;
}

bool RouteTable::fits(const std::vector<Part>& pattern, const std::vector<std::string>& path,
                      std::map<std::string, std::string>& arguments) {
  if (pattern.size() != path.size()) return false;
  arguments.clear();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Part& part = pattern[i];
    const std::string& text = path[i];
    if (part.argument.empty()) {
      if (text != part.before) return false;
      continue;
    }
    if (text.size() <= part.before.size() + part.after.size() || !text.starts_with(part.before) ||
        !text.ends_with(part.after))
      return false;
    arguments[part.argument] = text.substr(part.before.size(), text.size() - part.before.size() - part.after.size());
  }
  return true;
}

RouteTable::Found RouteTable::find(const std::string& method, const std::string& path) const {
  Found found;
  const auto parts = decoded_parts(path);
  if (!parts) return found;
  const std::string wanted = method == "HEAD" ? "GET" : method;
  // The most special pattern: words first, then arguments with words round them.
  const auto rank = [&](std::size_t i) {
    std::string out;
    for (const Part& part : patterns_[i])
      out += part.argument.empty() ? 'a' : part.before.empty() && part.after.empty() ? 'c' : 'b';
    return out;
  };
  std::string best;
  for (std::size_t i = 0; i < routes_.size(); ++i) {
    std::map<std::string, std::string> arguments;
    if (!fits(patterns_[i], *parts, arguments)) continue;
    found.methods.push_back(routes_[i].method);
    if (routes_[i].method != wanted || (found.route && rank(i) >= best)) continue;
    found.route = &routes_[i];
    found.arguments = arguments;
    best = rank(i);
  }
  return found;
}

}  // namespace trocar::review
