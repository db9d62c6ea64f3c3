#include "soil/contact_stiffness.hpp"

namespace mudlark {

template <int D>
void ContactStiffness<D>::apply(const FaceVector<D>& ways, FaceVector<D>& forces) const {
  if (!list) return;
  for (std::size_t c = 0; c < of.size(); ++c) {
    const Contact<D>& contact = list->contacts()[c];
    const Vec<D> way = list->at_contact(ways, contact);
    for (int d = 0; d < D; ++d) {
      double force = 0.0;
      for (int e = 0; e < D; ++e) force += of[c](d, e) * way[e];
      double* faces = forces[d].data();
      list->for_each_node(d, contact, [&](std::ptrdiff_t at, double w) { faces[at] += w * force; });
    }
  }
}

template <int D>
void ContactStiffness<D>::add_diagonal(FaceVector<D>& diagonal) const {
  if (!list) return;
  for (std::size_t c = 0; c < of.size(); ++c)
    for (int d = 0; d < D; ++d) {
      double* faces = diagonal[d].data();
      list->for_each_node(d, list->contacts()[c],
                          [&](std::ptrdiff_t at, double w) { faces[at] += w * w * of[c](d, d); });
    }
}

template <int D>
void ContactStiffness<D>::add_to(::Mat matrix,
                                 const std::array<const std::vector<PetscInt>*, D>& numbers,
                                 const std::array<std::vector<double>, D>& signs) const {
  if (!list) return;
  std::array<std::vector<PetscInt>, D> columns;
  std::array<Eigen::VectorXd, D> weights;
  for (std::size_t c = 0; c < of.size(); ++c) {
    const Contact<D>& contact = list->contacts()[c];
    for (std::size_t d = 0; d < D; ++d) {
      columns[d].clear();
      weights[d].resize(static_cast<Eigen::Index>(contact.nodes[d + 1] - contact.nodes[d]));
      list->for_each_node(static_cast<int>(d), contact, [&](std::ptrdiff_t at, double w) {
        const auto place = static_cast<std::size_t>(at);
        weights[d][static_cast<Eigen::Index>(columns[d].size())] = signs[d][place] * w;
        columns[d].push_back((*numbers[d])[place]);
      });
    }
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t e = 0; e < D; ++e) {
        const double entry = of[c](static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(e));
        const Eigen::Matrix<double, -1, -1, Eigen::RowMajor> block =
            entry * weights[d] * weights[e].transpose();
        MatSetValues(matrix, static_cast<PetscInt>(columns[d].size()), columns[d].data(),
                     static_cast<PetscInt>(columns[e].size()), columns[e].data(), block.data(),
                     ADD_VALUES);
      }
  }
}

template struct ContactStiffness<2>;
template struct ContactStiffness<3>;

}  // namespace mudlark
