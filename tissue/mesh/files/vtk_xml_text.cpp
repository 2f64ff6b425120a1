#include "tissue/mesh/files/vtk_xml_text.h"

#include <sstream>

namespace trocar {
namespace {

/// VTK writes strings as the numbers of their letters, each string ended by a 0.
std::string string_field(const char* name, const std::vector<std::string>& strings) {
  std::string text = std::string("<Array type=\"String\" Name=\"") + name + "\" NumberOfTuples=\"" +
                     std::to_string(strings.size()) + "\" format=\"ascii\">\n";
  for (const std::string& letters : strings) {
    for (const char letter : letters) text += std::to_string(static_cast<unsigned char>(letter)) + ' ';
    text += "0\n";
  }
  return text + "</Array>\n";
}

}  // namespace

std::string xml_escaped(const std::string& text) {
  std::string out;
  for (const char letter : text)
    out += letter == '&'   ? "&amp;"
           : letter == '<' ? "&lt;"
           : letter == '>' ? "&gt;"
           : letter == '"' ? "&quot;"
                           : std::string(1, letter);
  return out;
}

std::string vtk_xml_array(const char* type, const char* name, const std::string& values) {
  return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" format=\"ascii\">\n" + values +
         "</DataArray>\n";
}

std::string vtk_xml_text(const VtkXmlPiece& piece) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);
  text << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << piece.type  // SOFA looks for it in the second line
       << "\" version=\"0.1\" byte_order=\"LittleEndian\">\n<" << piece.type << ">\n<FieldData>\n"
       << string_field("SPACE", {"RAS"}) << string_field("UNIT", {"mm"}) << string_field("CREDIT", {piece.credit});
  if (!piece.regions.empty()) text << string_field("REGIONS", piece.regions);
  text << "</FieldData>\n<Piece NumberOfPoints=\"" << piece.points_m->size() << "\" " << piece.counts
       << ">\n<Points>\n<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const Vec3& point : *piece.points_m)
    text << point.x() * 1e3 << ' ' << point.y() * 1e3 << ' ' << point.z() * 1e3 << '\n';
  text << "</DataArray>\n</Points>\n" << piece.arrays << "</Piece>\n</" << piece.type << ">\n</VTKFile>\n";
  return text.str();
}

}  // namespace trocar
