// ranks: 1
// One-dimensional consolidation against Terzaghi's series, and the undrained limit.
#include <gtest/gtest.h>

#include <array>

#include "verification/soil/column.hpp"

namespace mudlark {
namespace {

using namespace soil_column;

// The step follows the undrained wave alone: no permeability shortens it. A column of 1 m is slow
// enough against its own waves up to k = 1e-3 m/s, one of 10 m up to 1e-2 m/s.
TEST(Consolidation, FollowsTerzaghiWithinOnePercentOfTheLoadAtFortyCells) {
  Column column;
  EXPECT_LT(isochrone_error(column), 0.01);
}

TEST(Consolidation, OfCoarseSandFollowsTerzaghiInALayerOfTenMetres) {
  Column column;
  column.cells = 20;
  column.height = 10.0;
  column.conductivity = 1e-2;
  EXPECT_LT(isochrone_error(column), 0.01);
}

TEST(Consolidation, ErrorFallsWithRefinement) {
  Column coarse, fine;
  coarse.cells = 10;
  fine.cells = 20;
  const double order = std::log2(isochrone_error(coarse) / isochrone_error(fine));
  std::printf("Terzaghi: order %.2f from 10 to 20 cells\n", order);
  EXPECT_GT(order, 1.0);
}

// Thousands of times below the permeability that would limit an explicit drag.
TEST(Consolidation, KeepsTheUndrainedAnswerWhenSoilHardlyDrains) {
  for (const double conductivity : {1e-7, 1e-9}) {
    Column column;
    column.cells = 20;
    column.conductivity = conductivity;
    column.undrained_start = false;
    column.ramp = 0.1;
    ColumnRun run(column);
    run.steps(20000);
    double sum = 0.0;
    int count = 0;
    for (std::size_t p = 0; p < run.points().size(); ++p) {
      if (run.points().start[1][p] > 0.9) continue;  // the drained end
      EXPECT_NEAR(run.points().pore_pressure[p] / column.load, column.undrained_share(), 0.01);
      sum += run.points().pore_pressure[p] / column.load;
      ++count;
    }
    std::printf("undrained: k = %g m/s: p0/q = %.5f, exact %.5f\n", conductivity, sum / count,
                column.undrained_share());
    EXPECT_NEAR(sum / count, 0.97557, 1e-3);
  }
}

// Table 1 of the paper under 400 kPa; closed forms of the four laws (Cauchy or Kirchhoff stress,
// logarithmic or engineering strain) for the drained column of 1 m.
TEST(Consolidation, AtLargeStrainEndsWhereEachStrainMeasureSays) {
  const std::array<double, 4> exact{0.29714, 0.25706, 0.20937, 0.22907};
  for (std::size_t law = 0; law < exact.size(); ++law) {
    Column column;
    column.cells = 10;
    column.conductivity = 1e-2;
    column.load = 4e5;
    column.undrained_start = false;
    column.strain = static_cast<StrainMeasure>(law);
    ColumnRun run(column);
    run.until(4.0);
    std::printf("large strain, law %zu: settlement %.5f m, exact %.5f m\n", law,
                run.settlement(1.0), exact[law]);
    EXPECT_NEAR(run.settlement(1.0), exact[law], 0.01 * exact[law]);
  }
}

// Anura3D's tutorial: cells of 0.1 m, step load, no damping. It gets 0.265 to 0.34 m where theory
// says 0.2527 m.
TEST(Consolidation, OfTheTutorialSettlesAsTheoryOnTheCoarsestGrid) {
  for (const int cells : {10, 20}) {
    Column column;
    column.cells = cells;
    column.conductivity = 1.0214e-9 * 9810.0 / 1.002e-3;
    column.load = 4e5;
    column.undrained_start = false;
    column.damping = 0.0;
    column.points_per_cell = 9;
    column.strain = StrainMeasure::logarithmic;
    ColumnRun run(column);
    run.until(2.5);
    std::printf("tutorial, %d cells: %.5f m, theory 0.25269 m\n", cells, run.settlement(0.983));
    EXPECT_NEAR(run.settlement(0.983), 0.2527, 0.01 * 0.2527);
  }
}

}  // namespace
}  // namespace mudlark
