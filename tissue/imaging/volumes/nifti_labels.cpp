#include "tissue/imaging/volumes/nifti_labels.h"

#include <expat.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <string_view>

namespace trocar {
namespace {

std::uint32_t four_bytes(std::span<const unsigned char> bytes, bool swapped) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data(), sizeof value);
  return swapped ? __builtin_bswap32(value) : value;
}

template <typename Number>
Number number_in(std::string_view text, Number otherwise) {
  Number value = otherwise;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && stop == text.data() + text.size() ? value : otherwise;
}

/// The elements <Label Key="5" Red=".."><![CDATA[liver]]></Label> of a table.
class LabelGatherer {
 public:
  std::map<int, Segment> labels;
  std::set<int> twice;
  bool failed = false;

  void start(std::string_view element, const XML_Char** attributes) {
    open_ = element == "Label";
    if (!open_) return;
    std::map<std::string_view, std::string_view> values;
    for (; attributes[0] != nullptr; attributes += 2) values[attributes[0]] = attributes[1];
    const auto part = [&](const char* key) { return number_in(values[key], -1.0); };
    label_ = {0, number_in(values["Key"], -1), "", colour_of(part("Red"), part("Green"), part("Blue"))};
  }

  void text(std::string_view letters) {
    if (open_ && label_.name.size() < 1024) label_.name += letters;
  }

  void end() {
    if (!open_) return;
    open_ = false;
    label_.name = readable_name(label_.name);
    if (label_.number < 1 || label_.number > 65535 || label_.name.empty()) return;
    const auto [place, fresh] = labels.try_emplace(label_.number, label_);
    if (!fresh && place->second.name != label_.name) twice.insert(label_.number);
  }

 private:
  bool open_ = false;
  Segment label_;
};

void XMLCALL label_start(void* user, const XML_Char* name, const XML_Char** pairs) {
  static_cast<LabelGatherer*>(user)->start(name, pairs);
}
void XMLCALL label_end(void* user, const XML_Char*) { static_cast<LabelGatherer*>(user)->end(); }
void XMLCALL label_text(void* user, const XML_Char* letters, int count) {
  static_cast<LabelGatherer*>(user)->text({letters, static_cast<std::size_t>(count)});
}
void XMLCALL label_doctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  static_cast<LabelGatherer*>(user)->failed = true;  // entities are never expanded
}

LabelGatherer gathered(std::string_view xml) {
  LabelGatherer gatherer;
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr), &XML_ParserFree);
  XML_SetUserData(parser.get(), &gatherer);
  XML_SetElementHandler(parser.get(), label_start, label_end);
  XML_SetCharacterDataHandler(parser.get(), label_text);
  XML_SetStartDoctypeDeclHandler(parser.get(), label_doctype);
  if (XML_Parse(parser.get(), xml.data(), static_cast<int>(xml.size()), 1) != XML_STATUS_OK) gatherer.failed = true;
  return gatherer;
}

/// The XML of an extension; blanks and zeros that fill it up are no part of it.
std::string_view trimmed_xml(std::span<const unsigned char> bytes) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto last = text.find_last_of('>');
  const auto first = text.find_first_of('<');
  return last == std::string_view::npos || first > last ? std::string_view() : text.substr(first, last - first + 1);
}

void take_names(std::string_view xml, std::vector<Segment>& labels, std::vector<std::string>& notes) {
  LabelGatherer gatherer = gathered(xml);
  if (gatherer.failed) {
    notes.emplace_back("the label table in the header (CaretExtension) is damaged; no name was taken from it");
    return;
  }
  for (auto& [number, label] : gatherer.labels) {
    if (gatherer.twice.contains(number))
      notes.push_back("the label table in the header gives number " + std::to_string(number) +
                      " two names; it stays without one");
    else if (const auto before = std::find_if(labels.begin(), labels.end(),
                                              [&, n = number](const Segment& other) { return other.number == n; });
             before == labels.end())
      labels.push_back(std::move(label));
    else if (before->name != label.name)
      notes.push_back("the label tables in the header give number " + std::to_string(number) +
                      " two names; it stays without one"),
          before->name.clear();
  }
}

}  // namespace

std::vector<Segment> nifti_labels(std::span<const unsigned char> bytes, bool swapped, std::vector<std::string>& notes) {
  std::vector<Segment> labels;
  if (bytes.size() < 4 || bytes[0] == 0) return labels;
  bytes = bytes.subspan(4);
  while (bytes.size() > 8) {
    const std::size_t length = four_bytes(bytes, swapped);
    if (length <= 8 || length > bytes.size()) break;  // the extensions end here, or are damaged
    const std::string_view xml = trimmed_xml(bytes.subspan(8, length - 8));
    if (xml.find("<CaretExtension") != std::string_view::npos) take_names(xml, labels, notes);
    bytes = bytes.subspan(length);
  }
  return labels;
}

}  // namespace trocar
