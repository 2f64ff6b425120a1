// The film of blood and water on an organ's surface: how it runs down, gathers, drips, dries, is rinsed and sucked.
//
// A volume of blood, of water and of dried blood at every vertex, its height the volume over the vertex's area at rest.
// Volumes are what is kept, so nothing is lost when the tissue moves or its surface grows.
//
//   flow       lubrication: flux a width q = rho g h^3 / (3 mu) times the fall of phi = z + n_z h along the DEFORMED
//              surface, in finite volumes on the mesh's edges (cotangent weights). h is what does not cling; h^2 is
//              limited, and so is what leaves a vertex in a step, so that the explicit step never overshoots. Dry
//              places are wetted by a film of some thickness only: rivulets. Blood and water go together, mixed: water
//              dilutes, and what runs off carries blood away.
//   dripping   an overhanging place, the lowest of those that face down, and the rim of an open surface let go of what
//              surface tension does not hold; it falls into the pool, a basin with a level floor under the organ
//   drying     blood dries to a stain, water evaporates, water dissolves the stain again; exponentials
//   shown      blood 1 - exp(-h / h0) (absorption), wet alike
// Only vertices with liquid cost anything; those where nothing moves are looked at every sixteenth step.
//
// The account closes: blood given = film + dried + pool + sucked; water given = film + pool + sucked + evaporated.
// Frame T (gravity along -z), m, m3, s. Thread: tissue task. Same input, same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "tissue/mesh/surface/surface_growth.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct SurfaceFilmOptions {
  double blood_pa_s = 3.5e-3;       ///< viscosity of whole blood at high shear rate, 37 C; unchecked
  double water_pa_s = 0.7e-3;       ///< at 37 C
  double density_kg_per_m3 = 1040;  ///< between water and blood (1060)
  double cling_m = 20e-6;           ///< layer that does not run; unchecked
  double advance_m = 0.2e-3;     ///< what runs is thinner: it does not wet a dry place (pinned contact line); unchecked
  double thickest_m = 0.3e-3;    ///< h^2 of the flux is not larger: there lubrication ends (0.1 m/s on a wall)
  double most_share = 0.5;       ///< of what can run, that leaves a vertex in a step
  double steepest_rise = 0.2;    ///< least n_z with which liquid rises: a cleft between walls fills
  double overhang = -0.3;        ///< n_z below which a thick film lets go wherever it is; unchecked
  double hang_m = 0.4e-3;        ///< layer that hangs under a place; unchecked
  double drip_s = 0.3;           ///< time constant of what drips; unchecked
  double dry_s = 400;            ///< time constant of a thin film of blood drying; unchecked
  double dissolve_s = 15;        ///< of a stain under water; unchecked
  double evaporate_s = 240;      ///< of a thin film of water in moist gas; unchecked
  double blood_shown_m = 60e-6;  ///< h0: whole blood absorbs green light within some 50 um; unchecked
  double wet_shown_m = 15e-6;
  double pool_area_m2 = 0.01;                                 ///< of the basin: 100 mL stand 10 mm high; unchecked
  double floor_m = std::numeric_limits<double>::quiet_NaN();  ///< z of its floor; NaN: the lowest vertex at rest
};

/// Two liquids, m3.
struct Liquids {
  double blood = 0, water = 0;
  double sum() const { return blood + water; }
};

/// Where everything is that has been given, m3.
struct FilmAccount {
  Liquids given, film, pool, sucked;
  double dried = 0, evaporated = 0;
  double blood_missing() const { return given.blood - film.blood - pool.blood - sucked.blood - dried; }
  double water_missing() const { return given.water - film.water - pool.water - sucked.water - evaporated; }
};

/// A jet of water from a tip.
struct Irrigation {
  Vec3 tip_T = Vec3::Zero(), direction_T = -Vec3::UnitZ();
  double flow_m3_per_s = 16.7e-6;  ///< 1 L/min: the least that irrigation systems of operating rooms give
  double half_angle_rad = 0.35;
  double reach_m = 0.08;
};

struct Suction {
  Vec3 tip_T = Vec3::Zero();
  double radius_m = 0.006;       ///< round the tip of a tube of 5 mm; unchecked
  double most_m3_per_s = 30e-6;  ///< 1.8 L/min; unchecked
};

class SurfaceFilm {
 public:
  explicit SurfaceFilm(const TriangleSurface& rest_T, const SurfaceFilmOptions& options = {});

  /// Onto a vertex. Volumes that are not positive, or vertices that are not there, are left out (returns 0).
  /// @returns what was taken, m3
  double add_blood(std::int32_t vertex, double volume_m3);
  double add_water(std::int32_t vertex, double volume_m3);
  double add_to_pool(const Liquids& volume);
  /// Water onto what faces the jet; what meets nothing ends in the pool.
  /// @param vertices_T of the surface as it is now, of every function here
  void irrigate(const Irrigation& jet, std::span<const Vec3> vertices_T, double step_s);
  /// @returns what went into the tube in this step, m3
  Liquids suck(const Suction& suction, std::span<const Vec3> vertices_T, double step_s);
  void step(std::span<const Vec3> vertices_T, double step_s);
  /// The surface has got more vertices and other triangles; those that were there keep their numbers and nearly all of
  /// their liquid: a new vertex takes over a share from those that it comes from.
  /// @param inside of each triangle: the wall of a cut. Liquid fills a cut and does not drip out of it; empty: none is
  void grow(const TriangleSurface& rest_T, const std::vector<VertexOrigin>& added,
            const std::vector<bool>& inside = {});
  void reset();

  const std::vector<float>& blood() const { return blood_shown_; }  ///< 0 .. 1 at every vertex
  const std::vector<float>& wet() const { return wet_shown_; }
  Liquids at(std::int32_t vertex) const;  ///< film on it, m3
  double stain_m3(std::int32_t vertex) const { return cells_[static_cast<std::size_t>(vertex)].dried; }
  double height_m(std::int32_t vertex) const;  ///< of the film
  double area_m2(std::int32_t vertex) const { return cells_[static_cast<std::size_t>(vertex)].area; }
  double pool_level_m() const;  ///< z of the pool's surface
  std::size_t wet_vertices() const { return active_.size(); }
  FilmAccount account() const;
  std::size_t vertices() const { return cells_.size(); }
  /// Area-weighted, not unit, of a vertex of the surface as it is now.
  Vec3 area_vector(std::int32_t vertex, std::span<const Vec3> vertices_T) const;

 private:
  struct Cell {
    double blood = 0, water = 0, dried = 0;  ///< m3
    double area = 0;                         ///< m2, at rest
    float rise = 1;                          ///< of phi with height
    bool faces_down = false, overhangs = false, rim = false, active = false, sloped = false;
  };
  /// What a higher neighbour reads of a vertex, as it is at the beginning of a step.
  struct Foot {
    float level_m = 0;  ///< phi, from the floor
    float area = 0;     ///< m2
    bool wet = false;
  };
  struct Neighbour {
    std::int32_t vertex = 0;
    float weight = 0;  ///< half the sum of the cotangents of the angles opposite the edge
  };
  double height(const Cell& cell) const { return (cell.blood + cell.water) / cell.area; }
  void find_levels(std::span<const Vec3> vertices_T);
  void activate(std::int32_t vertex);
  void build(const TriangleSurface& rest_T);
  void find_floor(const TriangleSurface& rest_T);
  /// @param fresh of each vertex: whether its triangles have changed
  void build_corners(const std::vector<char>& fresh);
  void build_areas(const TriangleSurface& rest_T, const std::vector<char>& fresh);
  void build_neighbours(const TriangleSurface& rest_T, const std::vector<char>& fresh);
  void add_neighbours(std::size_t v, const TriangleSurface& rest_T, std::vector<Neighbour>& out);
  void find_slope(std::size_t vertex, std::span<const Vec3> vertices_T);
  /// Lets liquid run from a vertex to its lower neighbours. @returns whether it has any
  bool run_down(std::size_t vertex, double moving_m, double step_s);
  void drip(std::size_t vertex, double step_s);
  void dry(Cell& cell, double step_s) const;
  void settle(double step_s);
  void show(std::size_t vertex);

  SurfaceFilmOptions options_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::vector<bool> inside_;  ///< of each triangle: the wall of a cut
  std::vector<Cell> cells_;
  std::vector<std::int32_t> neighbour_begin_, corner_begin_, corner_triangles_;
  std::vector<Neighbour> neighbours_;
  std::vector<Foot> feet_;
  std::vector<Liquids> change_;       ///< of this step, at every vertex
  std::vector<std::int32_t> active_;  ///< vertices with liquid, as they became wet
  std::vector<float> blood_shown_, wet_shown_;
  Liquids given_, pool_, sucked_;
  double evaporated_ = 0, floor_m_ = 0;
  std::uint32_t steps_ = 0;
};

}  // namespace trocar
