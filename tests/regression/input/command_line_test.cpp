/// What the commands of the real program do with right input.
#include <sys/file.h>

#include "regression/input/program.hpp"

namespace mudlark {
namespace {

class CommandLine : public ProgramTest {
 protected:
  fs::path pond(const std::string& end) const {
    return write("pond.toml", R"(title = "Small pond"
[domain]
upper = [1, 1]
cells = [16, 16]
[time]
end = )" + end + R"(
step = "5 ms"
[water]
[[water.body]]
shape = { box = { lower = [0, 0], upper = [1, 0.5] } }
[[gauge]]
name = "speed"
quantity = "max_speed"
every = "10 ms"
)");
  }
};

TEST_F(CommandLine, CheckPrintsAResolvedCaseThatIsAValidCase) {
  const Result first = program({"check", pond("0.1").string(), "--set", "time.end=20 ms"});
  ASSERT_EQ(first.code, 0) << first.output;
  EXPECT_NE(first.output.find("end = 0.02  # [s]"), std::string::npos) << first.output;
  EXPECT_NE(first.output.find("#   cells              256"), std::string::npos) << first.output;
  const Result second = program({"check", write("resolved.toml", first.output).string()});
  EXPECT_EQ(second.code, 0) << second.output;
}

TEST_F(CommandLine, RunOnTwoRanksLeavesResultsThatInfoDescribes) {
  const Result run = program({"run", pond("0.05").string(), "-n", "2", "--quiet", "-o", "out"});
  ASSERT_EQ(run.code, 0) << run.output;
  const Result info = program({"info", "out"});
  EXPECT_EQ(info.code, 0);
  EXPECT_NE(info.output.find("Small pond"), std::string::npos) << info.output;
  EXPECT_NE(info.output.find("speed"), std::string::npos) << info.output;
  EXPECT_NE(info.output.find("fields.xdmf"), std::string::npos) << info.output;
}

TEST_F(CommandLine, ResultsGoToAFolderNamedAfterTheCaseByDefault) {
  EXPECT_EQ(program({"run", pond("0.01").string(), "--quiet"}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "results" / "pond" / "summary.json"));
}

TEST_F(CommandLine, InterruptedRanksWriteACheckpointAndTheProgramReturns130) {
  const pid_t child = start({"run", pond("1e6").string(), "-n", "2", "--quiet", "-o", "out"});
  for (int i = 0; i < 3000 && !fs::exists(folder_ / "out" / "gauges" / "speed.csv"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  const Result result = wait_for(child, log());
  EXPECT_EQ(result.code, 130) << result.output;
  EXPECT_FALSE(fs::is_empty(folder_ / "out" / "checkpoint"));
}

/// The first run is played by the lock that it would hold.
TEST_F(CommandLine, ASecondRunIntoTheSameFolderIsRefused) {
  const fs::path results = folder_ / "out";
  fs::create_directories(results);
  const int file = open(results.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(flock(file, LOCK_EX | LOCK_NB), 0);
  const Result second = program({"run", pond("0.01").string(), "-o", results.string()});
  EXPECT_EQ(second.code, 1);
  EXPECT_NE(second.output.find("another run is writing"), std::string::npos) << second.output;
  close(file);
  EXPECT_EQ(program({"run", pond("0.01").string(), "-o", results.string()}).code, 0);
}

TEST_F(CommandLine, RanksThatTheGridCannotUseAreRefusedBeforeTheyStart) {
  const Result result = program({"run", pond("0.01").string(), "-n", "100000"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.output.find("too many for this grid"), std::string::npos) << result.output;
}

TEST_F(CommandLine, CasesAreListedWithTheirTitlesCopiedAndNeverOverwritten) {
  EXPECT_NE(program({"cases"}).output.find("Dam break of Martin and Moyce"), std::string::npos);
  EXPECT_EQ(program({"cases", "dam_break"}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "dam_break" / "martin_moyce.toml"));
  const Result again = program({"cases", "dam_break"});
  EXPECT_EQ(again.code, 1);
  EXPECT_NE(again.output.find("not overwritten"), std::string::npos);
}

TEST_F(CommandLine, VersionNamesTheProgramItsCommitAndItsLibraries) {
  const Result result = program({"--version"});
  EXPECT_EQ(result.code, 0);
  for (const char* word : {"mudlark 0.", "commit", "PETSc", "hypre", "HDF5", "MPI"})
    EXPECT_NE(result.output.find(word), std::string::npos) << result.output;
}

}  // namespace
}  // namespace mudlark
