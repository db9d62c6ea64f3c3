#include "parallel/collective_error.hpp"

#include "base/errors.hpp"

namespace mudlark {

std::string first_text(MPI_Comm comm, const std::string& text) {
  int rank = 0, size = 1, first = 0;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  const int mine = text.empty() ? size : rank;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm);
  if (first == size) return {};
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, first, comm);
  std::string shared = text;
  shared.resize(static_cast<std::size_t>(length));
  MPI_Bcast(shared.data(), length, MPI_CHAR, first, comm);
  return shared;
}

void throw_divergence_if_any(MPI_Comm comm, const std::string& problem) {
  if (const std::string text = first_text(comm, problem); !text.empty())
    throw DivergenceError(text);
}

void throw_input_error_if_any(MPI_Comm comm, const std::string& problem) {
  if (const std::string text = first_text(comm, problem); !text.empty()) throw InputError(text);
}

}  // namespace mudlark
