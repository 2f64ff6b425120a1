#include "tissue/imaging/labels/segmentation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "haptics/input_error.h"
#include "tissue/imaging/labels/itk_region.h"
#include "tissue/imaging/labels/label_grid.h"
#include "tissue/imaging/labels/mask_pieces.h"
#include "tissue/imaging/volumes/volume_frame.h"

namespace trocar {
namespace {

constexpr std::uint64_t kMostRegion = std::uint64_t{1} << 27;    // of masks and piece numbers: 0.7 GiB
constexpr std::uint64_t kMostSmoothed = std::uint64_t{1} << 25;  // of values in three copies: 0.4 GiB
constexpr double kBodyHu = -300;                                 // fat is above, lung and air below
constexpr int kFlowSteps = 5;
constexpr double kMostOfImage = 0.5;         // without a seed: more than this share is no organ
constexpr std::int64_t kMostTunnels = 5000;  // an organ has a few, noise through a whole image hundreds of thousands

/// A block of the image: indices low..high, both inside it.
struct GrownRegion {
  Eigen::Array3i low, high;
  Eigen::Array3i extent() const { return high - low + 1; }
};

struct Work {
  const ImageVolume& image;
  const SegmentationOptions& options;
  const Progress& progress;
  std::vector<std::string> notes;
  GrownRegion region;
  RegionShape shape;
  std::vector<std::uint8_t> mask;
  Eigen::Array3i seed = Eigen::Array3i::Zero();  ///< in the region

  std::size_t offset(const Eigen::Array3i& place) const {
    return static_cast<std::size_t>(place[0]) +
           static_cast<std::size_t>(shape.size[0]) *
               (static_cast<std::size_t>(place[1]) +
                static_cast<std::size_t>(shape.size[1]) * static_cast<std::size_t>(place[2]));
  }
};

template <typename Visit>
void each_voxel(const GrownRegion& region, Visit visit) {
  for (int k = region.low[2]; k <= region.high[2]; ++k)
    for (int j = region.low[1]; j <= region.high[1]; ++j)
      for (int i = region.low[0]; i <= region.high[0]; ++i) visit(i, j, k);
}

GrownRegion whole(const ImageVolume& image) {
  return {Eigen::Array3i::Zero(), Eigen::Array3i(image.size[0], image.size[1], image.size[2]) - 1};
}

void check_options(const SegmentationOptions& options) {
  if (!std::isfinite(options.low) || !std::isfinite(options.high) || options.low > options.high)
    throw InputError("--threshold: the lower value must not be above the upper one, and both must be numbers");
  for (const double length : {options.opening_mm, options.closing_mm, options.reach_mm})
    if (!(length >= 0 && length <= 1000)) throw InputError("opening, closing and reach: 0 to 1000 mm are wanted");
  if (options.keep == Keep::kSeeded && !options.seed_ras_mm)
    throw InputError("--seed-point: to keep the piece at a seed, a seed is wanted (x,y,z in RAS mm)");
  if (options.seed_ras_mm && !options.seed_ras_mm->allFinite()) throw InputError("--seed-point: not three numbers");
}

/// Index of the voxel that holds the seed. @throws InputError when it lies outside
Eigen::Array3i seed_voxel(const ImageVolume& image, const Eigen::Vector3d& seed) {
  const Eigen::Vector3d index = image.index_to_ras_mm.inverse() * seed;
  const GrownRegion all = whole(image);
  for (int axis = 0; axis < 3; ++axis)
    if (!(index[axis] >= -0.5 && index[axis] <= all.high[axis] + 0.5)) {
      const Eigen::Vector3d first = image.index_to_ras_mm.translation();
      const Eigen::Vector3d last = image.index_to_ras_mm * all.high.matrix().cast<double>();
      throw InputError("--seed-point " + plain(seed[0]) + "," + plain(seed[1]) + "," + plain(seed[2]) +
                       ": outside the image, which reaches from (" + plain(first[0]) + ", " + plain(first[1]) + ", " +
                       plain(first[2]) + ") to (" + plain(last[0]) + ", " + plain(last[1]) + ", " + plain(last[2]) +
                       ") in RAS mm");
    }
  return index.array().round().cast<int>().max(0).min(all.high);
}

/// The block round the seed's reach, or round all voxels in the window; a margin on each side where the image has one.
GrownRegion region_of(const ImageVolume& image, const SegmentationOptions& options) {
  const GrownRegion all = whole(image);
  const Eigen::Array3d edges = image.index_to_ras_mm.linear().colwise().norm().transpose().array();
  GrownRegion box{all.high, all.low};
  if (options.seed_ras_mm && options.reach_mm > 0) {
    const Eigen::Array3i seed = seed_voxel(image, *options.seed_ras_mm);
    const Eigen::Array3i reach = (options.reach_mm / edges).ceil().cast<int>() + 1;
    box = {seed - reach, seed + reach};
  } else if (options.smooth) {
    box = all;
  } else {
    each_voxel(all, [&](int i, int j, int k) {
      const float value = image.values[image.offset(i, j, k)];
      if (!(value >= options.low && value <= options.high)) return;
      box.low = box.low.min(Eigen::Array3i(i, j, k));
      box.high = box.high.max(Eigen::Array3i(i, j, k));
    });
    if ((box.low > box.high).any()) return box;
  }
  const Eigen::Array3i margin = (std::max(options.closing_mm, options.opening_mm) / edges).ceil().cast<int>() + 1;
  return {(box.low - margin).max(all.low), (box.high + margin).min(all.high)};
}

[[noreturn]] void refuse_empty_window(const ImageVolume& image, const SegmentationOptions& options) {
  const auto [lowest, highest] = std::minmax_element(image.values.begin(), image.values.end());
  throw InputError("--threshold " + plain(options.low) + "," + plain(options.high) +
                   ": no voxel holds such a value; the image has " + plain(*lowest) + " to " + plain(*highest));
}

void choose_region(Work& work) {
  work.region = region_of(work.image, work.options);
  if ((work.region.low > work.region.high).any()) refuse_empty_window(work.image, work.options);
  const Eigen::Array3i extent = work.region.extent();
  const std::uint64_t count = extent.cast<std::uint64_t>().prod();
  if (count > (work.options.smooth ? kMostSmoothed : kMostRegion))
    throw InputError("--threshold: " + std::to_string(count) + " voxels to look at are too many" +
                     (work.options.smooth ? " to smooth" : "") +
                     ": give --seed-point with a reach, or a narrower window");
  for (int axis = 0; axis < 3; ++axis) {
    work.shape.size[static_cast<std::size_t>(axis)] = extent[axis];
    work.shape.spacing_mm[static_cast<std::size_t>(axis)] = work.image.index_to_ras_mm.linear().col(axis).norm();
  }
}

void threshold(Work& work) {
  report(work.progress, "threshold", -1);
  std::vector<float> values;
  values.reserve(work.offset({0, 0, work.shape.size[2]}));
  each_voxel(work.region,
             [&](int i, int j, int k) { values.push_back(work.image.values[work.image.offset(i, j, k)]); });
  if (work.options.smooth) {
    report(work.progress, "smoothing", -1);
    curvature_flow(values, work.shape, kFlowSteps);
    work.notes.push_back("values smoothed by " + std::to_string(kFlowSteps) +
                         " steps of curvature flow before the threshold");
  }
  work.mask =
      window_mask(values, work.shape, static_cast<float>(work.options.low), static_cast<float>(work.options.high));
  if (!work.options.seed_ras_mm || work.options.reach_mm <= 0) return;
  std::size_t voxel = 0;
  each_voxel(work.region, [&](int i, int j, int k) {
    const Eigen::Vector3d place = work.image.index_to_ras_mm * Eigen::Vector3d(i, j, k);
    if ((place - *work.options.seed_ras_mm).norm() > work.options.reach_mm) work.mask[voxel] = 0;
    ++voxel;
  });
}

std::size_t marked(const std::vector<std::uint8_t>& mask) {
  return static_cast<std::size_t>(std::count(mask.begin(), mask.end(), std::uint8_t{1}));
}

/// The voxel of the mask nearest to the seed, which an opening may have taken away. @param reach_mm how far to look
Eigen::Array3i near_seed(const Work& work, const Eigen::Array3i& seed, double reach_mm) {
  Eigen::Array3i best = seed;
  double least = std::numeric_limits<double>::infinity();
  const Eigen::Array3d edges(work.shape.spacing_mm[0], work.shape.spacing_mm[1], work.shape.spacing_mm[2]);
  const Eigen::Array3i reach = (reach_mm / edges).ceil().cast<int>();
  const GrownRegion near{(seed - reach).max(0), (seed + reach).min(work.region.extent() - 1)};
  each_voxel(near, [&](int i, int j, int k) {
    const double distance = ((Eigen::Array3i(i, j, k) - seed).cast<double>() * edges).matrix().norm();
    if (work.mask[work.offset({i, j, k})] == 0 || distance > reach_mm + 1e-6 || distance >= least) return;
    least = distance;
    best = {i, j, k};
  });
  return best;
}

/// Noise may put the seed's own voxel outside the window: its neighbours within two voxels stand in for it.
void settle_seed(Work& work) {
  const Eigen::Array3i place = seed_voxel(work.image, *work.options.seed_ras_mm);
  const double edge = *std::max_element(work.shape.spacing_mm.begin(), work.shape.spacing_mm.end());
  work.seed = near_seed(work, place - work.region.low, 2 * edge);
  const std::string held = plain(work.image.values[work.image.offset(place[0], place[1], place[2])]);
  const bool inside = (work.seed >= 0).all() && (work.seed < work.region.extent()).all();
  if (!inside || work.mask[work.offset(work.seed)] == 0)
    throw InputError("--seed-point: its voxel holds " + held + ", outside the window " + plain(work.options.low) +
                     " to " + plain(work.options.high) + ", and so do its neighbours");
  if ((work.seed != place - work.region.low).any())
    work.notes.push_back("the seed's own voxel holds " + held +
                         ", outside the window; a neighbour in it was taken instead");
}

void open_mask(Work& work) {
  if (work.options.opening_mm <= 0) return;
  report(work.progress, "opening", -1);
  const std::size_t before = marked(work.mask);
  erode(work.mask, work.shape, work.options.opening_mm);
  dilate(work.mask, work.shape, work.options.opening_mm);
  const std::size_t after = marked(work.mask);
  if (after == 0)
    throw InputError("--opening " + plain(work.options.opening_mm) +
                     ": nothing is left; nothing that thick lies in the window");
  work.notes.push_back("opened by a ball of " + plain(work.options.opening_mm) + " mm, which took away " +
                       std::to_string(before - after) + " voxels");
}

void choose_piece(Work& work) {
  report(work.progress, "connected pieces", -1);
  if (work.options.seed_ras_mm) {
    const Eigen::Array3i start = near_seed(work, work.seed, work.options.opening_mm);
    if (work.mask[work.offset(start)] == 0)
      throw InputError(
          "--seed-point: the opening took away everything round it; choose a seed deeper inside or a smaller ball");
    keep_connected(work.mask, work.shape, {start[0], start[1], start[2]});
    work.notes.push_back("kept what hangs together with the seed");
  } else if (work.options.keep == Keep::kLargest) {
    const std::vector<std::size_t> pieces = keep_largest(work.mask, work.shape, work.progress);
    work.notes.push_back("kept the largest of " + std::to_string(pieces.size()) + " connected pieces" +
                         (pieces.size() > 1 ? "; the next one has " + std::to_string(pieces[1]) + " voxels" : ""));
  }
}

void close_mask(Work& work) {
  if (work.options.closing_mm > 0) {
    report(work.progress, "closing", -1);
    const std::size_t before = marked(work.mask);
    dilate(work.mask, work.shape, work.options.closing_mm);
    erode(work.mask, work.shape, work.options.closing_mm);
    work.notes.push_back("closed by a ball of " + plain(work.options.closing_mm) + " mm, which added " +
                         std::to_string(marked(work.mask) - before) + " voxels");
  }
  if (!work.options.fill_holes) return;
  report(work.progress, "filling holes", -1);
  const std::size_t filled = fill_holes(work.mask, work.shape, work.progress);
  if (filled > 0) work.notes.push_back("filled holes of " + std::to_string(filled) + " voxels in all");
}

std::string percent(std::size_t part, std::size_t all) {
  return plain(std::round(1000.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1))) /
               10) +
         " %";
}

std::string window_words(const SegmentationOptions& options) {
  return "--threshold " + plain(options.low) + " " + plain(options.high);
}

/// Without a seed, a window that most of the image lies in marks no organ: said before any further work is done on it.
void refuse_most_of_image(const Work& work) {
  const std::size_t inside = marked(work.mask);
  if (work.options.seed_ras_mm ||
      static_cast<double>(inside) <= kMostOfImage * static_cast<double>(work.image.values.size()))
    return;
  throw InputError(window_words(work.options) + ": " + percent(inside, work.image.values.size()) +
                   " of the image's voxels hold such values: that is no organ; narrow the window, or give --seed-point "
                   "in the organ and --reach");
}

/// Noise hangs together as a sponge, of which no surface can be made in sensible time.
void refuse_sponge(const Work& work) {
  report(work.progress, "counting tunnels", -1);
  const std::int64_t tunnels = tunnels_of(work.mask, work.shape);
  if (tunnels > kMostTunnels)
    throw InputError(window_words(work.options) + ": the piece is a sponge with about " + std::to_string(tunnels) +
                     " tunnels: the window lies in the noise; try --smooth, --opening 3, another window, or "
                     "--seed-point with --reach");
}

struct Extent {
  std::size_t inside = 0, body = 0, border = 0, at_reach = 0;
};

/// Fills the labels of the result and counts what the notes tell.
Extent write_labels(const Work& work, LabelVolume& result) {
  Extent extent;
  const Eigen::Array3i last = whole(work.image).high;
  const double edge = *std::max_element(work.shape.spacing_mm.begin(), work.shape.spacing_mm.end());
  const bool bounded = work.options.seed_ras_mm && work.options.reach_mm > 0;
  std::size_t voxel = 0;
  each_voxel(work.region, [&](int i, int j, int k) {
    if (work.mask[voxel++] == 0) return;
    const Eigen::Array3i place(i, j, k);
    result.labels[result.offset(i, j, k)] = 1;
    ++extent.inside;
    extent.border += (place == 0).any() || (place == last).any() ? 1 : 0;
    if (bounded)
      extent.at_reach +=
          (work.image.index_to_ras_mm * place.matrix().cast<double>() - *work.options.seed_ras_mm).norm() >
                  work.options.reach_mm - edge
              ? 1
              : 0;
  });
  for (const float value : work.image.values) extent.body += value > kBodyHu ? 1 : 0;
  return extent;
}

void tell_extent(const Work& work, const Extent& extent, std::vector<std::string>& notes) {
  const bool hounsfield = work.image.modality == "CT" || certainly_hounsfield(work.image);
  const double volume_ml =
      static_cast<double>(extent.inside) * std::abs(work.image.index_to_ras_mm.linear().determinant()) * 1e-3;
  notes.push_back(std::to_string(extent.inside) + " voxels, " + plain(volume_ml) + " mL, " +
                  percent(extent.inside, work.image.values.size()) + " of the image" +
                  (hounsfield ? " and " + percent(extent.inside, extent.body) + " of the body in it" : ""));
  if (extent.border > 0)
    notes.push_back("it touches the border of the image with " + std::to_string(extent.border) +
                    " voxels: either the image cuts the organ, or it leaked");
  if (extent.at_reach > 0)
    notes.push_back("warning: it fills up to its reach of " + plain(work.options.reach_mm) +
                    " mm: probably a leak into neighbours of equal values");
  if (static_cast<double>(extent.inside) > work.options.leak_share * static_cast<double>(work.image.values.size()))
    notes.push_back("warning: more than " + plain(100 * work.options.leak_share) +
                    " % of the image: probably a leak into neighbours of equal values");
}

}  // namespace

LabelVolume segment(const ImageVolume& image, const SegmentationOptions& options, const Progress& progress) {
  check_options(options);
  Work work{
      .image = image, .options = options, .progress = progress, .notes = {}, .region = {}, .shape = {}, .mask = {}};
  work.notes.push_back(
      "marked by values from " + plain(options.low) + " to " + plain(options.high) +
      ", not by anatomy: what has equal values and touches is one piece; look at the result before use");
  if (options.seed_ras_mm) seed_voxel(image, *options.seed_ras_mm);
  choose_region(work);
  threshold(work);
  if (options.seed_ras_mm) settle_seed(work);
  if (marked(work.mask) == 0) refuse_empty_window(image, options);
  refuse_most_of_image(work);
  open_mask(work);
  choose_piece(work);
  close_mask(work);
  refuse_sponge(work);
  LabelVolume result{.size = image.size, .labels = {}, .index_to_ras_mm = image.index_to_ras_mm, .notes = {}};
  result.labels.assign(image.values.size(), 0);
  tell_extent(work, write_labels(work, result), work.notes);
  if (skew_of(image.index_to_ras_mm) > kSkewTolerance) {
    result = resampled_to(result, squared_grid(grid_of(result)), progress);
    work.notes.push_back("the image's axes are not at right angles; the result was straightened by the nearest voxel");
  }
  result.notes = std::move(work.notes);
  return result;
}

double dice(const LabelVolume& a, int label_a, const LabelVolume& b, int label_b) {
  if (a.size != b.size) throw InputError("Dice: the two label maps have different grids");
  std::size_t both = 0, sum = 0;
  for (std::size_t voxel = 0; voxel < a.labels.size(); ++voxel) {
    const bool in_a = a.labels[voxel] == label_a, in_b = b.labels[voxel] == label_b;
    both += in_a && in_b ? 1 : 0;
    sum += (in_a ? 1U : 0U) + (in_b ? 1U : 0U);
  }
  return sum == 0 ? 1 : 2.0 * static_cast<double>(both) / static_cast<double>(sum);
}

}  // namespace trocar
