#include "materials/umat_library.hpp"

#include <dlfcn.h>

#include "base/errors.hpp"

namespace mudlark {
namespace {

std::string last_reason() {
  const char* reason = dlerror();
  return reason ? reason : "no reason given";
}

}  // namespace

UmatLibrary::UmatLibrary(const std::string& path) {
  // Lazy: a utility routine of Abaqus that is never called need not be there.
  void* handle = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (!handle) throw InputError("the library cannot be loaded: " + last_reason());
  handle_ = std::shared_ptr<void>(handle, [](void* library) { dlclose(library); });
  void* symbol = dlsym(handle, "umat_");
  if (!symbol) symbol = dlsym(handle, "umat");
  if (!symbol)
    throw InputError("the library has no routine umat (neither symbol umat_ nor symbol umat)");
  function_ = reinterpret_cast<UmatFunction>(symbol);
}

}  // namespace mudlark
