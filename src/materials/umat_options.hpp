#pragma once
/// A soil law that the user compiled: an Abaqus UMAT.
#include <string>
#include <vector>

namespace mudlark {

struct UmatOptions {
  std::string library;                ///< shared library, a path that the process finds
  std::vector<double> properties;     ///< PROPS
  int state_variables = 0;            ///< NSTATV
  std::vector<double> initial_state;  ///< STATEV at the start; empty: zeros
  std::string material_name;          ///< CMNAME
};

}  // namespace mudlark
