#include "coupling/end_of_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "coupling/around_face.hpp"
#include "numerics/loops.hpp"

namespace mudlark {
namespace {

/// Ground is within two faces where one of them is filled more than this, its end where one is
/// filled less [-]; it counts fully 0.3 beyond.
constexpr double half_full = 0.4;
/// Faces filled more than this are whole [-].
constexpr double whole = 0.98;
/// Water along the end flows when it is faster than this part of a long wave on one cell; what
/// round-off moves is much slower.
constexpr double creeps = 1e-4;
/// Cells that are less full than this are all but dry [-].
constexpr double moist = 0.01;

/// A face whose control volume the quadratic spline of the default kernel fills to `share` lies so
/// that this part of it is ground: none from half a cell before the end, all from half a cell
/// behind.
double part_of_ground(double share) { return std::clamp((share - 0.26) / 0.48, 0.0, 1.0); }

/// The same for water along the end, which finds its way as long as half of the face is open.
double part_in_the_way(double share) { return std::clamp(4.0 * share - 2.0, 0.0, 1.0); }

}  // namespace

template <int D>
EndOfGround<D>::EndOfGround(const Grid<D>& grid)
    : grid_(&grid),
      halo_(grid),
      ghosts_(grid),
      taken_(grid, "share that soil takes", "1"),
      rim_(grid, "rim of the ground", "1"),
      towards_(grid, "direction of the ground", "1"),
      slow_(std::max(creeps * std::sqrt(norm(grid.gravity()) * grid.smallest_spacing()), 1e-12)) {}

/// Grains and pores together: with one porosity at the start that is the grains', scaled. Ground
/// does not end at a body in it.
template <int D>
void EndOfGround<D>::find(SoilSolver<D>& soil, const SoilInWater<D>& room, const Space<D>& space) {
  const std::vector<SoilBody>& bodies = soil.options().bodies;
  const double porosity = bodies.front().porosity;
  const bool alike =
      std::ranges::all_of(bodies, [&](const SoilBody& body) { return body.porosity == porosity; });
  if (alike)
    taken_.copy_values_from(room.fraction());
  else
    soil.spread_over_grains([](const SoilBody&) { return 1.0; }, taken_);
  ghosts_.update(taken_);
  for_each(grid_->local(), [&](const Index<D>& cell) {
    taken_[cell] /= alike ? 1.0 - porosity : room.reach_at(cell);
    if (space.volume[cell] == 0.0) taken_[cell] = 1.0;
  });
}

/// Share of a face's control volume that soil takes, as the kernel spreads it [-].
template <int D>
double EndOfGround<D>::share_at(int axis, const Index<D>& face) const {
  const std::ptrdiff_t at = grid_->offset(face);
  return 0.5 * (taken_.data()[at - grid_->stride(axis)] + taken_.data()[at]);
}

/// 0 to 1: u^2 / (u^2 + u_0^2), u the water's velocity against the grains along the end, across the
/// slope of the soil's share; nothing where there is no water.
template <int D>
double EndOfGround<D>::flows(int axis, const Index<D>& face, const Vec<D>& slope,
                             const Vec<D>& grain_velocity, const FaceVector<D>& water,
                             const CellField<D>& saturation) const {
  const Vec<D> slip = velocity_around(axis, face, water) - grain_velocity;
  const double along = dot(slip, slope), steepness = dot(slope, slope);
  const double square =
      std::max(dot(slip, slip) - (steepness > 0.0 ? along * along / steepness : 0.0), 0.0);
  const double filled = std::max(saturation[face], saturation[face.shifted(axis, -1)]);
  const double wet = std::clamp(filled / moist, 0.0, 1.0);
  return square > 0.0 ? wet * square / (square + slow_ * slow_) : 0.0;
}

template <int D>
void EndOfGround<D>::look_at(int axis, const Index<D>& face, const FaceVector<D>& water,
                             const CellField<D>& saturation, MovingGrains<D>& grains) {
  double &resistance = grains.resistance[axis][face], &rim = rim_[axis][face];
  rim = 0.0;
  const double share = share_at(axis, face);
  if (share <= 0.0 || share >= whole || resistance <= 0.0) return;
  double densest = share, emptiest = share, most = share;
  Vec<D> slope;
  Index<D> outside = face;
  for (int a = 0; a < D; ++a) {
    const double lower = share_at(axis, face.shifted(a, -1));
    const double upper = share_at(axis, face.shifted(a, 1));
    const auto [less, more] = std::minmax(
        {lower, upper, share_at(axis, face.shifted(a, -2)), share_at(axis, face.shifted(a, 2))});
    densest = std::max(densest, more), emptiest = std::min(emptiest, less);
    const double step =
        a == axis ? taken_[face] - taken_[face.shifted(axis, -1)] : 0.5 * (upper - lower);
    slope[a] = step / grid_->spacing()[a];
    if (std::max(lower, upper) <= most) continue;
    most = std::max(lower, upper);
    const int side = lower > upper ? -1 : 1;
    outside = face.shifted(a, -side);
    towards_[axis][face] = side * (a + 1);
  }
  double ends = std::clamp((densest - half_full) / 0.3, 0.0, 1.0) *
                std::clamp((half_full - emptiest) / 0.3, 0.0, 1.0);
  const double steepness = dot(slope, slope);
  if (ends == 0.0 || steepness == 0.0) return;
  ends *= slope[D - 1] * slope[D - 1] / steepness;  // at upright faces nothing runs
  // Water that the rim still holds back flows as soon as that over it does.
  const Vec<D> with = velocity_around(axis, face, grains.velocity, &grains.share);
  ends *= std::max(flows(axis, face, slope, with, water, saturation),
                   flows(axis, outside, slope, with, water, saturation));
  const double along = 1.0 - slope[axis] * slope[axis] / steepness;
  const double across = part_of_ground(share);
  const double part = across + along * (part_in_the_way(share) - across);
  resistance *= 1.0 + ends * (part / share - 1.0);
  rim = most > share ? ends * std::max(1.0 - across / share, 0.0) : 0.0;
}

template <int D>
void EndOfGround<D>::sharpen(const FaceVector<D>& water, const CellField<D>& saturation,
                             MovingGrains<D>& grains) {
  for (int axis = 0; axis < D; ++axis)
    for_each(grid_->owned_faces(axis),
             [&](const Index<D>& face) { look_at(axis, face, water, saturation, grains); });
  std::array<double*, std::size_t{3} * D> fields{};
  std::size_t number = 0;
  for (FaceVector<D>* field : {&rim_, &towards_, &grains.resistance})
    for (int a = 0; a < D; ++a) fields[number++] = (*field)[a].data();
  halo_.exchange(fields);
  damp_rim(grains);
  halo_.exchange(grains.velocity);
}

/// All loans are those of the velocities before.
template <int D>
void EndOfGround<D>::damp_rim(MovingGrains<D>& grains) {
  for (int axis = 0; axis < D; ++axis) {
    const double *part = rim_[axis].data(), *direction = towards_[axis].data();
    const double* mass = grains.inertia[axis].data();
    double* v = grains.velocity[axis].data();
    loans_.clear();
    for_each_offset(*grid_, grid_->owned_faces(axis).grown(1), [&](std::ptrdiff_t at) {
      if (part[at] == 0.0) return;
      const std::ptrdiff_t s = grid_->stride(static_cast<int>(std::abs(direction[at])) - 1);
      const std::ptrdiff_t ground = direction[at] > 0.0 ? at + s : at - s;
      const double both = mass[at] + mass[ground];
      if (both > 0.0)
        loans_.push_back(
            {at, ground, 0.5 * part[at] * mass[at] * mass[ground] / both * (v[ground] - v[at])});
    });
    for (const Loan& loan : loans_) {
      if (loan.momentum == 0.0) continue;
      v[loan.rim] += loan.momentum / mass[loan.rim];
      v[loan.ground] -= loan.momentum / mass[loan.ground];
    }
  }
}

template class EndOfGround<2>;
template class EndOfGround<3>;

}  // namespace mudlark
