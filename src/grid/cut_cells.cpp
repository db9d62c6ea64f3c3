#include "grid/cut_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/cut_simplex.hpp"

namespace mudlark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Distances below this share of a cell count as zero and become a hundredth of it, so that no
/// surface lies exactly in a corner and none is lost between two simplices.
constexpr double on_surface = 1e-9;
/// Shares of cells nearer than this to 0 or 1 are 0 or 1.
constexpr double sliver = 1e-8;

/// Reflected at 0 and at `count` until it lies between them.
int reflected(int index, int count) {
  const int period = 2 * count;
  index = ((index % period) + period) % period;
  return index > count ? period - index : index;
}

template <int D>
double largest_diagonal(const Grid<D>& grid) {
  Vec<D> size;
  for (int a = 0; a < D; ++a)
    for (int i = 0; i < grid.cells()[a]; ++i) size[a] = std::max(size[a], grid.width(a, i));
  return norm(size);
}

}  // namespace

template <int D>
CutCells<D>::CutCells(const Grid<D>& grid)
    : grid_(&grid),
      diagonal_(largest_diagonal(grid)),
      snap_(on_surface * grid.smallest_spacing()),
      volume_(grid, "open volume", "1", 1.0),
      aperture_(grid, "aperture", "1", 1.0),
      geometric_(grid, "aperture", "1", 1.0) {
  std::size_t count = 1;
  for (int a = 0; a < D; ++a) {
    nodes_[a] = grid.local().upper[a] - grid.local().lower[a] + 1;
    count *= static_cast<std::size_t>(nodes_[a]);
  }
  distance_.assign(count, infinity);
}

/// Position of half-cell number `twice`: corners are even, centres odd [m].
template <int D>
double CutCells<D>::place_of(int axis, int twice) const {
  Index<D> index;
  index[axis] = twice >= 0 ? twice / 2 : (twice - 1) / 2;
  return twice % 2 == 0 ? grid_->face_centre(axis, index)[axis] : grid_->cell_centre(index)[axis];
}

template <int D>
SurfaceDistance CutCells<D>::nearest(const std::vector<RigidPose>& bodies, const Point3& place,
                                     double reach, std::size_t& body) const {
  const Grid<D>& grid = *grid_;
  SurfaceDistance found{infinity, {0.0, 0.0, 1.0}};
  body = bodies.size();
  // Images across periodic seams: one domain farther on either side.
  int images = 1;
  for (int a = 0; a < D; ++a) images *= grid.periodic(a) ? 3 : 1;
  for (int image = 0; image < images; ++image) {
    Point3 shifted = place;
    for (int a = 0, rest = image; a < D; ++a) {
      if (!grid.periodic(a)) continue;
      const int step = rest % 3 == 2 ? -1 : rest % 3;
      rest /= 3;
      shifted[static_cast<std::size_t>(axis_in_space<D>(a))] +=
          step * (grid.upper()[a] - grid.lower()[a]);
    }
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!bodies[b].near(shifted, reach)) continue;
      const SurfaceDistance one = bodies[b].distance(shifted);
      if (one.distance < found.distance) found = one, body = b;
    }
  }
  return found;
}

/// Is the nearest surface a side's, or beyond it? No water sees a body's face there.
template <int D>
bool CutCells<D>::unseen(const SurfaceDistance& found, const Vec<D>& place, int axis,
                         double outwards) const {
  const double side = outwards < 0.0 ? grid_->lower()[axis] : grid_->upper()[axis];
  const double normal = to_axes<D>(to_vector(found.normal))[axis];
  const double nearest = place[axis] - found.distance * normal;
  return found.distance < snap_ && outwards * normal > 0.999 &&
         outwards * (nearest - side) > -snap_;
}

/// Distance at a corner, given in half cells and mirrored into the domain. Where the nearest
/// surface is the foot of a body that stands on a side, the body goes on behind the side: the
/// distance is taken on from the first two corners farther in that see another surface, linear as
/// that of a plane is.
template <int D>
double CutCells<D>::sample(const std::vector<RigidPose>& bodies, const Index<D>& twice) const {
  Vec<D> place;
  Index<D> index;
  for (int a = 0; a < D; ++a) {
    index[a] = grid_->periodic(a) ? twice[a] : reflected(twice[a], 2 * grid_->cells()[a]);
    place[a] = place_of(a, index[a]);
  }
  std::size_t body = 0;
  const double reach = 2.0 * diagonal_;
  const SurfaceDistance found = nearest(bodies, to_point3(place), reach, body);
  double distance = found.distance;
  for (int a = 0; a < D; ++a)
    for (const int outwards : {-1, 1}) {
      if (grid_->periodic(a) || !unseen(found, place, a, outwards)) continue;
      double before = -reach, way_before = 0.0;
      for (int step = 2;; step += 2) {
        Vec<D> inside = place;
        inside[a] = place_of(a, index[a] - outwards * step);
        const double way = std::abs(inside[a] - place[a]);
        const SurfaceDistance one = nearest(bodies, to_point3(inside), reach, body);
        if (way > reach || !std::isfinite(one.distance)) break;
        if (unseen(one, inside, a, outwards)) continue;
        if (way_before > 0.0) {
          before -= (one.distance - before) * way_before / (way - way_before);
          break;
        }
        before = one.distance, way_before = way;
      }
      distance = std::min(distance, before);
    }
  return nonzero(std::clamp(distance, -reach, reach));
}

template <int D>
double CutCells<D>::nonzero(double distance) const {
  return std::abs(distance) < snap_ ? 0.01 * snap_ : distance;
}

template <int D>
std::size_t CutCells<D>::node(const Index<D>& index) const {
  std::size_t at = 0;
  for (int a = D - 1; a >= 0; --a)
    at = at * static_cast<std::size_t>(nodes_[a]) +
         static_cast<std::size_t>(index[a] - grid_->local().lower[a]);
  return at;
}

/// Halves boxes of corners until all of one lie far on one side of the surface, or one is left.
template <int D>
void CutCells<D>::sample_nodes(const std::vector<RigidPose>& bodies, const IndexBox<D>& box) {
  if (box.empty()) return;
  Vec<D> lower, upper;
  int longest = 0;
  for (int a = 0; a < D; ++a) {
    lower[a] = place_of(a, 2 * box.lower[a]), upper[a] = place_of(a, 2 * (box.upper[a] - 1));
    if (box.upper[a] - box.lower[a] > box.upper[longest] - box.lower[longest]) longest = a;
  }
  if (box.upper[longest] - box.lower[longest] == 1) {
    Index<D> twice;
    for (int a = 0; a < D; ++a) twice[a] = 2 * box.lower[a];
    distance_[node(box.lower)] = sample(bodies, twice);
    return;
  }
  // Beyond its own size and a cell's diagonal: no neighbour of the box can lie across the surface.
  const double radius = 0.5 * norm(upper - lower) + diagonal_;
  std::size_t body = 0;
  const double away = nearest(bodies, to_point3(0.5 * (lower + upper)), radius, body).distance;
  if (std::abs(away) >= radius) {
    const double value = std::copysign(2.0 * diagonal_, away);
    for_each(box, [&](const Index<D>& index) { distance_[node(index)] = value; });
    return;
  }
  IndexBox<D> first = box, second = box;
  first.upper[longest] = second.lower[longest] = (box.lower[longest] + box.upper[longest]) / 2;
  sample_nodes(bodies, first);
  sample_nodes(bodies, second);
}

/// Corners behind closed walls take the values of their mirror images.
template <int D>
void CutCells<D>::mirror_nodes() {
  IndexBox<D> all = grid_->local();
  for (int a = 0; a < D; ++a) all.upper[a] += 1;
  for_each(all, [&](const Index<D>& index) {
    Index<D> image = index;
    for (int a = 0; a < D; ++a)
      if (!grid_->periodic(a)) image[a] = reflected(index[a], grid_->cells()[a]);
    if (!(image == index)) distance_[node(index)] = distance_[node(image)];
  });
}

/// Can the surface pass the cell? If not, `sign` says on which side it lies.
template <int D>
bool CutCells<D>::is_near(const Index<D>& cell, double& sign) const {
  bool above = false, below = false, close = false;
  for (int corner = 0; corner < (1 << D); ++corner) {
    Index<D> index = cell;
    for (int a = 0; a < D; ++a) index[a] += (corner >> a) & 1;
    const double value = distance_[node(index)];
    (value > 0.0 ? above : below) = true;
    close = close || std::abs(value) < 0.5 * diagonal_;
  }
  sign = above ? 1.0 : -1.0;
  return close || (above && below);
}

/// Calls take(simplex) for the triangles or tetrahedra between the centre of a cell, the centres of
/// its faces (in space) and the ends of its edges: 4 or 24 of the same size.
template <int D>
template <class Take>
void CutCells<D>::for_each_simplex(const Index<D>& cell, Take&& take) const {
  Simplex<D> simplex;
  // `twice` counts half cells; at centres the mean of the corners around holds.
  const auto set = [&](std::size_t vertex, const Index<D>& twice) {
    for (int a = 0; a < D; ++a) simplex.place[vertex][a] = place_of(a, twice[a]);
    double sum = 0.0, count = 0.0;
    for (int corner = 0; corner < (1 << D); ++corner) {
      Index<D> index;
      bool new_one = true;
      for (int a = 0; a < D; ++a) {
        const int upper = (corner >> a) & 1;
        new_one = new_one && (twice[a] % 2 != 0 || upper == 0);
        index[a] = (twice[a] - (twice[a] % 2 != 0 ? 1 : 0)) / 2 + upper;
      }
      if (new_one) sum += distance_[node(index)], count += 1.0;
    }
    simplex.value[vertex] = nonzero(sum / count);
  };
  Index<D> centre;
  for (int a = 0; a < D; ++a) centre[a] = 2 * cell[a] + 1;
  set(0, centre);
  for (int axis = 0; axis < D; ++axis)
    for (const int side : {-1, 1}) {
      const Index<D> middle = centre.shifted(axis, side);
      const int first = (axis + 1) % D;
      if constexpr (D == 2) {
        set(1, middle.shifted(first, -1));
        set(2, middle.shifted(first, 1));
        take(simplex);
      } else {
        const int second = (axis + 2) % D;
        set(1, middle);
        constexpr std::array<std::array<int, 2>, 5> around{
            {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
        for (std::size_t k = 0; k < 4; ++k) {
          set(2, middle.shifted(first, around[k][0]).shifted(second, around[k][1]));
          set(3, middle.shifted(first, around[k + 1][0]).shifted(second, around[k + 1][1]));
          take(simplex);
        }
      }
    }
}

template <int D>
void CutCells<D>::cut(const Index<D>& cell) {
  double sum = 0.0;
  for_each_simplex(cell, [&](const Simplex<D>& simplex) { sum += positive_share(simplex.value); });
  const double share = sum / (D == 2 ? 4.0 : 24.0);
  volume_[cell] = share < sliver ? 0.0 : share > 1.0 - sliver ? 1.0 : share;
}

template <int D>
double CutCells<D>::share_of_face(int axis, const Index<D>& face) const {
  const int first = (axis + 1) % D;
  if constexpr (D == 2) {
    const double low = distance_[node(face)], high = distance_[node(face.shifted(first, 1))];
    return positive_share(std::array{low, high});
  } else {
    const int second = (axis + 2) % D;
    const std::array<double, 4> ring{distance_[node(face)], distance_[node(face.shifted(first, 1))],
                                     distance_[node(face.shifted(first, 1).shifted(second, 1))],
                                     distance_[node(face.shifted(second, 1))]};
    const double centre = nonzero(0.25 * (ring[0] + ring[1] + ring[2] + ring[3]));
    double share = 0.0;
    for (std::size_t k = 0; k < 4; ++k)
      share += 0.25 * positive_share(std::array{centre, ring[k], ring[(k + 1) % 4]});
    return share;
  }
}

/// Centre of a face's open share, geometrically.
template <int D>
Vec<D> CutCells<D>::open_centre(int axis, const Index<D>& face) const {
  const int first = (axis + 1) % D;
  const auto corner = [&](const Index<D>& index) {
    Index<D> twice;
    for (int a = 0; a < D; ++a) twice[a] = 2 * index[a];
    Vec<D> place;
    for (int a = 0; a < D; ++a) place[a] = place_of(a, twice[a]);
    return place;
  };
  CutPiece<D> open;
  if constexpr (D == 2) {
    const Index<D> other = face.shifted(first, 1);
    open = positive_part<D, 2>({corner(face), corner(other)},
                               {distance_[node(face)], distance_[node(other)]});
  } else {
    const int second = (axis + 2) % D;
    const std::array<Index<D>, 4> ring{face, face.shifted(first, 1),
                                       face.shifted(first, 1).shifted(second, 1),
                                       face.shifted(second, 1)};
    double mean = 0.0;
    for (const Index<D>& index : ring) mean += 0.25 * distance_[node(index)];
    for (std::size_t k = 0; k < 4; ++k) {
      const Index<D>&one = ring[k], &next = ring[(k + 1) % 4];
      const CutPiece<D> part =
          positive_part<D, 3>({grid_->face_centre(axis, face), corner(one), corner(next)},
                              {nonzero(mean), distance_[node(one)], distance_[node(next)]});
      open.size += part.size;
      open.moment += part.moment;
    }
  }
  return open.size > 0.0 ? (1.0 / open.size) * open.moment : grid_->face_centre(axis, face);
}

/// Faces beside cells without volume are closed: nothing can pass.
template <int D>
void CutCells<D>::close_faces() {
  const Grid<D>& grid = *grid_;
  const double* volume = volume_.data();
  for (int axis = 0; axis < D; ++axis) {
    IndexBox<D> inner = grid.local();
    inner.lower[axis] += 1;
    const std::ptrdiff_t s = grid.stride(axis);
    double* aperture = aperture_[axis].data();
    for_each(inner, [&](const Index<D>& face) {
      const std::ptrdiff_t at = grid.offset(face);
      if (volume[at] == 0.0 || volume[at - s] == 0.0) aperture[at] = 0.0;
    });
  }
}

template <int D>
void CutCells<D>::add_surface(const std::vector<RigidPose>& bodies, const Index<D>& cell) {
  const Grid<D>& grid = *grid_;
  CutCell<D> found{cell, 0, {}, {}, {}};
  CutPiece<D> sum;
  double volume = 1.0;
  for (int a = 0; a < D; ++a) volume *= grid.width(a, cell[a]);
  bool any = false;
  for (int axis = 0; axis < D; ++axis) {
    const double size = volume / grid.width(axis, cell[axis]);
    const Index<D> upper = cell.shifted(axis, 1);
    found.area[axis] = (aperture_[axis][upper] - aperture_[axis][cell]) * size;
    for (const Index<D>& face : {cell, upper}) {
      const double closed = (geometric_[axis][face] - aperture_[axis][face]) * size;
      const Vec<D> moment = closed > 0.0 ? closed * open_centre(axis, face) : Vec<D>{};
      any = any || aperture_[axis][face] < 1.0;
      sum.size += closed;
      sum.moment += moment;
      found.spread[static_cast<std::size_t>(axis)] += (face == cell ? 1.0 : -1.0) * moment;
    }
  }
  if (!any) return;
  for_each_simplex(cell, [&](const Simplex<D>& simplex) {
    const CutPiece<D> piece = cut_piece(simplex);
    sum.size += piece.size;
    sum.moment += piece.moment;
    if (piece.size == 0.0) return;
    for (int axis = 0; axis < D; ++axis)
      found.spread[static_cast<std::size_t>(axis)] +=
          (piece.area[axis] / piece.size) * piece.moment;
  });
  if (!(sum.size > 0.0)) return;
  found.middle = (1.0 / sum.size) * sum.moment;
  for (int axis = 0; axis < D; ++axis)
    found.spread[static_cast<std::size_t>(axis)] += (-found.area[axis]) * found.middle;
  nearest(bodies, to_point3(found.middle), 2.0 * diagonal_, found.body);
  if (found.body < bodies.size()) surface_.push_back(found);
}

template <int D>
void CutCells<D>::find(const std::vector<RigidPose>& bodies) {
  const Grid<D>& grid = *grid_;
  IndexBox<D> core = grid.local();
  for (int a = 0; a < D; ++a) {
    core.upper[a] += 1;
    if (grid.periodic(a)) continue;
    core.lower[a] = std::max(core.lower[a], 0);
    core.upper[a] = std::min(core.upper[a], grid.cells()[a] + 1);
  }
  sample_nodes(bodies, core);
  mirror_nodes();
  for_each(grid.local(), [&](const Index<D>& cell) {
    double sign = 1.0;
    if (is_near(cell, sign))
      cut(cell);
    else
      volume_[cell] = sign > 0.0 ? 1.0 : 0.0;
  });
  for (int axis = 0; axis < D; ++axis) {
    for_each(grid.local(),
             [&](const Index<D>& face) { geometric_[axis][face] = share_of_face(axis, face); });
    aperture_[axis].copy_values_from(geometric_[axis]);
  }
  close_faces();
  surface_.clear();
  for_each(grid.owned(), [&](const Index<D>& cell) {
    double sign = 1.0;
    if (volume_[cell] > 0.0 && is_near(cell, sign)) add_surface(bodies, cell);
  });
}

template class CutCells<2>;
template class CutCells<3>;

}  // namespace mudlark
