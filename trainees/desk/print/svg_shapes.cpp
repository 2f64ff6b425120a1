#include "trainees/desk/print/svg_shapes.h"

#include <cstdlib>
#include <map>
#include <stdexcept>

namespace trocar::printed {
namespace {

using Attributes = std::map<std::string, std::string>;

[[noreturn]] void unknown(const std::string& what) { throw std::invalid_argument("chart: " + what + " is not drawn"); }

std::string decoded(const std::string& text) {
  static const std::array<std::pair<const char*, char>, 5> kNames = {
      {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}}};
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    bool named = false;
    for (const auto& [name, c] : kNames) {
      if (text.compare(i, std::string(name).size(), name) != 0) continue;
      out += c;
      i += std::string(name).size();
      named = true;
      break;
    }
    if (!named) out += text[i++];
  }
  return out;
}

std::string of(const Attributes& all, const std::string& name, const std::string& otherwise = "") {
  const auto it = all.find(name);
  return it == all.end() ? otherwise : it->second;
}

double number(const Attributes& all, const std::string& name, double otherwise) {
  const auto it = all.find(name);
  return it == all.end() ? otherwise : std::strtod(it->second.c_str(), nullptr);
}

/// All numbers of a text, whatever stands between them.
std::vector<double> numbers(const std::string& text) {
  std::vector<double> out;
  const char* at = text.c_str();
  while (*at != '\0') {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at) {
      ++at;
      continue;
    }
    out.push_back(value);
    at = end;
  }
  return out;
}

Colour colour(const std::string& text) {
  const bool full = text.size() == 7, brief = text.size() == 4;
  if ((!full && !brief) || text[0] != '#' || text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
    unknown("colour " + text);
  Colour out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string part = full ? text.substr(1 + 2 * i, 2) : std::string(2, text[1 + i]);
    out.at(i) = static_cast<double>(std::strtol(part.c_str(), nullptr, 16)) / 255.0;
  }
  return out;
}

struct Tag {
  std::string name = {};
  Attributes attributes = {};
  bool opens = false, closes = false;  ///< both: <x/>
};

/// @param text between '<' and '>'.
Tag tag_of(const std::string& text) {
  Tag out;
  out.closes = text.starts_with("/") || text.ends_with("/");
  out.opens = !text.starts_with("/");
  std::size_t at = text.starts_with("/") ? 1 : 0;
  const std::size_t name_end = std::min(text.find_first_of(" \n\t/", at), text.size());
  out.name = text.substr(at, name_end - at);
  for (at = name_end; (at = text.find('=', at)) != std::string::npos;) {
    const std::size_t name_begin = text.find_last_of(" \n\t", at) + 1;
    if (at + 1 >= text.size() || text[at + 1] != '"') unknown("attribute of " + out.name);
    const std::size_t end = text.find('"', at + 2);
    if (end == std::string::npos) unknown("attribute of " + out.name);
    out.attributes[text.substr(name_begin, at - name_begin)] = text.substr(at + 2, end - at - 2);
    at = end + 1;
  }
  return out;
}

Shape::Run run_of(const std::string& points, bool closed) {
  const std::vector<double> all = numbers(points);
  Shape::Run out;
  out.closed = closed;
  for (std::size_t i = 0; i + 1 < all.size(); i += 2) out.points.push_back({all[i], all[i + 1]});
  return out;
}

/// M, L, H, V and Z, in absolute numbers.
std::vector<Shape::Run> path_of(const std::string& text) {
  std::vector<Shape::Run> out;
  Point at;
  for (std::size_t i = 0; i < text.size();) {
    const char command = text[i];
    const std::size_t end = std::min(text.find_first_of("MLHVZACQSTmlhvzacqst", i + 1), text.size());
    const std::vector<double> all = numbers(text.substr(i + 1, end - i - 1));
    i = end;
    if (command == 'M') out.emplace_back();
    if (out.empty()) unknown("path " + text);
    if (command == 'Z') {
      out.back().closed = true;
      continue;
    }
    const bool pair = command == 'M' || command == 'L';
    if ((!pair && command != 'H' && command != 'V') || all.size() % (pair ? 2 : 1) != 0) unknown("path " + text);
    for (std::size_t k = 0; k < all.size(); k += pair ? 2 : 1) {
      at = pair ? Point{all[k], all[k + 1]} : command == 'H' ? Point{all[k], at.y} : Point{at.x, all[k]};
      out.back().points.push_back(at);
    }
  }
  return out;
}

void set_style(Shape& shape, const Attributes& a) {
  const bool text = shape.kind == Shape::Kind::kText;
  const std::string fill = of(a, "fill", text ? "#27313b" : "#000"), stroke = of(a, "stroke", "none");
  shape.hatched = fill.starts_with("url(");
  if (fill != "none" && !shape.hatched) shape.fill = colour(fill);
  if (stroke != "none") shape.stroke = colour(stroke);
  shape.fill_opacity = number(a, "fill-opacity", 1);
  shape.stroke_opacity = number(a, "stroke-opacity", 1);
  shape.stroke_width = number(a, "stroke-width", 1);
  shape.dash = numbers(of(a, "stroke-dasharray"));
  shape.round = of(a, "stroke-linecap") == "round";
  shape.bold = of(a, "font-weight") == "bold";
}

Shape shape_of(const Tag& tag) {
  const Attributes& a = tag.attributes;
  Shape out;
  if (tag.name == "line") {
    out.runs = {{{{number(a, "x1", 0), number(a, "y1", 0)}, {number(a, "x2", 0), number(a, "y2", 0)}}, false}};
  } else if (tag.name == "rect") {
    const double x = number(a, "x", 0), y = number(a, "y", 0), w = number(a, "width", 0), h = number(a, "height", 0);
    out.runs = {{{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, true}};
  } else if (tag.name == "polyline" || tag.name == "polygon") {
    out.runs = {run_of(of(a, "points"), tag.name == "polygon")};
  } else if (tag.name == "path") {
    out.runs = path_of(of(a, "d"));
  } else if (tag.name == "circle") {
    out.kind = Shape::Kind::kCircle;
    out.at = {number(a, "cx", 0), number(a, "cy", 0)};
    out.radius = number(a, "r", 0);
  } else if (tag.name == "text") {
    out.kind = Shape::Kind::kText;
    out.at = {number(a, "x", 0), number(a, "y", 0)};
    out.anchor = of(a, "text-anchor", "start");
  } else {
    unknown("<" + tag.name + ">");
  }
  set_style(out, a);
  if (tag.name == "line") out.fill.reset();
  return out;
}

void move(Shape& shape, Point by) {
  shape.at.x += by.x;
  shape.at.y += by.y;
  for (Shape::Run& run : shape.runs)
    for (Point& point : run.points) point = {point.x + by.x, point.y + by.y};
}

Point translation(const Attributes& a) {
  const std::string text = of(a, "transform");
  if (text.empty()) return {};
  const std::vector<double> by = numbers(text);
  if (!text.starts_with("translate(") || by.size() != 2) unknown("transform " + text);
  return {by[0], by[1]};
}

class Reader {
 public:
  explicit Reader(const std::string& svg) : svg_(svg) {}

  Drawing read() {
    for (std::size_t open = svg_.find('<'); open != std::string::npos; open = svg_.find('<', open)) {
      const std::size_t close = svg_.find('>', open);
      if (close == std::string::npos) unknown("a tag without end");
      const Tag tag = tag_of(svg_.substr(open + 1, close - open - 1));
      open = close + 1;
      if (tag.opens && (tag.name == "title" || tag.name == "defs") && !tag.closes)
        open = svg_.find("</" + tag.name, open);
      else
        take(tag, svg_.substr(close + 1, std::min(svg_.find('<', close), svg_.size()) - close - 1));
    }
    if (out_.width <= 0) unknown("a chart without viewBox");
    return std::move(out_);
  }

 private:
  void take(const Tag& tag, const std::string& behind) {
    if (tag.name == "svg") {
      if (tag.opens) begin(tag.attributes);
    } else if (tag.name == "g" || tag.name == "a") {
      if (tag.opens && !tag.closes) moves_.push_back(translation(tag.attributes));
      if (!tag.opens && !moves_.empty()) moves_.pop_back();
    } else if (tag.opens) {
      Shape shape = shape_of(tag);
      if (shape.kind == Shape::Kind::kText) shape.words = decoded(behind);
      for (const Point& by : moves_) move(shape, by);
      out_.shapes.push_back(std::move(shape));
    }  // the end of a shape, behind its title or words
  }

  /// The style sheet gives squares larger words.
  void begin(const Attributes& a) {
    const std::vector<double> box = numbers(of(a, "viewBox"));
    if (box.size() != 4) unknown("a chart without viewBox");
    out_.width = box[2];
    out_.height = box[3];
    out_.font_size = of(a, "class") == "square" ? 20 : 14;
  }

  const std::string& svg_;
  Drawing out_;
  std::vector<Point> moves_;
};

}  // namespace

Drawing read_svg(const std::string& svg) { return Reader(svg).read(); }

std::string without_links(const std::string& svg) {
  std::string out;
  for (std::size_t at = 0; at < svg.size();) {
    const std::size_t open = std::min(svg.find('<', at), svg.size());
    out += svg.substr(at, open - at);
    const std::size_t end = svg.find('>', open);
    if (end == std::string::npos) return out + svg.substr(open);
    const std::string tag = svg.substr(open, end + 1 - open);
    if (tag.starts_with("<a ") || tag == "<a>")
      out += "<g>";
    else if (tag == "</a>")
      out += "</g>";
    else
      out += tag;
    at = end + 1;
  }
  return out;
}

}  // namespace trocar::printed
