#include "tissue/mesh/files/file_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>

#include "haptics/input_error.h"

namespace trocar {
namespace {

using namespace std::string_view_literals;

struct KindName {
  SurfaceKind kind;
  const char* extension;
  const char* name;
};

constexpr std::array<KindName, 11> kKinds{{{SurfaceKind::kStl, ".stl", "an STL file"},
                                           {SurfaceKind::kPly, ".ply", "a PLY file"},
                                           {SurfaceKind::kObj, ".obj", "a Wavefront OBJ file"},
                                           {SurfaceKind::kOff, ".off", "an OFF file"},
                                           {SurfaceKind::kGlb, ".glb", "a binary glTF file"},
                                           {SurfaceKind::kGltf, ".gltf", "a glTF file"},
                                           {SurfaceKind::kFbx, ".fbx", "an FBX file"},
                                           {SurfaceKind::kVtk, ".vtk", "a VTK legacy file"},
                                           {SurfaceKind::kVtp, ".vtp", "VTK XML polydata"},
                                           {SurfaceKind::kVtu, ".vtu", "a VTK XML unstructured grid"},
                                           {SurfaceKind::kMsh, ".msh", "a Gmsh mesh"}}};

/// Formats that people try, and what to do instead.
constexpr std::array<std::pair<const char*, const char*>, 14> kOthers{
    {{".3mf", "3MF is not read: export STL or PLY from the program that wrote it"},
     {".step", "STEP holds exact shapes, not triangles: export STL with a fine tolerance"},
     {".stp", "STEP holds exact shapes, not triangles: export STL with a fine tolerance"},
     {".igs", "IGES holds exact shapes, not triangles: export STL with a fine tolerance"},
     {".iges", "IGES holds exact shapes, not triangles: export STL with a fine tolerance"},
     {".blend", "Blender scenes are not read: export glTF, PLY or STL"},
     {".dae", "COLLADA is not read: export glTF, PLY or STL"},
     {".3ds", "3DS is not read: export glTF, PLY or STL"},
     {".usdz", "USD is not read: export glTF, PLY or STL"},
     {".wrl", "VRML is not read: export PLY or STL"},
     {".vti", "VTK image data is a volume: give it as NRRD, NIfTI or MetaImage"},
     {".vtm", "VTK multi-block files only point at others: give one of its .vtp files"},
     {".inp", "Abaqus input is not read: export Gmsh .msh or VTK"},
     {".mesh", "Medit meshes are not read: export Gmsh .msh or VTK"}}};

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return extension;
}

const char* kind_name(SurfaceKind kind) {
  return std::find_if(kKinds.begin(), kKinds.end(), [&](const KindName& entry) { return entry.kind == kind; })->name;
}

std::string_view without_blanks(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view() : bytes.substr(first);
}

bool is_binary_stl(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() < 84) return false;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  return bytes.size() == 84 + std::uint64_t{50} * count;
}

bool is_text(std::string_view bytes) { return bytes.substr(0, 4096).find('\0') == std::string_view::npos; }

std::string xml_kind(std::string_view text) {
  if (text.find("<VTKFile") != std::string_view::npos) {
    if (text.find("\"PolyData\"") != std::string_view::npos) return "VTK XML polydata";
    if (text.find("\"UnstructuredGrid\"") != std::string_view::npos) return "a VTK XML unstructured grid";
    return "another kind of VTK XML file";
  }
  if (text.find("<html") != std::string_view::npos || text.find("<HTML") != std::string_view::npos)
    return "a web page (perhaps a failed download)";
  return "an XML file";
}

/// A line of an OBJ: "v 1 2 3" somewhere at the start of a line.
bool has_obj_vertex(std::string_view bytes) {
  return bytes.starts_with("v ") || bytes.find("\nv ") != std::string_view::npos ||
         bytes.find("\nv\t") != std::string_view::npos;
}

bool matches(SurfaceKind kind, std::string_view bytes) {
  const std::string_view text = without_blanks(bytes.substr(0, 4096));
  switch (kind) {
    case SurfaceKind::kStl:
      return is_binary_stl(bytes) || looks_like(bytes).empty() || text.starts_with("solid");
    case SurfaceKind::kPly:
      return bytes.starts_with("ply\n") || bytes.starts_with("ply\r");
    case SurfaceKind::kObj:
      return is_text(bytes) && (looks_like(bytes).empty() || looks_like(bytes) == kind_name(kind));
    case SurfaceKind::kOff:
      return text.substr(0, 16).find("OFF") != std::string_view::npos;
    case SurfaceKind::kGlb:
      return bytes.starts_with("glTF");
    case SurfaceKind::kGltf:
      return text.starts_with('{');
    case SurfaceKind::kFbx:
      return bytes.starts_with("Kaydara FBX Binary") || text.starts_with("; FBX");
    case SurfaceKind::kVtk:
      return bytes.starts_with("# vtk DataFile");
    case SurfaceKind::kVtp:
      return text.starts_with('<') && xml_kind(text) == kind_name(kind);
    case SurfaceKind::kVtu:
      return text.starts_with('<') && xml_kind(text) == kind_name(kind);
    case SurfaceKind::kMsh:
      return text.starts_with('$');
  }
  return false;
}

}  // namespace

std::optional<SurfaceKind> kind_by_extension(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  for (const KindName& entry : kKinds)
    if (extension == entry.extension) return entry.kind;
  return std::nullopt;
}

std::string looks_like(std::string_view bytes) {
  constexpr std::array<std::pair<std::string_view, const char*>, 14> kSignatures{
      {{"ply\n"sv, "a PLY file"},
       {"ply\r"sv, "a PLY file"},
       {"glTF"sv, "a binary glTF file"},
       {"Kaydara FBX Binary"sv, "an FBX file"},
       {"# vtk DataFile"sv, "a VTK legacy file"},
       {"PK\3\4"sv, "a zip archive (3MF, or a packed file: unpack it first)"},
       {"\x1f\x8b"sv, "a gzip file (unpack it first)"},
       {"\x89PNG"sv, "a PNG picture"},
       {"\xff\xd8\xff"sv, "a JPEG picture"},
       {"ISO-10303-21"sv, "a STEP file"},
       {"NRRD"sv, "an NRRD volume"},
       {"\x5c\x01\0\0"sv, "a NIfTI volume"},
       {"%PDF"sv, "a PDF document"},
       {"BLENDER"sv, "a Blender scene"}}};
  for (const auto& [signature, name] : kSignatures)
    if (bytes.starts_with(signature)) return name;
  if (bytes.size() > 132 && bytes.substr(128, 4) == "DICM") return "a DICOM file";
  if (is_binary_stl(bytes)) return "an STL file";
  const std::string_view text = without_blanks(bytes.substr(0, 4096));
  if (text.starts_with("; FBX")) return "an FBX file";
  if (text.starts_with("OFF") || text.starts_with("COFF") || text.starts_with("NOFF")) return "an OFF file";
  if (text.starts_with("$MeshFormat") || text.starts_with("$NOD")) return "a Gmsh mesh";
  if (text.starts_with('<')) return xml_kind(text);
  if (!is_text(text)) return {};
  if (text.starts_with("solid")) return "an STL file";
  if (text.starts_with('{')) return "a JSON file (glTF?)";
  if (has_obj_vertex(bytes.substr(0, 65536))) return "a Wavefront OBJ file";
  return {};
}

SurfaceKind surface_kind(const std::filesystem::path& path, std::string_view bytes) {
  const std::string file = path.string(), extension = lower_extension(path);
  const auto kind = kind_by_extension(path);
  const std::string found = looks_like(bytes);
  const std::string seems = found.empty() ? "" : "; it looks like " + found;
  if (!kind) {
    for (const auto& [other, advice] : kOthers)
      if (extension == other) throw InputError(file + ": " + advice);
    throw InputError(
        file + ": extension: surfaces are read from .stl .ply .obj .off .glb .gltf .fbx .vtk .vtp .vtu .msh" + seems);
  }
  if (bytes.empty()) throw InputError(file + ": the file is empty");
  if (!matches(*kind, bytes))
    throw InputError(
        file + ": signature: the name promises " + kind_name(*kind) +
        (found.empty() ? ", but it does not begin like one" : ", but it looks like " + found + ": rename it if it is"));
  return *kind;
}

}  // namespace trocar
