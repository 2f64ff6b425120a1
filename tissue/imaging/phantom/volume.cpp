// From shapes to voxels: labels at voxel centres, HU with partial volume.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "haptics/input_error.h"
#include "tissue/imaging/phantom/phantom_labels.h"
#include "tissue/imaging/phantom/scanner.h"
#include "tissue/imaging/phantom/structures.h"

namespace trocar {
namespace {

using phantom::Box;
using phantom::Patient;
using phantom::Structure;
using phantom::Vec;

constexpr int kBlock = 6;
constexpr float kEdgeHu = 20;  ///< neighbours that differ by more are sampled finely

struct Grid {
  std::array<int, 3> size{};
  Vec low;
  double voxel;

  std::size_t offset(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
  Vec centre(int i, int j, int k) const { return low + voxel * Vec(i, j, k); }
  bool holds(const Eigen::Array3i& at) const {
    return (at >= 0).all() && at[0] < size[0] && at[1] < size[1] && at[2] < size[2];
  }
};

struct Image {
  Grid grid;
  std::vector<std::uint16_t> labels;
  std::vector<float> hounsfield;
  std::vector<std::uint8_t> fine;  ///< 1: sampled finely for partial volume
};

using Candidates = std::vector<const Structure*>;

/// What may own a point of the box, in order. The distances are approximate: they are trusted within a factor of two.
Candidates candidates_in(const Patient& patient, const Box& box) {
  Candidates found;
  const double far = box.diagonal().norm();
  for (const Structure& each : patient.structures) {
    if (!each.box.intersects(box) || (each.misses && each.misses(box))) continue;
    const double d = each.measured ? each.distance(box.center()) : 0;
    if (d < far) found.push_back(&each);
    if (d < -far) break;
  }
  return found;
}

struct Sample {
  std::uint16_t label;
  double hounsfield;
};

Sample sample_at(const Candidates& candidates, const Vec& p) {
  for (const Structure* each : candidates) {
    if (!each->box.contains(p)) continue;
    const double d = each->distance(p);
    if (d >= 0) continue;
    const bool core = each->core_label != 0 && d < -each->core_depth;
    return {core ? each->core_label : each->label, each->hounsfield(p, d)};
  }
  return {0, -1000};
}

/// Calls work(candidates, first, last) for every block of the grid.
template <typename Work>
void for_each_block(const Patient& patient, const Grid& grid, const Progress& progress, const char* stage, Work work) {
  for (int k = 0; k < grid.size[2]; k += kBlock) {
    report(progress, stage, static_cast<double>(k) / grid.size[2]);
    for (int j = 0; j < grid.size[1]; j += kBlock)
      for (int i = 0; i < grid.size[0]; i += kBlock) {
        const std::array<int, 3> first{i, j, k};
        std::array<int, 3> last{};
        for (std::size_t axis = 0; axis < 3; ++axis) last[axis] = std::min(first[axis] + kBlock, grid.size[axis]);
        const Vec rim = Vec::Constant(0.5 * grid.voxel);
        const Box box(grid.centre(i, j, k) - rim, grid.centre(last[0] - 1, last[1] - 1, last[2] - 1) + rim);
        work(candidates_in(patient, box), first, last);
      }
  }
}

void sample_centres(const Patient& patient, Image& image, const Progress& progress) {
  const Grid& grid = image.grid;
  for_each_block(patient, grid, progress, "drawing organs",
                 [&](const Candidates& candidates, const auto& first, const auto& last) {
                   for (int k = first[2]; k < last[2]; ++k)
                     for (int j = first[1]; j < last[1]; ++j)
                       for (int i = first[0]; i < last[0]; ++i) {
                         const Sample sample = sample_at(candidates, grid.centre(i, j, k));
                         const std::size_t at = grid.offset(i, j, k);
                         image.labels[at] = sample.label;
                         image.hounsfield[at] = static_cast<float>(sample.hounsfield);
                       }
                 });
}

void mark_edges(Image& image) {
  const auto& size = image.grid.size;
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto extent = static_cast<std::size_t>(size[axis]);
    for (std::size_t at = 0; at + stride < image.hounsfield.size(); ++at) {
      if (at / stride % extent + 1 == extent) continue;
      if (std::abs(image.hounsfield[at] - image.hounsfield[at + stride]) > kEdgeHu)
        image.fine[at] = image.fine[at + stride] = 1;
    }
    stride *= extent;
  }
}

bool is_thin(int label) { return label >= phantom_label::kCysticDuct && label <= phantom_label::kLeftHepaticArtery; }

/// The voxels that a course passes, each sharing a face with the one before.
std::vector<Eigen::Array3i> voxels_along(const Grid& grid, const phantom::Tube& tube) {
  std::vector<Eigen::Array3i> chain;
  const auto& course = tube.course();
  for (std::size_t n = 0; n + 1 < course.size(); ++n)
    for (int step = 0; step < 8; ++step) {
      const Vec p = course[n].at + (course[n + 1].at - course[n].at) * (step / 8.0);
      const Eigen::Array3i at = ((p - grid.low).array() / grid.voxel).round().cast<int>();
      if (chain.empty()) chain.push_back(at);
      for (int axis = 0; axis < 3; ++axis)
        while (chain.back()[axis] != at[axis]) {
          Eigen::Array3i next = chain.back();
          next[axis] += at[axis] > next[axis] ? 1 : -1;
          chain.push_back(next);
        }
    }
  return chain;
}

/// Ducts and arteries thinner than two voxels keep a chain of voxels: a tube of a voxel's width, where sampling at
/// centres would leave crumbs. Liver, gallbladder and other thin tubes are not overwritten.
void keep_thin_courses(const Patient& patient, Image& image) {
  for (const phantom::ThinCourse& each : patient.thin)
    for (const Eigen::Array3i& at : voxels_along(image.grid, each.tube)) {
      if (!image.grid.holds(at)) continue;
      const std::size_t offset = image.grid.offset(at[0], at[1], at[2]);
      std::uint16_t& label = image.labels[offset];
      image.fine[offset] = 1;
      if (each.tube.course().front().radius > image.grid.voxel) continue;
      if (label != phantom_label::kLiver && label != phantom_label::kGallbladder && !is_thin(label)) label = each.label;
    }
}

/// The voxels of the part that holds `start`, hanging together over faces; marks them in `seen`.
std::vector<std::size_t> part_at(const Image& image, std::size_t start, std::vector<bool>& seen) {
  const auto& size = image.grid.size;
  std::vector<std::size_t> part{start};
  seen[start] = true;
  for (std::size_t n = 0; n < part.size(); ++n) {
    std::size_t stride = 1;
    for (const int extent : size) {
      const auto length = static_cast<std::size_t>(extent), index = part[n] / stride % length;
      for (const bool up : {false, true}) {
        if (up ? index + 1 == length : index == 0) continue;
        const std::size_t next = up ? part[n] + stride : part[n] - stride;
        if (seen[next] || image.labels[next] != image.labels[start]) continue;
        seen[next] = true;
        part.push_back(next);
      }
      stride *= length;
    }
  }
  return part;
}

/// Organs that are one part in anatomy. Liver and gallbladder are left as they are drawn.
bool is_one_part(int label) {
  return (label != 0 && label < phantom_label::kSkin && label != phantom_label::kLiver &&
          label != phantom_label::kGallbladder) ||
         label == phantom_label::kHilumFat;
}

/// Where an organ slips behind another, single voxels may come out on the other side: they are called fat.
void drop_crumbs(Image& image) {
  std::vector<bool> seen(image.labels.size());
  std::map<std::uint16_t, std::vector<std::size_t>> largest;
  for (std::size_t at = 0; at < image.labels.size(); ++at) {
    const std::uint16_t label = image.labels[at];
    if (seen[at] || !is_one_part(label)) continue;
    std::vector<std::size_t> part = part_at(image, at, seen);
    std::vector<std::size_t>& kept = largest[label];
    if (part.size() > kept.size()) std::swap(part, kept);
    for (const std::size_t crumb : part) image.labels[crumb] = phantom_label::kVisceralFat;
  }
}

void sample_finely(const Patient& patient, Image& image, const Progress& progress) {
  const Grid& grid = image.grid;
  const int n = grid.voxel > 3 ? 3 : 2;  // samples along each edge of a voxel
  for_each_block(patient, grid, progress, "partial volume",
                 [&](const Candidates& candidates, const auto& first, const auto& last) {
                   for (int k = first[2]; k < last[2]; ++k)
                     for (int j = first[1]; j < last[1]; ++j)
                       for (int i = first[0]; i < last[0]; ++i) {
                         const std::size_t at = grid.offset(i, j, k);
                         if (image.fine[at] == 0) continue;
                         double sum = 0;
                         for (int s = 0; s < n * n * n; ++s) {
                           const Vec shift = (Vec(s % n, s / n % n, s / (n * n)).array() - 0.5 * (n - 1)) / n;
                           sum += sample_at(candidates, grid.centre(i, j, k) + grid.voxel * shift).hounsfield;
                         }
                         image.hounsfield[at] = static_cast<float>(sum / (n * n * n));
                       }
                 });
}

void require(double value, double least, double most, const char* name, const char* unit) {
  if (value >= least && value <= most) return;
  std::ostringstream text;
  text << "phantom: " << name << " of " << value << " " << unit << " is outside " << least << " to " << most << " "
       << unit;
  throw InputError(text.str());
}

Image empty_image(const Patient& patient, double voxel) {
  Image image;
  image.grid.voxel = voxel, image.grid.low = patient.field.min();
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    image.grid.size[axis] = static_cast<int>(std::floor(patient.field.sizes()[static_cast<int>(axis)] / voxel)) + 1;
    count *= static_cast<std::size_t>(image.grid.size[axis]);
  }
  image.labels.assign(count, 0), image.hounsfield.assign(count, 0), image.fine.assign(count, 0);
  return image;
}

}  // namespace

CtPhantom make_phantom(const PhantomOptions& options, const Progress& progress) {
  require(options.voxel_mm, kLeastPhantomVoxelMm, kMostPhantomVoxelMm, "a voxel", "mm");
  require(options.noise_hu, 0, 200, "a noise", "HU");
  const Patient patient = draw_patient(phantom::anatomy_of(options.variant, options.patient), 1.5 * options.voxel_mm);
  Image image = empty_image(patient, options.voxel_mm);
  sample_centres(patient, image, progress);
  mark_edges(image);
  keep_thin_courses(patient, image);
  drop_crumbs(image);
  sample_finely(patient, image, progress);
  report(progress, "noise and point spread", 0);
  phantom::scan(image.hounsfield, image.grid.size, {options.voxel_mm, options.noise_hu, options.seed});
  CtPhantom phantom;
  phantom.labels.size = image.grid.size;
  phantom.labels.index_to_ras_mm.linear() = Eigen::Matrix3d::Identity() * options.voxel_mm;
  phantom.labels.index_to_ras_mm.translation() = image.grid.low;
  phantom.labels.labels = std::move(image.labels);
  phantom.hounsfield.reserve(image.hounsfield.size());
  for (const float value : image.hounsfield)
    phantom.hounsfield.push_back(static_cast<std::int16_t>(std::lround(std::clamp(value, -1024.0F, 3071.0F))));
  return phantom;
}

}  // namespace trocar
