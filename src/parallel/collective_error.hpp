#pragma once
/// Errors that every rank must leave with, so that none waits for another for ever.
#include <mpi.h>

#include <string>

namespace mudlark {

/// The text of the lowest rank that has one, on every rank; empty when nobody has. Collective.
std::string first_text(MPI_Comm comm, const std::string& text);

/// Collective. When any rank brings a non-empty text, every rank throws DivergenceError with the
/// text of the lowest such rank.
void throw_divergence_if_any(MPI_Comm comm, const std::string& problem);

/// The same with InputError.
void throw_input_error_if_any(MPI_Comm comm, const std::string& problem);

}  // namespace mudlark
