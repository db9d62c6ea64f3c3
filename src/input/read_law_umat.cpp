/// law = { type = "umat", ... }: a law that the user compiled.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "base/errors.hpp"
#include "input/sections.hpp"
#include "materials/umat.hpp"

namespace mudlark {
namespace {

/// A relative path belongs to the folder of the case file, or else to the working directory; what
/// is recorded holds from everywhere.
std::string read_library(Section& section) {
  const Value* value = section.raw("library");
  const auto* text = value ? std::get_if<std::string>(&value->data) : nullptr;
  if (!text || text->empty()) {
    if (value)
      section.fail("library", "the path of a shared library is expected",
                   "For example \"libx.so\".");
    else
      section.missing("library",
                      "the shared library with the routine umat, for example \"libx.so\"");
    return {};
  }
  namespace fs = std::filesystem;
  const fs::path beside = fs::path(section.place("library").origin).parent_path() / *text;
  const fs::path path = fs::absolute(fs::exists(beside) ? beside : fs::path(*text));
  section.record().value("library", toml_text(path.lexically_normal().string()));
  if (!fs::is_regular_file(path)) {
    section.fail("library",
                 "there is no such file, neither beside the case file nor in the working "
                 "directory",
                 "gfortran -shared -fPIC -O2 -o libx.so x.f90 makes one.");
    return {};
  }
  return path.lexically_normal().string();
}

/// Loads the library and asks the routine for its stiffness, before hours of a run are spent.
void try_law(Section& section, const UmatOptions& options) {
  try {
    const Umat law(options);
    const double modulus = law.wave_modulus({}, {}), shear = law.shear_modulus();
    if (!(modulus > 0.0) || !(shear > 0.0))
      section.fail("properties",
                   fmt::format("for a step without strain at an even compression of 1 kPa the "
                               "routine returns no stiffness: DDSDDE gives waves a modulus of {} "
                               "Pa, shear one of {} Pa",
                               modulus, shear),
                   "Check number, order and units of the properties, and initial_state.");
  } catch (const InputError& error) {
    section.fail("library", error.what(), "docs/user/umat.md has the two commands that make one.");
  }
}

}  // namespace

SoilLawOptions read_umat(Section& section) {
  const std::size_t before = section.reading().report.size();
  UmatOptions law;
  law.library = read_library(section);
  law.properties = section.numbers("properties", quantity::number, 0, std::vector<double>{});
  law.state_variables = section.integer("state_variables",
                                        {.lower = 0,
                                         .upper = 1000,
                                         .reason = "NSTATV, the length of STATEV",
                                         .cure = "The author of the routine says how many."},
                                        0);
  law.initial_state = section.numbers("initial_state", quantity::number, 0, std::vector<double>{});
  if (!law.initial_state.empty() &&
      law.initial_state.size() != static_cast<std::size_t>(std::max(0, law.state_variables)))
    section.fail("initial_state",
                 fmt::format("{} numbers for {} state variables", law.initial_state.size(),
                             law.state_variables),
                 "Write one number for each, or leave the key out for zeros.");
  law.material_name = section.text("material_name", "SOIL");
  if (section.reading().report.size() == before) try_law(section, law);
  return law;
}

}  // namespace mudlark
