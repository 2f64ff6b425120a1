// A label table of the user's own, from a file: CSV or TSV "number,name", a 3D Slicer colour table (.ctbl) or an
// ITK-SNAP label file.
//
// Lines: "5,liver" / "5<TAB>liver" (a heading line is skipped when its number is none), "5 liver 221 130 101 255"
// (.ctbl, five or six columns), "    5  221 130 101  1  1  1  \"liver\"" (ITK-SNAP). '#' starts a comment. Background
// (0) may stand there and is left out. Thread: any, not the tick (file I/O).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "tissue/imaging/labels/label_table.h"

namespace trocar {

/// A table that owns its text; copies share it.
class OwnLabelTable {
 public:
  /// Valid as long as this object or a copy of it lives.
  const LabelTable& table() const;

 private:
  friend OwnLabelTable parse_label_table(std::string_view text, const std::string& file);
  friend OwnLabelTable label_table_or_file(const std::string& name);
  struct Contents;
  std::shared_ptr<const Contents> contents_;
};

/// @param file name for messages; its last part becomes the table's name
/// @throws InputError "FILE:LINE:COLUMN: what": no number, no name, number or name given twice, not one entry
OwnLabelTable parse_label_table(std::string_view text, const std::string& file);
OwnLabelTable read_label_table(const std::filesystem::path& path);

/// What a person gives as --label-table: the name of a built-in table, or a file.
/// @throws InputError listing the built-in tables when it is neither
OwnLabelTable label_table_or_file(const std::string& name);

}  // namespace trocar
