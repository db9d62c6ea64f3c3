#include "soil/implicit_matrix.hpp"

#include "soil/implicit_nodes.hpp"

namespace mudlark {
namespace {

/// Dense blocks of points that share their nodes, written to the matrix at once. Grains and water
/// meet through the pore pressure only, and the drag of water is a diagonal.
template <int D>
class PointBlocks {
 public:
  PointBlocks(const ImplicitUnknowns<D>& unknowns, ::Mat matrix, double dt, double water_scale)
      : unknowns_(unknowns), matrix_(matrix), dt_(dt), water_scale_(water_scale) {}
  PointBlocks(const PointBlocks&) = delete;
  PointBlocks& operator=(const PointBlocks&) = delete;
  ~PointBlocks() { flush(); }

  void add(const LinearPoint<D>& point, const ImplicitNodes<D>& nodes) {
    if (!nodes.same_places(group_) || wet_ != point.wet) {
      flush();
      open(nodes, point.wet);
    }
    add_stiffness(point, nodes);
    if (point.wet) add_water(point, nodes);
  }

 private:
  static constexpr int G = D * D;

  void open(const ImplicitNodes<D>& nodes, bool wet) {
    group_ = nodes;
    wet_ = wet;
    const auto faces = static_cast<Eigen::Index>(nodes.faces.size());
    const auto cells = static_cast<Eigen::Index>(nodes.cells.size());
    grains_.clear(), water_.clear(), pressure_.clear();
    signs_.resize(faces), water_signs_.resize(faces);
    for (Eigen::Index i = 0; i < faces; ++i) {
      const auto& face = nodes.faces[static_cast<std::size_t>(i)];
      const auto u = static_cast<std::size_t>(face.component);
      const auto at = static_cast<std::size_t>(face.at);
      grains_.push_back(unknowns_.grains[u][at]);
      water_.push_back(unknowns_.water[u][at]);
      signs_[i] = unknowns_.grain_sign[u][at];
      water_signs_[i] = unknowns_.water_sign[u][at];
    }
    pressure_signs_.resize(cells);
    for (Eigen::Index i = 0; i < cells; ++i) {
      const auto at = static_cast<std::size_t>(nodes.cells[static_cast<std::size_t>(i)].at);
      pressure_.push_back(unknowns_.pressure[at]);
      pressure_signs_[i] = unknowns_.pressure_sign[at];
    }
    stiffness_.setZero(faces, faces);
    squeeze_.setZero(faces, cells);
    flow_.setZero(faces, cells);
    storage_.setZero(cells, cells);
    drag_.setZero(faces);
  }

  void add_stiffness(const LinearPoint<D>& point, const ImplicitNodes<D>& nodes) {
    // Faces come component by component: block (a, b) is slopes_a^T tangent_ab slopes_b.
    const auto faces = static_cast<Eigen::Index>(nodes.faces.size());
    slopes_.resize(D, faces);
    std::array<Eigen::Index, D + 1> first{};
    for (Eigen::Index i = 0; i < faces; ++i) {
      const auto& face = nodes.faces[static_cast<std::size_t>(i)];
      first[static_cast<std::size_t>(face.component) + 1] = i + 1;
      for (int j = 0; j < D; ++j) slopes_(j, i) = face.slope[j];
    }
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) {
        const auto ua = static_cast<std::size_t>(a), ub = static_cast<std::size_t>(b);
        const Eigen::Index rows = first[ua + 1] - first[ua], columns = first[ub + 1] - first[ub];
        product_.noalias() = point.volume * point.tangent.template block<D, D>(a * D, b * D) *
                             slopes_.middleCols(first[ub], columns);
        stiffness_.block(first[ua], first[ub], rows, columns).noalias() +=
            slopes_.middleCols(first[ua], rows).transpose() * product_;
      }
  }

  void add_water(const LinearPoint<D>& point, const ImplicitNodes<D>& nodes) {
    const auto faces = static_cast<Eigen::Index>(nodes.faces.size());
    const auto cells = static_cast<Eigen::Index>(nodes.cells.size());
    weights_.resize(cells), volume_change_.resize(faces), divergence_.resize(faces);
    for (Eigen::Index i = 0; i < cells; ++i)
      weights_[i] = nodes.cells[static_cast<std::size_t>(i)].weight;
    for (Eigen::Index i = 0; i < faces; ++i) {
      const auto& face = nodes.faces[static_cast<std::size_t>(i)];
      double change = 0.0;
      for (int j = 0; j < D; ++j) change += point.cofactor(face.component, j) * face.slope[j];
      volume_change_[i] = change;
      divergence_[i] = face.slope[face.component];
      drag_[i] += point.volume * face.weight * point.drag / dt_;
    }
    squeeze_.noalias() += point.volume * volume_change_ * weights_.transpose();
    flow_.noalias() += point.volume * divergence_ * weights_.transpose();
    storage_.noalias() += point.volume * point.storage * weights_ * weights_.transpose();
  }

  void flush() {
    if (grains_.empty()) return;
    for (Eigen::Index c = 0; c < stiffness_.cols(); ++c)
      stiffness_.col(c).array() *= signs_.array() * signs_[c];
    write(grains_, grains_, stiffness_);
    if (!wet_) return;
    for (Eigen::Index c = 0; c < squeeze_.cols(); ++c) {
      squeeze_.col(c).array() *= signs_.array() * pressure_signs_[c];
      flow_.col(c).array() *= water_signs_.array() * pressure_signs_[c];
      storage_.col(c).array() *= pressure_signs_.array() * pressure_signs_[c];
    }
    write(grains_, pressure_, -squeeze_);
    write(water_, pressure_, -flow_);
    write(pressure_, grains_, water_scale_ * squeeze_.transpose());
    write(pressure_, water_, water_scale_ * flow_.transpose());
    write(pressure_, pressure_, water_scale_ * storage_);
    for (std::size_t i = 0; i < water_.size(); ++i)
      if (water_[i] >= 0)
        MatSetValue(matrix_, water_[i], water_[i], drag_[static_cast<Eigen::Index>(i)], ADD_VALUES);
  }
  void write(const std::vector<PetscInt>& rows, const std::vector<PetscInt>& columns,
             const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>& block) {
    MatSetValues(matrix_, static_cast<PetscInt>(rows.size()), rows.data(),
                 static_cast<PetscInt>(columns.size()), columns.data(), block.data(), ADD_VALUES);
  }

  const ImplicitUnknowns<D>& unknowns_;
  ::Mat matrix_;
  double dt_, water_scale_;
  ImplicitNodes<D> group_;
  bool wet_ = false;
  std::vector<PetscInt> grains_, water_, pressure_;
  Eigen::MatrixXd stiffness_, squeeze_, flow_, storage_;
  Eigen::VectorXd signs_, water_signs_, pressure_signs_, drag_, weights_, volume_change_,
      divergence_;
  Eigen::Matrix<double, D, -1> slopes_, product_;
};

/// How many nodes of one kind on an axis share points with a node of another (or the same) kind:
/// splines of these degrees, about faces or about cell centres.
PetscInt neighbours(int degree, bool at_face, int other_degree, bool other_at_face) {
  const int reach = degree + other_degree + 2;  // twice the distance at which supports part
  return at_face == other_at_face ? 2 * ((reach + 1) / 2) - 1 : 2 * (reach / 2);
}

/// Entries of a row of component `a` in the columns of component `b`; D stands for cells.
template <int D, class K>
PetscInt entries(int a, int b) {
  PetscInt product = 1;
  for (int axis = 0; axis < D; ++axis)
    product *= neighbours(a == axis ? K::along : K::across, a == axis,
                          b == axis ? K::along : K::across, b == axis);
  return product;
}

}  // namespace

template <int D>
void make_matrix(const Grid<D>& grid, Kernel kernel, const ImplicitUnknowns<D>& unknowns,
                 MatHandle& matrix) {
  const auto owned = static_cast<std::size_t>(unknowns.owned);
  std::vector<PetscInt> length(owned), others(owned);
  const auto set = [&](PetscInt number, PetscInt count) {
    if (number >= 0) length[static_cast<std::size_t>(number - unknowns.first)] = count;
  };
  with_kernel(kernel, [&]<class K>(K) {
    PetscInt cell_row = entries<D, K>(D, D);
    for (int d = 0; d < D; ++d) {
      const auto u = static_cast<std::size_t>(d);
      const PetscInt cells = entries<D, K>(d, D);
      PetscInt face_row = cells;
      for (int b = 0; b < D; ++b) face_row += entries<D, K>(d, b);
      cell_row += 2 * cells;
      for_each(grid.owned_faces(d), [&](const Index<D>& face) {
        const auto at = static_cast<std::size_t>(grid.offset(face));
        set(unknowns.grains[u][at], face_row);
        set(unknowns.water[u][at], cells + 1);
      });
    }
    for_each(grid.owned(), [&](const Index<D>& cell) {
      set(unknowns.pressure[static_cast<std::size_t>(grid.offset(cell))], cell_row);
    });
  });
  const PetscInt elsewhere = unknowns.total - unknowns.owned;
  for (std::size_t i = 0; i < owned; ++i) {
    others[i] = std::min(length[i], elsewhere);
    length[i] = std::min(length[i], unknowns.owned);
  }
  MatCreateAIJ(grid.comm(), unknowns.owned, unknowns.owned, PETSC_DETERMINE, PETSC_DETERMINE, 0,
               length.data(), 0, others.data(), matrix.put());
  MatSetOption(matrix, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE);  // the lengths are bounds
}

template <int D>
void add_jacobian(const Grid<D>& grid, Kernel kernel, const ImplicitUnknowns<D>& unknowns,
                  const std::vector<LinearPoint<D>>& points, double dt, double water_scale,
                  ::Mat matrix) {
  PointBlocks<D> blocks(unknowns, matrix, dt, water_scale);
  const Vec<D> per_spacing = inverse(grid.spacing());
  ImplicitNodes<D> nodes;
  with_kernel(kernel, [&]<class K>(K) {
    for (const LinearPoint<D>& point : points) {
      nodes.find(grid, per_spacing,
                 PointSplines<D, K>(in_cells(grid, per_spacing, point.position)));
      blocks.add(point, nodes);
    }
  });
}

template void make_matrix(const Grid<2>&, Kernel, const ImplicitUnknowns<2>&, MatHandle&);
template void make_matrix(const Grid<3>&, Kernel, const ImplicitUnknowns<3>&, MatHandle&);
template void add_jacobian(const Grid<2>&, Kernel, const ImplicitUnknowns<2>&,
                           const std::vector<LinearPoint<2>>&, double, double, ::Mat);
template void add_jacobian(const Grid<3>&, Kernel, const ImplicitUnknowns<3>&,
                           const std::vector<LinearPoint<3>>&, double, double, ::Mat);

}  // namespace mudlark
