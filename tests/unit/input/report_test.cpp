#include "input/report.hpp"

#include <gtest/gtest.h>

namespace mudlark {
namespace {

const std::vector<std::string> known{"friction_angle", "poisson_ratio", "porosity", "end"};

TEST(Report, FindsTheNearestWordToATypingError) {
  EXPECT_EQ(nearest_word("frction_angle", known), "friction_angle");
  EXPECT_EQ(nearest_word("poison_ratio", known), "poisson_ratio");
  EXPECT_EQ(nearest_word("prorosity", known), "porosity");
  EXPECT_EQ(nearest_word("ned", known), "end");
  const std::vector<std::string> tables{"soil", "soil_solver"};
  EXPECT_EQ(nearest_word("soil_solvr", tables), "soil_solver");
  EXPECT_EQ(nearest_word("soils", tables), "soil");
}

TEST(Report, ProposesNothingForAWordThatIsLikeNone) {
  EXPECT_EQ(nearest_word("temperature", known), "");
}

TEST(Report, SortsMistakesByLineAndIndentsReasons) {
  Report report;
  report.add({"a.toml", 20}, "unknown key x");
  report.add_impossible({"a.toml", 14}, "soil.poisson_ratio", "0.52", "needs nu < 0.5",
                        "Sand: 0.3.");
  report.add({"--set y=1", 0}, "unknown key y");
  EXPECT_EQ(report.text(),
            "a.toml:14: soil.poisson_ratio = 0.52 is not possible\n  (needs nu < 0.5). Sand: 0.3.\n"
            "a.toml:20: unknown key x\n"
            "--set y=1: unknown key y");
}

TEST(Report, PutsReasonsIntoBracketsWithoutTheirFullStop) {
  EXPECT_EQ(without_full_stop("Unexpected token at position 4."), "Unexpected token at position 4");
  EXPECT_EQ(without_full_stop("as in ..."), "as in ...");
}

TEST(Report, EscapesTextsForToml) { EXPECT_EQ(toml_text("a\"b\\c\n"), "\"a\\\"b\\\\c\\u000a\""); }

}  // namespace
}  // namespace mudlark
