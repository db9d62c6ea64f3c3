/// How runs end: exit codes, what the summary says, going on with other settings, conservation.
#include <sys/resource.h>

#include "regression/run/runs.hpp"

namespace mudlark {
namespace {

using Endings = RunTest;
using Ledgers = RunTest;

TEST_F(Endings, ADivergedRunReturns2AndGoesOnWithASmallerStep) {
  const Result diverged = run("flow_3d", 1, "out", {"--set", "time.step=0.05"});
  EXPECT_EQ(diverged.code, 2) << diverged.output;
  EXPECT_EQ(status_of(results("out")), "\"diverged\"");
  EXPECT_NE(diverged.output.find("too large"), std::string::npos) << diverged.output;
  EXPECT_NE(diverged.output.find("The last good state is in"), std::string::npos);
  const Result smaller = run("flow_3d", 2, "out", {"--resume", "--set", "time.step=0.004"});
  EXPECT_EQ(smaller.code, 0) << smaller.output;
  EXPECT_EQ(status_of(results("out")), "\"done\"");
  EXPECT_EQ(entry_of(results("out"), "time [s]"), "0.3");
}

TEST_F(Endings, ADivergedRunOnTwoRanksReturns2) {
  EXPECT_EQ(run("flow_3d", 2, "out", {"--set", "time.step=0.05"}).code, 2);
  EXPECT_EQ(status_of(results("out")), "\"diverged\"");
}

TEST_F(Endings, AFileThatCannotGrowFailsTheRunWithAWord) {
  const pid_t child = start(
      words("soil_3d", 1, "out",
            {"--set", "time.end=100", "time.output_every=0.002", "time.checkpoint_every=1000"}));
  wait_for_state("out");
  const rlimit small{2'000'000, 2'000'000};
  ASSERT_EQ(prlimit(child, RLIMIT_FSIZE, &small, nullptr), 0);
  const Result failed = wait_patiently(child);
  EXPECT_EQ(failed.code, 3) << failed.output;
  EXPECT_EQ(status_of(results("out")), "\"failed\"");
  EXPECT_NE(failed.output.find("points.h5: cannot grow beyond 2 MB"), std::string::npos)
      << failed.output;
  EXPECT_EQ(run("soil_3d", 1, "out", {"--resume", "--until", "0.02"}).code, 0);
}

TEST_F(Endings, AFinishedRunGoesOnToALaterEnd) {
  ASSERT_EQ(run("soil_3d", 1, "out", {"--until", "0.02"}).code, 0);
  EXPECT_EQ(entry_of(results("out"), "time [s]"), "0.02");
  ASSERT_EQ(run("soil_3d", 1, "out", {"--resume", "--until", "0.04"}).code, 0);
  EXPECT_EQ(entry_of(results("out"), "time [s]"), "0.04");
  const Result last = run("soil_3d", 1, "out",
                          {"--resume", "--set", "time.end=0.06", "soil_solver.courant=0.3",
                           "time.output_every=0.01", "gauge.3.every=0.001"});
  ASSERT_EQ(last.code, 0) << last.output;
  EXPECT_EQ(entry_of(results("out"), "time [s]"), "0.06");
  const Series corner = series_of(results("out") / "gauges/corner.csv");
  EXPECT_EQ(corner.rows.size(), 31u);
  EXPECT_EQ(corner.rows.back().front(), 0.06);
}

TEST_F(Endings, AStateOfAnotherSoilIsRefused) {
  ASSERT_EQ(run("soil_3d", 1, "out", {"--until", "0.01"}).code, 0);
  const Result other = run("soil_3d", 1, "out", {"--resume", "--set", "soil.0.porosity=0.35"});
  EXPECT_EQ(other.code, 1) << other.output;
  EXPECT_NE(other.output.find("belong to another case"), std::string::npos) << other.output;
}

TEST_F(Endings, ARunThatWaitsForRestEndsThereAndSaysHowCloseItIs) {
  ASSERT_EQ(run("rest", 1, "out").code, 0);
  EXPECT_EQ(status_of(results("out")), "\"done\"");
  const double time = std::stod(entry_of(results("out"), "time [s]"));
  EXPECT_GT(time, 0.1);
  EXPECT_LT(time, 20.0);
  EXPECT_LT(std::stod(entry_of(results("out"), "unbalanced force / external force")), 1e-3);
  EXPECT_LT(std::stod(entry_of(results("out"), "kinetic energy / external work")), 1e-4);
  const Series top = series_of(results("out") / "gauges/top.csv");
  EXPECT_EQ(top.rows.back().front(), time);  // gauges and fields have the last state
  // rho g (H^2 - (H - z)^2) / (2 M) for z = 0.95 m, to first order in the strain
  EXPECT_NEAR(top.rows.back()[1], 9.81 * 1590.0 * 0.99750 / (2.0 * 1.346154e6), 2e-4);
}

TEST_F(Endings, ARunThatWaitsForRestIsTheSameInTwoParts) {
  ASSERT_EQ(run("rest", 1, "whole").code, 0);
  ASSERT_EQ(run("rest", 1, "parts", {"--until", "0.4"}).code, 0);
  ASSERT_EQ(run("rest", 1, "parts", {"--resume", "--until", "100"}).code, 0);
  for (const char* what : {"time [s]", "unbalanced force / external force"})
    EXPECT_EQ(entry_of(results("parts"), what), entry_of(results("whole"), what)) << what;
  const Series whole = series_of(results("whole") / "gauges/top.csv"),
               parts = series_of(results("parts") / "gauges/top.csv");
  EXPECT_EQ(whole.rows, parts.rows);
}

TEST_F(Endings, ARunWithProjectedPorePressureIsTheSameInTwoParts) {
  for (const std::string formulation : {"u-w-p", "u-p"}) {
    const auto with = [&](std::vector<std::string> more) {
      const std::vector<std::string> wet{
          "--set", "soil.0.pore_water=two-phase", "soil.0.hydraulic_conductivity=1e-3",
          "water.bulk_modulus=2e8", "soil.0.formulation=" + formulation};
      more.insert(more.end(), wet.begin(), wet.end());
      return more;
    };
    ASSERT_EQ(run("soil_3d", 2, "whole", with({})).code, 0);
    ASSERT_EQ(run("soil_3d", 2, "parts", with({"--until", "0.03"})).code, 0);
    ASSERT_EQ(run("soil_3d", 2, "parts", with({"--resume"})).code, 0);
    compare_gauges("whole", "parts", 0.0);
    fs::remove_all(results("whole"));
    fs::remove_all(results("parts"));
  }
}

TEST_F(Endings, AStartInEquilibriumIsNotSoughtAgainWhenResumed) {
  const std::vector<std::string> start{"--set", "soil_solver.start_in_equilibrium.longest=60",
                                       "soil_solver.stop_when_static.after=1",
                                       "soil.0.initial_stress.zz=-15598*(1-z)"};
  auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), start.begin(), start.end());
    return more;
  };
  ASSERT_EQ(run("rest", 1, "whole", with({"--until", "1"})).code, 0);
  ASSERT_EQ(run("rest", 1, "parts", with({"--until", "0.4"})).code, 0);
  ASSERT_EQ(run("rest", 1, "parts", with({"--resume", "--until", "1"})).code, 0);
  EXPECT_EQ(entry_of(results("parts"), "external work"),
            entry_of(results("whole"), "external work"));
  const Series top = series_of(results("whole") / "gauges/top.csv");
  for (const auto& row : top.rows) EXPECT_LT(std::abs(row[1]), 1e-5);
}

double error_of(const fs::path& results, const std::string& what) {
  const std::string text = entry_of(results, what);
  return text.empty() || text == "null" ? HUGE_VAL : std::stod(text);
}

TEST_F(Ledgers, KeepWaterAndMomentumOfAPeriodicBoxOfWater) {
  ASSERT_EQ(run("vortex", 1, "out").code, 0);
  EXPECT_LE(error_of(results("out"), "water"), 1e-12);
  EXPECT_LE(error_of(results("out"), "momentum"), 1e-9);
}

TEST_F(Ledgers, KeepGrainsAndMomentumOfBlocksThatCollide) {
  for (const std::string transfer : {"flip", "apic"}) {
    ASSERT_EQ(run("collision", 2, transfer, {"--set", "soil_solver.transfer=" + transfer}).code, 0);
    EXPECT_EQ(error_of(results(transfer), "grains"), 0.0);
    EXPECT_LE(error_of(results(transfer), "momentum"), 1e-9);
    const Series hit = series_of(results(transfer) / "gauges/target.csv");
    EXPECT_GT(hit.rows.back()[1], 0.05) << "the target was not hit";
  }
}

TEST_F(Ledgers, KeepWaterAndGrainsOfACoupledRun) {
  ASSERT_EQ(run("dam_on_bed_2d", 1, "out").code, 0);
  EXPECT_LE(error_of(results("out"), "water"), 1e-12);
  EXPECT_EQ(error_of(results("out"), "grains"), 0.0);
}

}  // namespace
}  // namespace mudlark
