# One static library per folder of src/, named mudlark_<folder>; `links` names what it may include.
add_library(mudlark_compile_options INTERFACE)
target_compile_options(mudlark_compile_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
# GCC 12 warns about its own AVX-512 intrinsics when Eigen inlines them (GCC bug 105593).
target_compile_options(mudlark_compile_options INTERFACE -Wno-maybe-uninitialized)
# Short vectors wider than the processor's registers are passed in memory; all callers are built alike.
target_compile_options(mudlark_compile_options INTERFACE -Wno-psabi)
if(MUDLARK_WARNINGS_AS_ERRORS)
  target_compile_options(mudlark_compile_options INTERFACE -Werror)
endif()
if(MUDLARK_NATIVE)
  target_compile_options(mudlark_compile_options INTERFACE -march=native)
endif()
# Same answer on any optimisation level and rank count: no reassociation, no contraction surprises.
target_compile_definitions(mudlark_compile_options INTERFACE OMPI_SKIP_MPICXX)

function(mudlark_module name)
  cmake_parse_arguments(MODULE "" "" "LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  if(sources)
    add_library(mudlark_${name} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(mudlark_${name} PRIVATE mudlark_compile_options)
  else()
    add_library(mudlark_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(mudlark_${name} ${scope} ${CMAKE_SOURCE_DIR}/src)
  target_link_libraries(mudlark_${name} ${scope} ${MODULE_LINKS})
endfunction()

# Most of a file's time in the compiler goes into the headers of libraries: read once for all of them.
set(mudlark_library_headers <Eigen/Geometry> <algorithm> <array> <cmath> <filesystem> <functional>
    <limits> <memory> <mpi.h> <optional> <petscdmda.h> <span> <string> <variant> <vector>
    <fmt/format.h>)
