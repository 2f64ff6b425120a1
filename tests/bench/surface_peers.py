#!/usr/bin/env python3
"""How close surfaces lie to the labels they were made from: trocar, VTK, and 3D Slicer's closed surface.

    surface_peers.py [--trocar PROGRAM] [--triangles N] [--truth FINE] LABELS.nii.gz[:LABEL,LABEL...] ...

Every label (or those named) is cut down to its largest part over faces, its cavities are filled, and all three get the
same voxels, so that meshing is compared and not what is kept:

  trocar   `trocar organ import` with nothing but --triangles: reading, checks and writing are in its time
  vtk      vtkDiscreteFlyingEdges3D and vtkWindowedSincPolyDataFilter, both with the classes' own defaults (20
           iterations, pass band 0.1), in normalised coordinates, in millimetres
  slicer   3D Slicer's defaults: vtkDiscreteFlyingEdges3D in voxels, decimation factor 0, smoothing factor 0.5, that is
           20 iterations, pass band 10^(-4 x 0.5), boundary and feature edges off, no joint smoothing; then to
           millimetres (Libs/vtkSegmentationCore/vtkBinaryLabelmapToClosedSurfaceConversionRule.cxx of Slicer 5)

The last two are then brought to trocar's number of triangles by vtkQuadricDecimation with its volume preserved (of an
organ so small that they have fewer than --triangles, trocar is asked for as many as they have); what they were before
stands, with --dense, in the rows with a star.

All are measured by the same code, distances by VTK's own cell locator:

  volume   per cent off the voxels' volume
  iso      mm from the mesh to the label's border taken half-way between voxel centres: vtkDiscreteFlyingEdges3D as it
           comes, which the two peers start from. Mean, 95 % and largest by area, samples a third of a voxel apart
  back     from that border to the mesh
  faces    mean from the mesh to the voxels' faces, the border as the scanner's grid has it, and back
  truth    mean from the mesh to the border of the same label in FINE, and back: how close to the anatomy
           (the phantom's labels with smaller voxels)
  angle    smallest of all triangles, degrees; in brackets the 1 % quantile
  bend     mean angle between neighbouring triangles, degrees: how rough it looks and feels
  cut      pairs of triangles that cut each other
  s        user time of what makes the surface

Needs Python with VTK 9 and numpy (Debian: python3-vtk9).
"""
import argparse
import gzip
import math
import pathlib
import resource
import struct
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import (vtkImplicitPolyDataDistance, vtkQuadricDecimation, vtkTriangleFilter,
                                       vtkWindowedSincPolyDataFilter)
from vtkmodules.vtkFiltersGeneral import vtkDiscreteFlyingEdges3D
from vtkmodules.vtkImagingMorphological import vtkImageConnectivityFilter

MOST_SAMPLES = 60_000  # of a surface; of more so many are drawn, the same each time
NIFTI_TYPES = {2: "u1", 4: "i2", 8: "i4", 16: "f4", 64: "f8", 256: "i1", 512: "u2", 768: "u4"}


# ---- labels: arrays [k, j, i] and the affine from (i, j, k) to RAS millimetres

def read_nifti(path):
    try:
        data = path.read_bytes()
        if data[:2] == b"\x1f\x8b":
            data = gzip.decompress(data)
    except (OSError, EOFError) as error:
        sys.exit(f"{path}: {error}")
    if len(data) < 348 or struct.unpack("<i", data[:4])[0] != 348:
        sys.exit(f"{path}: not a little-endian NIfTI-1 file")
    dim = struct.unpack("<8h", data[40:56])
    code = struct.unpack("<h", data[70:72])[0]
    if code not in NIFTI_TYPES or dim[0] < 3 or any(n > 1 for n in dim[4:dim[0] + 1]):
        sys.exit(f"{path}: not a volume of numbers (datatype {code}, dimensions {dim[1:dim[0] + 1]})")
    if struct.unpack("<h", data[254:256])[0] <= 0:
        sys.exit(f"{path}: no sform: where its voxels lie is not said as this script reads it")
    start = int(struct.unpack("<f", data[108:112])[0])
    count = dim[1] * dim[2] * dim[3]
    if len(data) < start + count * np.dtype(NIFTI_TYPES[code]).itemsize:
        sys.exit(f"{path}: cut short")
    values = np.frombuffer(data, "<" + NIFTI_TYPES[code], count, start).reshape(dim[3], dim[2], dim[1])
    affine = np.vstack([np.array(struct.unpack("<12f", data[280:328])).reshape(3, 4), [0, 0, 0, 1]])
    return np.rint(values).astype(np.int32), affine


def write_nifti(path, mask, affine):
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, mask.shape[2], mask.shape[1], mask.shape[0], 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 2, 8)
    struct.pack_into("<8f", header, 76, 1, *np.linalg.norm(affine[:3, :3], axis=0), 0, 0, 0, 0)
    struct.pack_into("<f", header, 108, 352)
    header[123] = 2  # millimetres
    struct.pack_into("<2h", header, 252, 0, 1)
    struct.pack_into("<12f", header, 280, *affine[:3].flatten())
    header[344:348] = b"n+1\0"
    path.write_bytes(bytes(header) + mask.astype("u1").tobytes())


def image_of(mask):
    image = vtkImageData()
    image.SetDimensions(*mask.shape[::-1])
    image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(mask, np.uint8).ravel(), deep=True))
    return image


def largest_part(mask):
    parts = vtkImageConnectivityFilter()  # over faces
    parts.SetInputData(image_of(mask))
    parts.SetScalarRange(1, 1)
    parts.SetExtractionModeToLargestRegion()
    parts.Update()
    return vtk_to_numpy(parts.GetOutput().GetPointData().GetScalars()).reshape(mask.shape) != 0


def cut_out(labels, label):
    """The largest part, cavities filled, cropped; and how far the crop's corner lies from the volume's, in voxels."""
    mask = labels == label
    low = [np.flatnonzero(mask.any(axis=tuple({0, 1, 2} - {n})))[0] for n in range(3)]
    high = [np.flatnonzero(mask.any(axis=tuple({0, 1, 2} - {n})))[-1] + 1 for n in range(3)]
    part = largest_part(np.pad(mask[low[0]:high[0], low[1]:high[1], low[2]:high[2]], 2))
    return ~largest_part(~part), np.array(low[::-1]) - 2


# ---- surfaces: points (n, 3) in RAS millimetres and triangles (m, 3)

def poly_data(points, triangles):
    result = vtkPolyData()
    vtk_points, cells = vtkPoints(), vtkCellArray()
    vtk_points.SetDataTypeToDouble()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points, np.float64), deep=True))
    table = np.hstack([np.full((len(triangles), 1), 3), triangles]).astype(np.int64)
    cells.SetCells(len(triangles), numpy_to_vtkIdTypeArray(table.ravel(), deep=True))
    result.SetPoints(vtk_points)
    result.SetPolys(cells)
    return result


def arrays(poly):
    points = vtk_to_numpy(poly.GetPoints().GetData()).astype(np.float64)
    triangles = vtk_to_numpy(poly.GetPolys().GetData()).reshape(-1, 4)[:, 1:]
    return points, np.array(triangles)


def outward(points, triangles):
    return (points, triangles if volume(points, triangles) > 0 else triangles[:, ::-1])


def flying_edges(mask):
    edges = vtkDiscreteFlyingEdges3D()
    edges.SetInputData(image_of(mask))
    edges.SetValue(0, 1)
    edges.ComputeNormalsOff()
    edges.ComputeGradientsOff()
    edges.Update()
    return edges.GetOutput()


def moved(poly, affine):
    points, triangles = arrays(poly)
    return outward(points @ affine[:3, :3].T + affine[:3, 3], triangles)


def smoothed(poly, iterations, pass_band):
    sinc = vtkWindowedSincPolyDataFilter()
    sinc.SetInputData(poly)
    sinc.SetNumberOfIterations(iterations)
    sinc.SetPassBand(pass_band)
    sinc.BoundarySmoothingOff()
    sinc.FeatureEdgeSmoothingOff()
    sinc.NonManifoldSmoothingOn()
    sinc.NormalizeCoordinatesOn()
    sinc.Update()
    return sinc.GetOutput()


def decimated(surface, count):
    filter_ = vtkQuadricDecimation()
    filter_.SetInputData(poly_data(*surface))
    filter_.SetTargetReduction(max(0.0, 1 - count / len(surface[1])))
    filter_.VolumePreservationOn()
    filter_.Update()
    return arrays(filter_.GetOutput())


def voxel_faces(mask, affine):
    """Two triangles a face between inside and outside, in no particular winding."""
    points, triangles = [], []
    for axis in range(3):  # of the array: k, j, i
        at = np.argwhere(np.diff(mask.astype(np.int8), axis=axis) != 0).astype(float)
        at[:, axis] += 0.5
        steps = np.eye(3)[[n for n in range(3) if n != axis]] / 2
        corners = [at + a * steps[0] + b * steps[1] for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        first = sum(len(p) for p in points)
        points.extend(corners)
        index = first + np.arange(len(at))[:, None] + len(at) * np.array([[0, 1, 2], [0, 2, 3]])[:, None]
        triangles.append(index.reshape(-1, 3))
    return np.vstack(points)[:, ::-1] @ affine[:3, :3].T + affine[:3, 3], np.vstack(triangles)


def read_trocar_ply(path):
    head, body = path.read_bytes().split(b"end_header\n", 1)
    counts = [int(line.split()[2]) for line in head.decode().splitlines() if line.startswith("element")]
    points = np.frombuffer(body, "<f4", counts[0] * 3).reshape(-1, 3).astype(float) * 1000
    faces = np.frombuffer(body, np.dtype([("n", "u1"), ("v", "<i4", 3)]), counts[1], counts[0] * 12)
    return points, np.array(faces["v"], np.int64)


# ---- measures

def volume(points, triangles):
    a, b, c = (points[triangles[:, n]] for n in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def samples(points, triangles, spacing):
    """Places no further apart than the spacing, and the area that each stands for."""
    a, b, c = (points[triangles[:, n]] for n in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    longest = np.max([np.linalg.norm(p - q, axis=1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    pieces = np.clip(np.ceil(longest / spacing), 1, 64).astype(int)
    places, weights = [], []
    for n in np.unique(pieces):
        of = pieces == n
        up = [((i + 1 / 3) / n, (j + 1 / 3) / n) for i in range(n) for j in range(n - i)]
        down = [((i + 2 / 3) / n, (j + 2 / 3) / n) for i in range(n) for j in range(n - i - 1)]
        for u, v in up + down:
            places.append(a[of] + u * (b[of] - a[of]) + v * (c[of] - a[of]))
            weights.append(area[of] / n ** 2)
    places, weights = np.vstack(places), np.concatenate(weights)
    drawn = np.random.default_rng(1).permutation(len(places))[:MOST_SAMPLES]
    return places[drawn], weights[drawn]


class Border:
    def __init__(self, surface, spacing):
        self.distance = vtkImplicitPolyDataDistance()
        self.distance.SetInput(poly_data(*surface))
        self.sampled = samples(*surface, spacing)

    def distances(self, places):
        found = vtkDoubleArray()
        found.SetNumberOfTuples(len(places))
        self.distance.FunctionValue(numpy_to_vtk(np.ascontiguousarray(places), deep=True), found)
        return np.abs(vtk_to_numpy(found))


def summed(distances, weights):
    order = np.argsort(distances)
    below = np.cumsum(weights[order]) / weights.sum()
    return (float((distances * weights).sum() / weights.sum()), float(distances[order][np.searchsorted(below, 0.95)]),
            float(distances.max()))


def between(mesh, border):
    """(mean, 95 %, largest) from the mesh to the border, and back."""
    return (summed(border.distances(mesh.sampled[0]), mesh.sampled[1]),
            summed(mesh.distances(border.sampled[0]), border.sampled[1]))


def smallest_angles(points, triangles):
    corners = [points[triangles[:, n]] for n in range(3)]
    angles = []
    for n in range(3):
        u, v = corners[(n + 1) % 3] - corners[n], corners[(n + 2) % 3] - corners[n]
        angles.append(np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), np.einsum("ij,ij->i", u, v)))
    return np.degrees(np.min(angles, axis=0))


def bend(points, triangles):
    a, b, c = (points[triangles[:, n]] for n in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-12)[:, None]
    edges = np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    same = np.flatnonzero((edges[order[1:]] == edges[order[:-1]]).all(axis=1))
    first, second = order[same] % len(triangles), order[same + 1] % len(triangles)
    cosine = np.einsum("ij,ij->i", normals[first], normals[second])
    return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))).mean())


def candidates(points, triangles):
    """Pairs of triangles whose boxes meet: those that lie in a common cell of a grid."""
    corners = points[triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    cell = np.median(high - low, axis=0).max() * 1.5
    first, last = np.floor(low / cell).astype(int), np.floor(high / cell).astype(int)
    cells = {}
    for t, (p, q) in enumerate(zip(first, last)):
        for i in range(p[0], q[0] + 1):
            for j in range(p[1], q[1] + 1):
                for k in range(p[2], q[2] + 1):
                    cells.setdefault((i, j, k), []).append(t)
    pairs = [np.array(np.triu_indices(len(of), 1)).T[:, :] for of in cells.values()]
    pairs = np.vstack([np.array(of)[pair] for of, pair in zip(cells.values(), pairs)])
    meet = ((low[pairs[:, 0]] <= high[pairs[:, 1]]) & (low[pairs[:, 1]] <= high[pairs[:, 0]])).all(axis=1)
    return np.unique(np.sort(pairs[meet], axis=1), axis=0)


def pierces(p, q, a, b, c):
    """Whether the segment pq crosses the triangle abc (Moeller and Trumbore 1997)."""
    d, u, v = q - p, b - a, c - a
    h = np.cross(d, v)
    det = np.einsum("ij,ij->i", u, h)
    inverse = 1 / np.where(np.abs(det) < 1e-14, np.inf, det)
    s = p - a
    x = inverse * np.einsum("ij,ij->i", s, h)
    r = np.cross(s, u)
    y = inverse * np.einsum("ij,ij->i", d, r)
    t = inverse * np.einsum("ij,ij->i", v, r)
    return (inverse != 0) & (x > 0) & (y > 0) & (x + y < 1) & (t > 0) & (t < 1)


def self_intersections(points, triangles):
    """Pairs in which an edge of one goes through the other (those that share a corner by their other edges)."""
    pairs = candidates(points, triangles)
    cut = np.zeros(len(pairs), bool)
    for one, other in ((0, 1), (1, 0)):
        edges, faces = triangles[pairs[:, one]], triangles[pairs[:, other]]
        corners = [points[faces[:, n]] for n in range(3)]
        for n in range(3):
            p, q = edges[:, n], edges[:, (n + 1) % 3]
            apart = ((faces != p[:, None]) & (faces != q[:, None])).all(axis=1)
            cut |= apart & pierces(points[p], points[q], *corners)
    return int(cut.sum())


# ---- the three

def user_s(who):
    return resource.getrusage(who).ru_utime


def by_trocar(program, mask, affine, triangles, folder):
    write_nifti(folder / "organ.nii", mask, affine)
    before = user_s(resource.RUSAGE_CHILDREN)
    command = [program, "organ", "import", str(folder / "organ.nii"), "-o", str(folder / "organ"), "--name", "organ",
               "--material", "soft_tissue", "--triangles", str(triangles)]
    done = subprocess.run(command, capture_output=True, text=True)
    if not (folder / "organ.ply").exists():
        sys.exit(f"{' '.join(command)}: {done.stderr.strip()}")
    spent = user_s(resource.RUSAGE_CHILDREN) - before
    surface = read_trocar_ply(folder / "organ.ply")
    (folder / "organ.ply").unlink()
    return surface, spent


def timed(work):
    before = user_s(resource.RUSAGE_SELF)
    result = work()
    return result, user_s(resource.RUSAGE_SELF) - before


def by_vtk(mask, affine):
    points, triangles = moved(flying_edges(mask), affine)
    return outward(*arrays(smoothed(poly_data(points, triangles), 20, 0.1)))


def by_slicer(mask, affine):
    return moved(smoothed(flying_edges(mask), 20, 10 ** (-4 * 0.5)), affine)


HEADER = (f"{'':30}{'triangles':>9} {'vol %':>7} | {'iso mean':>8} {'95%':>6} {'max':>6} | {'back':>6} {'95%':>6} "
          f"{'max':>6} | {'faces':>6} {'back':>6} | {'truth':>6} {'back':>6} | {'angle':>11} {'bend':>5} {'cut':>4} {'s':>6}")


def row(name, surface, spent, borders, voxels_ml, spacing):
    mesh = Border(surface, spacing)
    (mean, p95, most), (back, back95, back_most) = between(mesh, borders["iso"])
    faces = between(mesh, borders["faces"])
    truth = between(mesh, borders["truth"]) if "truth" in borders else None
    angles = smallest_angles(*surface)
    off = (volume(*surface) / 1000 / voxels_ml - 1) * 100
    text = [f"{t[0]:6.3f}" for t in truth] if truth else ["     -", "     -"]
    print(f"{name:30}{len(surface[1]):9} {off:7.2f} | {mean:8.3f} {p95:6.2f} {most:6.2f} | {back:6.3f} {back95:6.2f} "
          f"{back_most:6.2f} | {faces[0][0]:6.3f} {faces[1][0]:6.3f} | {text[0]} {text[1]} | "
          f"{angles.min():5.1f} ({np.quantile(angles, 0.01):3.0f}) {bend(*surface):5.1f} {self_intersections(*surface):4} "
          f"{spent:6.2f}", flush=True)
    return mean, back


def compare(arguments, path, label, labels, affine, truth, folder):
    mask, corner = cut_out(labels, label)
    place = affine.copy()
    place[:3, 3] += affine[:3, :3] @ corner
    spacing = float(np.cbrt(abs(np.linalg.det(affine[:3, :3])))) / 3
    voxels_ml = float(mask.sum() * abs(np.linalg.det(affine[:3, :3])) / 1000)
    borders = {"iso": Border(moved(flying_edges(mask), place), spacing),
               "faces": Border(voxel_faces(mask, place), spacing)}
    if truth is not None and (truth[0] == label).any():
        fine, fine_corner = cut_out(truth[0], label)
        fine_place = truth[1].copy()
        fine_place[:3, 3] += truth[1][:3, :3] @ fine_corner
        borders["truth"] = Border(moved(flying_edges(fine), fine_place), spacing)
    name = f"{path.name.split('.')[0]}:{label}"
    wanted = min(arguments.triangles, flying_edges(mask).GetNumberOfPolys())
    surface, spent = by_trocar(arguments.trocar, mask, place, wanted, folder)
    count = len(surface[1])
    result = [row(f"{name} trocar", surface, spent, borders, voxels_ml, spacing)]
    for peer, work in (("vtk", by_vtk), ("slicer", by_slicer)):
        dense, spent = timed(lambda: work(mask, place))
        if arguments.dense:
            row(f"{name} {peer} *", dense, spent, borders, voxels_ml, spacing)
        coarse, more = timed(lambda: decimated(dense, count))
        result.append(row(f"{name} {peer}", coarse, spent + more, borders, voxels_ml, spacing))
    return name, result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("labels", nargs="+", help="NIfTI label map; :5,1 behind it takes labels 5 and 1")
    parser.add_argument("--trocar", default="build/release/trocar")
    parser.add_argument("--triangles", type=int, default=6000)
    parser.add_argument("--truth", type=pathlib.Path, help="the same labels with finer voxels")
    parser.add_argument("--dense", action="store_true", help="the peers before decimation too")
    arguments = parser.parse_args()
    if not pathlib.Path(arguments.trocar).is_file():
        sys.exit(f"{arguments.trocar}: no such program (--trocar)")
    truth = read_nifti(arguments.truth) if arguments.truth else None
    print(HEADER)
    worse = []
    with tempfile.TemporaryDirectory() as folder:
        for argument in arguments.labels:
            file, _, wanted = argument.partition(":")
            labels, affine = read_nifti(pathlib.Path(file))
            if not all(n.isdigit() for n in wanted.split(",") if wanted):
                sys.exit(f"{argument}: labels are numbers, as in {file}:5,1")
            numbers = [int(n) for n in wanted.split(",")] if wanted else [int(n) for n in np.unique(labels) if n > 0]
            for label in numbers:
                if not (labels == label).any():
                    sys.exit(f"{file}: no voxel carries label {label}")
                name, rows = compare(arguments, pathlib.Path(file), label, labels, affine, truth, pathlib.Path(folder))
                worse += [name] if any(rows[0][n] > peer[n] + 1e-9 for peer in rows[1:] for n in (0, 1)) else []
    print("farther than a peer, there or back: " + (", ".join(worse) if worse else "none"))
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
