#pragma once
/// Owners of PETSc's objects.
#include <petscsnes.h>

namespace mudlark {

/// Destroys what it holds. `put()` is where PETSc writes a new object.
template <class T, PetscErrorCode (*destroy)(T*)>
class PetscHandle {
 public:
  PetscHandle() = default;
  PetscHandle(const PetscHandle&) = delete;
  PetscHandle& operator=(const PetscHandle&) = delete;
  ~PetscHandle() { destroy(&object_); }

  T* put() {
    destroy(&object_);
    return &object_;
  }
  operator T() const { return object_; }  // NOLINT: stands for the object in PETSc's calls

 private:
  T object_ = nullptr;
};

using VecHandle = PetscHandle<::Vec, VecDestroy>;
using MatHandle = PetscHandle<::Mat, MatDestroy>;
using KspHandle = PetscHandle<KSP, KSPDestroy>;
using SnesHandle = PetscHandle<SNES, SNESDestroy>;
using PcHandle = PetscHandle<PC, PCDestroy>;
using IndexSetHandle = PetscHandle<IS, ISDestroy>;
using ScatterHandle = PetscHandle<VecScatter, VecScatterDestroy>;

}  // namespace mudlark
