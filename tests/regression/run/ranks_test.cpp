/// The number of ranks does not change the answer: all gauges of small cases on one rank and more.
#include "regression/run/runs.hpp"

namespace mudlark {
namespace {

class Ranks : public RunTest {
 protected:
  void expect_the_same_on_ranks(const std::string& name, const std::vector<int>& numbers = {3}) {
    const Result one = run(name, 1, "one");
    ASSERT_EQ(one.code, 0) << one.output;
    double worst = 0.0;
    for (const int ranks : numbers) {
      const std::string into = "on " + std::to_string(ranks);
      const Result several = run(name, ranks, into);
      ASSERT_EQ(several.code, 0) << several.output;
      SCOPED_TRACE(into + " ranks");
      EXPECT_EQ(entry_of(results(into), "ranks"), std::to_string(ranks));
      worst = std::max(worst, compare_gauges("one", into, 1e-10));
    }
    RecordProperty("largest_relative_difference", std::to_string(worst));
    printf("%s: largest relative difference %.3g\n", name.c_str(), worst);
  }
};

TEST_F(Ranks, GiveTheSameDamBreakOverAMoundOfSoil) {
  expect_the_same_on_ranks("dam_on_bed_2d", {2, 3, 4});
}

TEST_F(Ranks, GiveTheSameDamBreakOverASlopingBedIn3D) { expect_the_same_on_ranks("dam_on_bed_3d"); }

TEST_F(Ranks, GiveTheSameDamBreakWithOneWater) { expect_the_same_on_ranks("one_water_2d"); }

TEST_F(Ranks, GiveTheSameDamBreakOverGrainsThatYield) {
  expect_the_same_on_ranks("one_water_grains_2d");
}

TEST_F(Ranks, GiveTheSameDryBankThatTakesInWater) {
  expect_the_same_on_ranks("one_water_partly_filled_2d");
}

TEST_F(Ranks, GiveTheSameLeveeBetweenSidesThatLetWaterThrough) {
  expect_the_same_on_ranks("one_water_sides_2d");
}

TEST_F(Ranks, GiveTheSameTideBesideALevee) { expect_the_same_on_ranks("one_water_tide_2d"); }

TEST_F(Ranks, GiveTheSameBedThatComesToRestUnderWater) {
  expect_the_same_on_ranks("one_water_rest_2d");
}

TEST_F(Ranks, GiveTheSameWallPushedThroughASubmergedBed) {
  expect_the_same_on_ranks("one_water_solid_2d");
}

TEST_F(Ranks, GiveTheSameBlockThatWaterPushesOnABed) {
  expect_the_same_on_ranks("one_water_free_2d");
}

TEST_F(Ranks, GiveTheSameSlideIntoAReservoirIn3D) {
  expect_the_same_on_ranks("one_water_slide_3d");
}

TEST_F(Ranks, GiveTheSameBlockThatWaterPushesOnAFloor) { expect_the_same_on_ranks("free_2d"); }

TEST_F(Ranks, GiveTheSameThrownBlockOfSoilIn3D) { expect_the_same_on_ranks("soil_3d"); }

TEST_F(Ranks, GiveTheSameLumpWhosePointsAreSplit) { expect_the_same_on_ranks("drawn"); }

TEST_F(Ranks, GiveTheSameFootingAndPileInImplicitSteps) {
  expect_the_same_on_ranks("solid_implicit");
}

TEST_F(Ranks, GiveTheSameStages) { expect_the_same_on_ranks("stages"); }

TEST_F(Ranks, GiveTheSameFlowAgainstAPorousBlockIn3D) { expect_the_same_on_ranks("flow_3d"); }

}  // namespace
}  // namespace mudlark
