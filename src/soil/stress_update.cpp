/// update_stress of kinematics.hpp: strains of several points at once, the law on batches.
#include <algorithm>
#include <array>
#include <cmath>

#include "soil/kinematics.hpp"
#include "soil/point_group.hpp"

namespace mudlark {
namespace {

/// A run of points on their way through the law.
struct Batch {
  static constexpr std::size_t capacity = 128;
  std::array<SymTensor, capacity> strain, stress;
  std::array<std::array<double, 9>, capacity> rotation;     ///< where the law asks for it
  std::array<TensorLanes, capacity / tensor_lanes> turned;  ///< old stress, of rate measures
  std::array<unsigned char, capacity> failed;
  std::vector<double> history;  ///< point after point
};

/// Soil that has swollen to this times its first volume is single grains that do not touch.
constexpr double apart = 2.0;

bool is_rate(StrainMeasure measure) {
  return measure == StrainMeasure::objective || measure == StrainMeasure::jaumann;
}

/// 1/2 ln b of all lanes: by a rule as long as the largest strain asks for, in closed form or by
/// eigenvectors where elastic strains are beyond any soil's.
template <int D>
TensorLanes half_log_lanes(const TensorLanes& b) {
  TensorLanes x = b;
  x.xx -= 1.0, x.yy -= 1.0, x.zz -= 1.0;
  const TensorValue norm2 = x.squared_norm();
  double largest = 0.0;
  bool numbers = true;
  for (std::size_t i = 0; i < tensor_lanes; ++i) {
    largest = std::max(largest, norm2[i]);
    numbers = numbers && norm2[i] <= 1e300;
  }
  if (numbers && largest < 1e-6) return half_log_of(x, gauss_2);
  if (numbers && largest < 9e-4) return half_log_of(x, gauss_4);
  if (numbers && largest < 0.09) return half_log_of(x, gauss_7);
  TensorLanes strain;
  for (std::size_t i = 0; i < tensor_lanes; ++i)
    strain.set(i, D == 2 ? half_log_plane(b.at(i)) : half_log(b.at(i)));
  return strain;
}

/// exp(2 strain) of all lanes.
TensorLanes exp_twice_lanes(const TensorLanes& strain) {
  const TensorLanes twice = strain.scaled(spread<tensor_lanes>(2.0));
  const TensorValue norm2 = twice.squared_norm();
  double largest = 0.0;
  for (std::size_t i = 0; i < tensor_lanes; ++i) largest = std::max(largest, norm2[i]);
  if (largest < 2.5e-3) return exp_of<8>(twice);
  if (largest < 0.25) return exp_of<14>(twice);
  TensorLanes b;
  for (std::size_t i = 0; i < tensor_lanes; ++i) b.set(i, exp_twice(strain.at(i)));
  return b;
}

/// F <- (I + g) F; returns its symmetric part without I.
template <int D>
TensorLanes deform(SoilParticles<D>& points, const PointGroup& group, const MatrixLanes& g) {
  MatrixLanes old{}, now{};
  const auto at = [](int i, int j) {
    return static_cast<std::size_t>(D == 2 ? 6 * i + 2 * j : 3 * i + j);
  };
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) old[at(i, j)] = group.get(points.deformation[i * D + j]);
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      TensorValue sum = old[at(i, j)];
      for (int k = 0; k < D; ++k) sum += g[at(i, k)] * old[at(k, j)];
      now[at(i, j)] = sum;
      group.set(sum, points.deformation[i * D + j]);
    }
  if (D == 2) now[4] = spread<tensor_lanes>(1.0);
  return {now[0] - 1.0,
          now[4] - 1.0,
          now[8] - 1.0,
          0.5 * (now[1] + now[3]),
          0.5 * (now[5] + now[7]),
          0.5 * (now[2] + now[6])};
}

/// The strain that the law sees, and the stress that it starts from; `k` counts within the batch.
template <int D>
void prepare(SoilParticles<D>& points, const PointGroup& group, MatrixLanes g,
             StrainMeasure measure, bool wants_rotation, std::size_t k, Batch& batch) {
  TensorLanes strain, stress;
  if (is_rate(measure)) {
    const MatrixLanes rotation = step_rotation(g, strain);
    stress = congruent(group.get(points.stress), rotation);
    batch.turned[k / tensor_lanes] = stress;
    if (wants_rotation)
      for (std::size_t i = 0; i < group.live; ++i)
        for (std::size_t c = 0; c < 9; ++c) batch.rotation[k + i][c] = rotation[c][i];
  } else if (measure == StrainMeasure::small) {
    const TensorValue one = spread<tensor_lanes>(1.0);
    strain = deform(points, group, g).combined(TensorValue{}, one, one, group.get(points.elastic));
  } else {
    for (const std::size_t i : {0u, 4u, 8u}) g[i] += 1.0;
    const TensorLanes b = congruent(group.get(points.elastic), g);
    group.set(b, points.elastic);
    strain = half_log_lanes<D>(b);
  }
  for (std::size_t i = 0; i < group.live; ++i)
    batch.strain[k + i] = strain.at(i), batch.stress[k + i] = stress.at(i);
}

/// Grains that do not touch carry nothing, whatever the law made of the strains on their way.
/// Cracks that open one way and close another swell a lone point of Mohr-Coulomb soil without end,
/// and it would press with all that volume.
template <int D>
TensorLanes without_grains_apart(SoilParticles<D>& points, const PointGroup& group,
                                 StrainMeasure measure, const TensorLanes& stress) {
  const TensorValue swollen = group.get(points.volume) / group.get(points.start_volume);
  const TensorValue touching = swollen > apart ? TensorValue{} : spread<tensor_lanes>(1.0);
  if (measure == StrainMeasure::hencky || measure == StrainMeasure::logarithmic)
    for (std::size_t i = 0; i < group.live; ++i)
      if (touching[i] == 0.0)
        set_tensor(points.elastic, group.first + i, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0});
  return stress.scaled(touching);
}

/// Cauchy stress from what the law gave, and the elastic state that belongs to it.
template <int D>
void finish(SoilParticles<D>& points, const PointGroup& group, const SoilModel& law,
            StrainMeasure measure, bool yields, std::size_t k, const Batch& batch) {
  const auto lane = [&](std::size_t i) { return k + (i < group.live ? i : group.live - 1); };
  TensorLanes stress;
  for (std::size_t i = 0; i < tensor_lanes; ++i) stress.set(i, batch.stress[lane(i)]);
  if (measure == StrainMeasure::hencky) {
    if (yields) {
      TensorLanes elastic;
      std::array<bool, tensor_lanes> lost{};
      bool any = false;
      for (std::size_t i = 0; i < tensor_lanes; ++i) {
        const SymTensor left = law.elastic_strain(batch.stress[lane(i)]);
        elastic.set(i, left);
        lost[i] = (batch.strain[lane(i)] + -1.0 * left).squared_norm() > 1e-26;
        any = any || lost[i];
      }
      if (any) {
        const TensorLanes b = exp_twice_lanes(elastic);
        for (std::size_t i = 0; i < group.live; ++i)
          if (lost[i]) set_tensor(points.elastic, group.first + i, b.at(i));
      }
    }
    const TensorValue scale = group.get(points.start_volume) / group.get(points.volume);
    stress = stress.scaled(scale);
  }
  if (measure == StrainMeasure::objective) {  // Hill's term, mid-step
    TensorValue half_rate;
    for (std::size_t i = 0; i < tensor_lanes; ++i)
      half_rate[i] = 0.5 * batch.strain[lane(i)].trace();
    const TensorValue scale = 1.0 / (1.0 + half_rate);
    stress =
        stress.combined(TensorValue{}, scale, -half_rate * scale, batch.turned[k / tensor_lanes]);
  }
  if (yields) stress = without_grains_apart(points, group, measure, stress);
  group.set(stress, points.stress);
}

/// r t r^T, r rows first.
SymTensor rotated(const SymTensor& t, const std::array<double, 9>& r) {
  const std::array<double, 9> m{t.xx, t.xy, t.zx, t.xy, t.yy, t.yz, t.zx, t.yz, t.zz};
  const auto entry = [&](std::size_t i, std::size_t j) {
    double sum = 0.0;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) sum += r[3 * i + a] * m[3 * a + b] * r[3 * j + b];
    return sum;
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)};
}

/// State variables of the points [first, first + length) into the batch, tensors turned.
template <int D>
void load_history(const SoilParticles<D>& points, std::size_t first, std::size_t length,
                  const SoilModel& law, bool rate, Batch& batch) {
  const std::size_t count = points.history.size();
  batch.history.resize(count * length);
  for (std::size_t h = 0; h < count; ++h)
    for (std::size_t k = 0; k < length; ++k)
      batch.history[k * count + h] = points.history[h][first + k];
  if (!rate) return;
  for (const std::size_t at : law.history_tensors())
    for (std::size_t k = 0; k < length; ++k) {
      double* values = &batch.history[k * count + at];
      const SymTensor turned = rotated(
          {values[0], values[1], values[2], values[3], values[4], values[5]}, batch.rotation[k]);
      values[0] = turned.xx, values[1] = turned.yy, values[2] = turned.zz;
      values[3] = turned.xy, values[4] = turned.yz, values[5] = turned.zx;
    }
}
template <int D>
void store_history(SoilParticles<D>& points, std::size_t first, std::size_t length,
                   const Batch& batch) {
  const std::size_t count = points.history.size();
  for (std::size_t h = 0; h < count; ++h)
    for (std::size_t k = 0; k < length; ++k)
      points.history[h][first + k] = batch.history[k * count + h];
}

}  // namespace

template <int D>
StressResult update_stress(SoilParticles<D>& points, PointRange range,
                           std::span<const double> gradient, const SoilModel& law,
                           StrainMeasure measure, const StressStep& step) {
  Batch batch;
  StressResult result;
  const bool with_history = !points.history.empty(), rate = is_rate(measure);
  const bool wants_rotation = law.wants_rotation() || !law.history_tensors().empty();
  for (std::size_t first = range.first; first < range.last; first += Batch::capacity) {
    const std::size_t length = std::min(Batch::capacity, range.last - first);
    const PointRange part{first, first + length};
    for_each_group(part, [&](const PointGroup& group) {
      prepare<D>(points, group, group.gradient<D>(gradient.data(), range), measure, wants_rotation,
                 group.first - first, batch);
    });
    if (with_history) load_history(points, first, length, law, rate, batch);
    std::fill_n(batch.failed.begin(), length, static_cast<unsigned char>(0));
    MaterialPoints material{
        {batch.strain.data(), length}, {batch.stress.data(), length}, batch.history};
    material.dt = step.dt, material.time = step.time, material.length = step.length;
    if (law.wants_rotation()) material.rotation = {batch.rotation.data(), length};
    material.failed = {batch.failed.data(), length};
    const std::size_t failed = law.update_stress(material);
    if (failed > 0 && result.failed == 0)
      result.first_failed =
          first + static_cast<std::size_t>(std::find(batch.failed.begin(), batch.failed.end(), 1) -
                                           batch.failed.begin());
    result.failed += failed;
    if (with_history) store_history(points, first, length, batch);
    for_each_group(part, [&](const PointGroup& group) {
      finish(points, group, law, measure, law.yields(), group.first - first, batch);
    });
  }
  return result;
}

template StressResult update_stress(SoilParticles<2>&, PointRange, std::span<const double>,
                                    const SoilModel&, StrainMeasure, const StressStep&);
template StressResult update_stress(SoilParticles<3>&, PointRange, std::span<const double>,
                                    const SoilModel&, StrainMeasure, const StressStep&);

}  // namespace mudlark
