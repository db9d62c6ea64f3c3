/// A law that the user compiled, in the real program: the same run as with the native law, and
/// clear words for what cannot be used.
#include "regression/run/runs.hpp"

namespace mudlark {
namespace {

class UmatRun : public RunTest {
 protected:
  fs::path write(const std::string& name, const std::string& law) const {
    const fs::path file = folder_ / (name + ".toml");
    std::ofstream(file) << R"(title = "Slumping block"
[domain]
upper = [1.6, 0.8]
cells = [16, 8]
gravity = "9.81 m/s2"
[domain.walls]
lower_z = "no-slip"
[time]
end = "0.15 s"
[[soil]]
name = "block"
shape = { box = { lower = [0.3, 0], upper = [0.9, 0.5] } }
porosity = 0.4
pore_water = "none"
initial_velocity = [1.0, 0.0]
law = )" << law << R"(
[[gauge]]
name = "corner"
quantity = "displacement"
at = [0.85, 0.45]
every = "5 ms"
[[gauge]]
name = "stress"
quantity = "effective_stress"
at = [0.6, 0.2]
every = "5 ms"
)";
    return file;
  }
  Result run_law(const std::string& name, const std::string& law, int ranks = 1) const {
    std::vector<std::string> words{"run", write(name, law).string(), "--quiet", "-o", name};
    if (ranks > 1) words.insert(words.end(), {"-n", std::to_string(ranks)});
    return wait_patiently(start(words));
  }
  static std::string umat(const std::string& library, const std::string& rest) {
    return "{ type = \"umat\", library = \"" + std::string(MUDLARK_UMATS) + "/" + library +
           ".so\", " + rest + " }";
  }
};

TEST_F(UmatRun, OfVonMisesPlasticityEqualsTheNativeLawOnOneRankAndOnThree) {
  const std::string compiled =
      umat("von_mises", "properties = [1e6, 0.3, 1000.0], state_variables = 1");
  ASSERT_EQ(run_law("native",
                    "{ type = \"von-mises\", young_modulus = 1e6, poisson_ratio = 0.3, "
                    "undrained_strength = 1000, strain = \"jaumann\" }")
                .code,
            0);
  ASSERT_EQ(run_law("compiled", compiled).code, 0);
  ASSERT_EQ(run_law("shared", compiled, 3).code, 0);
  compare_gauges("native", "compiled", 1e-8);
  compare_gauges("native", "shared", 1e-8);
}

TEST_F(UmatRun, FindsItsLibraryBesideTheCaseFile) {
  fs::copy_file(fs::path(MUDLARK_UMATS) / "elastic.so", folder_ / "mine.so");
  const fs::path file =
      write("beside", "{ type = \"umat\", library = \"mine.so\", properties = [1e6, 0.3] }");
  EXPECT_EQ(program({"check", file.string()}).code, 0);
}

TEST_F(UmatRun, RefusesWhatCannotBeUsed) {
  const auto expect_refused = [&](const std::string& law, const std::string& fragment) {
    const Result result = program({"check", write("wrong", law).string()});
    EXPECT_EQ(result.code, 1) << law;
    EXPECT_NE(result.output.find(fragment), std::string::npos) << result.output;
  };
  expect_refused(umat("no_such", "properties = [1e6, 0.3]"), "there is no such file");
  expect_refused(umat("nothing", "properties = [1e6, 0.3]"), "no routine umat");
  expect_refused(umat("elastic", "properties = [0.0, 0.3]"), "returns no stiffness");
  expect_refused(umat("elastic", "properties = [1e6, 0.3], state_variables = -1"), "NSTATV");
  expect_refused(umat("elastic", "properties = [1e6, 0.3], initial_state = [1.0]"),
                 "1 numbers for 0 state variables");
  expect_refused(umat("elastic", "properties = [1e6, 0.3], strain = \"hencky\""), "strain measure");
  std::ofstream(folder_ / "text.so") << "this is no library";
  expect_refused("{ type = \"umat\", library = \"text.so\" }", "cannot be loaded");
}

TEST_F(UmatRun, StopsAtAPointThatTheRoutineGivesUp) {
  const Result result = run_law("careful", umat("careful",
                                                "properties = [1e6, 0.3, 1e-4], "
                                                "state_variables = 1"));
  EXPECT_EQ(result.code, 2) << result.output;
  EXPECT_NE(result.output.find("umat"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace mudlark
