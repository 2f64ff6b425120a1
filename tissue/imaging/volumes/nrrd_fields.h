// The text of a NRRD header, taken apart: fields "name: value" and keys "name:=value", each with its line.
//
// Source: the format definition of Teem, NRRD0001 to NRRD0006. Names of fields are kept in lower case without blanks
// ("spaceorigin"), keys as they are. Thread: any.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace trocar {

struct NrrdText {
  std::string text;
  int line = 0;
};

struct NrrdFields {
  std::string file;  ///< for messages
  std::map<std::string, NrrdText> fields, keys;
  std::uint64_t data_offset = 0;  ///< byte behind the empty line; the file's length when there is none
  bool ended = false;             ///< the empty line was there

  bool has(const std::string& field) const { return fields.contains(field); }
  /// @throws InputError naming the field when it is missing
  const NrrdText& wanted(const std::string& field) const;
  /// @throws InputError "FILE:LINE:1: FIELD: what"
  [[noreturn]] void refuse(const std::string& field, const std::string& what) const;
};

/// Largest header that is read: room for some hundred segments with all their key/value pairs.
inline constexpr std::size_t kMostHeaderBytes = std::size_t{4} << 20;

/// @throws InputError naming file and line: no NRRD signature, header too long, a field twice, a line that is none
NrrdFields read_nrrd_fields(const std::filesystem::path& path);

/// The values of a field, "none" (or NaN) as no value. @throws InputError naming field and line
std::vector<std::optional<double>> nrrd_numbers(const NrrdFields& header, const std::string& field);
std::vector<std::optional<Eigen::Vector3d>> nrrd_vectors(const NrrdFields& header, const std::string& field);
std::vector<std::string> nrrd_words(const NrrdFields& header, const std::string& field);
/// A whole number within 0..`most`. @throws InputError
std::int64_t whole_number(const NrrdFields& header, const std::string& field, std::int64_t least, std::int64_t most);

}  // namespace trocar
