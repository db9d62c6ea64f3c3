#pragma once
/// The shared library with a user's UMAT.
#include <cstddef>
#include <memory>
#include <string>

namespace mudlark {

/// UMAT of Abaqus (User Subroutines Reference Guide, "UMAT"), as gfortran and C compile it: every
/// argument by address, arrays column by column, the length of CMNAME at the end.
using UmatFunction = void (*)(double* stress, double* statev, double* ddsdde, double* sse,
                              double* spd, double* scd, double* rpl, double* ddsddt, double* drplde,
                              double* drpldt, const double* stran, const double* dstran,
                              const double* time, const double* dtime, const double* temp,
                              const double* dtemp, const double* predef, const double* dpred,
                              const char* cmname, const int* ndi, const int* nshr, const int* ntens,
                              const int* nstatv, const double* props, const int* nprops,
                              const double* coords, const double* drot, double* pnewdt,
                              const double* celent, const double* dfgrd0, const double* dfgrd1,
                              const int* noel, const int* npt, const int* layer, const int* kspt,
                              const int* kstep, const int* kinc, std::size_t cmname_length);

/// Keeps the library loaded while it lives. A rank is a process, so routines that keep values
/// between calls (SAVE, COMMON) do not meet each other.
class UmatLibrary {
 public:
  /// Throws InputError with the reason when there is no such library, or no umat in it.
  explicit UmatLibrary(const std::string& path);
  UmatFunction function() const { return function_; }

 private:
  std::shared_ptr<void> handle_;
  UmatFunction function_ = nullptr;
};

}  // namespace mudlark
