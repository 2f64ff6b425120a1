// Reads a page as a browser and a screen reader would and says what is wrong with it; expat is the independent reader.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace trocar::review {

struct PageElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< of itself and what is in it
  std::string of(const std::string& attribute) const;
};

struct CheckedPage {
  std::vector<std::string> problems;  ///< empty when the page is sound
  std::vector<PageElement> elements;  ///< in the order in which they begin
  std::vector<const PageElement*> all(const std::string& name, const std::string& class_part = "") const;
  const PageElement* by_id(const std::string& id) const;
};

/// Well-formed; language, one main and one h1; addresses of this desk only; no inline style or script; every field with
/// a label; tables with caption and scopes; ids once; forms that post carry the token; svg with words.
CheckedPage check_page(const std::string& html, const std::string& token = "token-4711");

}  // namespace trocar::review
