// The pass over a page: tags are copied, texts and the attributes that people read are looked up.
#include <algorithm>

#include "trainees/desk/words/page_language.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

constexpr std::string_view kLabel = "data-label";  // the desk's own word, whatever stands in its element
constexpr std::array<std::string_view, 6> kReadAttributes = {"alt",        "aria-label",  kLabel,
                                                             "data-words", "placeholder", "title"};
constexpr std::array<std::string_view, 4> kForeignElements = {"code", "script", "style", "textarea"};
constexpr std::array<std::string_view, 3> kForeignClasses = {"mono", "said", "written"};
constexpr std::array<std::string_view, 6> kVoidElements = {"br", "hr", "img", "input", "link", "meta"};

template <class Names>
bool among(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool has_foreign_class(std::string_view classes) {
  while (!classes.empty()) {
    const std::size_t end = std::min(classes.find(' '), classes.size());
    if (among(kForeignClasses, classes.substr(0, end))) return true;
    classes.remove_prefix(std::min(end + 1, classes.size()));
  }
  return false;
}

/// The reverse of escape_html. Other entities: none, so that the text is left as it is.
std::optional<std::string> plain_text(std::string_view escaped) {
  std::string out;
  for (std::size_t at = 0; at < escaped.size();) {
    if (escaped[at] != '&') {
      out += escaped[at++];
      continue;
    }
    bool known = false;
    for (const auto& [entity, character] : {std::pair<std::string_view, char>{"&amp;", '&'},
                                            {"&lt;", '<'},
                                            {"&gt;", '>'},
                                            {"&quot;", '"'},
                                            {"&#39;", '\''}}) {
      if (!escaped.substr(at).starts_with(entity)) continue;
      out += character;
      at += entity.size();
      known = true;
      break;
    }
    if (!known) return std::nullopt;
  }
  return out;
}

class PagePass {
 public:
  PagePass(const PageLanguage& language, std::string_view html, AskedWords* asked)
      : language_(language), html_(html), asked_(asked) {}

  std::string done() {
    out_.reserve(html_.size() + html_.size() / 8);
    while (at_ < html_.size()) {
      const std::size_t open = std::min(html_.find('<', at_), html_.size());
      text(html_.substr(at_, open - at_));
      at_ = open;
      if (at_ < html_.size()) tag();
    }
    return std::move(out_);
  }

 private:
  void copy_to(std::size_t end) {
    out_ += html_.substr(at_, end - at_);
    at_ = end;
  }

  std::size_t behind(std::string_view what) const {
    const std::size_t at = html_.find(what, at_);
    return at == std::string_view::npos ? html_.size() : at + what.size();
  }

  /// Looked up once a page: a drawing says the same many times.
  void text(std::string_view raw) {
    const std::size_t from = raw.find_first_not_of(" \n\t");
    if (!foreign_.empty() || from == std::string_view::npos) {
      out_ += raw;
      return;
    }
    const std::size_t to = raw.find_last_not_of(" \n\t") + 1;
    const std::string_view words = raw.substr(from, to - from);
    auto at = seen_.find(words);
    if (at == seen_.end()) {
      const auto plain = plain_text(words);
      at = seen_.emplace(words, plain ? escape_html(language_.words(*plain, asked_)) : std::string(words)).first;
    }
    out_ += raw.substr(0, from);
    out_ += at->second;
    out_ += raw.substr(to);
  }

  void tag() {
    if (html_.substr(at_).starts_with("<!--")) return copy_to(behind("-->"));
    if (html_.substr(at_).starts_with("<!")) return copy_to(behind(">"));
    const bool closes = html_.substr(at_).starts_with("</");
    const std::size_t from = at_ + (closes ? 2 : 1);
    const std::size_t to = std::min(html_.find_first_of(" \n\t/>", from), html_.size());
    const std::string_view name = html_.substr(from, to - from);
    if (!closes) return opening(name, to);
    if (name == foreign_ && --depth_ == 0) foreign_ = {};
    copy_to(behind(">"));
  }

  /// @param to behind its name.
  void opening(std::string_view name, std::size_t to) {
    read_.clear();
    bool foreign = among(kForeignElements, name), empty = among(kVoidElements, name);
    while (to < html_.size() && html_[to] != '>') {
      to = html_.find_first_not_of(" \n\t", to);
      if (to == std::string_view::npos) break;
      if (html_[to] == '>') break;
      if (html_[to] == '/') {
        empty = true;
        ++to;
        continue;
      }
      const std::size_t end = std::min(html_.find_first_of("= \n\t/>", to), html_.size());
      const std::string_view attribute = html_.substr(to, end - to);
      to = end;
      if (!html_.substr(to).starts_with("=\"")) {
        to += to < html_.size() && html_[to] == '=' ? 1 : 0;
        continue;
      }
      const std::size_t value = to + 2, close = std::min(html_.find('"', value), html_.size());
      const std::string_view said = html_.substr(value, close - value);
      foreign =
          foreign || (attribute == "translate" && said == "no") || (attribute == "class" && has_foreign_class(said));
      if (among(kReadAttributes, attribute) || (name == "html" && attribute == "lang"))
        read_.push_back({value, close, attribute == kLabel});
      to = std::min(close + 1, html_.size());
    }
    to = std::min(to, html_.size());
    if (foreign_.empty()) attributes(name, foreign);
    copy_to(std::min(to + 1, html_.size()));
    if (empty) return;
    if (foreign_.empty() && foreign) {
      foreign_ = name;
      depth_ = 1;
    } else if (name == foreign_) {
      ++depth_;
    }
  }

  void attributes(std::string_view name, bool foreign) {
    for (const auto& [from, to, label] : read_) {
      if (foreign && !label) continue;
      copy_to(from);
      if (name == "html")
        out_ += language_.code();
      else
        text(html_.substr(from, to - from));
      at_ = to;
    }
  }

  const PageLanguage& language_;
  std::string_view html_;
  AskedWords* asked_;
  std::string out_ = {};
  std::size_t at_ = 0;
  std::string_view foreign_ = {};  ///< element whose words are left alone; "" outside
  int depth_ = 0;                  ///< of elements of that name in it
  struct Read {
    std::size_t from, to;
    bool label;
  };
  std::vector<Read> read_ = {};
  std::unordered_map<std::string_view, std::string> seen_ = {};
};

}  // namespace

std::string PageLanguage::page(std::string_view html, AskedWords* asked) const {
  return PagePass(*this, html, asked).done();
}

}  // namespace trocar::review
