#include "materials/umat.hpp"

#include <algorithm>
#include <cmath>

#include "materials/invariants.hpp"

namespace mudlark {
namespace {

/// Even compression at which the law is asked for the stiffness of "stress-free" soil [Pa]: laws
/// whose stiffness grows with the stress have none without.
constexpr double little_stress = 1e3;
/// Share of the step below which PNEWDT makes a point count as failed.
constexpr double smallest_share = 1e-4;
constexpr std::array<double, 9> identity{1, 0, 0, 0, 1, 0, 0, 0, 1};

std::array<double, 6> stress_to_abaqus(const SymTensor& t) {
  return {t.xx, t.yy, t.zz, t.xy, t.zx, t.yz};
}
std::array<double, 6> strain_to_abaqus(const SymTensor& t) {
  return {t.xx, t.yy, t.zz, 2.0 * t.xy, 2.0 * t.zx, 2.0 * t.yz};
}
SymTensor stress_from_abaqus(const std::array<double, 6>& v) {
  return {v[0], v[1], v[2], v[3], v[5], v[4]};
}
SymTensor load(const double* v) { return {v[0], v[1], v[2], v[3], v[4], v[5]}; }
void save(const SymTensor& t, double* v) {
  v[0] = t.xx, v[1] = t.yy, v[2] = t.zz, v[3] = t.xy, v[4] = t.yz, v[5] = t.zx;
}

}  // namespace

/// What goes in and what comes back.
struct Umat::Call {
  std::array<double, 6> stress{}, strain{}, strain_increment{};
  std::vector<double> state;
  std::array<double, 36> tangent{};
  double time = 0.0, dt = 1.0, length = 1.0, proposal = 1.0;
  std::array<double, 9> rotation = identity;  ///< columns first
  int point = 1, increment = 1;
};

/// The last tangent and its wave modulus; many points have the same.
struct Umat::Tangent {
  std::array<double, 36> tangent{};
  double modulus = 0.0;
};

double largest_wave_modulus(const std::array<double, 36>& ddsdde) {
  static constexpr int voigt[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  static constexpr double directions[13][3] = {
      {1, 0, 0}, {0, 1, 0},  {0, 0, 1}, {1, 1, 0},  {1, -1, 0}, {1, 0, 1}, {1, 0, -1},
      {0, 1, 1}, {0, 1, -1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
  double largest = 0.0;
  for (const double(&n)[3] : directions) {
    const double square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    double acoustic[3][3] = {};  // n_i C_ijkl n_l
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l)
            acoustic[j][k] += n[i] * n[l] / square *
                              ddsdde[static_cast<std::size_t>(voigt[i][j] + 6 * voigt[k][l])];
    const SymTensor even{acoustic[0][0],
                         acoustic[1][1],
                         acoustic[2][2],
                         0.5 * (acoustic[0][1] + acoustic[1][0]),
                         0.5 * (acoustic[1][2] + acoustic[2][1]),
                         0.5 * (acoustic[0][2] + acoustic[2][0])};
    if (!std::isfinite(even.squared_norm())) return std::nan("");
    largest = std::max(largest, principal_values(even)[0]);
  }
  return largest;
}

Umat::Umat(const UmatOptions& options)
    : options_(options),
      library_(options.library),
      states_(static_cast<std::size_t>(options.state_variables)),
      tensors_{states_} {
  options_.initial_state.resize(states_, 0.0);
  for (std::size_t s = 0; s < states_; ++s)
    names_.push_back("state variable " + std::to_string(s + 1) + " [-]");
  for (const char* axes : {"xx", "yy", "zz", "xy", "yz", "zx"})
    names_.push_back(std::string("strain ") + axes + " [-]");
  names_.push_back("wave modulus [Pa]");
  views_.assign(names_.begin(), names_.end());
}

void Umat::call(Call& c) const {
  static constexpr int normal = 3, shears = 3, all = 6, one = 1, step[4] = {1, 1, 0, 0};
  static constexpr double zero[6] = {};
  const int states = options_.state_variables;
  const auto properties = static_cast<int>(options_.properties.size());
  std::array<char, 80> name;
  name.fill(' ');
  std::copy_n(options_.material_name.begin(),
              std::min<std::size_t>(80, options_.material_name.size()), name.begin());
  double energies[3] = {}, heat = 0.0, by_temperature[6] = {}, heat_by_strain[6] = {}, last = 0.0;
  const double time[2] = {c.time, c.time};
  double no_state = 0.0;
  const double no_property = 0.0;
  const std::array<double, 9> before = identity, after = identity;
  library_.function()(
      c.stress.data(), c.state.empty() ? &no_state : c.state.data(), c.tangent.data(), &energies[0],
      &energies[1], &energies[2], &heat, by_temperature, heat_by_strain, &last, c.strain.data(),
      c.strain_increment.data(), time, &c.dt, zero, zero, zero, zero, name.data(), &normal, &shears,
      &all, &states, properties > 0 ? options_.properties.data() : &no_property, &properties, zero,
      c.rotation.data(), &c.proposal, &c.length, before.data(), after.data(), &c.point, &one, &one,
      &one, step, &c.increment, name.size());
}

/// DDSDDE of a step without strain.
std::array<double, 36> Umat::tangent(const SymTensor& stress, const double* state) const {
  Call c;
  c.stress = stress_to_abaqus(stress);
  c.state.assign(state, state + states_);
  call(c);
  return c.tangent;
}

void Umat::initialise_history(std::span<const SymTensor> stress, double,
                              std::span<double> history) const {
  const std::size_t count = views_.size();
  for (std::size_t i = 0; i < stress.size(); ++i) {
    double* values = &history[i * count];
    std::copy(options_.initial_state.begin(), options_.initial_state.end(), values);
    values[count - 1] = largest_wave_modulus(tangent(stress[i], values));
  }
}

double Umat::wave_modulus(std::span<const SymTensor> stress,
                          std::span<const double> history) const {
  if (stress.empty())
    return largest_wave_modulus(
        tangent(-little_stress * SymTensor::identity(), options_.initial_state.data()));
  double largest = 0.0;
  for (std::size_t i = 0; i < stress.size(); ++i)
    largest = std::max(largest, history[(i + 1) * views_.size() - 1]);
  return largest;
}

double Umat::shear_modulus() const {
  return tangent(-little_stress * SymTensor::identity(), options_.initial_state.data())[3 + 6 * 3];
}

/// Confined compression along z in the tangent of a little even stress.
double Umat::earth_pressure_at_rest() const {
  const auto d = tangent(-little_stress * SymTensor::identity(), options_.initial_state.data());
  return d[0 + 6 * 2] / d[2 + 6 * 2];
}

bool Umat::update_point(const MaterialPoints& points, std::size_t i, Tangent& known) const {
  const std::size_t count = views_.size();
  double* values = &points.history[i * count];
  const auto whole = strain_to_abaqus(points.strain_increment[i]);
  Call next;
  next.stress = stress_to_abaqus(points.stress[i]);
  next.strain = strain_to_abaqus(load(values + states_));
  next.state.assign(values, values + states_);
  next.length = points.length;
  next.point = static_cast<int>(i) + 1;
  next.increment = points.time > 0.0 ? 2 : 1;
  if (!points.rotation.empty())
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 3; ++column)
        next.rotation[row + 3 * column] = points.rotation[i][3 * row + column];
  double done = 0.0, share = 1.0;
  while (done < 1.0) {
    Call trial = next;
    trial.time = points.time + done * points.dt;
    trial.dt = share * points.dt;
    for (std::size_t k = 0; k < 6; ++k) trial.strain_increment[k] = share * whole[k];
    call(trial);
    if (trial.proposal < 1.0) {  // the routine asks for a smaller step
      share *= std::clamp(trial.proposal, 0.1, 0.9);
      if (share < smallest_share) return false;
      continue;
    }
    done = share >= 1.0 - done ? 1.0 : done + share;
    share = std::min(share, 1.0 - done);
    for (std::size_t k = 0; k < 6; ++k) trial.strain[k] += trial.strain_increment[k];
    trial.proposal = 1.0;
    trial.rotation = identity;  // the whole rotation went with the first part
    next = trial;
  }
  const SymTensor stress = stress_from_abaqus(next.stress);
  if (next.tangent != known.tangent) known = {next.tangent, largest_wave_modulus(next.tangent)};
  const double modulus = known.modulus;
  const bool finite = std::isfinite(stress.squared_norm()) && modulus > 0.0 &&
                      std::all_of(next.state.begin(), next.state.end(),
                                  [](double value) { return std::isfinite(value); });
  if (!finite) return false;
  points.stress[i] = stress;
  std::copy(next.state.begin(), next.state.end(), values);
  save(load(values + states_) + points.strain_increment[i], values + states_);
  values[count - 1] = std::max(values[count - 1], modulus);
  return true;
}

std::size_t Umat::update_stress(const MaterialPoints& points) const {
  std::size_t failed = 0;
  Tangent known;
  for (std::size_t i = 0; i < points.stress.size(); ++i) {
    if (update_point(points, i, known)) continue;
    ++failed;
    if (!points.failed.empty()) points.failed[i] = 1;
  }
  return failed;
}

}  // namespace mudlark
