# Version and commit for `mudlark --version` and output files. The commit is asked for at every build, and the
# generated file changes only when the answer does.
add_custom_target(mudlark_commit ALL
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${CMAKE_SOURCE_DIR} -DOUTPUT=${CMAKE_BINARY_DIR}/generated/version.cpp
          -DVERSION=${PROJECT_VERSION} -P ${CMAKE_SOURCE_DIR}/cmake/write_version.cmake
  BYPRODUCTS ${CMAKE_BINARY_DIR}/generated/version.cpp
  COMMENT "Asking for the commit")
add_library(mudlark_version STATIC ${CMAKE_BINARY_DIR}/generated/version.cpp)
add_dependencies(mudlark_version mudlark_commit)
target_include_directories(mudlark_version PRIVATE ${CMAKE_SOURCE_DIR}/src)
