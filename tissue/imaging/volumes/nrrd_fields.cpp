#include "tissue/imaging/volumes/nrrd_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "haptics/input_error.h"
#include "tissue/imaging/volumes/byte_stream.h"
#include "tissue/imaging/volumes/volume_frame.h"

namespace trocar {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// "Space Directions" and "spacedirections" are one field.
std::string field_name(const std::string& text) {
  std::string name = lower_case(text);
  std::erase_if(name, [](char letter) { return letter == ' ' || letter == '\t'; });
  if (name == "centerings") return "centers";
  return name;
}

void keep_line(const std::string& line, int number, NrrdFields& header) {
  if (line.empty() || line[0] == '#') return;
  const auto colon = line.find(':');
  if (colon == std::string::npos) throw InputError(header.file, number, 1, "neither a field nor a key");
  const bool key = colon + 1 < line.size() && line[colon + 1] == '=';
  const std::string name = key ? trimmed(line.substr(0, colon)) : field_name(line.substr(0, colon));
  const std::string value = trimmed(line.substr(colon + (key ? 2 : 1)));
  auto& kept = key ? header.keys : header.fields;
  if (!kept.try_emplace(name, NrrdText{value, number}).second && !key)
    throw InputError(header.file, number, 1, name + ": given twice");
}

/// The file down to its first empty line at least.
std::string first_bytes(const std::filesystem::path& path) {
  const auto bytes = open_plain(path, 0);
  std::string text;
  while (text.size() < kMostHeaderBytes) {
    std::string piece(1 << 16, '\0');
    piece.resize(bytes->read(reinterpret_cast<unsigned char*>(piece.data()), piece.size()));
    const std::size_t seam = text.size() < 4 ? 0 : text.size() - 4;
    text += piece;
    if (piece.empty() || text.find("\n\n", seam) != std::string::npos || text.find("\n\r\n", seam) != std::string::npos)
      break;
  }
  return text;
}

double number_of(const std::string& word, const NrrdFields& header, const std::string& field) {
  double value = 0;
  const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
  const auto [stop, error] = std::from_chars(first, word.data() + word.size(), value);
  if (error != std::errc() || stop != word.data() + word.size())
    header.refuse(field, "holds something that is no number");
  return value;
}

/// "(1,2,3)" as its numbers.
Eigen::Vector3d vector_of(const std::string& text, const NrrdFields& header, const std::string& field) {
  Eigen::Vector3d vector;
  std::size_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto comma = text.find(',', place);
    if ((axis < 2) == (comma == std::string::npos)) header.refuse(field, "a vector of another length than 3");
    const auto end = axis < 2 ? comma : text.size();
    vector[axis] = number_of(trimmed(text.substr(place, end - place)), header, field);
    place = end + 1;
  }
  return vector;
}

}  // namespace

const NrrdText& NrrdFields::wanted(const std::string& field) const {
  const auto found = fields.find(field);
  if (found == fields.end()) throw InputError(file + ": " + field + ": missing");
  return found->second;
}

void NrrdFields::refuse(const std::string& field, const std::string& what) const {
  const auto found = fields.find(field);
  if (found == fields.end()) throw InputError(file + ": " + field + ": " + what);
  throw InputError(file, found->second.line, 1, field + ": " + what);
}

NrrdFields read_nrrd_fields(const std::filesystem::path& path) {
  NrrdFields header;
  header.file = path.string();
  const std::string text = first_bytes(path);
  std::size_t place = 0;
  for (int number = 1; place < text.size(); ++number) {
    const auto end = std::min(text.find('\n', place), text.size());
    std::string line = text.substr(place, end - place);
    place = std::min(end + 1, text.size());
    if (line.ends_with('\r')) line.pop_back();
    if (number == 1 && (line.size() != 8 || !line.starts_with("NRRD000") || line[7] < '1' || line[7] > '6'))
      throw InputError(header.file, 1, 1, "not one of NRRD0001 to NRRD0006");
    if (number > 1 && line.empty()) {
      header.ended = true;
      break;
    }
    if (number > 1) keep_line(line, number, header);
  }
  if (!header.ended && text.size() >= kMostHeaderBytes)
    throw InputError(header.file + ": header: longer than 4 MiB without an empty line");
  header.data_offset = place;
  return header;
}

std::vector<std::string> nrrd_words(const NrrdFields& header, const std::string& field) {
  std::vector<std::string> words;
  std::string word;
  bool quoted = false;
  for (const char letter : header.wanted(field).text + " ") {
    if (letter == '"') quoted = !quoted;
    if (quoted || (letter != ' ' && letter != '\t')) {
      if (letter != '"') word.push_back(letter);
    } else if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
    }
  }
  return words;
}

std::vector<std::optional<double>> nrrd_numbers(const NrrdFields& header, const std::string& field) {
  std::vector<std::optional<double>> numbers;
  for (const std::string& word : nrrd_words(header, field)) {
    if (lower_case(word) == "nan" || lower_case(word) == "none")
      numbers.push_back(std::nullopt);
    else
      numbers.emplace_back(number_of(word, header, field));
  }
  return numbers;
}

std::vector<std::optional<Eigen::Vector3d>> nrrd_vectors(const NrrdFields& header, const std::string& field) {
  const std::string& text = header.wanted(field).text;
  std::vector<std::optional<Eigen::Vector3d>> vectors;
  for (std::size_t place = 0; place < text.size();) {
    if (text[place] == ' ' || text[place] == '\t') {
      ++place;
    } else if (text.compare(place, 4, "none") == 0) {
      vectors.push_back(std::nullopt);
      place += 4;
    } else {
      const auto close = text.find(')', place);
      if (text[place] != '(' || close == std::string::npos)
        header.refuse(field, "neither \"none\" nor a vector (x,y,z)");
      vectors.emplace_back(vector_of(text.substr(place + 1, close - place - 1), header, field));
      place = close + 1;
    }
    if (vectors.size() > 16) header.refuse(field, "more than 16 vectors");
  }
  return vectors;
}

std::int64_t whole_number(const NrrdFields& header, const std::string& field, std::int64_t least, std::int64_t most) {
  const std::string& text = header.wanted(field).text;
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || value < least || value > most)
    header.refuse(field, "no whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return value;
}

}  // namespace trocar
