#include "tests/trainees/desk/pages/page_checker.h"

#include <expat.h>

#include <algorithm>
#include <cstring>
#include <set>
#include "trainees/desk/words/page_language.h"

namespace trocar::review {
namespace {

struct Reader {
  std::vector<PageElement> elements;
  std::vector<std::size_t> open;  ///< positions in `elements`
  std::vector<std::vector<std::size_t>> parents;

  static void begin(void* self, const char* name, const char** attributes) {
    auto& reader = *static_cast<Reader*>(self);
    PageElement element{name, {}, ""};
    for (; *attributes != nullptr; attributes += 2) element.attributes[attributes[0]] = attributes[1];
    reader.parents.push_back(reader.open);
    reader.open.push_back(reader.elements.size());
    reader.elements.push_back(std::move(element));
  }
  static void end(void* self, const char*) { static_cast<Reader*>(self)->open.pop_back(); }
  static void text(void* self, const char* words, int length) {
    auto& reader = *static_cast<Reader*>(self);
    for (const std::size_t i : reader.open)
      if (i != 0) reader.elements[i].text.append(words, static_cast<std::size_t>(length));
  }
};

std::string parse(const std::string& html, Reader& reader) {
  XML_Parser parser = XML_ParserCreate("UTF-8");
  XML_SetUserData(parser, &reader);
  XML_SetElementHandler(parser, Reader::begin, Reader::end);
  XML_SetCharacterDataHandler(parser, Reader::text);
  std::string problem;
  if (XML_Parse(parser, html.data(), static_cast<int>(html.size()), 1) != XML_STATUS_OK)
    problem = std::string(XML_ErrorString(XML_GetErrorCode(parser))) + " in line " +
              std::to_string(XML_GetCurrentLineNumber(parser)) + ", column " +
              std::to_string(XML_GetCurrentColumnNumber(parser));
  XML_ParserFree(parser);
  return problem;
}

bool local(const std::string& address) {
  if (address.empty()) return false;
  if (address[0] == '#' || address[0] == '?') return true;
  return address[0] == '/' && (address.size() < 2 || (address[1] != '/' && address[1] != '\\'));
}

void check_element(const PageElement& e, std::vector<std::string>& problems) {
  for (const auto& [name, value] : e.attributes) {
    if ((name == "href" || name == "src" || name == "action" || name == "data-base" || name == "formaction") &&
        !local(value))
      problems.push_back(e.name + " leads outside: " + value);
    if (name == "style" || name.starts_with("on")) problems.push_back(e.name + " has " + name);
  }
  if (e.name == "script" && (e.of("src") != "/desk.js" || !e.text.empty())) problems.push_back("script of its own");
  if (e.name == "style") problems.push_back("inline style sheet");
  if (e.name == "th" && e.of("scope").empty()) problems.push_back("th without scope: " + e.text);
  if (e.name == "img" && e.of("alt").empty()) problems.push_back("img without alt");
  if (e.name == "svg" && e.of("aria-hidden").empty() && e.of("aria-label").empty())
    problems.push_back("svg without words");
  if (e.name == "a" && e.text.empty()) problems.push_back("link without words to " + e.of("href"));
}

void check_labels(const Reader& reader, std::vector<std::string>& problems) {
  std::set<std::string> labelled, ids;
  for (const PageElement& e : reader.elements)
    if (e.name == "label" && !e.text.empty()) labelled.insert(e.of("for"));
  for (const PageElement& e : reader.elements) {
    const std::string id = e.of("id");
    if (!id.empty() && !ids.insert(id).second) problems.push_back("id twice: " + id);
    const bool field = (e.name == "input" && e.of("type") != "hidden") || e.name == "select" || e.name == "textarea";
    if (field && !labelled.contains(id)) problems.push_back(e.name + " without a label: " + e.of("name"));
    if (e.name == "button" && e.text.empty()) problems.push_back("button without words");
  }
  for (const PageElement& e : reader.elements) {
    const std::string by = e.of("aria-labelledby");
    if (!by.empty() && !ids.contains(by)) problems.push_back("named by what is not there: " + by);
  }
}

/// What stands inside element `i`.
std::vector<const PageElement*> inside(const Reader& reader, std::size_t i) {
  std::vector<const PageElement*> out;
  for (std::size_t k = i + 1; k < reader.elements.size(); ++k)
    if (std::find(reader.parents[k].begin(), reader.parents[k].end(), i) != reader.parents[k].end())
      out.push_back(&reader.elements[k]);
  return out;
}

void check_tables_and_forms(const Reader& reader, const std::string& token, std::vector<std::string>& problems) {
  for (std::size_t i = 0; i < reader.elements.size(); ++i) {
    const PageElement& e = reader.elements[i];
    if (e.name != "table" && e.name != "form") continue;
    const auto in = inside(reader, i);
    if (e.name == "table" && std::none_of(in.begin(), in.end(), [](const PageElement* p) {
          return p->name == "caption" && !p->text.empty();
        }))
      problems.push_back("table without caption");
    const bool has_token = std::any_of(in.begin(), in.end(), [&](const PageElement* p) {
      return p->of("name") == "token" && p->of("value") == token;
    });
    if (e.name == "form" && (e.of("method") == "post") != has_token)
      problems.push_back("token in form " + e.of("action"));
    if (e.name == "form" && std::any_of(in.begin(), in.end(), [](const PageElement* p) { return p->name == "form"; }))
      problems.push_back("form in a form");
  }
}

}  // namespace

std::string PageElement::of(const std::string& attribute) const {
  const auto it = attributes.find(attribute);
  return it == attributes.end() ? "" : it->second;
}

std::vector<const PageElement*> CheckedPage::all(const std::string& name, const std::string& class_part) const {
  std::vector<const PageElement*> out;
  for (const PageElement& e : elements)
    if (e.name == name &&
        (" " + e.of("class") + " ").find(class_part.empty() ? "" : " " + class_part + " ") != std::string::npos)
      out.push_back(&e);
  return out;
}

const PageElement* CheckedPage::by_id(const std::string& id) const {
  const auto it =
      std::find_if(elements.begin(), elements.end(), [&](const PageElement& e) { return e.of("id") == id; });
  return it == elements.end() ? nullptr : &*it;
}

CheckedPage check_page(const std::string& html, const std::string& token) {
  Reader reader;
  CheckedPage page;
  if (!html.starts_with("<!DOCTYPE html>\n")) page.problems.push_back("no doctype");
  if (const std::string problem = parse(html, reader); !problem.empty()) page.problems.push_back(problem);
  if (!reader.elements.empty() && !desk_tongue(reader.elements[0].of("lang"))) page.problems.push_back("no language");
  for (const PageElement& e : reader.elements) check_element(e, page.problems);
  check_labels(reader, page.problems);
  check_tables_and_forms(reader, token, page.problems);
  page.elements = std::move(reader.elements);
  for (const char* once : {"main", "h1", "head", "footer"})
    if (page.all(once).size() != 1) page.problems.push_back(std::string(once) + " not once");
  if (page.by_id("main") == nullptr || page.all("a", "skip").size() != 1)
    page.problems.push_back("no way to skip to the content");
  return page;
}

}  // namespace trocar::review
