/// A run that ends early goes on from its checkpoint as if nothing had happened.
#include <random>

#include "regression/run/runs.hpp"

namespace mudlark {
namespace {

const std::vector<std::string> saving_often{"--set", "time.checkpoint_every=0.02"};

class Resume : public RunTest {
 protected:
  /// A straight run; returns how long it took [s].
  double straight(const std::string& name, int ranks) {
    const auto begin = std::chrono::steady_clock::now();
    const Result result = run(name, ranks, "straight", saving_often);
    EXPECT_EQ(result.code, 0) << result.output;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  void resume(const std::string& name, int ranks, const std::string& into) {
    std::vector<std::string> more = saving_often;
    more.push_back("--resume");
    const Result result = run(name, ranks, into, more);
    ASSERT_EQ(result.code, 0) << result.output;
    EXPECT_EQ(status_of(results(into)), "\"done\"");
    EXPECT_EQ(entry_of(results(into), "resumed"), "true");
  }
  /// Kills runs at random moments, those that are resumed included, and lets the last one end.
  void kill_and_resume(const std::string& name, int ranks, int kills, unsigned seed) {
    const double duration = straight(name, ranks);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    double latest = 0.6 * duration;  // shorter after runs that ended sooner: machines have moods
    int killed = 0;
    // A run that ended before its turn leaves nothing to kill: the next one starts anew.
    for (int i = 0; i < kills || (killed == 0 && i < kills + 4); ++i) {
      std::vector<std::string> more = saving_often;
      if (killed > 0)
        more.push_back("--resume");
      else
        std::filesystem::remove_all(results("killed"));
      const pid_t child = start(words(name, ranks, "killed", more));
      wait_for_state("killed");
      std::this_thread::sleep_for(std::chrono::duration<double>(share(random) * latest));
      const bool alive = kill_family(child);
      killed += alive ? 1 : 0;
      if (!alive) latest *= 0.2;
    }
    EXPECT_GT(killed, 0) << "every run ended before it could be killed";
    resume(name, ranks, "killed");
    compare_gauges("straight", "killed", 0.0);
  }
  /// Interrupts a run by a signal early on, checks what it leaves, and completes it.
  void interrupt_and_resume(const std::string& name, int ranks, int signal) {
    straight(name, ranks);
    const pid_t child = start(words(name, ranks, "stopped", saving_often));
    wait_for_state("stopped");
    kill(child, signal);
    const Result result = wait_patiently(child);
    EXPECT_EQ(result.code, 130) << result.output;
    EXPECT_EQ(status_of(results("stopped")), "\"interrupted\"");
    resume(name, ranks, "stopped");
    compare_gauges("straight", "stopped", 0.0);
  }
  /// A run that was killed half way on one number of ranks.
  void leave_half_a_run(const std::string& name, int ranks) {
    const pid_t child = start(words(name, ranks, "half", saving_often));
    wait_for_state("half");
    for (int i = 0; i < 60000 && text_of(results("half") / "gauges/energy.csv").size() < 300; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_TRUE(kill_family(child)) << "the run ended before it could be killed";
  }
};

TEST_F(Resume, AfterKillsGivesTheSameBitsOfACoupledRun) {
  kill_and_resume("dam_on_bed_2d", 1, 4, 1);
}
TEST_F(Resume, AfterKillsGivesTheSameBitsOfACoupledRunOnTwoRanks) {
  kill_and_resume("dam_on_bed_2d", 2, 4, 2);
}
TEST_F(Resume, AfterKillsGivesTheSameBitsOfACoupledRunIn3D) {
  kill_and_resume("dam_on_bed_3d", 2, 2, 3);
}
TEST_F(Resume, AfterKillsGivesTheSameBitsOfARunWithOneWater) {
  kill_and_resume("one_water_2d", 2, 2, 8);
}
TEST_F(Resume, AfterKillsGivesTheSameBitsOfALeveeBetweenSidesThatLetWaterThrough) {
  kill_and_resume("one_water_sides_2d", 2, 2, 11);
}
TEST_F(Resume, AfterKillsGivesTheSameBitsOfATideBesideALevee) {
  kill_and_resume("one_water_tide_2d", 2, 2, 13);
}
TEST_F(Resume, AfterKillsGivesTheSameBitsOfABedThatComesToRestUnderWater) {
  kill_and_resume("one_water_rest_2d", 2, 2, 14);
}
TEST_F(Resume, AfterKillsGivesTheSameBitsOfABodyInOneWater) {
  kill_and_resume("one_water_solid_2d", 2, 2, 9);
}
TEST_F(Resume, AfterKillsGivesTheSameBitsOfABodyThatIsFreeInOneWater) {
  kill_and_resume("one_water_free_2d", 2, 2, 10);
}
TEST_F(Resume, AfterKillsGivesTheSameBitsOfABodyThatIsFreeInWater) {
  kill_and_resume("free_2d", 2, 2, 11);
}
TEST_F(Resume, AfterKillsGivesTheSameBitsOfSoilAlone) { kill_and_resume("soil_3d", 1, 3, 4); }
TEST_F(Resume, AfterKillsGivesTheSameBitsOfSplitPoints) { kill_and_resume("drawn", 2, 2, 6); }
/// On one rank: the direct solver of implicit steps sums up what other ranks send as it arrives.
TEST_F(Resume, AfterKillsGivesTheSameBitsOfBodiesInImplicitSteps) {
  kill_and_resume("solid_implicit", 1, 2, 12);
}
TEST_F(Resume, AfterKillsGivesTheSameBitsOfStages) { kill_and_resume("stages", 1, 3, 7); }

/// In the middle of every stage, and where one ends and the next has not begun.
TEST_F(Resume, InAnyStageGoesOnAsAStraightRun) {
  straight("stages", 1);
  std::vector<std::string> more;
  for (const char* until : {"0.01", "0.02", "0.032", "0.04", "0.046", "0.05", "0.06", "0.07"}) {
    std::vector<std::string> part = more;
    part.insert(part.end(), {"--until", until});
    const Result result = run("stages", 1, "parts", part);
    ASSERT_EQ(result.code, 0) << until << result.output;
    more = {"--resume"};
  }
  compare_gauges("straight", "parts", 0.0);
  EXPECT_EQ(entry_of(results("parts"), "grains taken out [kg]"),
            entry_of(results("straight"), "grains taken out [kg]"));
}
TEST_F(Resume, AfterKillsGivesTheSameBitsOfFlowAlone) { kill_and_resume("flow_3d", 2, 3, 5); }

TEST_F(Resume, OnAnotherNumberOfRanksGivesTheSameNumbers) {
  straight("dam_on_bed_2d", 1);
  for (const auto& [before, after] : {std::pair{1, 3}, std::pair{2, 1}}) {
    fs::remove_all(results("half"));
    leave_half_a_run("dam_on_bed_2d", before);
    resume("dam_on_bed_2d", after, "half");
    const double worst = compare_gauges("straight", "half", 1e-10);
    printf("%d ranks, then %d: largest relative difference %.3g\n", before, after, worst);
  }
}

TEST_F(Resume, AfterControlCGivesTheSameBits) { interrupt_and_resume("dam_on_bed_2d", 1, SIGINT); }
TEST_F(Resume, AfterControlCOnTwoRanksGivesTheSameBits) {
  interrupt_and_resume("dam_on_bed_2d", 2, SIGINT);
}
TEST_F(Resume, AfterTheSignalOfABatchSystemGivesTheSameBits) {
  interrupt_and_resume("soil_3d", 1, SIGTERM);
}
TEST_F(Resume, AfterTheSignalOfABatchSystemOnTwoRanksGivesTheSameBits) {
  interrupt_and_resume("flow_3d", 2, SIGTERM);
}

TEST_F(Resume, PassesOverATruncatedStateAndTakesTheOlderOne) {
  straight("dam_on_bed_2d", 1);
  ASSERT_EQ(run("dam_on_bed_2d", 1, "cut", saving_often).code, 0);
  fs::path newest = results("cut") / "checkpoint/state-A.h5",
           other = results("cut") / "checkpoint/state-B.h5";
  if (fs::last_write_time(other) > fs::last_write_time(newest)) std::swap(newest, other);
  fs::resize_file(newest, fs::file_size(newest) / 2);
  const Result result =
      run("dam_on_bed_2d", 1, "cut", {"--resume", "--set", "time.checkpoint_every=1000"});
  ASSERT_EQ(result.code, 0) << result.output;
  EXPECT_NE(result.output.find(newest.filename().string() + " is damaged"), std::string::npos)
      << result.output;
  compare_gauges("straight", "cut", 0.0);
}

TEST_F(Resume, IsRefusedWithoutAGoodState) {
  const Result none = run("soil_3d", 1, "none", {"--resume"});
  EXPECT_EQ(none.code, 1) << none.output;
  EXPECT_NE(none.output.find("holds no checkpoint"), std::string::npos) << none.output;
}

}  // namespace
}  // namespace mudlark
