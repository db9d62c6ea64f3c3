/// Runs the real program on wrong input: exit code 1, the right line, nothing else.
#include <algorithm>

#include "regression/input/program.hpp"

namespace mudlark {
namespace {

class WrongInput : public ProgramTest {
 protected:
  /// Exit code 1, `fragment` in the message, and no sign of a crash.
  static void expect_refused(const Result& result, const std::string& fragment) {
    EXPECT_EQ(result.code, 1) << result.output.substr(0, 800);
    EXPECT_NE(result.output.find(fragment), std::string::npos)
        << "expected: " << fragment << "\ngot: " << result.output.substr(0, 800);
    for (const char* crash : {"terminate called", "PETSC ERROR", "Segmentation",
                              "Signal:", "internal error", "AddressSanitizer", "runtime error:"})
      EXPECT_EQ(result.output.find(crash), std::string::npos) << result.output.substr(0, 800);
  }
};

const fs::path wrong_files = fs::path(MUDLARK_SOURCE_DIR) / "tests/regression/input/wrong";

/// The part of `output` that the mistake at `place` ("file:line:") takes: its line and the indented
/// ones.
std::vector<std::string> mistakes_at(const std::string& output, const std::string& place) {
  std::vector<std::string> found;
  std::istringstream stream(output);
  bool inside = false;
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("  ")) {
      inside = line.starts_with(place);
      if (inside) found.push_back(line);
    } else if (inside) {
      found.back() += "\n" + line;
    }
  }
  return found;
}

TEST_F(WrongInput, EveryWrongCaseFileIsRefusedAtTheRightLineForTheRightReason) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(wrong_files)) {
    if (entry.is_directory()) continue;  // files that the cases read
    const std::string text = text_of(entry.path()), mark = "# expect: ";
    ASSERT_TRUE(text.starts_with(mark)) << entry.path();
    const std::string first = text.substr(mark.size(), text.find('\n') - mark.size());
    const std::size_t colon = first.find(": ");
    const std::string line = first.substr(0, colon), fragment = first.substr(colon + 2);
    const Result result = program({"check", entry.path().string()});
    SCOPED_TRACE(entry.path().filename().string());
    expect_refused(result, fragment);
    const auto found = mistakes_at(result.output, entry.path().string() + ":" + line + ":");
    EXPECT_TRUE(std::any_of(
        found.begin(), found.end(),
        [&](const std::string& mistake) { return mistake.find(fragment) != std::string::npos; }))
        << "not at line " << line << ":\n"
        << result.output.substr(0, 800);
    ++count;
  }
  EXPECT_GE(count, 60);
}

TEST_F(WrongInput, AGaugeIsNotBlamedForTheBoundaryThatItMeasures) {
  const std::string text = text_of(wrong_files / "boundary_pressure_without_value.toml") +
                           "\n[[gauge]]\nname = \"q\"\nquantity = \"discharge\"\nof = \"";
  const Result right = program({"check", write("right.toml", text + "b\"\n").string()});
  expect_refused(right, "boundary.pore_water");
  EXPECT_EQ(right.output.find("gauge"), std::string::npos) << right.output;
  expect_refused(program({"check", write("other.toml", text + "c\"\n").string()}), "gauge.of");
}

TEST_F(WrongInput, EmptyBinaryAndForeignFilesAreRefused) {
  using namespace std::string_literals;
  expect_refused(program({"check", write("empty.toml", "").string()}),
                 ":1: the case file is empty");
  expect_refused(program({"check", write("blank.toml", " \n\n").string()}), "is empty");
  expect_refused(program({"check", write("latin1.toml", "title = \"B\xf6schung\"\n").string()}),
                 "latin1.toml:1:");
  expect_refused(program({"check", write("utf16.toml", "\xff\xfe[\0d\0]\0"s).string()}),
                 "utf16.toml:1:");
  expect_refused(program({"check", write("zeros.toml", std::string(5000, '\0')).string()}),
                 "zeros.toml:1:");
  expect_refused(program({"check", write("deep.toml", "a = " + std::string(100000, '[')).string()}),
                 "deep.toml:1:");
  expect_refused(program({"check", MUDLARK_PROGRAM}), "not valid TOML");
}

TEST_F(WrongInput, MissingFilesFoldersAndDevicesAreRefused) {
  expect_refused(program({"check", "nowhere.toml"}), "nowhere.toml: there is no such case file");
  expect_refused(program({"check", folder_.string()}), "this is a folder");
  expect_refused(program({"check", "/dev/zero"}), "not a regular file");
  if (geteuid() != 0) {
    const fs::path secret = write("secret.toml", "title = \"a\"\n");
    fs::permissions(secret, fs::perms::none);
    expect_refused(program({"check", secret.string()}), "cannot be read");
  }
}

TEST_F(WrongInput, CommandLineMistakesExitWithOne) {
  expect_refused(program({}), "subcommand");
  expect_refused(program({"fly"}), "");
  expect_refused(program({"run"}), "");
  expect_refused(program({"run", "a.toml", "-n", "0"}), "");
  expect_refused(program({"run", "a.toml", "-n", "many"}), "");
  expect_refused(program({"check", "a.toml", "--colour"}), "--colour");
  expect_refused(program({"cases", "atlantis"}), "there is no case atlantis");
  expect_refused(program({"cases", "../src"}), "there is no case ../src");
  expect_refused(program({"info", "nowhere"}), "there is no such folder");
  expect_refused(program({"info", folder_.string()}), "not a results folder");
  expect_refused(program({"plot", "nowhere"}), "there is no such folder");
}

class WrongRun : public WrongInput {
 protected:
  fs::path pond() const {
    return write("pond.toml", R"([domain]
upper = [1, 1]
cells = [8, 8]
[time]
end = "20 ms"
step = "5 ms"
[water]
[[water.body]]
shape = { box = { lower = [0, 0], upper = [1, 0.5] } }
)");
  }
};

TEST_F(WrongRun, OverridesThatAreWrongNameTheirOption) {
  const std::string file = pond().string();
  expect_refused(program({"check", file, "--set", "time.end=-1"}), "--set time.end=-1: time.end");
  expect_refused(program({"check", file, "--set", "time.end=5 kg"}), "wrong dimension");
  expect_refused(program({"check", file, "--set", "tim.end=5"}), "Did you mean time?");
  expect_refused(program({"check", file, "--set", "water.body.7.pressure=hydrostatic"}),
                 "there is no 7");
  expect_refused(program({"check", file, "--set", "end"}), "not of the form key=value");
  expect_refused(program({"check", file, "--set", "..=1"}), "not of the form key=value");
  expect_refused(program({"check", file, "--set", "time.end.more=1"}), "not a table");
}

TEST_F(WrongRun, WhatFollowsFromAMistakeIsNotReportedBesideIt) {
  const std::string base = text_of(pond());
  const auto mistakes = [&](const char* name, const std::string& more) {
    const fs::path file = write(name, base + more);
    return mistakes_at(program({"check", file.string()}).output, file.string() + ":");
  };
  const auto wave = mistakes(
      "wave.toml", "[[wave]]\nname = \"sea\"\ntype = \"jonswap\"\nTp = 2\nside = \"lower_x\"\n");
  ASSERT_EQ(wave.size(), 1u);  // which keys it has depends on the type
  EXPECT_NE(wave[0].find("wave.type"), std::string::npos) << wave[0];
  const auto soil = mistakes("soil.toml", R"([[soil]]
name = "bed"
shape = { box = { lower = [0, 0], upper = [1, 0.2] } }
porosity = 0.4
pore_water = "undrained"
hydraulic_conductivity = 1e-4
law = { type = "linear-elastic", young_modulus = 1e7, poisson_ratio = 0.3 }
)");
  ASSERT_EQ(soil.size(), 1u);
  EXPECT_NE(soil[0].find("\"two-phase\", \"none\", \"unified\""), std::string::npos) << soil[0];
}

TEST_F(WrongRun, AStepThatTheWaterCannotTakeIsWarnedOf) {
  const std::string file = pond().string();
  EXPECT_EQ(program({"check", file}).output.find("warning"), std::string::npos);
  const Result result = program({"check", file, "--set", "time.step=1"});
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.output.find("warning: time.step = 1 s"), std::string::npos) << result.output;
}

TEST_F(WrongRun, ExplicitStepsOverMonthsAreWarnedOf) {
  const std::string file = write("clay.toml", R"([domain]
upper = [4, 2]
cells = [40, 20]
walls = { upper_z = "open" }
[time]
end = "30 d"
[[soil]]
name = "clay"
shape = { box = { lower = [0, 0], upper = [4, 1] } }
porosity = 0.4
pore_water = "none"
law = { type = "linear-elastic", young_modulus = "20 MPa", poisson_ratio = 0.3 }
)")
                               .string();
  EXPECT_NE(program({"check", file}).output.find("soil_solver.method = \"implicit\""),
            std::string::npos);
  EXPECT_EQ(program({"check", file, "--set", "time.end=1 s"}).output.find("warning"),
            std::string::npos);
}

TEST_F(WrongRun, WrongCaseIsRefusedBeforeAnyRankStarts) {
  const fs::path file = wrong_files / "poisson_ratio.toml";
  expect_refused(program({"run", file.string(), "-n", "3"}), "soil.law.poisson_ratio = 0.52");
  EXPECT_FALSE(fs::exists(folder_ / "results"));
}

TEST_F(WrongRun, ResultsFolderThatCannotBeWrittenIsRefused) {
  const std::string file = pond().string();
  expect_refused(program({"run", file, "-o", file}), "-o");
  expect_refused(program({"run", file, "-o", file + "/below"}), "cannot be made");
  expect_refused(program({"run", file, "-o", "/proc/mudlark"}), "cannot be made");
  if (geteuid() != 0) {
    fs::create_directories(folder_ / "locked");
    fs::permissions(folder_ / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    expect_refused(program({"run", file, "-o", "locked"}), "nothing can be written");
  }
}

TEST_F(WrongRun, UntilMustBeATimeAboveZero) {
  const std::string file = pond().string();
  expect_refused(program({"run", file, "--until", "5 kg"}), "--until = 5 kg");
  expect_refused(program({"run", file, "--until", "0"}), "--until = 0");
}

TEST_F(WrongRun, ResumingWithoutACheckpointIsRefused) {
  expect_refused(program({"run", pond().string(), "--resume", "-o", "fresh"}), "no checkpoint");
}

TEST_F(WrongRun, DamagedCheckpointIsRefused) {
  const std::string file = pond().string();
  ASSERT_EQ(program({"run", file, "--quiet", "-o", "out"}).code, 0);
  const fs::path checkpoint = folder_ / "out" / "checkpoint";
  ASSERT_TRUE(fs::exists(checkpoint));
  for (const auto& entry : fs::recursive_directory_iterator(checkpoint))
    if (entry.is_regular_file()) fs::resize_file(entry.path(), entry.file_size() / 2);
  expect_refused(program({"run", file, "--quiet", "--resume", "-o", "out"}), "checkpoint");
  for (const auto& entry : fs::recursive_directory_iterator(checkpoint))
    if (entry.is_regular_file()) std::ofstream(entry.path()) << "no checkpoint at all";
  expect_refused(program({"run", file, "--quiet", "--resume", "-o", "out"}), "checkpoint");
}

}  // namespace
}  // namespace mudlark
