#include "tissue/imaging/dicom/dicom_elements.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_tags.h"
#include "tissue/imaging/dicom/element_reader.h"
#include "tissue/imaging/dicom/inflate.h"

namespace trocar {
namespace {

constexpr std::uint64_t kPreamble = 132;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// A file without signature is taken for DICOM when it starts with a plausible element of group 8.
const TransferSyntax* guessed(ByteSource& source) {
  unsigned char head[8];
  if (!source.read(0, head, sizeof head) || head[0] != 8 || head[1] != 0 || head[3] != 0) return nullptr;
  const auto letter = [](unsigned char c) { return c >= 'A' && c <= 'Z'; };
  if (letter(head[4]) && letter(head[5])) return &explicit_little_endian();
  return head[6] == 0 && head[7] == 0 ? &implicit_little_endian() : nullptr;
}

void parse(DicomFile& file, ByteSource& source, const TransferSyntax& syntax, std::uint64_t from) {
  try {
    ElementReader(source, syntax, file.pixels).read_all(file.data, from);
  } catch (const InputError& error) {
    if (file.damage.empty()) file.damage = error.what();
  }
}

/// Reads the file header (always explicit little endian) up to the first element that is not of group 2.
std::uint64_t read_file_header(DicomFile& file, ByteSource& source) {
  try {
    return ElementReader(source, explicit_little_endian(), file.pixels).read_group(file.data, kPreamble, 2);
  } catch (const InputError& error) {
    file.damage = error.what();
    return kPreamble;
  }
}

/// What a deflated file inflates to; what comes before its damage is kept.
std::unique_ptr<ByteSource> inflated(DicomFile& file, ByteSource& source, std::uint64_t from, InflateBudget& budget) {
  Inflated all = inflate_raw(source, from, budget);
  file.damage = std::move(all.damage);
  return std::make_unique<ByteSource>(std::move(all.bytes), source.name());
}

}  // namespace

const DicomElement* DicomItem::find(DicomTag tag) const {
  const auto found = elements.find(tag);
  return found == elements.end() ? nullptr : &found->second;
}

const DicomItem* DicomItem::first_item(DicomTag tag) const {
  const DicomElement* element = find(tag);
  return element == nullptr || element->items.empty() ? nullptr : &element->items.front();
}

std::string DicomItem::text(DicomTag tag) const {
  const DicomElement* element = find(tag);
  return element == nullptr ? "" : element->value;
}

std::optional<std::vector<double>> DicomItem::decimals(DicomTag tag) const {
  const std::string all = text(tag);
  if (all.empty()) return {};
  std::vector<double> numbers;
  for (std::size_t from = 0; from <= all.size();) {
    const std::size_t to = std::min(all.find('\\', from), all.size());
    std::string one = trimmed(all.substr(from, to - from));
    if (one.starts_with("+-")) return {};  // one sign only; from_chars knows no plus
    if (one.starts_with('+')) one.erase(0, 1);
    double number = 0;
    const auto [end, error] = std::from_chars(one.data(), one.data() + one.size(), number);
    if (error != std::errc() || end != one.data() + one.size() || !std::isfinite(number)) return {};
    numbers.push_back(number);
    from = to + 1;
  }
  return numbers;
}

std::optional<std::uint32_t> DicomItem::whole(DicomTag tag) const {
  const DicomElement* element = find(tag);
  if (element == nullptr || element->value.size() < 2) return {};
  const auto byte = [&](std::size_t at) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(element->value[at]));
  };
  const std::uint32_t low = byte(0) | byte(1) << 8;
  return element->value.size() >= 4 ? low | byte(2) << 16 | byte(3) << 24 : low;
}

std::optional<DicomFile> read_dicom_elements(const std::filesystem::path& path, const std::string& name,
                                             InflateBudget& budget, std::unique_ptr<ByteSource>* source) {
  auto bytes = std::make_unique<ByteSource>(path, name);
  char signature[4];
  DicomFile file;
  file.has_header = bytes->read(128, signature, 4) && std::string_view(signature, 4) == "DICM";
  std::uint64_t from = 0;
  if (file.has_header) {
    from = read_file_header(file, *bytes);
    file.syntax = transfer_syntax(file.data.text(tag::kTransferSyntax));
  } else if ((file.syntax = guessed(*bytes)) == nullptr) {
    return {};
  }
  const bool header_holds = file.damage.empty();
  if (header_holds && file.syntax != nullptr && file.syntax->deflated)
    bytes = inflated(file, *bytes, std::exchange(from, 0), budget);
  if (header_holds) parse(file, *bytes, file.syntax != nullptr ? *file.syntax : explicit_little_endian(), from);
  if (source != nullptr) *source = std::move(bytes);
  return file;
}

}  // namespace trocar
