// One sheet of a scene as it is laid out, as it is seen and as it is recorded.
//
// The sheet is computed on its middle surface (elastic_sheet.h) and seen as a shell of its thickness. What parts it is
// kept in bytes (TissueShape::changes): the edges, by nodes, so that playback parts the same ones. T, SI. Thread:
// tissue task; a playback belongs to one thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tissue/surface_snapshot.h"
#include "tissue/thin/elastic_sheet.h"
#include "tissue/thin/sheet_setup.h"
#include "tissue/tissue_shape.h"

namespace trocar {

struct SheetChange {
  std::int32_t sheet = 0;  ///< index in the scene
  std::vector<SheetEdge> edges;
};

std::string sheet_change_bytes(const SheetChange& change);
bool is_sheet_change(std::string_view bytes);
/// @throws InputError: bytes that are none
SheetChange parse_sheet_change(std::string_view bytes);

/// The shell: above, below, and the rim between.
class SheetSurface {
 public:
  explicit SheetSurface(const SheetSetup& setup);

  /// The middle surface came apart into these triangles. @param copied of each new node: of which one
  void part(std::span<const std::array<std::int32_t, 3>> triangles, std::span<const std::int32_t> copied);
  SurfacePtr at(std::span<const Vec3> middle_T) const;

 private:
  void grow();
  std::vector<Vec3> shell(std::span<const Vec3> middle_T) const;

  double thickness_m_;
  TriangleSurface middle_;  ///< drawn
  SurfacePtr rest_;
};

/// The shells as they lie before anything has been done to them.
std::vector<SurfacePtr> drawn_sheets(std::span<const SheetSetup> sheets);

/// Shells from recorded nodes.
class SheetPlayback {
 public:
  /// @param changes of the recording, those of sheets are taken. @throws InputError: one that is none of these sheets
  SheetPlayback(std::span<const SheetSetup> sheets, std::span<const std::string> changes);

  std::size_t nodes() const;
  /// @param nodes_T as many as nodes(), sheet after sheet
  std::vector<SurfacePtr> at(std::span<const NodePlace> nodes_T) const;

 private:
  struct Sheet {
    std::vector<std::array<std::int32_t, 3>> triangles;
    std::size_t nodes = 0;
    SheetSurface seen;
  };
  std::vector<Sheet> sheets_;
};

}  // namespace trocar
