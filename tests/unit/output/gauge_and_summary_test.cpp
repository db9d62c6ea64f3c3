// ranks: 1 3
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/errors.hpp"
#include "output/files.hpp"
#include "output/gauge_writer.hpp"
#include "output/summary.hpp"
#include "output_support.hpp"

namespace mudlark {
namespace {

using testing_support::TemporaryFolder;
using testing_support::text_of;

const std::vector<std::string> columns{"settlement [m]", "pore pressure [Pa]"};

void sample_steps(GaugeWriter& gauge, int from, int to) {
  for (int i = from; i <= to; ++i) {
    const std::array<double, 2> values{1.0 / (i + 3.0), -1e5 * i};
    gauge.sample(0.1 * i, values);
  }
  gauge.flush();
}

TEST(GaugeWriter, WritesNumbersThatReadBackAsTheSameDoubles) {
  const TemporaryFolder folder;
  GaugeWriter gauge(MPI_COMM_WORLD, folder.path(), "top", columns);
  sample_steps(gauge, 0, 3);
  std::istringstream lines(text_of(folder.path() / "gauges" / "top.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(line, "time [s],settlement [m],pore pressure [Pa]");
  for (int i = 0; i <= 3; ++i) {
    ASSERT_TRUE(std::getline(lines, line));
    double time = 0.0, settlement = 0.0, pressure = 0.0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &settlement, &pressure), 3);
    EXPECT_EQ(time, 0.1 * i);
    EXPECT_EQ(settlement, 1.0 / (i + 3.0));
    EXPECT_EQ(pressure, -1e5 * i);
  }
}

TEST(GaugeWriter, GivesTheSameFileAfterAKillAndResumeAsAStraightRun) {
  const TemporaryFolder straight, resumed;
  {
    GaugeWriter gauge(MPI_COMM_WORLD, straight.path(), "top", columns);
    sample_steps(gauge, 0, 9);
  }
  {
    GaugeWriter gauge(MPI_COMM_WORLD, resumed.path(), "top", columns);
    sample_steps(gauge, 0, 7);
  }
  if (resumed.first_rank())  // the row during which the run was killed
    std::ofstream(resumed.path() / "gauges" / "top.csv", std::ios::app)
        << "0.80000000000000004,0.09";
  GaugeWriter gauge(MPI_COMM_WORLD, resumed.path(), "top", columns, 0.1 * 4);
  sample_steps(gauge, 4, 9);  // the row of the resumed time is there already
  EXPECT_EQ(text_of(resumed.path() / "gauges" / "top.csv"),
            text_of(straight.path() / "gauges" / "top.csv"));
  if (resumed.first_rank()) {
    ASSERT_TRUE(gauge.extremes());
    EXPECT_EQ(gauge.extremes()->largest[0], 1.0 / 3.0)
        << "the extreme of the part before the resumption counts";
    EXPECT_EQ(gauge.extremes()->smallest[1], -9e5);
    EXPECT_EQ(gauge.extremes()->last[0], 1.0 / 12.0);
  }
}

TEST(GaugeWriter, RefusesToContinueAFileWithOtherColumns) {
  const TemporaryFolder folder;
  { GaugeWriter gauge(MPI_COMM_WORLD, folder.path(), "top", {"speed [m/s]"}); }
  EXPECT_THROW(GaugeWriter(MPI_COMM_WORLD, folder.path(), "top", columns, 1.0), InputError);
}

TEST(GaugeWriter, RefusesANameThatLeavesTheFolder) {
  const TemporaryFolder folder;
  EXPECT_THROW(GaugeWriter(MPI_COMM_WORLD, folder.path(), "../top", columns), InputError);
  EXPECT_THROW(GaugeWriter(MPI_COMM_WORLD, folder.path(), "", columns), InputError);
}

TEST(GaugeWriter, TellsEveryRankWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  GaugeWriter gauge(MPI_COMM_WORLD, folder.path(), "top", columns);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{20, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(sample_steps(gauge, 0, 3), std::runtime_error);
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
}

TEST(Summary, IsReadableJsonWithNullForUnknownNumbers) {
  const TemporaryFolder folder;
  Summary summary;
  summary.title = "a \"title\" with \xff bytes";
  summary.steps = 12;
  summary.wall_seconds = std::numeric_limits<double>::quiet_NaN();
  summary.phase_seconds = {{"soil", 1.5}, {"flow", 2.5}};
  summary.conservation_errors = {{"water", 1e-15}};
  summary.gauges = {{"top", {"settlement [m]"}, GaugeExtremes{3.0, {0.25}, {0.0}, {0.26}}},
                    {"empty", {"x [m]"}, {}}};
  summary.peak_memory_bytes = peak_memory(MPI_COMM_WORLD);
  write_summary(folder.path(), summary, MPI_COMM_WORLD);
  const auto json = nlohmann::json::parse(text_of(folder.path() / "summary.json"));
  EXPECT_EQ(json["status"], "running");
  EXPECT_EQ(json["steps"], 12);
  EXPECT_TRUE(json["wall time [s]"].is_null());
  EXPECT_EQ(json["gauges"]["top"]["settlement [m]"]["largest"], 0.26);
  EXPECT_EQ(json["time per phase [s]"]["flow"], 2.5);
  EXPECT_GT(json["peak memory [bytes]"], 1e6);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "summary.json.part"));
}

TEST(Files, PassAnErrorOfRankZeroToEveryRankWithItsKind) {
  EXPECT_THROW(on_rank_zero(MPI_COMM_WORLD, [] { throw InputError("why"); }), InputError);
  EXPECT_THROW(on_rank_zero(MPI_COMM_WORLD, [] { throw std::bad_alloc(); }), std::runtime_error);
  EXPECT_NO_THROW(on_rank_zero(MPI_COMM_WORLD, [] {}));
}

}  // namespace
}  // namespace mudlark
