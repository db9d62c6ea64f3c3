/// Boundaries of all kinds: the same on any number of ranks and in two parts; shaking from a file.
#include "regression/run/runs.hpp"

namespace mudlark {
namespace {

using Boundaries = RunTest;

TEST_F(Boundaries, GiveTheSameOnAnyNumberOfRanks) {
  ASSERT_EQ(run("boundaries", 1, "one").code, 0);
  for (const int ranks : {2, 4}) {
    const std::string into = "on " + std::to_string(ranks);
    const Result several = run("boundaries", ranks, into);
    ASSERT_EQ(several.code, 0) << several.output;
    printf("%d ranks: largest relative difference %.3g\n", ranks,
           compare_gauges("one", into, 1e-9));
  }
  EXPECT_GT(std::abs(series_of(results("one") / "gauges/head.csv").rows.back()[1]), 1e-6);
  EXPECT_GT(series_of(results("one") / "gauges/face.csv").rows.back()[1], 1e-6);
}

TEST_F(Boundaries, GoOnFromACheckpointAsIfNothingHadHappened) {
  for (const int ranks : {1, 2}) {
    const std::string whole = "whole " + std::to_string(ranks), parts = "parts" + whole;
    ASSERT_EQ(run("boundaries", ranks, whole).code, 0);
    ASSERT_EQ(run("boundaries", ranks, parts, {"--until", "0.02"}).code, 0);
    const Result rest = run("boundaries", ranks, parts, {"--resume", "--until", "0.05"});
    ASSERT_EQ(rest.code, 0) << rest.output;
    compare_gauges(whole, parts, 0.0);
  }
  ASSERT_EQ(run("boundaries", 1, "fewer", {"--until", "0.02"}).code, 0);
  ASSERT_EQ(run("boundaries", 3, "fewer", {"--resume", "--until", "0.05"}).code, 0);
  compare_gauges("whole 1", "fewer", 1e-9);
}

// A side that moves and a moving frame, as an expression and as a record with the same numbers.
TEST_F(Boundaries, AreShakenByARecordAsByAnExpression) {
  std::string record = "time [ms],displacement [mm],acceleration [gal]\n";
  const double w = 300.0;
  for (int i = 0; i <= 5000; ++i) {
    const double t = i * 1e-5, s = std::sin(w * t);
    char line[100];
    std::snprintf(line, sizeof line, "%.17g,%.17g,%.17g\n", 1e3 * t, s * s,
                  1e2 * 2.0 * 1e-3 * w * w * std::cos(2.0 * w * t));
    record += line;
  }
  const std::string file = write("record.csv", record).string();
  const auto expect_the_same = [&](const std::string& key, const std::string& expression,
                                   const std::string& column) {
    ASSERT_EQ(run("boundaries", 1, "expression" + column, {"--set", key + "=" + expression}).code,
              0);
    const Result csv =
        run("boundaries", 1, "record" + column,
            {"--set", key + "=[{ csv = \"" + file + "\", column = \"" + column + "\" }, 0]"});
    ASSERT_EQ(csv.code, 0) << csv.output;
    compare_gauges("expression" + column, "record" + column, 1e-3);
  };
  expect_the_same("boundary.0.grains.displacement", "[\"1e-3*sin(300*t)^2\", 0]", "displacement");
  expect_the_same("soil_solver.body_acceleration", "[\"180*cos(600*t)\", 0]", "acceleration");
}

}  // namespace
}  // namespace mudlark
